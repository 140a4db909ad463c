using System;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuPhysics.Constraints;
using DemoTests.Support;
using Xunit;

namespace DemoTests.LoadPath;

/// <summary>Loads that are handed down to the ground: what rests keeps its place to the tenth of a millimetre, and what moves moves as before.</summary>
public class LoadPathTests
{
    public static TheoryData<LoadPathMode, int> Modes => new()
    {
        { LoadPathMode.WhereNeeded, 0 },
        { LoadPathMode.WhereNeeded, 1 },
        { LoadPathMode.Always, 0 },
        { LoadPathMode.Always, 1 },
    };

    [Theory, MemberData(nameof(Modes))]
    public void A_hundred_boxes_stand_where_they_were_put(LoadPathMode mode, int relaxations)
    {
        using var world = new LoadPathWorld(mode, relaxations: relaxations);
        world.AddStack(100);
        world.Run(6);
        // A prototype lost 3e-5 m; a tenth of that is the rounding of a height of 100 m.
        Assert.InRange(world.Moved, 0, mode == LoadPathMode.Always ? 1e-5 : 2e-3);
    }

    [Theory, MemberData(nameof(Modes))]
    public void A_heavy_box_rests_on_light_ones(LoadPathMode mode, int relaxations)
    {
        foreach (var (count, mass) in new[] { (1, 100f), (1, 10_000f), (10, 1_000f), (10, 10_000f) })
        {
            using var world = new LoadPathWorld(mode, relaxations: relaxations);
            world.AddStack(count);
            world.Add(new Vector3(0, count + 0.5f, 0), Vector3.One, mass);
            world.Run(4);
            Assert.True(world.Moved < 2e-4, $"{mass} kg on {count}: {world.Moved} m");
        }
    }

    [Theory, MemberData(nameof(Modes))]
    public void Strong_gravity_does_not_press_a_stack_together(LoadPathMode mode, int relaxations)
    {
        using var world = new LoadPathWorld(mode, new Vector3(0, -1000, 0), relaxations: relaxations);
        world.AddStack(10);
        world.Run(4);
        Assert.InRange(world.Moved, 0, mode == LoadPathMode.Always ? 1e-4 : 4e-3);
    }

    [Theory, MemberData(nameof(Modes))]
    public void A_plank_with_a_load_aside_lies_still(LoadPathMode mode, int relaxations)
    {
        using var world = new LoadPathWorld(mode, relaxations: relaxations);
        world.Add(new Vector3(-1, 0.5f, 0), Vector3.One, 1);
        world.Add(new Vector3(1, 0.5f, 0), Vector3.One, 1);
        world.Add(new Vector3(0, 1.1f, 0), new Vector3(4, 0.2f, 1), 1);
        world.Add(new Vector3(0.7f, 1.7f, 0), Vector3.One, 1000);
        world.Run(4);
        Assert.InRange(world.Moved, 0, 1e-4);
    }

    /// <summary>
    /// Boxes of which each is .12 m aside of the one below fall. At four substeps without relaxation they do so a quarter too early by sweeps alone, and
    /// an eighth with the load path: what begins to tip is on two contacts, which are left to the sweeps.
    /// </summary>
    [Theory, MemberData(nameof(Modes))]
    public void What_truly_falls_falls_no_sooner_than_by_sweeps_alone(LoadPathMode mode, int relaxations)
    {
        float Falls(LoadPathMode with, int substeps, int sweeps)
        {
            using var world = new LoadPathWorld(with, substeps: substeps, relaxations: sweeps);
            world.AddStack(10, 0.12f);
            var time = 0f;
            for (; time < 10 && world.Moved < 1; time += LoadPathWorld.Dt)
                world.Step();
            return time;
        }

        var reference = Falls(LoadPathMode.Off, 64, 1);
        var error = MathF.Abs(Falls(mode, 4, relaxations) - reference);
        Assert.InRange(error, 0, MathF.Abs(Falls(LoadPathMode.Off, 4, relaxations) - reference));
        Assert.InRange(error / reference, 0, relaxations > 0 ? 0.1f : 0.2f);
    }

    [Theory, MemberData(nameof(Modes))]
    public void A_leaning_stack_that_is_in_balance_stands(LoadPathMode mode, int relaxations)
    {
        using var world = new LoadPathWorld(mode, relaxations: relaxations);
        world.AddStack(10, 0.09f);
        world.Run(5);
        Assert.InRange(world.Moved, 0, 1e-3);
    }

