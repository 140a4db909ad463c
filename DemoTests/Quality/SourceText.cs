using System.Collections.Generic;
using System.Linq;
using System.Text.RegularExpressions;

namespace DemoTests.Quality;

/// <summary>What can be told from the text of a C# file without a compiler.</summary>
static partial class SourceText
{
    /// <summary>The text without comments, strings and using directives.</summary>
    public static string Code(string text) => Noise().Replace(text, " ");

    /// <summary>Namespace that a file declares; null where it declares none.</summary>
    public static string? Namespace(string text) =>
        NamespaceDeclaration().Match(text) is { Success: true } match ? match.Groups["name"].Value : null;

    /// <summary>Names of the types that a file declares outside of other types: those that begin in the first column.</summary>
    public static IEnumerable<string> DeclaredTypes(string text) =>
        TypeDeclaration().Matches(Code(text)).Select(match => match.Groups["name"].Value).Distinct();

    /// <summary>
    /// Names that a file uses and that may be types: identifiers that are no member of something, not assigned to and not called, unless
    /// to make a new one.
    /// </summary>
    public static IEnumerable<string> UsedNames(string text) =>
        Name().Matches(Code(text)).Select(match => match.Value).Distinct();

    [GeneratedRegex(
        @"//[^\n]*|/\*.*?\*/|""""""(?s:.*?)""""""|@""(?:[^""]|"""")*""|""(?:\\.|[^""\\\n])*""|^using\s[^(=;]*;",
        RegexOptions.Multiline | RegexOptions.Singleline)]
    private static partial Regex Noise();

    [GeneratedRegex(@"^namespace\s+(?<name>[\w.]+)\s*;", RegexOptions.Multiline)]
    private static partial Regex NamespaceDeclaration();

    [GeneratedRegex(
        @"^(?:[a-z]+\s+)*(?:class|struct|interface|enum|record|delegate\s+[\w<>\[\]?]+)\s+(?<name>[A-Z]\w*)",
        RegexOptions.Multiline)]
    private static partial Regex TypeDeclaration();

    [GeneratedRegex(@"(?<=\bnew )[A-Z]\w+|(?<![\w.])[A-Z]\w+\b(?!\s*(?:\(|=[^=>]))")]
    private static partial Regex Name();
}
