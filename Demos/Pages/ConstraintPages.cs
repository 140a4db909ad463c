using System;
using System.Collections.Generic;
using System.IO;
using System.Linq;
using System.Reflection;
using System.Text;
using BepuPhysics;
using BepuPhysics.Constraints;

namespace Demos.Pages;

/// <summary>A page and a picture for each type of joint, and a page that lists them, made from the types, their comments and their examples.</summary>
static class ConstraintPages
{
    /// <summary>Name of the page that lists the others.</summary>
    public const string Index = "README.md";

    const string Command = "dotnet run -c Release --project Demos -- constraints --write Docs/Constraints";

    static readonly (RowKind Kind, string Name, string Meaning)[] kinds =
    [
        (RowKind.Equality, "joint", "always holds"),
        (RowKind.Inequality, "limit", "does nothing within its range, and pushes only back into it"),
        (RowKind.Servo, "servo", "brings to a place, with limits of speed and force"),
        (RowKind.Motor, "motor", "holds a velocity, with a limit of force; where things are is the same to it"),
    ];

    /// <summary>All files: their names and what is in them.</summary>
    /// <exception cref="Scenes.SceneException">The library was built without its documentation file.</exception>
    public static SortedDictionary<string, string> Write()
    {
        DocComments comments = new(typeof(Solver).Assembly, name => JointFacts.All.Any(facts => facts.Name == name));
        SortedDictionary<string, string> files = new(StringComparer.Ordinal) { [Index] = IndexPage(comments) };
        foreach (var facts in JointFacts.All)
        {
            JointPicture picture = new(facts);
            files.Add($"{facts.Name}.svg", picture.ToSvg());
            files.Add($"{facts.Name}.md", Page(facts, picture, comments));
        }
        return files;
    }

    /// <summary>The example of a type, as it stands in its source.</summary>
    public static string ExampleText(string name)
    {
        using StreamReader reader = new(typeof(ConstraintPages).Assembly.GetManifestResourceStream($"{nameof(JointExamples)}.cs")!);
        var lines = reader.ReadToEnd().ReplaceLineEndings("\n").Split('\n');
        var start = Array.FindIndex(lines, line => line.Contains($" {name}(Simulation simulation", StringComparison.Ordinal));
        var end = Array.FindIndex(lines, start, line => line.EndsWith(';'));
        return string.Concat(lines[(start + 1)..(end + 1)].Select(line => line[8..] + "\n"));
    }

    static string Page(JointFacts facts, JointPicture picture, DocComments comments)
    {
        var (_, kind, meaning) = kinds.First(kind => kind.Kind == facts.Kind);
        StringBuilder page = new($"# {facts.Name}\n\n");
        page.Append(comments.Read(facts.Description, "summary")).Append("\n\n");
        page.Append($"![{facts.Name}]({facts.Name}.svg)\n\n");
        if (comments.Read(facts.Description, "remarks") is { Length: > 0 } remarks)
            page.Append(remarks).Append("\n\n");
        page.Append("| kind | bodies | rows | type id |\n|---|---|---|---|\n");
        page.Append($"| {kind}: {meaning} | {facts.BodyCount} | {facts.RowCount} | {facts.TypeId} |\n\n");
        var motions = picture.Motions.Count == 0 ? "nothing" : string.Join(", ", picture.Motions);
        page.Append(facts.Kind == RowKind.Equality ? $"What {picture.Moving} can do in the picture" : $"What it acts on in the picture, of {picture.Moving}");
        page.Append($": {motions}.\n\n## Settings\n\n");
        AppendFields(page, facts.Description, comments);
        page.Append("\n## Example\n\nIt adds what the picture shows: ");
        page.Append(string.Join(", ", JointStage.Places.Take(facts.BodyCount).Select((place, i) =>
            FormattableString.Invariant($"`{"abcd"[i]}` at ({place.X}, {place.Y}, {place.Z})"))));
        page.Append(" m, unturned.\n\n```csharp\n").Append(ExampleText(facts.Name)).Append("```\n\n");
        page.Append($"[All constraints]({Index}), settings that many of them have included.\n");
        return page.ToString();
    }

    static string IndexPage(DocComments comments)
    {
        StringBuilder page = new("# Constraints\n\n");
        page.Append("All constraints that games add by hand, with a page each. One between two bodies decides on as many of the six motions of one against\n");
        page.Append("the other as it has rows. Several on the same bodies add up: a hinge and a limit of its twist, a slider and a motor.\n");
        page.Append($"All settings that are not given are zero. Written by `{Command}`.\n");
        foreach (var (kind, name, meaning) in kinds)
        {
            page.Append($"\n## {char.ToUpperInvariant(name[0])}{name[1..]}s\n\nA {name} {meaning}.\n\n");
            page.Append("| constraint | bodies | rows | type id | what it does |\n|---|---|---|---|---|\n");
            foreach (var facts in JointFacts.All.Where(facts => facts.Kind == kind))
            {
                var summary = comments.Read(facts.Description, "summary");
                page.Append($"| [{facts.Name}]({facts.Name}.md) | {facts.BodyCount} | {facts.RowCount} | {facts.TypeId} | {summary} |\n");
            }
        }
        page.Append("\n## Settings that many have\n");
        foreach (var settings in new[] { typeof(SpringSettings), typeof(ServoSettings), typeof(MotorSettings) })
        {
            page.Append($"\n### {settings.Name}\n\n{comments.Read(settings, "summary")} {comments.Read(settings, "remarks")}".TrimEnd()).Append("\n\n");
            AppendFields(page, settings, comments);
        }
        return page.ToString();
    }

    // Properties that can be set are settings too, said in other units.
    static void AppendFields(StringBuilder page, Type type, DocComments comments)
    {
        page.Append("| setting | type | meaning |\n|---|---|---|\n");
        foreach (var field in type.GetFields(BindingFlags.Instance | BindingFlags.Public))
            Append(field, field.FieldType);
        foreach (var property in type.GetProperties(BindingFlags.Instance | BindingFlags.Public).Where(property => property.CanWrite))
            Append(property, property.PropertyType);

        void Append(MemberInfo member, Type memberType) =>
            page.Append($"| `{member.Name}` | `{(memberType == typeof(float) ? "float" : memberType.Name)}` | {comments.Read(member, "summary")} |\n");
    }
}
