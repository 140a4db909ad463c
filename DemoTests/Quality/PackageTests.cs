using System;
using System.Buffers.Binary;
using System.Collections.Generic;
using System.IO;
using System.IO.Compression;
using System.Linq;
using System.Text;
using System.Text.Json;
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
        foreach (var name in new[] { $"lib/net10.0/{assembly}.dll", $"lib/net10.0/{assembly}.xml", "README.md", "LICENSE", "icon.png" })
            Assert.True(entries.GetValueOrDefault(name) > 0, $"{id} has no {name}.");

        using var manifest = archive.GetEntry($"{id}.nuspec")!.Open();
        var metadata = XDocument.Load(manifest).Root!.Elements().First(element => element.Name.LocalName == "metadata");
        XElement? Find(string name) => metadata.Elements().FirstOrDefault(element => element.Name.LocalName == name);
        Assert.Equal("MIT", Find("license")?.Value);
        Assert.Equal("expression", Find("license")?.Attribute("type")?.Value);
        Assert.Equal("README.md", Find("readme")?.Value);
        Assert.False(string.IsNullOrWhiteSpace(Find("description")?.Value));
        Assert.Equal("icon.png", Find("icon")?.Value);
        // The notes are about this version.
        Assert.Contains($"## {packages.Version.Split('-')[0]}", Find("releaseNotes")?.Value, StringComparison.Ordinal);
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

    // NuGet shows an icon of up to 128 x 128.
    [Theory, MemberData(nameof(Ids))]
    public void The_icon_is_a_small_picture(string id)
    {
        using var archive = ZipFile.OpenRead(packages.File(id));
        using var icon = archive.GetEntry("icon.png")!.Open();
        var head = new byte[24];
        icon.ReadExactly(head);
        Assert.Equal("\u0089PNG\r\n\u001a\n", Encoding.Latin1.GetString(head, 0, 8));
        Assert.Equal((128, 128), (BinaryPrimitives.ReadInt32BigEndian(head.AsSpan(16)), BinaryPrimitives.ReadInt32BigEndian(head.AsSpan(20))));
        Assert.InRange(archive.GetEntry("icon.png")!.Length, 100, 20_000);
    }

    [Theory, MemberData(nameof(Ids))]
    public void One_property_says_where_the_project_lives(string id)
    {
        const string home = "https://example.org/physics";
        var values = Packages.Dotnet(
            $"msbuild {id["Tootbird.".Length..]} -p:ProjectHome={home} -getProperty:PackageProjectUrl -getProperty:RepositoryUrl " +
            "-getProperty:RepositoryType -getProperty:EnableSourceLink -getProperty:EmbedUntrackedSources", RepositoryFiles.Root);
        using var json = JsonDocument.Parse(values);
        string? Property(string name) => json.RootElement.GetProperty("Properties").GetProperty(name).GetString();
        Assert.Equal((home, home, "git"), (Property("PackageProjectUrl"), Property("RepositoryUrl"), Property("RepositoryType")));
        Assert.NotEqual("false", Property("EnableSourceLink"));
        Assert.Equal("true", Property("EmbedUntrackedSources"));
    }

    // Word by word: a new project, the package, the program.
    [Fact]
    public void Commands_of_the_readme_make_a_program_that_runs()
    {
        var folder = packages.CreateFolder("readme");
        var game = Path.GetFullPath(Path.Combine(folder, "../hello"));
        WriteSources(folder);
        Directory.CreateDirectory(game);
        WriteSources(game);
        var commands = DocPages.Commands("README.md").ToArray();
        Assert.StartsWith("dotnet pack ", commands[0], StringComparison.Ordinal);
        foreach (var command in commands[1..])
            Packages.Dotnet(command["dotnet ".Length..].Replace("$PWD/packages", packages.Folder, StringComparison.Ordinal), folder);
        File.WriteAllText(Path.Combine(game, "Program.cs"), DocPages.CodeBlocks("README.md").First());
        Assert.Matches(Height(), Run(game, "hello"));
    }

    [Fact]
    public void The_guide_runs_as_it_is_pasted_and_prints_what_it_says()
    {
        const string page = "Docs/Guides/GettingStarted.md";
        var blocks = DocPages.CodeBlocks(page).ToLookup(block => TypeDeclaration().IsMatch(block));
        Assert.Single(blocks[true]);
        var folder = packages.CreateFolder("guide");
        WriteSources(folder);
        File.WriteAllText(Path.Combine(folder, "IceCallbacks.cs"), blocks[true].Single());
        File.WriteAllText(Path.Combine(folder, "Program.cs"), string.Join('\n', blocks[false]));
        WriteProject(folder, "guide");
        // In whatever way the machine writes numbers.
        var printed = Run(folder, "guide").Replace(',', '.').Split('\n', StringSplitOptions.RemoveEmptyEntries).Select(line => line.TrimEnd());
        Assert.Equal(DocPages.PrintedLines(page).Select(line => line.Replace(',', '.')), printed);
    }

    // In an assembly of its own, as that of a game, whatever is internal to the library is out of reach.
    [Fact]
    public void The_constraint_of_characters_could_be_a_games_own()
    {
        var folder = packages.CreateFolder("constraint");
        WriteSources(folder);
        WriteProject(folder, "constraint");
        foreach (var file in RepositoryFiles.Find("BepuPhysics/Characters", "CharacterMotion*.cs"))
            File.WriteAllText(Path.Combine(folder, Path.GetFileName(file)), RepositoryFiles.Read(file)
                .Replace("namespace BepuPhysics.Characters", "namespace Game", StringComparison.Ordinal)
                .Replace("ConstraintTypeIds.StaticCharacterMotion", "100", StringComparison.Ordinal)
                .Replace("ConstraintTypeIds.DynamicCharacterMotion", "101", StringComparison.Ordinal));
        File.WriteAllText(Path.Combine(folder, "Program.cs"), """
            using System.Numerics;
            using BepuPhysics;
            using BepuPhysics.Collidables;
            using BepuUtilities.Memory;

            using var pool = new BufferPool();
            using var simulation = Simulation.Create(
                pool, new DefaultNarrowPhaseCallbacks(), new DefaultPoseIntegratorCallbacks(Vector3.Zero), new SolveDescription(1, 4));
            var body = simulation.Bodies.Add(BodyDescription.CreateConvexDynamic(Vector3.Zero, 2, simulation.Shapes, new Sphere(1)));
            simulation.Solver.Add(body, new Game.StaticCharacterMotion
            {
                SurfaceBasis = Quaternion.Identity,
                MaximumHorizontalForce = 6,
                TargetVelocity = new(0, 4),
            });
            for (int i = 0; i < 60; ++i)
                simulation.Timestep(1 / 60f);
            Console.WriteLine(MathF.Round(-1000 * simulation.Bodies[body].Velocity.Linear.Z));
            """);
        // 6 N on 2 kg for a second, in mm/s.
        Assert.Equal("3000", Run(folder, "constraint").Trim());
    }

    // Takes minutes, a linker, and the compiler from the feed that the machine knows.
    [Theory]
    [InlineData("")]
    [InlineData("-p:IlcInstructionSet=native")]
    public void Compiled_ahead_of_time_a_world_has_the_same_bits(string option)
    {
        if (Environment.GetEnvironmentVariable("PHYSICS_FULL_TESTS") is not { Length: > 0 })
            return;
        var folder = packages.CreateFolder("ahead" + option.Length);
        WriteProject(folder, "ahead");
        File.WriteAllText(Path.Combine(folder, "Program.cs"), AheadProgram);
        var source = $"-p:RestoreAdditionalProjectSources={packages.Folder} -p:RestorePackagesPath={Path.Combine(folder, "cache")}";
        Packages.Dotnet($"build -c Release -o run --disable-build-servers {source}", folder);
        var expected = Packages.Dotnet(Path.Combine("run", "ahead.dll"), folder);
        // What would be missing there at run time is a warning.
        Packages.Dotnet($"publish -c Release -p:PublishAot=true -warnaserror -o native --disable-build-servers {source} {option}", folder);
        Assert.Equal(expected, Packages.Run(Path.Combine(folder, "native", "ahead"), "", folder));
    }

    // Rays into compounds in compounds, a mesh, a joint, contacts of several kinds, sleep, a snapshot, threads.
    const string AheadProgram = """
        using System.Numerics;
        using BepuPhysics;
        using BepuPhysics.Collidables;
        using BepuPhysics.Constraints;
        using BepuPhysics.Trees;
        using BepuUtilities;
        using BepuUtilities.Memory;

        using var pool = new BufferPool();
        using var dispatcher = new ThreadDispatcher(2);
        using var simulation = Simulation.Create(
            pool, new DefaultNarrowPhaseCallbacks(), new DefaultPoseIntegratorCallbacks(), new SolveDescription(1, 4));
        pool.Take(2, out Buffer<Triangle> triangles);
        triangles[0] = new(new(-50, 0, -50), new(50, 0, -50), new(-50, 0, 50));
        triangles[1] = new(new(50, 0, -50), new(50, 0, 50), new(-50, 0, 50));
        simulation.Statics.Add(new StaticDescription(Vector3.Zero, simulation.Shapes.Add(new Mesh(triangles, Vector3.One, pool))));
        var box = simulation.Shapes.Add(new Box(1, .5f, .7f));
        var inner = Of(new(new RigidPose(new(0, .3f, 0)), box), new(new RigidPose(new(.6f, 0, 0)), simulation.Shapes.Add(new Sphere(.4f))));
        var outer = Of(new(new RigidPose(new(-.5f, 0, 0)), inner), new(new RigidPose(new(1, 0, 0)), simulation.Shapes.Add(new Cylinder(.3f, .8f))));
        var previous = default(BodyHandle);
        for (int i = 0; i < 20; ++i)
        {
            var body = simulation.Bodies.Add(BodyDescription.CreateDynamic(
                new Vector3(i % 3, 1 + 1.5f * i, i % 2), new Box(2, 1, 1).ComputeInertia(1 + i), i % 2 == 0 ? outer : inner, .01f));
            if (i % 5 == 4)
                simulation.Solver.Add(previous, body, new BallSocket
                {
                    LocalOffsetA = new(0, .75f, 0),
                    LocalOffsetB = new(0, -.75f, 0),
                    SpringSettings = new(30, 1),
                });
            previous = body;
        }
        using var saved = new SimulationSnapshot(pool);
        for (int i = 0; i < 600; ++i)
        {
            if (i == 100)
                simulation.Save(saved);
            simulation.Timestep(1 / 60f, i % 2 == 0 ? dispatcher : null);
        }
        Console.WriteLine($"{simulation.StateHash():x16}");
        var hits = new Hits();
        simulation.RayCast(new Vector3(.5f, 40, .5f), new Vector3(0, -1, 0), 100, pool, ref hits);
        Console.WriteLine($"{hits.Count} {hits.Sum:r}");
        simulation.Restore(saved);
        simulation.Timestep(1 / 60f);
        Console.WriteLine($"{simulation.StateHash():x16}");

        TypedIndex Of(params CompoundChild[] parts)
        {
            pool.Take(parts.Length, out Buffer<CompoundChild> children);
            parts.CopyTo(children.AsSpan());
            return simulation.Shapes.Add(new Compound(children));
        }

        struct Hits : IRayHitHandler
        {
            public int Count;
            public float Sum;
            public bool AllowTest(CollidableReference collidable) => true;
            public bool AllowTest(CollidableReference collidable, int childIndex) => true;
            public void OnRayHit(in RayData ray, ref float maximumT, float t, Vector3 normal, CollidableReference collidable, int childIndex)
            {
                ++Count;
                Sum += t * (1 + childIndex);
            }
        }
        """;

    // What dotnet new console writes.
    void WriteProject(string folder, string name) => File.WriteAllText(Path.Combine(folder, name + ".csproj"), $"""
        <Project Sdk="Microsoft.NET.Sdk">
          <PropertyGroup>
            <OutputType>Exe</OutputType>
            <TargetFramework>net10.0</TargetFramework>
            <ImplicitUsings>enable</ImplicitUsings>
            <Nullable>enable</Nullable>
          </PropertyGroup>
          <ItemGroup>
            <PackageReference Include="Tootbird.BepuPhysics" Version="{packages.Version}" />
          </ItemGroup>
        </Project>
        """);

    // The folder of the packages is the only source, and nothing that an earlier build of this version left is taken for it.
    void WriteSources(string folder) => File.WriteAllText(Path.Combine(folder, "nuget.config"), $"""
        <configuration>
          <packageSources><clear /><add key="packed" value="{packages.Folder}" /></packageSources>
          <config><add key="globalPackagesFolder" value="{Path.Combine(folder, "cache")}" /></config>
        </configuration>
        """);

    static string Run(string folder, string name)
    {
        Packages.Dotnet("build -c Release -o run --disable-build-servers", folder);
        return Packages.Dotnet(Path.Combine("run", name + ".dll"), folder);
    }

    [GeneratedRegex(@"^struct ", RegexOptions.Multiline)]
    private static partial Regex TypeDeclaration();

    // Half the height of the box, give or take the sink of a rigid contact, in whatever way the machine writes numbers.
    [GeneratedRegex(@"^The box rests at a height of 0[.,](49|50) m\.\s*$")]
    private static partial Regex Height();
}
