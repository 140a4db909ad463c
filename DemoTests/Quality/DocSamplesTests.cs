using System;
using System.Collections.Generic;
using System.IO;
using System.Linq;
using System.Numerics;
using System.Text.RegularExpressions;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuPhysics.Trees;
using BepuUtilities.Memory;
using DemoTests.Support;
using Xunit;

namespace DemoTests.Quality;

/// <summary>The code of the documentation compiles, because it is here, and does what the pages say.</summary>
public sealed class DocSamplesTests : IDisposable
{
    static readonly string[] sampleFiles =
    [
        "DemoTests/Quality/DocSamples.cs",
        .. new[] { "Characters", "Events", "FastThings", "LargeWorlds", "Nearby", "OwnShapes", "Rays", "Rollback", "Sweeps" }
            .Select(name => $"DemoTests/Quality/DocSamples.{name}.cs"),
    ];

    const float Dt = 1 / 60f;

    readonly BufferPool pool = new();

    // The guide is a program, which PackageTests runs; ConstraintPageTests runs the examples of constraints.
    public static TheoryData<string> Pages => [.. DocPages.All
        .Where(page => DocPages.CodeBlocks(page).Any() && page != "Docs/Guides/GettingStarted.md" &&
            !page.StartsWith("Docs/Constraints/", StringComparison.Ordinal))];

    [Theory, MemberData(nameof(Pages))]
    public void Code_of_a_page_is_among_the_samples(string page)
    {
        var samples = Lines(string.Concat(sampleFiles.Select(RepositoryFiles.Read)));
        foreach (var block in DocPages.CodeBlocks(page))
        {
            var lines = Lines(block);
            var usings = lines.Where(IsUsing).ToArray();
            Assert.All(usings, line => Assert.Contains(line, samples));
            var code = lines.Except(usings).Any() ? lines.Where(line => !IsUsing(line)).ToArray() : [];
            Assert.True(Contains(samples, code), $"{page} has code that is in none of {string.Join(", ", sampleFiles)}:\n{block}");
        }
    }

    static string[] Lines(string text) => [.. text.Split('\n').Select(line => line.Trim()).Where(line => line.Length > 0)];

    // A using directive, not a using declaration of a variable.
    static bool IsUsing(string line) =>
        line.StartsWith("using ", StringComparison.Ordinal) && !line.Contains('=', StringComparison.Ordinal);

    static bool Contains(string[] lines, string[] part)
    {
        for (int start = 0; start + part.Length <= lines.Length; ++start)
        {
            if (lines.AsSpan(start, part.Length).SequenceEqual(part))
                return true;
        }
        return false;
    }

    [Fact]
    public void A_capsule_walks_up_to_a_wall()
    {
        using var simulation = EmptySimulation.Create(pool);
        simulation.Statics.Add(new StaticDescription(new RigidPose(new Vector3(2, 0, 0)), simulation.Shapes.Add(new Box(1, 4, 4))));
        var near = new RigidPose(new Vector3(1, 0, 0));

        Assert.InRange(DocSamples.Walk(simulation, pool, near, new Vector3(60, 0, 0)).X, 1.1f - 1e-5f, 1.1f);
        Assert.Equal(near.Position, DocSamples.Walk(simulation, pool, near, new Vector3(-60, 0, 0)));
    }

    [Fact]
    public void Links_of_all_pages_lead_to_files()
    {
        List<string> broken = [];
        foreach (var page in DocPages.All)
        {
            var folder = Path.GetDirectoryName(RepositoryFiles.PathOf(page))!;
            broken.AddRange(DocPages.FileLinks(page)
                .Where(link => !Path.Exists(Path.Combine(folder, link)))
                .Select(link => $"{page}: {link}"));
        }
        Assert.Empty(broken);
    }

    [Fact]
    public void Pages_that_sources_name_exist()
    {
        List<string> missing = [];
        foreach (var folder in new[] { "BepuUtilities", "BepuPhysics", "Demos", "Benchmarks" })
        {
            foreach (var file in RepositoryFiles.Find(folder, "*.cs"))
            {
                missing.AddRange(Regex.Matches(RepositoryFiles.Read(file), @"Docs/[\w/]+\.md").Select(match => match.Value)
                    .Where(page => !File.Exists(RepositoryFiles.PathOf(page))).Select(page => $"{file}: {page}"));
            }
        }
        Assert.Empty(missing);
    }

    [Fact]
    public void Bouncing_material_bounces_and_soft_one_does_not()
    {
        Assert.InRange(ReboundHeight(DocSamples.Bouncing()), 0.2f, 0.3f);
        Assert.InRange(ReboundHeight(DocSamples.Soft()), 0, 0.05f);
    }

