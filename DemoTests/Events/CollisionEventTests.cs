using System;
using System.Collections.Generic;
using System.Linq;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuPhysics.CollisionDetection;
using DemoTests.Scenes;
using Xunit;

namespace DemoTests.Events;

/// <summary>Begin, end, hit and persist, by what the laws of motion say of impulses and by brute force.</summary>
public sealed class CollisionEventTests
{
    const float Gravity = 9.81f;

    static StaticHandle AddFloor(TestWorld world) => world.AddStatic(new Box(50, 2, 50), new RigidPose(new Vector3(0, -1, 0)));

    [Fact]
    public void ABoxThatIsDroppedAndLiftedBeginsAndEndsOnce()
    {
        using var world = new TestWorld();
        var floor = AddFloor(world);
        var box = world.AddDynamic(new Box(1, 1, 1), 2, new RigidPose(new Vector3(0, 2, 0)));
        var events = world.Simulation.Events;
        events.Listen(box, EventMask.All);
        int began = 0, ended = 0, hits = 0, persisting = 0;
        for (int step = 0; step < 240; ++step)
        {
            if (step == 180)
                world.Bodies[box].Velocity.Linear = new Vector3(0, 8, 0);
            world.Step();
            began += events.Began.Length;
            ended += events.Ended.Length;
            hits += events.Hits.Length;
            persisting += events.Persisting.Length;
            foreach (ref readonly var contact in events.Began)
            {
                Assert.Equal((box, floor), (contact.Pair.A.BodyHandle, contact.Pair.B.StaticHandle));
                Assert.InRange((contact.Normal - Vector3.UnitY).Length(), 0, 1e-3f);
                Assert.InRange(contact.Position.Y, -.15f, .15f);
                // It falls by 1.5 m.
                Assert.InRange(contact.ApproachSpeed, 5.0f, MathF.Sqrt(2 * Gravity * 1.5f) + .01f);
                Assert.False(contact.IsSensor);
            }
        }
        Assert.Equal((1, 1, 1), (began, ended, hits));
        Assert.InRange(persisting, 100, 150);
    }

    [Fact]
    public void ImpulsesAreWhatMotionLost()
    {
        using var world = new TestWorld();
        AddFloor(world);
        const float mass = 3;
        var box = world.AddDynamic(new Box(1, 1, 1), mass, new RigidPose(new Vector3(0, 1.5f, 0)), new BodyVelocity(new Vector3(4, -2, 0)));
        var events = world.Simulation.Events;
        events.Listen(box, EventMask.All);
        var given = new Vector3();
        const int steps = 120;
        for (int step = 0; step < steps; ++step)
        {
            var before = world.Bodies[box].Velocity.Linear;
            world.Step();
            var change = mass * (world.Bodies[box].Velocity.Linear - before) + new Vector3(0, mass * Gravity * TestWorld.Dt, 0);
            var told = new Vector3();
            foreach (var list in new[] { events.Began.ToArray(), events.Persisting.ToArray() })
            {
                foreach (var contact in list)
                {
                    told += contact.Impulse * contact.Normal + contact.FrictionImpulse;
                    float sum = 0;
                    foreach (ref readonly var one in events.Contacts(contact))
                        sum += one.Impulse;
                    Assert.Equal(contact.Impulse, sum, 1e-4f);
                }
            }
            given += told;
            Assert.InRange((told - change).Length(), 0, .01f * MathF.Max(change.Length(), mass * Gravity * TestWorld.Dt));
        }
        // It has come to rest: all momentum and all weight went into the floor.
        var expected = mass * new Vector3(-4, 2 + Gravity * TestWorld.Dt * steps, 0);
        Assert.InRange((given - expected).Length(), 0, .01f * expected.Length());
    }

    [Fact]
    public void ABounceHits()
    {
        const float restitution = .7f, mass = 2, speed = 6;
        using var world = new TestWorld(restitution: restitution);
        AddFloor(world);
        var ball = world.AddDynamic(new Sphere(.5f), mass, new RigidPose(new Vector3(0, 1.5f, 0)), new BodyVelocity(new Vector3(0, -speed, 0)));
        var events = world.Simulation.Events;
        events.Listen(ball, EventMask.Begin | EventMask.Hit);
        for (int step = 0; step < 30; ++step)
        {
            world.Step();
            Assert.Equal(events.Began.Length, events.Hits.Length);
            if (events.Hits.IsEmpty)
                continue;
            var impact = MathF.Sqrt(speed * speed + 2 * Gravity);
            Assert.InRange(events.Hits[0].Impulse / (mass * (1 + restitution) * impact), .98f, 1.02f);
            return;
        }
        Assert.Fail("The ball has not hit the floor.");
    }

