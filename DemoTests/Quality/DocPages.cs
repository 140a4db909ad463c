using System;
using System.Collections.Generic;
using System.Linq;
using System.Text.RegularExpressions;

namespace DemoTests.Quality;

/// <summary>The pages of the documentation and what is in them.</summary>
static partial class DocPages
{
    /// <summary>Relative paths of all pages.</summary>
    public static IReadOnlyList<string> All { get; } =
        [.. RepositoryFiles.Find(".", "*.md").Select(path => path.StartsWith("./", StringComparison.Ordinal) ? path[2..] : path)];

    /// <summary>Blocks of C# code of a page.</summary>
    public static IEnumerable<string> CodeBlocks(string page) =>
        CodeBlock().Matches(RepositoryFiles.Read(page)).Select(match => match.Groups["code"].Value);

    /// <summary>What the programs of a page print, by its own account.</summary>
    public static IEnumerable<string> PrintedLines(string page) => PrintedBlock().Matches(RepositoryFiles.Read(page))
        .SelectMany(match => match.Groups["text"].Value.Split('\n', StringSplitOptions.RemoveEmptyEntries)).Select(line => line.TrimEnd());

    /// <summary>Commands of a page, for a shell.</summary>
    public static IEnumerable<string> Commands(string page) => CommandBlock().Matches(RepositoryFiles.Read(page))
        .SelectMany(match => match.Groups["commands"].Value.Split('\n', StringSplitOptions.RemoveEmptyEntries)).Select(line => line.TrimEnd());

    /// <summary>Targets of the links of a page that lead to files.</summary>
    public static IEnumerable<string> FileLinks(string page) => Link().Matches(RepositoryFiles.Read(page))
        .Select(match => match.Groups["target"].Value.Split('#')[0])
        .Where(target => target.Length > 0 && !target.Contains("://", StringComparison.Ordinal));

    /// <summary>Cells of the rows of the tables of a page, those of head rows and rules included.</summary>
    public static IEnumerable<string[]> TableRows(string page) => RepositoryFiles.Read(page).Split('\n')
        .Where(line => line.StartsWith('|'))
        .Select(line => line.Trim().Trim('|').Split('|').Select(cell => cell.Trim().Replace("`", "", StringComparison.Ordinal)).ToArray());

    [GeneratedRegex(@"^```csharp\r?\n(?<code>.*?)^```", RegexOptions.Multiline | RegexOptions.Singleline)]
    private static partial Regex CodeBlock();

    [GeneratedRegex(@"^```text\r?\n(?<text>.*?)^```", RegexOptions.Multiline | RegexOptions.Singleline)]
    private static partial Regex PrintedBlock();

    [GeneratedRegex(@"^```sh\r?\n(?<commands>.*?)^```", RegexOptions.Multiline | RegexOptions.Singleline)]
    private static partial Regex CommandBlock();

    [GeneratedRegex(@"\]\((?<target>[^)\s]+)\)")]
    private static partial Regex Link();
}
