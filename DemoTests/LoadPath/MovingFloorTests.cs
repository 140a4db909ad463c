using System;
using System.Numerics;
using BepuPhysics;
using DemoTests.Support;
using Xunit;
using Xunit.Abstractions;

namespace DemoTests.LoadPath;

/// <summary>What stands on something that moves and does not turn stands as on the ground, also while that speeds up and brakes.</summary>
public class MovingFloorTests(ITestOutputHelper output)
{
    static readonly Func<double, Vector3> still = _ => default;

    // At this speed upwards the velocity after a step of gravity is none.
    const float FallOfStep = FloorWorld.Gravity * FloorWorld.Dt;

    public static TheoryData<string, float, float> EvenMotions()
    {
        var motions = new TheoryData<string, float, float>();
        foreach (var structure in new[] { "twenty", "fifty", "wall", "heavy" })
        {
            foreach (var (x, y) in new (float, float)[] { (0, 1e-4f), (0, FallOfStep), (0, 0.5f), (0, 2), (0, 10), (0, -2), (0.5f, 0), (7, -3) })
                motions.Add(structure, x, y);
        }
        return motions;
    }

    // Per height of what stands. Positions are rounded otherwise where the platform has got to.
    [Theory, MemberData(nameof(EvenMotions))]
    public void Even_motion_is_no_motion(string structure, float x, float y)
    {
        using var ground = new FloorWorld(still).With(structure);
        using var lift = new FloorWorld(_ => new Vector3(x, y, x / 2)).With(structure);
        double height = 1, worst = 0;
        for (int i = 0; i < 240; ++i)
        {
            ground.Step();
            lift.Step();
            for (int box = 0; box < lift.Count; ++box)
            {
                height = Math.Max(height, ground.Place(box).Y);
                worst = Math.Max(worst, (lift.Place(box) - ground.Place(box)).Length());
            }
        }
        output.WriteLine($"{worst:e2} m of {height:f1}, moved {lift.Moved:e2}, on the ground {ground.Moved:e2}");
        Assert.InRange(worst / height, 0, 1e-5);
    }

    // Stands for a second, speeds up for one, goes on for one, brakes for one, and stands again.
    static Func<double, Vector3> Ride(Vector3 acceleration) => time => acceleration * (float)(
        Math.Clamp(time + FloorWorld.Dt - 1, 0, 1) - Math.Clamp(time + FloorWorld.Dt - 3, 0, 1));

    [Theory]
    [InlineData("twenty", 0, 1, 0), InlineData("twenty", 0, 3, 0), InlineData("twenty", 0, -1, 0), InlineData("twenty", 0, -3, 0)]
    [InlineData("fifty", 0, 1, 0), InlineData("fifty", 0, 3, 0), InlineData("fifty", 0, -1, 0), InlineData("fifty", 0, -3, 0)]
    [InlineData("wall", 0, 3, 0), InlineData("wall", 0, -3, 0), InlineData("wall", 1, 0, 0)]
    [InlineData("heavy", 0, 3, 0), InlineData("heavy", 0, -3, 0), InlineData("heavy", 3, 0, -1)]
    public void A_ride_moves_nothing_on_the_platform(string structure, float x, float y, float z)
    {
        using var lift = new FloorWorld(Ride(new Vector3(x, y, z))).With(structure);
        var moved = lift.Run(6).Moved;
        output.WriteLine($"{moved:e2} m");
        // Where loads change, what is too little to be handed down adds up; by sweeps alone twenty lose 16 to 27 cm and fifty fall.
        Assert.InRange(moved, 0, structure == "fifty" ? 1e-3 : 5e-4);
    }

    [Theory, InlineData(1), InlineData(3), InlineData(-3)]
    public void A_lift_bears_the_weight_and_the_force_of_inertia(float acceleration)
    {
        using var lift = new FloorWorld(Ride(new Vector3(0, acceleration, 0))).With("twenty");
        foreach (var (until, share) in new (double, int)[] { (0.9, 0), (1.9, 1), (2.9, 0), (3.9, -1), (5, 0) })
        {
            lift.Run(until - lift.Time);
            var expected = 20 * (FloorWorld.Gravity + share * acceleration);
            Assert.InRange(lift.Load / expected, 0.999, 1.001);
        }
    }