    // Greatest height of the underside after the first impact, of a sphere that falls from one metre.
    float ReboundHeight(DefaultNarrowPhaseCallbacks callbacks)
    {
        using var simulation = Simulation.Create(pool, callbacks, new DefaultPoseIntegratorCallbacks(), new SolveDescription(1, 4));
        AddFloor(simulation);
        var handle = simulation.Bodies.Add(
            BodyDescription.CreateConvexDynamic(new Vector3(0, 1.5f, 0), 1, simulation.Shapes, new Sphere(0.5f)));
        bool hit = false;
        float height = 0;
        for (int i = 0; i < 90; ++i)
        {
            simulation.Timestep(Dt);
            var underside = simulation.Bodies[handle].Pose.Position.Y - 0.5f;
            hit |= underside < 0.04f;
            if (hit)
                height = MathF.Max(height, underside);
        }
        return height;
    }

    [Fact]
    public void A_ray_finds_the_material_of_a_part_of_a_level()
    {
        using var simulation = Simulation.Create(
            pool, new DefaultNarrowPhaseCallbacks(), new DefaultPoseIntegratorCallbacks(), new SolveDescription(1, 4));
        var corners = (Vector3[])[new(-9, 0, -9), new(9, 0, -9), new(-9, 0, 9), new(9, 0, 9)];
        var terrain = new Mesh(corners, [0, 1, 2, 2, 1, 3], Vector3.One, pool, [7, 8]);
        var bridge = new Mesh(corners, [0, 1, 2, 2, 1, 3], new(.1f), pool, [1, 1]);
        var level = DocSamples.BuildLevel(simulation, terrain, bridge, new Vector3(20, 0, 0));
        simulation.Statics.Add(new StaticDescription(RigidPose.Identity, level));
        foreach (var (x, z, material) in ((float, float, byte)[])[(-5, -5, 7), (5, 5, 8), (19.8f, 0, 0), (0, 0, 0)])
        {
            var hit = new FirstHit { Child = -1 };
            simulation.RayCast(new Vector3(x, 9, z), -Vector3.UnitY, 20, pool, ref hit);
            Assert.Equal(material, DocSamples.MaterialOf(simulation, level, terrain, hit.Child));
        }
        simulation.Statics.Clear();
        simulation.Shapes.RecursivelyRemoveAndDispose(level, pool);
    }

    struct FirstHit : IRayHitHandler
    {
        public int Child;

        public readonly bool AllowTest(CollidableReference collidable) => true;

        public readonly bool AllowTest(CollidableReference collidable, int childIndex) => true;

        public void OnRayHit(in RayData ray, ref float maximumT, float t, Vector3 normal, CollidableReference collidable, int childIndex)
        {
            Child = childIndex;
            maximumT = t;
        }
    }

    [Fact]
    public void Bodies_on_ice_slide_and_others_stop()
    {
        Assert.InRange(SlidingSpeed(onIce: true), 0.99f, 1.01f);
        Assert.InRange(SlidingSpeed(onIce: false), -0.01f, 0.01f);
    }

    float SlidingSpeed(bool onIce)
    {
        var callbacks = new IceCallbacks { Ice = new StaticHandle(onIce ? 0 : 99) };
        using var simulation = Simulation.Create(pool, callbacks, new DefaultPoseIntegratorCallbacks(), new SolveDescription(1, 4));
        AddFloor(simulation);
        var handle = simulation.Bodies.Add(BodyDescription.CreateConvexDynamic(
            new Vector3(0, 0.5f, 0), new BodyVelocity(new Vector3(1, 0, 0)), 1, simulation.Shapes, new Box(1, 1, 1)));
        for (int i = 0; i < 60; ++i)
            simulation.Timestep(Dt);
        return simulation.Bodies[handle].Velocity.Linear.X;
    }

    [Fact]
    public void Bodies_of_the_guide_can_be_added_and_pushed_on_threads()
    {
        using var simulation = CreateWorld();
        var platform = DocSamples.AddBodies(simulation);
        Assert.Equal(11, simulation.Bodies.CountBodies());
        Assert.Equal(3, DocSamples.Push(simulation, new BodyHandle(0)));
        Assert.Equal(2.5f, simulation.Bodies[new BodyHandle(0)].Velocity.Linear.Y);
        DocSamples.StepOnThreads(simulation);
        Assert.Equal(0.5f * Dt, simulation.Bodies[platform].Pose.Position.X, 1e-6f);
    }

    [Fact]
    public void A_joint_holds_until_it_is_removed()
    {
        using var simulation = CreateWorld();
        var shape = simulation.Shapes.Add(new Sphere(0.1f));
        var anchor = simulation.Bodies.Add(BodyDescription.CreateKinematic(new Vector3(0, 5, 0), shape, -1));
        var bob = simulation.Bodies.Add(BodyDescription.CreateDynamic(new Vector3(0, 4, 0), new Sphere(0.1f).ComputeInertia(1), shape, -1));
        DocSamples.HangAndLetGo(simulation, anchor, bob, () =>
        {
            for (int i = 0; i < 30; ++i)
                simulation.Timestep(Dt);
            Assert.Equal(4, simulation.Bodies[bob].Pose.Position.Y, 1e-2f);
        });
        for (int i = 0; i < 30; ++i)
            simulation.Timestep(Dt);
        Assert.InRange(simulation.Bodies[bob].Pose.Position.Y, 2.5f, 3);
    }

