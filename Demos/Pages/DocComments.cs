using System;
using System.Collections.Generic;
using System.IO;
using System.Linq;
using System.Reflection;
using System.Text.RegularExpressions;
using System.Xml.Linq;
using Demos.Scenes;

namespace Demos.Pages;

/// <summary>The documentation comments of a library, as text of pages.</summary>
sealed partial class DocComments
{
    readonly Dictionary<string, XElement> members;
    readonly Func<string, bool> hasPage;

    /// <summary>Reads the file that the compiler wrote beside a library.</summary>
    /// <exception cref="SceneException">There is none.</exception>
    public DocComments(Assembly library, Func<string, bool> hasPage)
    {
        this.hasPage = hasPage;
        var path = Path.ChangeExtension(library.Location, ".xml");
        if (!File.Exists(path))
            throw new SceneException($"there is no {path}: build with -p:GenerateDocumentationFile=true");
        members = XDocument.Load(path).Descendants("member").ToDictionary(member => member.Attribute("name")!.Value);
    }

    /// <summary>A part of the comment of a type, field or property; empty where it has none.</summary>
    /// <param name="member">The type, field or property.</param>
    /// <param name="part">Name of the part: summary, remarks.</param>
    public string Read(MemberInfo member, string part)
    {
        var name = member switch
        {
            Type type => $"T:{type.FullName}",
            FieldInfo => $"F:{member.DeclaringType!.FullName}.{member.Name}",
            _ => $"P:{member.DeclaringType!.FullName}.{member.Name}",
        };
        return members.TryGetValue(name, out var comment) && comment.Element(part) is { } element ? Space().Replace(Text(element), " ").Trim() : "";
    }

    string Text(XElement element) => string.Concat(element.Nodes().Select(node => node switch
    {
        XText text => text.Value,
        XElement { Name.LocalName: "see" } see => Link(see.Attribute("cref")!.Value),
        XElement { Name.LocalName: "c" } code => $"`{code.Value}`",
        XElement other => $" {Text(other)} ",
        _ => "",
    }));

    // "T:BepuPhysics.Constraints.Hinge", "F:BepuPhysics.Constraints.ServoSettings.MaximumForce"
    string Link(string reference)
    {
        var parts = reference[2..].Split('(')[0].Split('.');
        if (reference[0] != 'T')
            return $"`{parts[^2]}.{parts[^1]}`";
        return hasPage(parts[^1]) ? $"[{parts[^1]}]({parts[^1]}.md)" : $"`{parts[^1]}`";
    }

    [GeneratedRegex(@"\s+")]
    private static partial Regex Space();
}
