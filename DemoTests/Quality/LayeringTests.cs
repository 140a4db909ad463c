using System;
using System.Collections.Generic;
using System.Linq;
using Xunit;

namespace DemoTests.Quality;

/// <summary>Docs/Architecture.md says who may know whom, and which folder holds which namespace. The sources must say the same.</summary>
public class LayeringTests
{
    const string Page = "Docs/Architecture.md";
    const string Everything = "all";
    const string Root = "Simulation";

    static readonly Dictionary<string, string[]> mayKnow = ReadTable("layer", "may know")
        .ToDictionary(row => row[0], row => row[1].Split(',', StringSplitOptions.TrimEntries | StringSplitOptions.RemoveEmptyEntries));

    static readonly HashSet<(string Layer, string Type)> exceptions =
        [.. ReadTable("layer", "type", "why").Select(row => (row[0], row[1]))];

    [Fact]
    public void Types_use_only_what_their_layer_may_know()
    {
        var files = LibraryFiles("BepuPhysics").ToDictionary(file => file, RepositoryFiles.Read);
        var layerOfType = FindTypes(files);
        SortedSet<string> violations = [];
        foreach (var (file, text) in files)
        {
            var layer = LayerOf(file);
            foreach (var name in SourceText.UsedNames(text))
            {
                if (layerOfType.TryGetValue(name, out var other) && !Allows(layer, other) && !exceptions.Contains((layer, name)))
                    violations.Add($"{layer} uses {name} of {other} ({file})");
            }
        }
        Assert.True(violations.Count == 0, $"{Page} does not allow:\n{string.Join('\n', violations)}");
    }

    [Fact]
    public void Exceptions_are_still_needed()
    {
        var files = LibraryFiles("BepuPhysics").ToDictionary(file => file, RepositoryFiles.Read);
        var used = files.SelectMany(file => SourceText.UsedNames(file.Value).Select(name => (LayerOf(file.Key), name))).ToHashSet();
        var layerOfType = FindTypes(files);
        Assert.All(exceptions, e => Assert.True(
            used.Contains((e.Layer, e.Type)) && layerOfType.TryGetValue(e.Type, out var other) && !Allows(e.Layer, other), $"{e} is not needed."));
    }

    [Theory, InlineData("BepuPhysics"), InlineData("BepuUtilities")]
    public void Folders_hold_the_namespaces_that_the_page_says(string project)
    {
        var table = ReadTable("folder", "what is in it", "namespace").ToDictionary(
            row => row[0], row => row[2].Split(',', StringSplitOptions.TrimEntries));
        List<string> violations = [];
        foreach (var file in LibraryFiles(project))
        {
            if (SourceText.Namespace(RepositoryFiles.Read(file)) is not string found)
                continue;
            var folder = FolderOf(file);
            while (!table.ContainsKey(folder) && folder.Contains('/', StringComparison.Ordinal))
                folder = FolderOf(folder);
            if (!table.TryGetValue(folder, out var expected) || !expected.Contains(found))
                violations.Add($"{file} has the namespace {found}");
        }
        Assert.True(violations.Count == 0, $"{Page} does not say so:\n{string.Join('\n', violations)}");
    }

    [Fact]
    public void Every_folder_of_the_library_is_a_layer() =>
        Assert.All(LibraryFiles("BepuPhysics").Select(LayerOf).Distinct(), layer => Assert.Contains(layer, mayKnow));

    // Layers by type name. Names that two layers declare cannot be told apart in text; there must be none among those that others may see.
    static Dictionary<string, string> FindTypes(Dictionary<string, string> files)
    {
        Dictionary<string, string> layers = [];
        HashSet<string> ambiguous = [];
        foreach (var (file, text) in files)
        {
            foreach (var type in SourceText.DeclaredTypes(text))
            {
                if (!layers.TryAdd(type, LayerOf(file)) && layers[type] != LayerOf(file))
                    ambiguous.Add(type);
            }
        }
        Assert.True(layers.Count > 100, "The sources were not understood.");
        Assert.Empty(ambiguous);
        return layers;
    }

    static bool Allows(string layer, string other) =>
        layer == other || mayKnow[layer].Contains(Everything) || mayKnow[layer].Contains(other);

    // The longest path of the table that the file is under.
    static string LayerOf(string file)
    {
        var folder = FolderOf(file);
        for (var path = folder["BepuPhysics".Length..].TrimStart('/'); path.Length > 0; path = FolderOf(path))
        {
            if (mayKnow.ContainsKey(path) || !path.Contains('/', StringComparison.Ordinal))
                return path;
        }
        return Root;
    }

    static string FolderOf(string path) => path[..Math.Max(0, path.LastIndexOf('/'))];

    static IEnumerable<string> LibraryFiles(string project) => RepositoryFiles.Find(project, "*.cs");

    // Rows of the table whose head has these cells.
    static string[][] ReadTable(params string[] head)
    {
        var rows = DocPages.TableRows(Page).SkipWhile(row => !row.SequenceEqual(head)).Skip(2)
            .TakeWhile(row => row.Length == head.Length).ToArray();
        Assert.True(rows.Length > 0, $"{Page} has no table of {string.Join(", ", head)}.");
        // Tables of as many columns may follow: each begins with a head and a rule.
        var rule = Array.FindIndex(rows, row => row[0].StartsWith("--", StringComparison.Ordinal));
        return rule < 0 ? rows : rows[..(rule - 1)];
    }
}