    /// <summary>Who starts a lift at once, by three times gravity and more, hits nothing: what stands on it is pressed on.</summary>
    [Theory, InlineData("twenty"), InlineData("fifty"), InlineData("wall"), InlineData("heavy")]
    public void A_lift_may_start_at_once(string structure)
    {
        foreach (var speed in new[] { 0.5f, 2, 10 })
        {
            using var lift = new FloorWorld(time => new Vector3(0, time < 1 ? 0 : speed, 0)).With(structure);
            var moved = lift.Run(4).Moved;
            output.WriteLine($"{speed} m/s: {moved:e2} m");
            Assert.InRange(moved, 0, 2e-3);
        }
    }

    // A stack of n cubes tips over at g / n.
    [Theory, InlineData(1, 3), InlineData(3, 3), InlineData(5, 1.8)]
    public void A_platform_that_shakes_below_the_limit_of_friction_keeps_its_load(int count, double acceleration)
    {
        using var platform = new FloorWorld(time => new Vector3((float)(acceleration / Math.Tau * Math.Sin(Math.Tau * time)), 0, 0));
        platform.AddStack(count);
        var moved = platform.Run(5).Moved;
        output.WriteLine($"{moved:e2} m");
        Assert.InRange(moved, 0, 1e-4);
    }

    // Nine tenths of what friction holds; then more than it holds, by which the load slides on with the difference.
    [Fact]
    public void What_lies_in_a_wagon_slides_when_it_brakes_harder_than_friction()
    {
        static Func<double, Vector3> Brake(double g) =>
            time => new Vector3((float)Math.Max(0, 20 - g * FloorWorld.Gravity * Math.Max(0, time + FloorWorld.Dt - 1)), 0, 0);

        using (var wagon = new FloorWorld(Brake(0.45)))
        {
            wagon.Add(new Vector3(0, 0.1f, 0), new Vector3(1, 0.2f, 1));
            Assert.InRange(wagon.Run(7).Moved, 0, 1e-5);
        }
        foreach (var g in new[] { 0.52, 0.6, 0.8, 2 })
        {
            using var wagon = new FloorWorld(Brake(g));
            wagon.Add(new Vector3(-5, 0.1f, 0), new Vector3(1, 0.2f, 1));
            wagon.Run(1);
            for (double seconds = 0.1; seconds < 0.85; seconds += 0.1)
            {
                wagon.Run(0.1);
                var expected = (g - FloorWorld.Friction) * FloorWorld.Gravity * seconds;
                output.WriteLine($"{g} g: {wagon.Speed(0).X / expected:f4}");
                Assert.InRange(wagon.Speed(0).X / expected, 0.99, 1.01);
            }
        }
    }

    /// <summary>Down at once is an impact: the stack falls freely for some steps, and lands with the speed of the lift.</summary>
    [Theory, InlineData(0.1f, 1e-3), InlineData(0.2f, 0.02), InlineData(0.3f, 0.02)]
    public void A_lift_that_starts_downwards_at_once_puts_its_load_down(float speed, double most)
    {
        using var lift = new FloorWorld(time => new Vector3(0, time < 1 ? 0 : -speed, 0)).With("twenty");
        double lowest = 0;
        while (lift.Time < 6)
        {
            lift.Step();
            for (int box = 0; box < lift.Count; ++box)
                lowest = Math.Max(lowest, 0.5 + box - lift.Place(box).Y);
        }
        output.WriteLine($"{speed} m/s: lower by {lowest:e2} m");
        Assert.InRange(lowest, 0, most);
    }

