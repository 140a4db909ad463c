using System;
using System.IO;
using System.Linq;
using BepuPhysics;
using BepuUtilities.Memory;
using Xunit;

namespace DemoTests.Quality;

/// <summary>
/// The public surface is what Docs/PublicApi.txt says. A change of that file is a change that games see, to be looked at. With the
/// environment variable PHYSICS_UPDATE_PUBLIC_API set to 1 the test writes the file anew.
/// </summary>
public class PublicApiTests
{
    const string Page = "Docs/PublicApi.txt";

    [Fact]
    public void Public_surface_is_the_recorded_one()
    {
        string[] actual = [.. PublicApi.Describe(typeof(BufferPool).Assembly), .. PublicApi.Describe(typeof(Simulation).Assembly)];
        if (Environment.GetEnvironmentVariable("PHYSICS_UPDATE_PUBLIC_API") == "1")
            File.WriteAllText(RepositoryFiles.PathOf(Page), string.Join('\n', actual) + "\n");
        var recorded = RepositoryFiles.Read(Page).ReplaceLineEndings("\n").TrimEnd('\n').Split('\n');
        // Whole texts, since a line alone does not say whose member it is.
        var added = Qualified(actual).Except(Qualified(recorded)).Select(line => "+ " + line);
        var removed = Qualified(recorded).Except(Qualified(actual)).Select(line => "- " + line);
        var differences = removed.Concat(added).ToArray();
        Assert.True(differences.Length == 0, $"{Page} differs in {differences.Length} lines:\n{string.Join('\n', differences.Take(50))}");
        Assert.Equal(recorded.Length, actual.Length);
    }

    // Members with the type that they belong to.
    static string[] Qualified(string[] lines)
    {
        var type = "";
        return [.. lines.Select(line => line.StartsWith(' ') ? $"{type}{line}" : type = line)];
    }
}
