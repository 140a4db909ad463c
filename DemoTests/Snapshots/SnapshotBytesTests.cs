using System;
using System.Collections.Generic;
using System.Linq;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuPhysics.CollisionDetection;
using BepuPhysics.Constraints;
using BepuUtilities.Memory;
using DemoTests.Scenes;
using DemoTests.Support;
using Xunit;

namespace DemoTests.Snapshots;

/// <summary>Snapshots as bytes, as memory, and what is refused.</summary>
public class SnapshotBytesTests
{
    [Fact]
    public void Bytes_that_were_written_go_on_in_a_simulation_that_never_saw_the_saved_one()
    {
        var scene = SmallScenes.Pile("hull-pile", 3, 3);
        using var world = new SceneWorld(scene, threads: 2);
        using var pool = new BufferPool();
        using var snapshot = new SimulationSnapshot(pool);
        world.HashSteps(30);
        world.Simulation.Save(snapshot);
        var bytes = new byte[snapshot.SerializedByteCount];
        snapshot.WriteTo(bytes);
        var expected = world.HashSteps(30);

        using var read = new SimulationSnapshot(pool);
        read.ReadFrom(bytes);
        using var other = new SceneWorld(scene, threads: 1);
        other.Simulation.Restore(read);
        other.Simulation.Validate();
        Assert.Equal(expected, other.HashSteps(30));
    }

    [Fact]
    public void What_was_restored_is_saved_as_the_same_bytes()
    {
        using var world = new SceneWorld(SmallScenes.Pyramids(1, 6), threads: 1);
        using var pool = new BufferPool();
        using var first = new SimulationSnapshot(pool);
        using var second = new SimulationSnapshot(pool);
        world.HashSteps(20);
        world.Simulation.Save(first);
        world.HashSteps(20);
        world.Simulation.Restore(first);
        world.Simulation.Save(second);
        Assert.Equal(Written(first), Written(second));
    }

    [Fact]
    public void Damaged_bytes_are_refused_and_the_snapshot_holds_what_it_held()
    {
        using var world = new SceneWorld(SmallScenes.Pyramids(1, 4), threads: 1);
        using var pool = new BufferPool();
        using var snapshot = new SimulationSnapshot(pool);
        world.HashSteps(10);
        world.Simulation.Save(snapshot);
        var bytes = Written(snapshot);
        var random = new Random(5);
        for (int i = 0; i < 400; ++i)
        {
            var damaged = bytes.ToArray();
            if (i % 4 == 0)
                damaged = damaged[..random.Next(damaged.Length)];
            else
                // The header too.
                damaged[i % 4 == 1 ? random.Next(32) : random.Next(damaged.Length)] ^= (byte)(1 << random.Next(8));
            Assert.Throws<ArgumentException>(() => snapshot.ReadFrom(damaged));
        }
        Assert.Throws<ArgumentException>(() => snapshot.ReadFrom([.. bytes, 0]));
        Assert.Throws<ArgumentException>(() => snapshot.WriteTo(new byte[bytes.Length - 1]));
        Assert.Equal(bytes, Written(snapshot));
    }

    [Fact]
    public void What_cannot_be_restored_is_refused_and_changes_nothing()
    {
        using var world = new TestWorld();
        using var pool = new BufferPool();
        using var snapshot = new SimulationSnapshot(pool);
        Assert.Throws<InvalidOperationException>(() => world.Simulation.Restore(snapshot));
        Assert.Throws<InvalidOperationException>(() => snapshot.WriteTo(new byte[100]));
        Assert.Throws<ArgumentNullException>(() => world.Simulation.Restore(null!));
        Assert.Throws<ArgumentNullException>(() => world.Simulation.Save(null!));
        world.AddStatic(new Box(20, 1, 20), new RigidPose(new Vector3(0, -.5f, 0)));
        var ball = world.AddDynamic(new Sphere(.5f), 1, new RigidPose(new Vector3(0, 1, 0)));
        world.Step(5);
        world.Simulation.Save(snapshot);

        // Another shape under the same name.
        var shape = world.Bodies[ball].Collidable.Shape;
        world.Bodies.Remove(ball);
        world.Simulation.Shapes.RemoveAndDispose(shape, world.Pool);
        var hash = world.Simulation.StateHash();
        Assert.Contains("shape", Assert.Throws<InvalidOperationException>(() => world.Simulation.Restore(snapshot)).Message, StringComparison.Ordinal);
        Assert.Equal(shape, world.Simulation.Shapes.Add(new Sphere(.5f)));
        Assert.Throws<InvalidOperationException>(() => world.Simulation.Restore(snapshot));
        Assert.Equal(hash, world.Simulation.StateHash());
        world.Simulation.Validate();

        using var other = new TestWorld(fallbackBatchThreshold: 8);
        Assert.Contains("threshold", Assert.Throws<InvalidOperationException>(() => other.Simulation.Restore(snapshot)).Message, StringComparison.Ordinal);
        snapshot.Dispose();
        Assert.Throws<ObjectDisposedException>(() => world.Simulation.Restore(snapshot));
        Assert.Throws<ObjectDisposedException>(() => world.Simulation.Save(snapshot));
    }