    [Fact]
    public void ANearMissIsNoEvent()
    {
        using var world = new TestWorld();
        world.AddKinematic(new Box(1, 1, 1), RigidPose.Identity);
        var ball = world.AddDynamic(new Sphere(.25f), 1, new RigidPose(new Vector3(-2, .85f, 0)), new BodyVelocity(new Vector3(20, 0, 0)));
        var events = world.Simulation.Events;
        events.Listen(ball, EventMask.All);
        int foreseen = 0;
        for (int step = 0; step < 12; ++step)
        {
            world.Step();
            foreseen += world.Simulation.NarrowPhase.PairCount;
            Assert.Equal(0, events.Began.Length + events.Ended.Length + events.Hits.Length + events.Persisting.Length);
        }
        Assert.True(foreseen > 0);
    }

    [Fact]
    public void WhatIsListenedToLaterBeginsThen()
    {
        using var world = new TestWorld();
        var floor = AddFloor(world);
        var box = world.AddDynamic(new Box(1, 1, 1), 2, new RigidPose(new Vector3(0, .5f, 0)));
        world.AddDynamic(new Box(1, 1, 1), 2, new RigidPose(new Vector3(5, .5f, 0)));
        var events = world.Simulation.Events;
        world.Step(30);
        Assert.False(events.IsUsed);
        events.Listen(box, EventMask.Begin);
        world.Step();
        Assert.Equal(1, events.Began.Length);
        world.Step();
        Assert.Equal(0, events.Began.Length + events.Persisting.Length);
        events.Listen(floor, EventMask.All);
        world.Step();
        Assert.Equal((1, 1), (events.Began.Length, events.Persisting.Length));
        events.Listen(floor, EventMask.None);
        events.Listen(box, EventMask.None);
        world.Step();
        Assert.Equal(0, events.Began.Length + events.Persisting.Length + events.Ended.Length);
    }

    [Fact]
    public void RemovalEndsInTheNextStep()
    {
        using var world = new TestWorld();
        var floor = AddFloor(world);
        var boxes = new List<BodyHandle>();
        for (int i = 0; i < 5; ++i)
        {
            boxes.Add(world.AddDynamic(new Box(1, 1, 1), 1, new RigidPose(new Vector3(3 * i, .5f, 0))));
            world.Simulation.Events.Listen(boxes[i], EventMask.Begin | EventMask.End);
        }
        var events = world.Simulation.Events;
        world.Step(20);
        world.Bodies.Remove(boxes[1]);
        world.Bodies.Remove(boxes[3]);
        // Another body in the slot of one that is gone.
        var next = world.AddDynamic(new Box(1, 1, 1), 1, new RigidPose(new Vector3(0, 30, 0)));
        Assert.Equal(boxes[3].Slot, next.Slot);
        Assert.Equal(EventMask.None, events.GetMask(world.Bodies[next].CollidableReference));
        world.Step();
        Assert.Equal([boxes[1], boxes[3]], events.Ended.ToArray().Select(e => e.Pair.A.BodyHandle));
        Assert.False(world.Bodies.BodyExists(events.Ended[0].Pair.A.BodyHandle));
        world.Statics.Remove(floor);
        world.Step();
        Assert.Equal([boxes[0], boxes[2], boxes[4]], events.Ended.ToArray().Select(e => e.Pair.A.BodyHandle));
        world.Step();
        Assert.Equal(0, events.Ended.Length);
    }

    static List<BodyHandle> AddHeap(TestWorld world, int count, bool spheres, bool listens)
    {
        var random = new Random(4);
        var bodies = new List<BodyHandle>();
        for (int i = 0; i < count; ++i)
        {
            var pose = new RigidPose(TestWorld.Scatter(random, 6) + new Vector3(0, 4, 0), TestWorld.Turn(random));
            bodies.Add(spheres || i % 2 == 0
                ? world.AddDynamic(new Sphere(.4f), 1, pose)
                : world.AddDynamic(new Box(.7f, .6f, .8f), 1, pose));
            if (listens)
                world.Simulation.Events.Listen(bodies[i], EventMask.All);
        }
        return bodies;
    }