    [Theory, MemberData(nameof(Modes))]
    public void A_box_on_a_slope_holds_below_the_angle_of_friction_and_slides_above_it(LoadPathMode mode, int relaxations)
    {
        const float seconds = 5;
        // Also turned, so that its axes of inertia are askew of the way: what stayed held while it slid was led off its way.
        float Distance(float part, float turn = 0)
        {
            var angle = MathF.Atan(part * LoadPathWorld.Friction);
            using var world = new LoadPathWorld(mode, 9.81f * new Vector3(MathF.Sin(angle), -MathF.Cos(angle), 0), relaxations: relaxations);
            var body = world.Add(new Vector3(0, 0.3f, 0), new Vector3(1, 0.6f, 0.8f), 1);
            world.Simulation.Bodies[body].Pose.Orientation = Quaternion.CreateFromAxisAngle(Vector3.UnitY, turn);
            world.Run(seconds);
            return world.Position(body).X;
        }

        Assert.InRange(Distance(0.98f), -1e-6f, 1e-6f);
        Assert.InRange(Distance(0.999f), -1e-6f, 1e-6f);
        Assert.InRange(Distance(0.999f, 0.5f), -1e-6f, 1e-6f);
        foreach (var part in new[] { 1.02f, 1.1f, 1.5f })
        {
            var angle = Math.Atan(part * LoadPathWorld.Friction);
            var coulomb = 9.81 * (Math.Sin(angle) - LoadPathWorld.Friction * Math.Cos(angle)) * seconds * seconds / 2;
            Assert.InRange(Distance(part) / coulomb, 0.99, 1.01);
            // What is slow and turned goes aside a little: rows along and across bring it to rest by other masses.
            Assert.InRange(Distance(part, 0.5f) / coulomb, 0.99, part == 1.02f ? 1.015 : 1.005);
        }
    }

    [Theory, MemberData(nameof(Modes))]
    public void A_sliding_box_stops_where_friction_has_taken_its_energy(LoadPathMode mode, int relaxations)
    {
        foreach (var speed in new[] { 0.5f, 2, 5 })
        {
            using var world = new LoadPathWorld(mode, relaxations: relaxations);
            var body = world.Add(new Vector3(0, 0.5f, 0), new Vector3(2, 1, 2), 1, new Vector3(speed, 0, 0));
            world.Run(4);
            // The step of the discrete motion is half a substep's way.
            var way = speed * speed / (2 * LoadPathWorld.Friction * 9.81);
            Assert.InRange(world.Position(body).X, way * 0.99 - speed / 240, way * 1.01);
            Assert.Equal(0, world.Velocity(body).Length(), 1e-4);
        }
    }

    /// <summary>What rolls, flies, bounces off or stands on springs of the game is no load: it keeps its bits.</summary>
    [Theory, InlineData(LoadPathMode.WhereNeeded), InlineData(LoadPathMode.Always)]
    public void What_is_no_load_keeps_its_bits(LoadPathMode mode)
    {
        ulong Hash(LoadPathMode with)
        {
            using var world = new LoadPathWorld(with, frequency: 30);
            world.AddStack(5);
            world.Run(1);
            var springs = world.Simulation.StateHash();
            using var rolling = new LoadPathWorld(with);
            rolling.Add(new Vector3(0, 0.5f, 0), new Sphere(0.5f), 1, new Vector3(0.2f, 0, 0), new Vector3(0, 0, -0.4f));
            rolling.Add(new Vector3(0, 0.5f, 5), new Sphere(0.5f), 1, new Vector3(3, 2, 0), new Vector3(0, 0, -6));
            rolling.Add(new Vector3(0, 9, -5), new Box(1, 1, 1), 1, default, new Vector3(1, 2, 3));
            rolling.Run(1);
            return springs * 31 + rolling.Simulation.StateHash();
        }

        Assert.Equal(Hash(LoadPathMode.Off), Hash(mode));
    }

    /// <summary>As <see cref="EnergyLaw"/> says.</summary>
    /// <remarks>PHYSICS_FULL_TESTS: a thousand piles in place of twenty.</remarks>
    [Theory, MemberData(nameof(Modes))]
    public void The_stage_never_adds_energy(LoadPathMode mode, int relaxations)
    {
        var piles = Environment.GetEnvironmentVariable("PHYSICS_FULL_TESTS") is { Length: > 0 } ? 1000 : 20;
        var law = new EnergyLaw();
        for (int seed = 0; seed < piles; ++seed)
        {
            using var world = new LoadPathWorld(mode, relaxations: relaxations);
            EnergyLaw.DropPile(new Random(seed), (place, size, mass) => world.Add(place, size, mass));
            law.Watch(world.Simulation, seed);
            world.Run(3);
        }
        law.AssertDidSomething();
    }