    [Fact]
    public void Nothing_is_saved_or_restored_within_a_step()
    {
        using var world = new TestWorld();
        using var pool = new BufferPool();
        using var snapshot = new SimulationSnapshot(pool);
        world.AddDynamic(new Sphere(.5f), 1, new RigidPose(new Vector3(0, 1, 0)));
        world.Simulation.Save(snapshot);
        int refused = 0;
        world.Solver.SubstepStarted += _ =>
        {
            Assert.Throws<InvalidOperationException>(() => world.Simulation.Save(snapshot));
            Assert.Throws<InvalidOperationException>(() => world.Simulation.Restore(snapshot));
            ++refused;
        };
        world.Step();
        Assert.True(refused > 0);
        world.Simulation.Validate();
    }

    [Fact]
    public void Going_back_again_and_again_takes_no_memory()
    {
        using var world = new SceneWorld(SmallScenes.Pile("shape-pile", 4, 3), threads: 1);
        using var pool = new BufferPool();
        using var snapshot = new SimulationSnapshot(pool);
        world.HashSteps(60);
        for (int i = 0; i < 10; ++i)
            Roll();
        var before = world.PoolBytes + pool.GetTotalAllocatedByteCount();
        Assert.Equal(0, Garbage.Of(() =>
        {
            for (int i = 0; i < 10; ++i)
                Roll();
        }));
        Assert.Equal(before, world.PoolBytes + pool.GetTotalAllocatedByteCount());

        // The same steps again and again, and fewer than there are until pools give back what nobody borrows.
        void Roll()
        {
            world.Simulation.Save(snapshot);
            for (int j = 0; j < 3; ++j)
                world.Step();
            world.Simulation.Restore(snapshot);
        }
    }

    [Fact]
    public void Events_layers_sleep_and_joints_go_on_as_they_would_have()
    {
        using var pool = new BufferPool();
        using var snapshot = new SimulationSnapshot(pool);
        using var plain = new EventfulWorld();
        using var rolled = new EventfulWorld();
        for (int step = 0; step < 150; ++step)
        {
            rolled.World.Simulation.Save(snapshot);
            rolled.Disturb(step);
            rolled.World.Simulation.Restore(snapshot);
            Assert.Equal(plain.StepAndTell(), rolled.StepAndTell());
        }
        Assert.Contains(plain.Told, text => text.StartsWith("began", StringComparison.Ordinal));
        Assert.Contains(plain.Told, text => text.StartsWith("slept", StringComparison.Ordinal));
        Assert.Contains(plain.Told, text => text.StartsWith("broke", StringComparison.Ordinal));
    }

    static byte[] Written(SimulationSnapshot snapshot)
    {
        var bytes = new byte[snapshot.SerializedByteCount];
        snapshot.WriteTo(bytes);
        return bytes;
    }

    // Boxes that fall, touch, rest and sleep; one hangs on a joint that breaks when another lands on it.
    sealed class EventfulWorld : IDisposable
    {
        readonly BodyHandle[] boxes = new BodyHandle[6];

        public EventfulWorld()
        {
            var floor = World.AddStatic(new Box(40, 1, 40), new RigidPose(new Vector3(0, -.5f, 0)));
            World.Simulation.Events.Listen(floor, EventMask.All);
            var box = new Box(1, 1, 1);
            var shape = World.Simulation.Shapes.Add(box);
            for (int i = 0; i < boxes.Length; ++i)
            {
                boxes[i] = World.Bodies.Add(BodyDescription.CreateDynamic(
                    new Vector3(i < 4 ? 3 * i : 12, i < 4 ? 1 + i : 4 * (i - 3), 0), box.ComputeInertia(1), shape, new BodyActivityDescription(.02f, 8)));
                World.Simulation.Events.Listen(boxes[i], EventMask.All);
            }
            World.Simulation.Layers[boxes[1]] = new CollisionLayers(2, 1);
            var joint = World.Solver.Add(boxes[4], new OneBodyLinearServo
            {
                Target = new Vector3(12, 4, 0),
                ServoSettings = ServoSettings.Default,
                SpringSettings = new SpringSettings(20, 1),
            });
            World.Solver.SetBreakThreshold(joint, new BreakThreshold { Impulse = 1, AngularImpulse = float.PositiveInfinity });
        }

        public TestWorld World { get; } = new();

        public List<string> Told { get; } = [];

        public void Disturb(int seed)
        {
            var random = new Random(seed);
            World.Simulation.Events.Listen(boxes[random.Next(boxes.Length)], EventMask.None);
            World.Simulation.Layers[boxes[random.Next(boxes.Length)]] = new CollisionLayers(4, 4);
            var box = World.Bodies[boxes[random.Next(boxes.Length)]];
            box.Awake = random.Next(2) == 0;
            if (random.Next(3) == 0)
                World.Bodies.Remove(boxes[random.Next(boxes.Length)]);
            World.Step(random.Next(3));
        }

        public string StepAndTell()
        {
            World.Step();
            World.Simulation.Validate();
            var events = World.Simulation.Events;
            var told = new List<string>();
            foreach (ref readonly var began in events.Began)
                told.Add($"began {began.Pair} {began.Impulse:R}");
            foreach (ref readonly var ended in events.Ended)
                told.Add($"ended {ended.Pair}");
            foreach (ref readonly var hit in events.Hits)
                told.Add($"hit {hit.Pair} {hit.ApproachSpeed:R}");
            foreach (var body in events.Slept)
                told.Add($"slept {body}");
            foreach (var body in events.Woke)
                told.Add($"woke {body}");
            foreach (ref readonly var broken in World.Solver.BrokenConstraints)
                told.Add($"broke {broken.Handle} {broken.Impulse:R}");
            Told.AddRange(told);
            return $"{World.Simulation.StateHash():x} {string.Join("; ", told)}";
        }

        public void Dispose() => World.Dispose();
    }
}