    static List<(int, ulong, float, float, Vector3, Vector3)> Record(int threads, out List<ulong> hashes)
    {
        using var world = new TestWorld(threads: threads);
        AddFloor(world);
        AddHeap(world, 300, spheres: false, listens: true);
        var events = world.Simulation.Events;
        var stream = new List<(int, ulong, float, float, Vector3, Vector3)>();
        hashes = [];
        for (int step = 0; step < 90; ++step)
        {
            world.Step();
            hashes.Add(world.Simulation.StateHash());
            Add(step * 4, events.Began);
            Add(step * 4 + 1, events.Ended);
            Add(step * 4 + 2, events.Hits);
            Add(step * 4 + 3, events.Persisting);
        }
        return stream;

        void Add(int id, ReadOnlySpan<ContactEvent> list)
        {
            foreach (ref readonly var e in list)
                stream.Add((id, (ulong)e.Pair.A.Packed << 32 | e.Pair.B.Packed, e.Impulse, e.Depth, e.Position, e.FrictionImpulse));
        }
    }

    [Fact]
    public void TheStreamDependsOnNoThreadAndIsInOrderOfPairs()
    {
        var stream = Record(1, out var hashes);
        Assert.Equal(stream, Record(3, out var otherHashes));
        Assert.Equal(hashes, otherHashes);
        Assert.True(stream.Count > 10_000);
        for (int i = 1; i < stream.Count; ++i)
            Assert.True(stream[i - 1].Item1 < stream[i].Item1 || stream[i - 1].Item2 < stream[i].Item2);
    }

    [Fact]
    public void ListeningChangesNothingInTheWorld()
    {
        Record(1, out var hashes);
        using var world = new TestWorld();
        AddFloor(world);
        AddHeap(world, 300, spheres: false, listens: false);
        Assert.Equal(hashes, world.HashSteps(90));
    }

    [Fact]
    public void WhatTouchesIsWhatOverlapsOrPushes()
    {
        using var world = new TestWorld();
        var bodies = AddHeap(world, 150, spheres: true, listens: true);
        AddFloor(world);
        var events = world.Simulation.Events;
        var touching = new HashSet<(BodyHandle, BodyHandle)>();
        var places = new Vector3[bodies.Count];
        int most = 0;
        for (int step = 0; step < 60; ++step)
        {
            for (int i = 0; i < bodies.Count; ++i)
                places[i] = world.Bodies[bodies[i]].Pose.Position;
            world.Step();
            foreach (ref readonly var e in events.Ended)
                Assert.True(e.Pair.B.Mobility == CollidableMobility.Static || touching.Remove((e.Pair.A.BodyHandle, e.Pair.B.BodyHandle)));
            foreach (ref readonly var e in events.Began)
                Assert.True(e.Pair.B.Mobility == CollidableMobility.Static || touching.Add((e.Pair.A.BodyHandle, e.Pair.B.BodyHandle)));
            var pushing = events.Began.ToArray().Concat(events.Persisting.ToArray()).Where(e => e.Impulse > 0)
                .Select(e => (e.Pair.A.BodyHandle, e.Pair.B.BodyHandle)).ToHashSet();
            for (int i = 0; i < bodies.Count; ++i)
            {
                for (int j = i + 1; j < bodies.Count; ++j)
                {
                    var depth = .8f - (places[i] - places[j]).Length();
                    var pair = (bodies[i], bodies[j]);
                    if (MathF.Abs(depth) > 1e-5f)
                        Assert.Equal(depth > 0 || pushing.Contains(pair), touching.Contains(pair));
                }
            }
            most = Math.Max(most, touching.Count);
        }
        Assert.True(most > 10);
    }

    [Fact]
    public void NobodyWhoListensMakesGarbage()
    {
        using var world = new TestWorld();
        AddFloor(world);
        AddHeap(world, 60, spheres: false, listens: true);
        world.Step(200);
        long before = GC.GetAllocatedBytesForCurrentThread();
        world.Step(50);
        Assert.Equal(before, GC.GetAllocatedBytesForCurrentThread());
        Assert.True(world.Simulation.Events.Persisting.Length > 30);
    }

    [Fact]
    public void BadCallsAreRefused()
    {
        using var world = new TestWorld();
        var body = world.AddDynamic(new Sphere(1), 1, RigidPose.Identity);
        var events = world.Simulation.Events;
        Assert.Throws<ArgumentException>(() => events.Listen(body, (EventMask)32));
        Assert.Throws<ArgumentException>(() => events.Listen(body, (EventMask)128));
        Assert.Throws<ArgumentOutOfRangeException>(() => events.HitSpeed = -1);
        Assert.Throws<ArgumentOutOfRangeException>(() => events.HitSpeed = float.NaN);
        Assert.Equal(1, events.HitSpeed);
        world.Bodies.Remove(body);
        Assert.Throws<ArgumentException>(() => events.Listen(body, EventMask.All));
        Assert.Throws<ArgumentException>(() => events.SetSensor(body, true));
        Assert.Throws<ArgumentException>(() => events.Listen(new StaticHandle(0), EventMask.All));
        Assert.False(events.IsUsed);
    }
}