    [Fact]
    public void Threads_do_not_change_a_bit()
    {
        ulong Hash(int threads, int relaxations)
        {
            using var world = new LoadPathWorld(LoadPathMode.WhereNeeded, relaxations: relaxations, threads: threads);
            for (int row = 0; row < 8; ++row)
            {
                for (int i = row; i < 8; ++i)
                {
                    for (int copy = 0; copy < 4; ++copy)
                        world.Add(new Vector3(i - row * 0.5f, 0.5f + row, copy * 3), Vector3.One, 1 + copy * row);
                }
            }
            world.Run(1);
            return world.Simulation.StateHash();
        }

        for (int relaxations = 0; relaxations < 2; ++relaxations)
        {
            var expected = Hash(1, relaxations);
            foreach (var threads in new[] { 2, 3, 8 })
                Assert.Equal(expected, Hash(threads, relaxations));
        }
    }

    [Fact]
    public void Contacts_are_held_for_the_step_and_no_longer()
    {
        using var world = new LoadPathWorld(LoadPathMode.Always);
        world.AddStack(3);
        var held = 0;
        world.Simulation.Solver.SubstepEnded += _ => held = Math.Max(held, CountHeld(world.Simulation.Solver));
        world.Run(0.2f);
        Assert.Equal(3, held);
        Assert.Equal(0, CountHeld(world.Simulation.Solver));
        world.Simulation.Solver.SubstepEnded += _ => throw new InvalidOperationException("The game's.");
        Assert.Throws<InvalidOperationException>(world.Step);
        Assert.Equal(0, CountHeld(world.Simulation.Solver));
    }

    /// <summary>What rests alone needs no graph, and is held in each substep all the same; what slides is not.</summary>
    [Fact]
    public void What_rests_alone_is_held_too()
    {
        using var world = new LoadPathWorld(LoadPathMode.WhereNeeded);
        world.Add(new Vector3(0, 0.5f, 0), Vector3.One, 1);
        world.Add(new Vector3(3, 0.5f, 0), Vector3.One, 1000);
        world.Add(new Vector3(-100, 0.5f, 9), new Vector3(2, 1, 2), 1, new Vector3(40, 0, 0));
        world.Run(1);
        int least = int.MaxValue, most = 0;
        world.Simulation.Solver.SubstepEnded += _ =>
        {
            least = Math.Min(least, CountHeld(world.Simulation.Solver));
            most = Math.Max(most, CountHeld(world.Simulation.Solver));
        };
        world.Run(0.5f);
        Assert.Equal((2, 2), (least, most));
        Assert.Equal(0, CountHeld(world.Simulation.Solver));
    }

    static int CountHeld(Solver solver)
    {
        int held = 0;
        ref var batches = ref solver.ActiveSet.Batches;
        for (int i = 0; i < batches.Count; ++i)
        {
            for (int j = 0; j < batches[i].TypeBatches.Count; ++j)
            {
                ref var batch = ref batches[i].TypeBatches[j];
                var spring = BepuPhysics.Constraints.Contact.ContactPrestepLayout.Spring(ConstraintTypeIds.ContactCount(batch.TypeId));
                for (int k = 0; k < batch.ConstraintCount; ++k)
                    held += solver.Processor(batch.TypeId).PrestepFloat(ref batch, k, spring) < 0 ? 1 : 0;
            }
        }
        return held;
    }

    [Fact]
    public void A_step_makes_no_garbage()
    {
        using var world = new LoadPathWorld(LoadPathMode.Always);
        world.AddStack(20);
        world.Run(0.5f);
        Assert.Equal(0, Garbage.Of(() => world.Run(0.5f)));
    }

    [Fact]
    public void There_are_three_modes()
    {
        using var world = new LoadPathWorld(LoadPathMode.Off);
        Assert.Throws<ArgumentOutOfRangeException>(() => world.Simulation.Solver.LoadPath = (LoadPathMode)3);
        Assert.Throws<ArgumentOutOfRangeException>(() => world.Simulation.Solver.LoadPath = (LoadPathMode)(-1));
        Assert.Equal(LoadPathMode.Off, world.Simulation.Solver.LoadPath);
        Assert.Throws<ArgumentOutOfRangeException>(() => new LoadPathWorld((LoadPathMode)7));
    }
}