    [Fact]
    public void The_dial_has_the_values_that_the_guide_names()
    {
        var (usual, stiff, calm) = DocSamples.Dial();
        Assert.Equal((1, 4, 1, 16), (usual.VelocityIterationCount, usual.SubstepCount, stiff.VelocityIterationCount, stiff.SubstepCount));
        Assert.Equal((0, 0, 1), (usual.RelaxationIterationCount, stiff.RelaxationIterationCount, calm.RelaxationIterationCount));
    }

    [Fact]
    public void All_memory_comes_back_as_the_page_on_memory_says() => DocSamples.GiveEverythingBack();

    [Fact]
    public void The_constraint_of_the_recipe_holds_a_body_up()
    {
        using var simulation = CreateWorld();
        var body = simulation.Bodies.Add(BodyDescription.CreateConvexDynamic(new Vector3(0, 2, 0), 3, simulation.Shapes, new Sphere(0.1f)));
        var limit = DocSamples.KeepAbove(simulation, body);
        for (int i = 0; i < 120; ++i)
            simulation.Timestep(Dt);
        Assert.Equal(1, simulation.Bodies[body].Pose.Position.Y, 1e-2f);
        // It holds the weight: 3 kg times 9.81 m/s2 over a substep.
        Assert.Equal(3 * 9.81f * Dt / 4, simulation.Solver.GetAccumulatedImpulseMagnitude(limit), 1e-3f);
        Assert.Throws<ArgumentException>(() => simulation.Solver.Add(body, new HeightLimit { MinimumHeight = float.NaN }));
    }

    [Fact]
    public void The_motor_of_the_recipe_lifts_as_fast_as_its_force_allows()
    {
        using var simulation = Simulation.Create(
            pool, new DefaultNarrowPhaseCallbacks(), new DefaultPoseIntegratorCallbacks(), new SolveDescription(1, 4));
        var strong = simulation.Bodies.Add(BodyDescription.CreateConvexDynamic(new Vector3(0, 3, 0), 1, simulation.Shapes, new Sphere(1)));
        var weak = simulation.Bodies.Add(BodyDescription.CreateConvexDynamic(new Vector3(9, 3, 0), 1, simulation.Shapes, new Sphere(1)));
        simulation.Solver.Add(strong, new Lift { TargetVelocity = 2, Settings = new(100, 0) });
        // Half of its weight.
        simulation.Solver.Add(weak, new Lift { TargetVelocity = 2, Settings = new(9.81f / 2, 0) });
        for (int i = 0; i < 60; ++i)
            simulation.Timestep(Dt);
        Assert.Equal(2, simulation.Bodies[strong].Velocity.Linear.Y, 1e-3f);
        Assert.Equal(-9.81f / 2, simulation.Bodies[weak].Velocity.Linear.Y, .1f);
        Assert.Throws<ArgumentException>(() => simulation.Solver.Add(weak, new Lift { TargetVelocity = float.NaN }));
    }

    [Fact]
    public void The_pair_of_the_recipe_keeps_spheres_apart()
    {
        using var simulation = Simulation.Create(
            pool, new DefaultNarrowPhaseCallbacks(), new DefaultPoseIntegratorCallbacks(), new SolveDescription(1, 4));
        DocSamples.RegisterPair(simulation);
        simulation.Statics.Add(new StaticDescription(Vector3.Zero, simulation.Shapes.Add(new Sphere(1))));
        var body = simulation.Bodies.Add(BodyDescription.CreateConvexDynamic(new Vector3(0, 2.1f, 0), 1, simulation.Shapes, new Sphere(1)));
        for (int i = 0; i < 60; ++i)
            simulation.Timestep(Dt);
        Assert.Equal(1.99f, simulation.Bodies[body].Pose.Position.Y, 2e-3f);
    }

    [Fact]
    public void Hello_world_says_where_the_box_rests()
    {
        var output = Console.Out;
        using var text = new StringWriter(System.Globalization.CultureInfo.InvariantCulture);
        Console.SetOut(text);
        try
        {
            DocSamples.HelloWorld();
        }
        finally
        {
            Console.SetOut(output);
        }
        Assert.Contains("0.50 m", text.ToString(), StringComparison.Ordinal);
    }

    Simulation CreateWorld()
    {
        var simulation = Simulation.Create(pool, new DefaultNarrowPhaseCallbacks(), new DefaultPoseIntegratorCallbacks(), new SolveDescription(1, 4));
        AddFloor(simulation);
        return simulation;
    }

    static void AddFloor(Simulation simulation) =>
        simulation.Statics.Add(new StaticDescription(new Vector3(0, -0.5f, 0), simulation.Shapes.Add(new Box(100, 1, 100))));

    public void Dispose()
    {
        pool.AssertEmpty();
        pool.Dispose();
    }
}
