using System.Collections.Generic;
using System.Linq;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuPhysics.CollisionDetection;
using BepuUtilities.Memory;
using DemoTests.Scenes;
using Xunit;

namespace DemoTests.Events;

/// <summary>Sensors see what overlaps them when a step begins, and what is marked on its way, and push nothing.</summary>
public sealed class SensorTests
{
    [Theory]
    [InlineData(1)]
    [InlineData(3)]
    public void ASensorSeesABodyFallThroughIt(int threads)
    {
        using var world = new TestWorld(threads: threads);
        using var empty = new TestWorld();
        var zone = world.AddStatic(new Box(4, 1, 4), RigidPose.Identity);
        var events = world.Simulation.Events;
        events.SetSensor(zone, true);
        events.Listen(zone, EventMask.All);
        var pose = new RigidPose(new Vector3(0, 3, 0));
        var ball = world.AddDynamic(new Sphere(.5f), 1, pose);
        empty.AddDynamic(new Sphere(.5f), 1, pose);
        bool wasInside = false;
        int visits = 0;
        for (int step = 0; step < 90; ++step)
        {
            // The ball and the box overlap while its centre is within a radius of the box.
            bool isInside = System.MathF.Abs(world.Bodies[ball].Pose.Position.Y) < 1;
            world.Step();
            empty.Step();
            Assert.Equal(empty.Bodies.ActiveSet.MotionStates[0], world.Bodies.ActiveSet.MotionStates[0]);
            Assert.Equal(isInside && !wasInside ? 1 : 0, events.Began.Length);
            Assert.Equal(!isInside && wasInside ? 1 : 0, events.Ended.Length);
            Assert.Equal(isInside && wasInside ? 1 : 0, events.Persisting.Length);
            Assert.True(events.Hits.IsEmpty);
            Assert.All(events.Began.ToArray(), e => Assert.True(e.IsSensor && e.Pair.B.StaticHandle == zone && events.Contacts(e).IsEmpty));
            visits += events.Began.Length;
            wasInside = isInside;
        }
        Assert.Equal(1, visits);
        Assert.False(wasInside);
    }

    /// <summary>A bullet is seen by what it passes within a step, once, and not by what is behind the wall that stops it, nor by what it misses.</summary>
    [Theory]
    [InlineData(1)]
    [InlineData(3)]
    public void AMarkedBodyIsSeenByThinSensorsOnItsWay(int threads)
    {
        for (int phase = 0; phase < 8; ++phase)
        {
            using var world = new TestWorld(new() { Gravity = default }, threads: threads);
            var events = world.Simulation.Events;
            var handles = new List<StaticHandle>();
            foreach (var x in (float[])[20.3f, 22.1f, 60.7f])
                handles.Add(world.AddStatic(new Box(.01f, 4, 4), new RigidPose(new Vector3(x, 0, 0))));
            // Beside its way, and behind the wall.
            handles.Add(world.AddStatic(new Box(4, .01f, 4), new RigidPose(new Vector3(30, .2f, 0))));
            world.AddStatic(new Box(1, 4, 4), new RigidPose(new Vector3(80, 0, 0)));
            handles.Add(world.AddStatic(new Box(.01f, 4, 4), new RigidPose(new Vector3(80.8f, 0, 0))));
            foreach (var zone in handles)
            {
                events.SetSensor(zone, true);
                events.Listen(zone, EventMask.All);
            }
            var bullet = new Sphere(.05f);
            world.Bodies.Add(BodyDescription.CreateDynamic(new RigidPose(new Vector3(phase, 0, 0)), new BodyVelocity(new Vector3(500, 0, 0)),
                bullet.ComputeInertia(1), new CollidableDescription(world.Simulation.Shapes.Add(bullet), ContinuousDetection.Continuous()), -1));
            var began = new List<StaticHandle>();
            var ended = new List<StaticHandle>();
            for (int step = 0; step < 20; ++step)
            {
                world.Step();
                began.AddRange(events.Began.ToArray().Select(e => e.Pair.B.StaticHandle));
                ended.AddRange(events.Ended.ToArray().Select(e => e.Pair.B.StaticHandle));
                Assert.All(events.Began.ToArray(), e => Assert.True(e.IsSensor));
            }
            Assert.Equal(handles.Take(3), began.OrderBy(handle => handle.Value));
            Assert.Equal(handles.Take(3), ended.OrderBy(handle => handle.Value));
            Assert.InRange(world.Bodies.ActiveSet.MotionStates[0].Pose.Position.X, 79, 79.5f);
        }
    }