    // Which contact opens first is decided by rounding, and with it when a stack falls, by up to a tenth: so many are asked that differ by less than is seen.
    [Theory, InlineData(0.11f), InlineData(0.12f)]
    public void What_falls_on_the_ground_falls_on_a_lift(float aside)
    {
        static double Falls(float aside, Func<double, Vector3> velocity)
        {
            const int stacks = 60;
            double sum = 0;
            for (int i = 0; i < stacks; ++i)
            {
                using var lift = new FloorWorld(velocity);
                lift.AddStack(10, aside + i * 1e-6f);
                while (lift.Time < 10 && lift.Moved < 1)
                    lift.Step();
                sum += lift.Time;
            }
            return sum / stacks;
        }

        var onGround = Falls(aside, still);
        output.WriteLine($"{aside} m: {onGround:f3} s on the ground");
        Assert.InRange(onGround, 1, 5);
        foreach (var velocity in new Vector3[] { new(0, 2, 0), new(3, 0, 1) })
        {
            var onLift = Falls(aside, _ => velocity);
            output.WriteLine($"{onLift:f3} s on a floor with {velocity} m/s");
            Assert.InRange(onLift / onGround, 0.98, 1.02);
        }
    }

    /// <summary>
    /// As on the ground (<see cref="LoadPathTests.The_stage_never_adds_energy"/>), to who moves along with the floor, whose velocity changes or not.
    /// </summary>
    [Theory, InlineData(LoadPathMode.WhereNeeded), InlineData(LoadPathMode.Always)]
    public void The_stage_never_adds_energy(LoadPathMode mode)
    {
        var law = new EnergyLaw();
        for (int seed = 0; seed < 20; ++seed)
        {
            var random = new Random(seed);
            float Next(float most) => most * (2 * random.NextSingle() - 1);
            var change = new Vector3(Next(2), Next(3), Next(2)) * (seed % 3);
            using var lift = new FloorWorld(
                time => new Vector3(3, 1, 0) + change * (float)Math.Sin(3 * time), SolveDescription.Default with { LoadPath = mode });
            EnergyLaw.DropPile(random, (place, size, mass) => lift.Add(place, size, mass));
            law.Watch(lift.Simulation, seed, lift.Platform);
            lift.Run(3);
        }
        law.AssertDidSomething();
    }

    /// <summary>A lift that goes down faster than things fall leaves them behind.</summary>
    [Fact]
    public void What_a_lift_drops_falls_freely()
    {
        using var lift = new FloorWorld(time => new Vector3(0, time < 0.5 ? 1 : -10, 0));
        var box = lift.Add(new Vector3(0, 0.5f, 0), Vector3.One);
        lift.Run(0.5);
        var start = lift.Simulation.Bodies[box].Pose.Position.Y;
        lift.Run(0.5);
        var (height, velocity) = (lift.Simulation.Bodies[box].Pose.Position.Y - start, lift.Simulation.Bodies[box].Velocity.Linear.Y);
        Assert.Equal(1 - FloorWorld.Gravity / 2, velocity, 1e-3);
        Assert.Equal(0.5 - FloorWorld.Gravity / 8, height, 0.5 * FloorWorld.Gravity * FloorWorld.Dt / 2);
    }

    /// <summary>To who carries the box with its pose alone, nothing moves: the box stays where it is, and at rest.</summary>
    [Fact]
    public void A_platform_that_is_put_elsewhere_carries_nothing_along()
    {
        using var platform = new FloorWorld(still);
        var box = platform.Add(new Vector3(0, 0.5f, 0), Vector3.One);
        platform.Run(0.5);
        for (int i = 0; i < 60; ++i)
        {
            platform.Simulation.Bodies[platform.Platform].Pose.Position.X += 0.01f;
            platform.Step();
        }
        Assert.InRange((platform.Simulation.Bodies[box].Pose.Position - new Vector3(0, 0.5f, 0)).Length(), 0, 1e-5);
    }

    [Fact]
    public void Threads_and_restoring_do_not_change_a_bit() => FloorWorld.AssertIsRepeatable(
        threads =>
        {
            var world = new FloorWorld(Ride(new Vector3(0.3f, 2, 0)), threads: threads).With("wall");
            for (int i = 0; i < 10; ++i)
                world.Add(new Vector3(3 * i - 15, 0.5f, 5), Vector3.One);
            return world;
        },
        3);

    [Fact]
    public void A_step_makes_no_garbage()
    {
        using var lift = new FloorWorld(Ride(new Vector3(0, 2, 0))).With("wall");
        lift.Run(1.1);
        Assert.Equal(0, Garbage.Of(() => lift.Run(0.5)));
    }
}
