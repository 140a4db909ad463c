using System.Collections.Generic;
using System.IO;
using System.IO.Compression;
using System.Linq;
using System.Text.RegularExpressions;
using System.Xml.Linq;
using Xunit;

namespace DemoTests.Quality;

/// <summary>What a game gets: packages with everything in them, from which the program of the README can be built.</summary>
public partial class PackageTests(Packages packages) : IClassFixture<Packages>
{
    public static TheoryData<string> Ids => [.. Packages.Ids];

    [Theory, MemberData(nameof(Ids))]
    public void A_package_holds_library_documentation_readme_and_licence(string id)
    {
        using var archive = ZipFile.OpenRead(packages.File(id));
        var assembly = id["Tootbird.".Length..];
        var entries = archive.Entries.ToDictionary(entry => entry.FullName, entry => entry.Length);
        foreach (var name in new[] { $"lib/net10.0/{assembly}.dll", $"lib/net10.0/{assembly}.xml", "README.md", "LICENSE" })
            Assert.True(entries.GetValueOrDefault(name) > 0, $"{id} has no {name}.");

        using var manifest = archive.GetEntry($"{id}.nuspec")!.Open();
        var metadata = XDocument.Load(manifest).Root!.Elements().First(element => element.Name.LocalName == "metadata");
        XElement? Find(string name) => metadata.Elements().FirstOrDefault(element => element.Name.LocalName == name);
        Assert.Equal("MIT", Find("license")?.Value);
        Assert.Equal("expression", Find("license")?.Attribute("type")?.Value);
        Assert.Equal("README.md", Find("readme")?.Value);
        Assert.False(string.IsNullOrWhiteSpace(Find("description")?.Value));
        // Nothing outside the framework but the sister library.
        var dependencies = metadata.Descendants().Where(element => element.Name.LocalName == "dependency")
            .Select(element => element.Attribute("id")!.Value);
        Assert.Equal(id == "Tootbird.BepuPhysics" ? ["Tootbird.BepuUtilities"] : [], dependencies);
    }

    [Theory, MemberData(nameof(Ids))]
    public void Symbols_are_packed_beside_the_library(string id)
    {
        using var archive = ZipFile.OpenRead(packages.File(id, ".snupkg"));
        Assert.Contains(archive.Entries, entry => entry.FullName == $"lib/net10.0/{id["Tootbird.".Length..]}.pdb");
    }

    [Fact]
    public void Hello_world_of_the_readme_runs_from_the_packages()
    {
        var folder = packages.CreateFolder("hello");
        File.WriteAllText(Path.Combine(folder, "Program.cs"), DocPages.CodeBlocks("README.md").First());
        File.WriteAllText(Path.Combine(folder, "hello.csproj"), $"""
            <Project Sdk="Microsoft.NET.Sdk">
              <PropertyGroup>
                <OutputType>Exe</OutputType>
                <TargetFramework>net10.0</TargetFramework>
              </PropertyGroup>
              <ItemGroup>
                <PackageReference Include="Tootbird.BepuPhysics" Version="{packages.Version}" />
              </ItemGroup>
            </Project>
            """);
        // The folder of the packages is the only source, and nothing that an earlier build of this version left is taken for it.
        File.WriteAllText(Path.Combine(folder, "nuget.config"), $"""
            <configuration>
              <packageSources><clear /><add key="packed" value="{packages.Folder}" /></packageSources>
              <config><add key="globalPackagesFolder" value="{Path.Combine(folder, "cache")}" /></config>
            </configuration>
            """);
        Packages.Dotnet("build -c Release -o run --disable-build-servers", folder);
        var output = Packages.Dotnet(Path.Combine("run", "hello.dll"), folder);
        Assert.Matches(Height(), output);
    }

    // Half the height of the box, give or take the sink of a rigid contact, in whatever way the machine writes numbers.
    [GeneratedRegex(@"^The box rests at a height of 0[.,](49|50) m\.\s*$")]
    private static partial Regex Height();
}
