using System;
using System.Collections.Generic;
using System.Linq;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Characters;
using BepuPhysics.Collidables;
using BepuPhysics.CollisionDetection;
using BepuUtilities.Memory;
using DemoTests.Support;
using Xunit;

namespace DemoTests.Characters;

/// <summary>Characters as a set: they come and go, are saved, and depend on nothing but their world.</summary>
public class CharacterSetTests
{
    [Fact]
    public void Threads_do_not_change_a_bit()
    {
        Assert.Equal(Hashes(1), Hashes(2));
        Assert.Equal(Hashes(1), Hashes(5));

        static List<ulong> Hashes(int threads)
        {
            using var world = new CharacterWorld(threads);
            var bodies = world.AddCrowd(1);
            var hashes = new List<ulong>();
            for (int i = 0; i < 120; ++i)
            {
                world.StepCrowd(bodies, i);
                hashes.Add(world.Simulation.StateHash());
            }
            return hashes;
        }
    }

    [Fact]
    public void A_restored_crowd_goes_on_as_the_saved_one()
    {
        using var world = new CharacterWorld();
        var bodies = world.AddCrowd(2);
        for (int i = 0; i < 60; ++i)
            world.StepCrowd(bodies, i);
        using var snapshot = new SimulationSnapshot(world.Pool);
        world.Simulation.Save(snapshot);
        var saved = new byte[world.Characters.SerializedByteCount];
        world.Characters.WriteTo(saved);
        var first = GoOn();
        // Meanwhile one has gone.
        world.Characters.RemoveCharacterByBodyHandle(bodies[3]);
        world.Simulation.Restore(snapshot);
        world.Characters.ReadFrom(saved);
        Assert.Equal(first, GoOn());

        List<ulong> GoOn()
        {
            var hashes = new List<ulong>();
            for (int i = 60; i < 120; ++i)
            {
                world.StepCrowd(bodies, i);
                hashes.Add(world.Simulation.StateHash());
            }
            return hashes;
        }
    }

    [Fact]
    public void Bytes_that_are_none_of_characters_are_refused()
    {
        using var world = new CharacterWorld();
        world.AddFloor();
        var body = world.Add(default);
        world.Step(5);
        var saved = new byte[world.Characters.SerializedByteCount];
        Assert.Throws<ArgumentException>(() => world.Characters.WriteTo(saved.AsSpan(1)));
        world.Characters.WriteTo(saved);
        Assert.Throws<ArgumentException>(() => world.Characters.ReadFrom(saved.AsSpan(0, saved.Length - 1)));
        Assert.Throws<ArgumentException>(() => world.Characters.ReadFrom(default));
        world.Add(new(3, 0, 0));
        var twice = new byte[world.Characters.SerializedByteCount];
        world.Characters.WriteTo(twice);
        saved.AsSpan(^(twice.Length - saved.Length)..).CopyTo(twice.AsSpan(saved.Length));
        Assert.Contains("one body", Assert.Throws<ArgumentException>(() => world.Characters.ReadFrom(twice)).Message, StringComparison.Ordinal);
        Assert.Equal(0, world.Characters.GetCharacterIndexForBodyHandle(body.Value));
        saved[0] ^= 1;
        Assert.Throws<ArgumentException>(() => world.Characters.ReadFrom(saved));
        Assert.True(world.Characters.IsCharacter(body));
    }

    [Fact]
    public void Steps_leave_no_garbage()
    {
        using var world = new CharacterWorld();
        var bodies = world.AddCrowd(3);
        for (int i = 0; i < 240; ++i)
            world.StepCrowd(bodies, i);
        foreach (var body in bodies)
            world[body].TargetVelocity = new(2, 3);
        var before = GC.GetAllocatedBytesForCurrentThread();
        world.Step(60);
        Assert.Equal(0, GC.GetAllocatedBytesForCurrentThread() - before);
    }

    [Fact]
    public void Characters_come_and_go()
    {
        using var world = new CharacterWorld();
        world.AddFloor();
        var bodies = new List<BodyHandle>();
        for (int i = 0; i < 100; ++i)
            bodies.Add(world.Add(new(i % 10 * 2, 0, i / 10 * 2)));
        world.Step(10);
        Assert.Equal(100, world.Simulation.Solver.CountConstraints() - ContactCount(world));
        for (int i = 0; i < 100; i += 2)
        {
            world.Characters.RemoveCharacterByBodyHandle(bodies[i]);
            world.Simulation.Bodies.Remove(bodies[i]);
        }
        Assert.Equal(50, world.Characters.CharacterCount);
        for (int i = 0; i < 100; ++i)
            Assert.Equal(i % 2 == 1, world.Characters.IsCharacter(bodies[i]));
        for (int i = 0; i < 50; ++i)
            Assert.Equal(i, world.Characters.GetCharacterIndexForBodyHandle(world.Characters.GetCharacterByIndex(i).BodyHandle.Value));
        world.Step(10);
        Assert.Equal(50, world.Simulation.Solver.CountConstraints() - ContactCount(world));
        world.Simulation.Validate();
    }

    // Each stands on the floor alone.
    static int ContactCount(CharacterWorld world) => world.Characters.CharacterCount;

