using System;
using System.Numerics;
using BepuPhysics;
using Demos.Accuracy;
using DemoTests.Scenes;
using Xunit;

namespace DemoTests.Determinism;

/// <summary>
/// What becomes of a body does not depend on bodies that it has nothing to do with: not on the lane that it lands in, nor on what
/// happens in the lanes beside it. With another width of vectors it has other neighbours, so this is also what makes widths agree.
/// </summary>
public class UnrelatedBodyTests
{
    const int Steps = 40;

    public static TheoryData<int, int, int> Cases()
    {
        var cases = new TheoryData<int, int, int>();
        for (int seed = 1; seed <= 12; ++seed)
            cases.Add(seed, seed % 3 == 0 ? 16 : 4, seed % 2);
        return cases;
    }

    [Theory]
    [MemberData(nameof(Cases))]
    public void A_body_that_touches_nobody_changes_no_bit_of_the_others(int seed, int substeps, int relaxations)
    {
        var settings = new AccuracySettings { SubstepCount = substeps, RelaxationCount = relaxations };
        var scene = new RandomScene(seed, Ingredients.Contacts | Ingredients.Joints);
        var expected = Run(settings, scene, _ => null);
        var random = new Random(seed);
        for (int round = 0; round < 4; ++round)
        {
            // Before any of the others, or behind them all.
            int place = random.Next(scene.BodyCount);
            var stranger = RandomScene.AnyBody(random);
            stranger.Pose.Position += new Vector3(0, 5000, 0);
            if (round == 0)
                stranger.Velocity.Linear = new Vector3(0, 700, 0);
            expected.AssertSame(Run(settings, scene, i => i == place ? stranger : null), $"a stranger at {place}");
        }
    }

    [Theory]
    [InlineData(false)]
    [InlineData(true)]
    public void A_velocity_that_a_game_writes_begins_anew(bool writesPose)
    {
        // Two bodies with the same pose and velocity; one has lost something to rounding before.
        using var world = new TestWorld();
        var inertia = new BodyInertia { InverseMass = 1 };
        var first = world.Bodies.Add(BodyDescription.CreateDynamic(
            RigidPose.Identity, new BodyVelocity(new Vector3(703.1f, -311.7f, 1234.5f), default), inertia, default, new(-1)));
        world.Step(7);
        var pose = writesPose ? new RigidPose(new Vector3(1, 2, 3)) : world.Bodies[first].Pose;
        var velocity = new BodyVelocity(new Vector3(812.3f, 77.7f, -402.1f), default);
        var second = world.Bodies.Add(BodyDescription.CreateDynamic(pose, velocity, inertia, default, new(-1)));
        if (writesPose)
            world.Bodies[first].Pose = pose;
        world.Bodies[first].Velocity = velocity;
        for (int i = 0; i < 20; ++i)
        {
            world.Step();
            Assert.Equal(world.Bodies[second].Velocity.Linear, world.Bodies[first].Velocity.Linear);
            if (writesPose)
                Assert.Equal(world.Bodies[second].Pose.Position, world.Bodies[first].Pose.Position);
        }
    }

    [Theory]
    [InlineData(0)]
    [InlineData(1)]
    public void A_fast_body_keeps_what_rounding_takes_from_step_to_step(int relaxations)
    {
        // 60 s of gravity added to 1,234.5 m/s sideways and 3,000 m/s upwards; a float there is 2.4e-4 m/s wide.
        using var world = new TestWorld(new AccuracySettings { RelaxationCount = relaxations });
        var body = world.Bodies.Add(BodyDescription.CreateDynamic(RigidPose.Identity, new BodyVelocity(new Vector3(1234.5f, 3000, 0), default),
            new BodyInertia { InverseMass = 1 }, default, new(-1)));
        world.Step(3600);
        var expected = 3000 - 9.81f * (double)TestWorld.Dt * 3600;
        Assert.Equal(expected, world.Bodies[body].Velocity.Linear.Y, 5e-4);
    }

    static BodyStates Run(AccuracySettings settings, RandomScene scene, Func<int, BodyDescription?> stranger)
    {
        using var world = new TestWorld(settings);
        var handles = scene.AddTo(world, i =>
        {
            if (stranger(i) is { } description)
                world.Bodies.Add(description);
        });
        return BodyStates.Of(world, handles, Steps);
    }
}
