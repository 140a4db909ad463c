using System;
using System.Collections.Generic;
using System.IO;
using System.Threading;
using DemoTests.Support;

namespace DemoTests.CollisionDetection;

/// <summary>Tables of the report, in its order.</summary>
enum ConvexPairTable
{
    /// <summary>Single tests against the reference.</summary>
    Errors,

    /// <summary>What searches took that knew nothing.</summary>
    Effort,

    /// <summary>Slow sequences against the reference.</summary>
    Sequences,

    /// <summary>What the searches of slow sequences took.</summary>
    SequenceEffort,

    /// <summary>What the searches of a pile of hulls took.</summary>
    Pile,
}

/// <summary>
/// Collects tables of a test run. When the environment variable PHYSICS_CONVEX_REPORT names a file, they are kept there, behind what of the
/// file stands before the first of them.
/// </summary>
static class ConvexPairReport
{
    static readonly (string Title, string Header)[] titles =
    [
        ("## Table 1: single tests", ConvexPairTally.Header),
        ("## Table 2: searches that know nothing", Header("pair | regime | ", ConvexPairEffort.Columns)),
        ("## Table 3: slow sequences", Header("pair | of | states | ", ConvexSequenceTally.Columns)),
        ("## Table 4: searches of the slow sequences", Header("pair | states | ", ConvexPairEffort.Columns)),
        ("## Table 5: searches of a pile", Header("hulls | steps | states | known % | ", ConvexPairEffort.Columns)),
    ];

    static readonly SortedDictionary<(ConvexPairTable Table, string Key), string> tables = [];
    static readonly Lock gate = new();

    /// <summary>Adds rows to a table; the keys order them.</summary>
    public static void Add(ConvexPairTable table, string key, string rows)
    {
        lock (gate)
        {
            tables[(table, key)] = rows;
            if (Environment.GetEnvironmentVariable("PHYSICS_CONVEX_REPORT") is { Length: > 0 } path)
                Write(path);
        }
    }

    static string Header(string first, string columns)
    {
        var header = $"| {first}{columns}";
        return $"{header}\n|{new string('|', header.AsSpan().Count('|') - 1).Replace("|", "---|", StringComparison.Ordinal)}";
    }

    static void Write(string path)
    {
        var text = File.Exists(path) ? File.ReadAllText(path) : "";
        var start = text.IndexOf("## Table ", StringComparison.Ordinal);
        text = start >= 0 ? text[..start] : text;
        ConvexPairTable? last = null;
        foreach (var ((table, _), rows) in tables)
        {
            if (table != last)
                text += $"{(last is null ? "" : "\n")}{titles[(int)table].Title}\n\n{titles[(int)table].Header}\n";
            text += $"{rows}\n";
            last = table;
        }
        File.WriteAllText(path, text);
    }
}
