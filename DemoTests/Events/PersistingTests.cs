using System.Collections.Generic;
using System.Linq;
using System.Numerics;
using System.Threading.Tasks;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuPhysics.CollisionDetection;
using DemoTests.Scenes;
using Xunit;

namespace DemoTests.Events;

/// <summary>What persists is written when somebody asks: whoever asks, and whenever, is told of the step and not of what came after it.</summary>
public sealed class PersistingTests
{
    const int BoxCount = 6;

    static (TestWorld World, BodyHandle[] Stack) Create(ITimestepper? timestepper = null)
    {
        var world = new TestWorld(timestepper: timestepper);
        world.AddStatic(new Box(50, 2, 50), new RigidPose(new Vector3(0, -1, 0)));
        var stack = Enumerable.Range(0, BoxCount)
            .Select(i => world.AddDynamic(new Box(1, 1, 1), 1, new RigidPose(new Vector3(.02f * i, .5f + i, 0)))).ToArray();
        foreach (var box in stack)
            world.Simulation.Events.Listen(box, EventMask.All);
        return (world, stack);
    }

    static List<string> Read(CollisionEvents events)
    {
        var told = new List<string>();
        foreach (ref readonly var one in events.Persisting)
        {
            told.Add($"{one.Pair.A.Packed} {one.Pair.B.Packed} {one.Position} {one.Normal} {one.Depth:r}");
            told.Add($"{one.Impulse:r} {one.FrictionImpulse} {one.ApproachSpeed:r}");
            foreach (ref readonly var contact in events.Contacts(one))
                told.Add($"{contact.Position} {contact.Normal} {contact.Depth:r} {contact.Impulse:r} {contact.FeatureId} {contact.ChildA} {contact.ChildB}");
        }
        return told;
    }

    [Fact]
    public void ChangesAfterTheStepDoNotChangeWhatIsToldOfIt()
    {
        var (asked, _) = Create();
        var (changed, stack) = Create();
        using (asked)
        using (changed)
        {
            asked.Step(40);
            changed.Step(40);
            var expected = Read(asked.Simulation.Events);
            Assert.True(expected.Count >= 5 * BoxCount);

            changed.Bodies[stack[1]].Pose.Position += Vector3.UnitY;
            changed.Bodies[stack[2]].Velocity.Linear += Vector3.UnitX;
            changed.Bodies.Remove(stack[0]);
            changed.AddDynamic(new Sphere(1), 1, new RigidPose(new Vector3(5, 5, 5)));
            changed.Bodies.Remove(stack[3]);

            Assert.Equal(expected, Read(changed.Simulation.Events));
            changed.Step();
            // The lowest box lay on the floor and bore one; the fourth lay on one and bore one.
            Assert.Equal(4, changed.Simulation.Events.Ended.Length);
        }
    }

    [Fact]
    public void WhatWasAskedForHoldsUntilTheNextStepIsSolvedAndTheRestIsGone()
    {
        var timestepper = new DefaultTimestepper();
        var (world, _) = Create(timestepper);
        using var end = world;
        var seen = new List<int>();
        world.Step(40);
        timestepper.CollisionsDetected += (_, _) => seen.Add(world.Simulation.Events.Persisting.Length);
        timestepper.ConstraintsSolved += (_, _) => seen.Add(world.Simulation.Events.Persisting.Length);
        world.Step();
        world.Step();
        Assert.Equal([0, BoxCount, BoxCount, BoxCount], seen);
    }

    /// <summary>Stages that a game calls itself, in whatever order, are told of as the step that they are.</summary>
    [Fact]
    public void AStageThatFollowsTheSolverLosesNothing()
    {
        const float dt = TestWorld.Dt;
        var (world, _) = Create();
        var (ordered, _) = Create();
        using (world)
        using (ordered)
        {
            for (int i = 0; i < 40; ++i)
            {
                ordered.Step();
                world.Simulation.PredictBoundingBoxes(dt);
                world.Simulation.CollisionDetection(dt);
                world.Simulation.Solve(dt);
                world.Simulation.Sleep();
            }
            var expected = Read(ordered.Simulation.Events);
            Assert.NotEmpty(expected);
            Assert.Equal(expected, Read(world.Simulation.Events));
        }
    }

    [Fact]
    public void ManyMayReadAtOnce()
    {
        var (world, _) = Create();
        using var end = world;
        for (int step = 0; step < 50; ++step)
        {
            world.Step();
            var readers = new List<string>[4];
            Parallel.For(0, readers.Length, i => readers[i] = Read(world.Simulation.Events));
            foreach (var reader in readers)
                Assert.Equal(readers[0], reader);
        }
        Assert.NotEmpty(Read(world.Simulation.Events));
    }

    // Every pair of the stack pushes with the weight of what is above it, whoever asked in the steps before.
    [Theory]
    [InlineData(1)]
    [InlineData(7)]
    public void ImpulsesAreTheWeightHoweverSeldomSomebodyAsks(int period)
    {
        var (world, _) = Create();
        using var end = world;
        for (int step = 1; step <= 15 * 7; ++step)
        {
            world.Step();
            if (step % period != 0)
                continue;
            var told = world.Simulation.Events.Persisting;
            if (step < 12 * 7)
                continue;
            Assert.Equal(BoxCount, told.Length);
            var impulses = told.ToArray().Select(one => one.Impulse / (9.81f * TestWorld.Dt)).Order().ToArray();
            for (int i = 0; i < BoxCount; ++i)
                Assert.Equal(i + 1, impulses[i], .02f * (i + 1));
        }
    }
}
