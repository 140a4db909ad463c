using System;
using System.Collections.Generic;
using System.IO;
using System.Threading;

namespace DemoTests.CollisionDetection;

/// <summary>Collects tables of a test run. When the environment variable PHYSICS_CONVEX_REPORT names a file, they are kept there.</summary>
static class ConvexPairReport
{
    const string Introduction = """
        # Convex pairs against a reference

        Written by `ConvexPairTests` when `PHYSICS_CONVEX_REPORT` names this file; `PHYSICS_FULL_TESTS=1` for the full number of poses.

        Each pair is tested once, without anything known from an earlier step. Lengths are relative to the outer radius of the smaller
        shape. *depth*: deepest contact against the least depth (the distance when apart) in double precision. *excess*: depth along the
        normal, less the least one. *normal*: degrees to the nearest normal that is as good as the best one. *wrong*: excess above 0.01.
        *missed*: overlapping by more than 0.001, no contact. *unseen*: apart by less than the margin of 0.15, no contact. *ghosts*: apart
        by more, but a contact. *outside*: contacts farther than 0.001 beyond the middle between the two surfaces. *broken*: not finite, or
        a normal that is not of unit length. Half of the shapes are plates, discs, needles, rods and slivers of 1:20 to 1:100, a quarter of
        the pairs differs in size by up to 100, in a quarter the smaller shape is of any size from 1 mm to 1 km.


        """;

    static readonly SortedDictionary<string, string> tables = new(StringComparer.Ordinal);
    static readonly Lock gate = new();

    /// <summary>Adds a table with its heading; the headings order the file.</summary>
    public static void Add(string heading, string table)
    {
        lock (gate)
        {
            tables[heading] = table;
            if (Environment.GetEnvironmentVariable("PHYSICS_CONVEX_REPORT") is not { Length: > 0 } path)
                return;
            var text = Introduction;
            foreach (var (name, rows) in tables)
                text += $"## {name}\n\n{rows}\n\n";
            File.WriteAllText(path, text.TrimEnd() + "\n");
        }
    }
}
