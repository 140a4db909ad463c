using System;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuPhysics.Constraints;
using Demos.Accuracy;
using Demos.Running;
using Xunit;
using Xunit.Abstractions;

namespace DemoTests.Accuracy;

/// <summary>What relaxation sweeps are for, what they must leave alone, and the stiffness that they allow.</summary>
public class RelaxationTests(ITestOutputHelper output)
{
    /// <summary>
    /// Pushed out of the ground at up to 2 m/s, a box comes to rest at the surface. It has no velocity of its own to fly on with; that of the
    /// correction would carry it 0.2 m farther, at most a tenth of which may be left. With the load path, what rests is pushed out without a velocity.
    /// </summary>
    [Theory]
    [InlineData(.1f)]
    [InlineData(.4f)]
    [InlineData(.9f)]
    public void What_is_pushed_out_does_not_fly_on(float depth)
    {
        var relaxed = HighestBottom(depth, relaxations: 1);
        var unrelaxed = HighestBottom(depth, relaxations: 0);
        output.WriteLine($"{depth} m deep: {relaxed:G4} m high, {unrelaxed:G4} m without relaxation");
        Assert.True(unrelaxed > .1, "the case shows nothing any more");
        Assert.InRange(relaxed, -.01, .1 * unrelaxed);
        Assert.InRange(HighestBottom(depth, relaxations: 0, LoadPathChoice.WhereNeeded), -.001, .001);
    }

    static double HighestBottom(float depth, int relaxations, LoadPathChoice loadPath = LoadPathChoice.Off)
    {
        using var world = new AccuracyWorld(new AccuracySettings { RelaxationCount = relaxations, LoadPath = loadPath });
        world.AddGround(thickness: 10);
        var box = world.AddDynamic(new Box(1, 1, 1), 1, new RigidPose(new Vector3(0, .5f - depth, 0)));
        double highest = double.MinValue;
        world.Run(3, () => highest = Math.Max(highest, world.Position(box).Y - .5));
        return highest;
    }

    /// <summary>
    /// The worst case for stiff joints is a chain that hangs exactly straight. Whatever stiffness the number of sweeps gives it, it only
    /// loses energy, and hangs still in the end.
    /// </summary>
    [Theory]
    [InlineData(1, 0)]
    [InlineData(2, 0)]
    [InlineData(3, 0)]
    [InlineData(4, 0)]
    [InlineData(5, 0)]
    [InlineData(6, 0)]
    [InlineData(8, 0)]
    [InlineData(1, 1)]
    [InlineData(2, 1)]
    [InlineData(3, 1)]
    [InlineData(4, 1)]
    [InlineData(8, 1)]
    [InlineData(1, 2)]
    [InlineData(1, 4)]
    public void A_straight_chain_gains_no_energy(int iterations, int relaxations)
    {
        foreach (int substeps in (ReadOnlySpan<int>)[1, 4, 16])
        {
            var settings = new AccuracySettings
            {
                SubstepCount = substeps,
                VelocityIterationCount = iterations,
                RelaxationCount = relaxations,
                Contacts = ContactScope.None,
            };
            using var world = new AccuracyWorld(settings);
            const int linkCount = 60;
            var chain = new LoadedChain(world, ChainStart.HangingStraight, linkCount, load: 1);
            double start = chain.Energy, highest = start;
            world.Run(6, () => highest = Tally.Most(highest, chain.Energy));
            double gain = (highest - start) / (linkCount * 9.81);
            output.WriteLine($"{settings}: gained {gain:G3} m");
            Assert.True(gain < 1e-6, $"{settings}: energy rose by what lifts the chain by {gain} m");
        }
    }

    /// <summary>With one relaxation joints are as stiff as with twice the substeps, so that the stretch of a chain is the same.</summary>
    [Fact]
    public void A_relaxed_chain_stretches_as_with_twice_the_substeps()
    {
        double relaxed = Stretch(4, 1), doubled = Stretch(8, 0);
        output.WriteLine($"stretch {relaxed:P3}, with twice the substeps {doubled:P3}, with neither {Stretch(4, 0):P3}");
        Assert.InRange(relaxed, .9 * doubled, 1.1 * doubled);

        static double Stretch(int substeps, int relaxations)
        {
            var settings = new AccuracySettings { SubstepCount = substeps, RelaxationCount = relaxations, Contacts = ContactScope.None };
            using var world = new AccuracyWorld(settings);
            var chain = new LoadedChain(world, ChainStart.HangingStraight, linkCount: 40, load: 100);
            double worst = 0;
            world.Run(10);
            chain.Gaps(out double stretch, ref worst);
            return stretch;
        }
    }