    [Fact]
    public void SensorsSeeKinematicsAndStaticsButNoSensors()
    {
        using var pool = new BufferPool();
        // The callbacks of the other tests want a dynamic body in each pair.
        using var simulation = Simulation.Create(pool, new DefaultNarrowPhaseCallbacks(), new DefaultPoseIntegratorCallbacks(), new SolveDescription(1, 4));
        var events = simulation.Events;
        var shape = simulation.Shapes.Add(new Box(1, 1, 1));
        var wall = simulation.Statics.Add(new StaticDescription(RigidPose.Identity, shape));
        var zone = simulation.Statics.Add(new StaticDescription(new RigidPose(new Vector3(.2f, 0, 0)), shape));
        var platform = simulation.Bodies.Add(BodyDescription.CreateKinematic(new RigidPose(new Vector3(.4f, 0, 0)), shape, -1));
        var feeler = simulation.Bodies.Add(BodyDescription.CreateKinematic(new RigidPose(new Vector3(.3f, .3f, 0)), shape, -1));
        events.SetSensor(zone, true);
        events.SetSensor(feeler, true);
        events.Listen(zone, EventMask.Begin);
        events.Listen(feeler, EventMask.Begin);
        simulation.Timestep(TestWorld.Dt);
        var seen = events.Began.ToArray().Select(e => (e.Pair.A.RawHandleValue, e.Pair.B.Mobility, e.Pair.B.RawHandleValue)).ToHashSet();
        var expected = new HashSet<(int, CollidableMobility, int)>
        {
            (platform.Value, CollidableMobility.Kinematic, feeler.Value),
            (platform.Value, CollidableMobility.Static, zone.Value),
            (feeler.Value, CollidableMobility.Static, wall.Value),
        };
        Assert.Equal(expected, seen);
        Assert.All(events.Began.ToArray(), e => Assert.True(e.IsSensor));
        Assert.Equal(0, simulation.NarrowPhase.PairCount);
    }

    [Fact]
    public void AContactThatBecomesASensorEndsAndBegins()
    {
        using var world = new TestWorld();
        var floor = world.AddStatic(new Box(20, 2, 20), new RigidPose(new Vector3(0, -1, 0)));
        var box = world.AddDynamic(new Box(1, 1, 1), 1, new RigidPose(new Vector3(0, .4f, 0)));
        var events = world.Simulation.Events;
        events.Listen(box, EventMask.All);
        world.Step(2);
        Assert.Equal(1, events.Persisting.Length);
        events.SetSensor(floor, true);
        world.Step();
        Assert.Equal((1, 1, 0), (events.Ended.Length, events.Began.Length, events.Persisting.Length));
        Assert.Equal((false, true), (events.Ended[0].IsSensor, events.Began[0].IsSensor));
        Assert.Equal(0, world.Simulation.NarrowPhase.PairCount);
        Assert.True(events.IsSensor(world.Statics[floor].CollidableReference));
        world.Simulation.Validate();
        events.SetSensor(floor, false);
        world.Step();
        Assert.Equal((true, false), (events.Ended[0].IsSensor, events.Began[0].IsSensor));
        world.Simulation.Clear();
        Assert.False(events.IsUsed);
    }
}