    [Fact]
    public void What_a_game_does_wrong_is_said()
    {
        using var world = new CharacterWorld();
        world.AddFloor();
        var body = world.Add(default);
        var kinematic = world.Simulation.Bodies.Add(
            BodyDescription.CreateKinematic(new RigidPose(new Vector3(5, 5, 5)), world.Simulation.Shapes.Add(new Sphere(1)), -1));
        Assert.Throws<ArgumentException>(() => world.Characters.AllocateCharacter(body));
        Assert.Throws<ArgumentException>(() => world.Characters.AllocateCharacter(kinematic));
        Assert.Throws<ArgumentException>(() => world.Characters.GetCharacterByBodyHandle(kinematic));
        Assert.Throws<ArgumentOutOfRangeException>(() => world.Characters.GetCharacterByIndex(1));
        world[body].TargetVelocity = new(float.NaN, 0);
        Assert.Contains("TargetVelocity", Assert.Throws<InvalidOperationException>(() => world.Step()).Message, StringComparison.Ordinal);
        world[body].TargetVelocity = default;
        world[body].MaximumStepHeight = -1;
        Assert.Contains("MaximumStepHeight", Assert.Throws<InvalidOperationException>(() => world.Step()).Message, StringComparison.Ordinal);
        world[body].MaximumStepHeight = 0;
        world.Step();
        world.Simulation.Bodies.Remove(body);
        Assert.Contains("RemoveCharacter", Assert.Throws<InvalidOperationException>(() => world.Step()).Message, StringComparison.Ordinal);
    }

    [Fact]
    public void A_body_in_the_slot_of_a_removed_character_is_no_character_before_that_is_none()
    {
        using var world = new CharacterWorld();
        world.AddFloor();
        var first = world.Add(default);
        world.Simulation.Bodies.Remove(first);
        Assert.Contains(first.ToString(), Assert.Throws<InvalidOperationException>(() => world.Add(default)).Message, StringComparison.Ordinal);
        var second = world.Simulation.Bodies.ActiveSet.IndexToHandle[0];
        Assert.Equal(first.Slot, second.Slot);
        world.Characters.RemoveCharacterByBodyHandle(first);
        world.Characters.AllocateCharacter(second);
        Assert.Equal((1, 0), (world.Characters.CharacterCount, world.Characters.GetCharacterIndexForBodyHandle(second.Value)));
        world.Step();
    }

    public static TheoryData<string> NumbersOfACharacter => [.. FloatFields.Of(typeof(CharacterController)).Select(FloatFields.Name)];

    [Theory, MemberData(nameof(NumbersOfACharacter))]
    public void No_number_of_a_character_may_be_none(string name)
    {
        using var world = new CharacterWorld();
        world.AddFloor();
        var body = world.Add(default);
        world.Step(5);
        var healthy = world[body];
        var before = world.Simulation.StateHash();
        var path = FloatFields.Of(typeof(CharacterController)).First(path => FloatFields.Name(path) == name);
        world[body] = FloatFields.With(healthy, path, float.NaN);
        Assert.Contains(path[0].Name, Assert.Throws<InvalidOperationException>(() => world.Step()).Message, StringComparison.Ordinal);
        Assert.Equal(before, world.Simulation.StateHash());
        world[body] = healthy;
        world.Step();
    }

    [Fact]
    public void What_is_left_of_characters_is_bodies()
    {
        using var world = new CharacterWorld();
        world.AddFloor();
        var body = world.Add(default);
        world[body].TargetVelocity = new(3, 0);
        world.Step(30);
        world.Characters.Dispose();
        Assert.Equal(1, world.Simulation.Solver.CountConstraints());
        // Friction is the floor's again: 9.81 m/s2.
        world.Step(30);
        Assert.True(world.Velocity(body).Length() < 1e-3f, $"{world.Velocity(body)}");
    }

    // As in the demo of characters whose names these are, where all else of a game that came from there stays.
    struct DisposingCallbacks(CharacterControllers characters) : INarrowPhaseCallbacks
    {
        public readonly void Initialize(Simulation simulation) => characters.Initialize(simulation);

        public readonly bool AllowContactGeneration(int workerIndex, CollidableReference a, CollidableReference b, ref float speculativeMargin) => true;

        public readonly bool AllowContactGeneration(int workerIndex, CollidablePair pair, int childIndexA, int childIndexB) => true;

        public readonly bool ConfigureContactManifold<TManifold>(
            int workerIndex, CollidablePair pair, ref TManifold manifold, out PairMaterialProperties pairMaterial)
            where TManifold : unmanaged, IContactManifold<TManifold>
        {
            pairMaterial = new(1, 2, default);
            characters.TryReportContacts(pair, ref manifold, workerIndex, ref pairMaterial);
            return true;
        }

        public readonly bool ConfigureContactManifold(
            int workerIndex, CollidablePair pair, int childIndexA, int childIndexB, ref ConvexContactManifold manifold) => true;

        public readonly void Dispose() => characters.Dispose();
    }

    [Fact]
    public void Callbacks_of_a_game_may_dispose_of_them()
    {
        using var pool = new BufferPool();
        var characters = new CharacterControllers(pool);
        var simulation = Simulation.Create(
            pool, new DisposingCallbacks(characters), new DefaultPoseIntegratorCallbacks(new Vector3(0, -10, 0)), new SolveDescription(1, 4));
        simulation.Statics.Add(new StaticDescription(new Vector3(0, -0.5f, 0), simulation.Shapes.Add(new Box(20, 1, 20))));
        var body = simulation.Bodies.Add(BodyDescription.CreateDynamic(
            new Vector3(0, CharacterWorld.HalfHeight, 0), new BodyInertia { InverseMass = 0.1f }, simulation.Shapes.Add(CharacterWorld.Shape), 0.01f));
        characters.AllocateCharacter(body).TargetVelocity = new(3, 0);
        for (int i = 0; i < 10; ++i)
            simulation.Timestep(CharacterWorld.Dt);
        // It stands, so there is a constraint to let go of.
        Assert.Equal(2, simulation.Solver.CountConstraints());

        simulation.Dispose();

        pool.AssertEmpty();
    }
}
