using System;
using System.Collections.Generic;
using System.Linq;
using Xunit;
using Xunit.Abstractions;

namespace DemoTests.Quality;

/// <summary>Sizes that keep files readable. Aims are reported, limits are kept.</summary>
public class StyleTests(ITestOutputHelper output)
{
    const int AimedLines = 400;
    const int MostLines = 500;
    const int AimedWidth = 140;
    const int MostWidth = 160;

    static readonly string[] projects = ["BepuUtilities", "BepuPhysics", "Demos", "DemoTests", "Benchmarks", "Build"];

    static IEnumerable<string> Files => projects.SelectMany(project => RepositoryFiles.Find(project, "*.cs"))
        .Where(file => !file.EndsWith(".g.cs", StringComparison.Ordinal));

    [Fact]
    public void Files_are_short()
    {
        List<string> tooLong = [];
        foreach (var file in Files)
        {
            var count = RepositoryFiles.Read(file).TrimEnd().Split('\n').Length;
            if (count > AimedLines)
                output.WriteLine($"{file}: {count} lines, aimed at {AimedLines}");
            if (count > MostLines)
                tooLong.Add($"{file}: {count} lines");
        }
        Assert.Empty(tooLong);
    }

    [Fact]
    public void Lines_fit_beside_another_window()
    {
        List<string> tooWide = [];
        foreach (var file in Files)
        {
            var widths = RepositoryFiles.Read(file).Split('\n').Select(line => line.TrimEnd().Length).ToArray();
            var aboveAim = widths.Count(width => width > AimedWidth);
            var aboveLimit = widths.Count(width => width > MostWidth);
            if (aboveAim > 0)
                output.WriteLine($"{file}: {aboveAim} lines above {AimedWidth}");
            if (aboveLimit > 0)
                tooWide.Add($"{file}: {aboveLimit} lines above {MostWidth}");
        }
        Assert.Empty(tooWide);
    }

    [Fact]
    public void Sources_do_not_use_what_the_style_leaves_out()
    {
        List<string> found = [];
        foreach (var file in Files)
        {
            var lines = RepositoryFiles.Read(file).Split('\n').Select(line => line.TrimStart());
            foreach (var line in lines)
            {
                if (line.StartsWith("#region", StringComparison.Ordinal) || line.StartsWith("global using", StringComparison.Ordinal) ||
                    (line.StartsWith("#if", StringComparison.Ordinal) && !file.Contains("/Diagnostics/", StringComparison.Ordinal)))
                    found.Add($"{file}: {line}");
            }
        }
        Assert.Empty(found);
    }

    [Fact]
    public void Namespaces_that_are_used_are_in_order()
    {
        List<string> found = [];
        foreach (var file in Files)
        {
            var lines = RepositoryFiles.Read(file).Split('\n').Where(line => line.StartsWith("using ", StringComparison.Ordinal)).ToArray();
            if (!lines.SequenceEqual(lines.OrderBy(KindOfUsing).ThenBy(line => line.TrimEnd(';'), StringComparer.OrdinalIgnoreCase)))
                found.Add(file);
        }
        Assert.Empty(found);
    }

    // Those of the framework, all others, members of types, other names of types.
    static int KindOfUsing(string line) => line switch
    {
        _ when line.StartsWith("using static ", StringComparison.Ordinal) => 2,
        _ when line.Contains('=', StringComparison.Ordinal) => 3,
        _ when line.StartsWith("using System;", StringComparison.Ordinal) || line.StartsWith("using System.", StringComparison.Ordinal) => 0,
        _ => 1,
    };
}