    /// <summary>The velocity of a spring or a servo is what was asked for: relaxation changes no bit of it.</summary>
    [Theory]
    [InlineData(2, 0, float.MaxValue)]
    [InlineData(2, .3, float.MaxValue)]
    [InlineData(10, 1, float.MaxValue)]
    [InlineData(0, 1, float.MaxValue)]
    [InlineData(0, 1, 1)]
    public void Springs_and_servos_are_left_alone(float frequency, float dampingRatio, float maximumSpeed)
    {
        var spring = frequency > 0 ? new SpringSettings(frequency, dampingRatio) : SpringSettings.Rigid;
        var servo = new OneBodyLinearServo
        {
            Target = new Vector3(0, 1, 0),
            ServoSettings = new ServoSettings(maximumSpeed, 0, float.MaxValue),
            SpringSettings = spring,
        };
        using var relaxed = World(1);
        using var unrelaxed = World(0);
        // Rigid is as stiff as the sweeps allow, and the relaxed world allows more.
        bool isRigid = frequency == 0;
        for (int i = 0; i < 120; ++i)
        {
            relaxed.Step(1 / 60f);
            unrelaxed.Step(1 / 60f);
            var (a, b) = (relaxed.Bodies[relaxed.Dynamics[0]], unrelaxed.Bodies[unrelaxed.Dynamics[0]]);
            if (!isRigid)
                Assert.Equal((b.Pose.Position, b.Velocity.Linear), (a.Pose.Position, a.Velocity.Linear));
            else if (i < 6 && maximumSpeed == 1)
                Assert.InRange(a.Velocity.Linear.Y, .9f, 1.1f);
        }
        if (isRigid)
            Assert.InRange(relaxed.Position(relaxed.Dynamics[0]).Y, .999, 1.001);

        AccuracyWorld World(int relaxations)
        {
            var world = new AccuracyWorld(new AccuracySettings { RelaxationCount = relaxations, Gravity = default });
            var body = world.AddDynamic(new Sphere(.5f), 2, RigidPose.Identity);
            world.Simulation.Solver.Add(body, servo);
            return world;
        }
    }

    /// <summary>
    /// A spring that is stiffer than a substep can hold is cut down to what its sweeps hold, and relaxations sweep no springs: turning them on
    /// must not let a chain of such springs swing up.
    /// </summary>
    [Theory]
    [InlineData(0)]
    [InlineData(1)]
    [InlineData(4)]
    public void Springs_that_are_cut_down_stay_stable(int relaxations)
    {
        var settings = new AccuracySettings { RelaxationCount = relaxations, Contacts = ContactScope.None };
        using var world = new AccuracyWorld(settings);
        var chain = new LoadedChain(world, ChainStart.HangingStraight, linkCount: 60, load: 1, new SpringSettings(1000, 1));
        double start = chain.Energy, highest = start;
        world.Run(10, () => highest = Tally.Most(highest, chain.Energy));
        Assert.True(highest - start < 1e-6 * Math.Abs(start), $"energy rose from {start} to {highest}");
    }

    /// <summary>
    /// A box that tips over its edge keeps pushing on the ground at the end of each step, as the edge does not leave it; and its edge does not
    /// sink: relaxation has to know how far bodies have moved, in the first substep and in the last.
    /// </summary>
    [Theory]
    [InlineData(1)]
    [InlineData(4)]
    [InlineData(16)]
    public void A_tipping_box_keeps_its_load(int substeps)
    {
        var settings = new AccuracySettings { SubstepCount = substeps, RelaxationCount = 1, Friction = 1 };
        using var world = new AccuracyWorld(settings);
        world.AddGround();
        // Balanced over an edge, but for 0.1 rad.
        var turn = Quaternion.CreateFromAxisAngle(Vector3.UnitZ, float.Pi / 4 - .1f);
        float height = MathF.Sqrt(.5f) * MathF.Cos(.1f);
        var box = world.AddDynamic(new Box(1, 1, 1), 1, new RigidPose(new Vector3(0, height, 0), turn));
        world.Run(.2);
        int loaded = 0, steps = 0;
        while (world.Time < .8)
        {
            world.Step(settings.Dt);
            ++steps;
            ref var set = ref world.Simulation.Solver.ActiveSet;
            double load = 0;
            for (int batch = 0; batch < set.Batches.Count; ++batch)
            {
                ref var typeBatch = ref set.Batches[batch].TypeBatches[0];
                var processor = world.Simulation.Solver.TypeProcessors[typeBatch.TypeId]!;
                // Before friction's three numbers and that of the twist.
                for (int i = 0; i < processor.ImpulseFloats - 4; ++i)
                    load += processor.Impulse(ref typeBatch, 0, i);
            }
            if (load > .2 * 9.81 * settings.SubstepDuration)
                ++loaded;
        }
        output.WriteLine($"{loaded} of {steps} steps end with a load");
        Assert.True(loaded >= .9 * steps, $"only {loaded} of {steps} steps end with a load");
    }

    [Fact]
    public void A_heap_of_boxes_stays_where_it_is()
    {
        var settings = new AccuracySettings { RelaxationCount = 1 };
        using var world = new AccuracyWorld(settings);
        world.AddGround();
        const int rows = 12;
        for (int row = 0; row < rows; ++row)
            for (int i = 0; i < rows - row; ++i)
                world.AddDynamic(new Box(1, 1, 1), 1, new RigidPose(new Vector3((i - (rows - row) * .5f) * 1.1f, row + .5f, 0)));
        var start = new double[world.Dynamics.Count];
        for (int i = 0; i < start.Length; ++i)
            start[i] = world.Position(world.Dynamics[i]).X;
        world.Run(10);
        for (int i = 0; i < start.Length; ++i)
        {
            Assert.InRange(world.Position(world.Dynamics[i]).X - start[i], -.005, .005);
            Assert.InRange(world.LinearVelocity(world.Dynamics[i]).Length, 0, .005);
        }
    }
}
