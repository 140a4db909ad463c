using System;
using System.Collections.Generic;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Characters;
using BepuPhysics.Collidables;
using BepuUtilities;
using BepuUtilities.Memory;

namespace DemoTests.Characters;

/// <summary>A world with one kind of characters: capsules of 70 kg, 1.8 m high.</summary>
sealed class CharacterWorld : IDisposable
{
    public const float Dt = 1 / 60f, Gravity = 9.81f, HalfHeight = 0.9f;

    public static readonly Capsule Shape = new(0.3f, 1.2f);

    public CharacterWorld(int threads = 1, float friction = 1)
    {
        Dispatcher = threads > 1 ? new ThreadDispatcher(threads) : null;
        Characters = new CharacterControllers(Pool);
        Simulation = Simulation.Create(
            Pool, new CharacterNarrowPhaseCallbacks<DefaultNarrowPhaseCallbacks>(Characters, new(new(friction, 2, default))),
            new DefaultPoseIntegratorCallbacks(new Vector3(0, -Gravity, 0)), new SolveDescription(1, 4));
    }

    public BufferPool Pool { get; } = new();

    public ThreadDispatcher? Dispatcher { get; }

    public CharacterControllers Characters { get; }

    public Simulation Simulation { get; }

    /// <summary>Adds a character with its feet at a place.</summary>
    public BodyHandle Add(Vector3 feet, float mass = 70)
    {
        var body = Simulation.Bodies.Add(BodyDescription.CreateDynamic(
            feet + new Vector3(0, HalfHeight, 0), new BodyInertia { InverseMass = 1 / mass }, Simulation.Shapes.Add(Shape), 0.01f));
        Characters.AllocateCharacter(body);
        return body;
    }

    public StaticHandle AddBox(Vector3 center, Vector3 size, Quaternion? orientation = null) => Simulation.Statics.Add(new StaticDescription(
        new RigidPose(center, orientation ?? Quaternion.Identity), Simulation.Shapes.Add(new Box(size.X, size.Y, size.Z))));

    public void AddFloor() => AddBox(new(0, -0.5f, 0), new(200, 1, 200));

    /// <summary>Steps of a height and a depth, upwards along -Z from a place on, ten of them.</summary>
    public void AddStairs(float rise, float tread, float z)
    {
        for (int i = 0; i < 10; ++i)
            AddBox(new(0, (i + 1) * rise / 2, z - i * tread - 20), new(4, (i + 1) * rise, 40));
    }

    public ref CharacterController this[BodyHandle body] => ref Characters.GetCharacterByBodyHandle(body);

    public Vector3 Feet(BodyHandle body) => Simulation.Bodies[body].Pose.Position - new Vector3(0, HalfHeight, 0);

    public Vector3 Velocity(BodyHandle body) => Simulation.Bodies[body].Velocity.Linear;

    public void Step(int count = 1)
    {
        for (int i = 0; i < count; ++i)
            Simulation.Timestep(Dt, Dispatcher);
    }

    /// <summary>Stairs, a crate, a turning platform and characters that run about among them.</summary>
    public List<BodyHandle> AddCrowd(int seed, int count = 24)
    {
        var random = new Random(seed);
        AddFloor();
        AddStairs(0.2f, 0.3f, -6);
        Simulation.Bodies.Add(BodyDescription.CreateKinematic(new RigidPose(new Vector3(8, 0.1f, 0)), new BodyVelocity(default, new Vector3(0, 0.7f, 0)),
            Simulation.Shapes.Add(new Box(6, 0.4f, 6)), -1));
        var crate = new Box(0.8f, 0.8f, 0.8f);
        for (int i = 0; i < 12; ++i)
            Simulation.Bodies.Add(BodyDescription.CreateDynamic(Place(0.4f), crate.ComputeInertia(20), Simulation.Shapes.Add(crate), 0.01f));
        var bodies = new List<BodyHandle>();
        for (int i = 0; i < count; ++i)
        {
            bodies.Add(Add(Place(0.5f)));
            this[bodies[i]].MaximumStepHeight = 0.4f;
        }
        return bodies;

        Vector3 Place(float y) => new((random.NextSingle() - 0.5f) * 20, y, (random.NextSingle() - 0.5f) * 20);
    }

    /// <summary>New goals for all, every ten steps, and a step.</summary>
    public void StepCrowd(List<BodyHandle> bodies, int step)
    {
        if (step % 10 == 0)
        {
            var random = new Random(step);
            foreach (var body in bodies)
            {
                ref var character = ref this[body];
                character.TargetVelocity = new Vector2(random.NextSingle() - 0.5f, random.NextSingle() - 0.5f) * 8;
                character.ViewDirection = new Vector3(random.NextSingle() - 0.5f, -0.2f, random.NextSingle() - 0.5f);
                character.TryJump = random.Next(5) == 0;
            }
        }
        Step();
    }

    public void Dispose()
    {
        Characters.Dispose();
        Simulation.Dispose();
        Pool.AssertEmpty();
        Dispatcher?.Dispose();
        Pool.Clear();
    }
}
