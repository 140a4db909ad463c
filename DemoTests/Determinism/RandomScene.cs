using System;
using System.Collections.Generic;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuPhysics.Constraints;
using DemoTests.Scenes;

namespace DemoTests.Determinism;

/// <summary>What a random scene is made of.</summary>
[Flags]
public enum Ingredients
{
    None = 0,
    /// <summary>A floor with bodies that fall on it.</summary>
    Contacts = 1,
    /// <summary>Pairs and chains of bodies in joints of all kinds.</summary>
    Joints = 2,
    /// <summary>A body with more joints than there are batches before the order of a sweep is random.</summary>
    Hub = 4,
    /// <summary>A body with more constraints than there are batches.</summary>
    Fallback = 8,
    All = Contacts | Joints | Hub | Fallback,
}

/// <summary>
/// A list of bodies, some so fast that rounding takes of their velocity, some with tilted inertia, and joints between them: the same list
/// can be added to any simulation, with or without something else before, between and behind.
/// </summary>
sealed class RandomScene
{
    readonly record struct Link(int Kind, int A, int B, Vector3 Offset);

    readonly List<(BodyDescription Description, int Shape)> bodies = [];
    readonly List<Link> links = [];
    readonly bool hasFloor;

    public RandomScene(int seed, Ingredients ingredients, int bodyCount = 24)
    {
        var random = new Random(seed);
        hasFloor = ingredients.HasFlag(Ingredients.Contacts);
        for (int i = 0; i < bodyCount; ++i)
            AddBody(AnyBody(random), random.Next(ShapeCount));
        if (ingredients.HasFlag(Ingredients.Joints))
        {
            for (int i = 0; i < bodyCount; ++i)
                links.Add(new(random.Next(LinkKinds), random.Next(bodyCount), random.Next(bodyCount), TestWorld.Scatter(random, 2)));
            for (int i = 0; i < 20; ++i)
                AddOrbiter(random);
        }
        if (ingredients.HasFlag(Ingredients.Hub))
            AddHub(random, arms: 10);
        if (ingredients.HasFlag(Ingredients.Fallback))
            AddHub(random, arms: 70);
    }

    const int ShapeCount = 5;
    const int LinkKinds = 7;

    public int BodyCount => bodies.Count;

    /// <summary>Adds everything, and calls the game before each body and each joint.</summary>
    /// <returns>Handles of the bodies.</returns>
    public List<BodyHandle> AddTo(TestWorld world, Action<int>? beforeBody = null, Action<int>? beforeJoint = null)
    {
        // A shape for everything that has it, as games do.
        var shapes = world.Simulation.Shapes;
        TypedIndex[] indices =
        [
            shapes.Add(new Sphere(.5f)), shapes.Add(new Box(.8f, .6f, 1)), shapes.Add(new Capsule(.3f, .8f)), shapes.Add(new Cylinder(.4f, .7f)), default,
        ];
        if (hasFloor)
            world.AddStatic(new Box(200, 2, 200), new RigidPose(new Vector3(0, -1, 0)));
        var handles = new List<BodyHandle>();
        for (int i = 0; i < bodies.Count; ++i)
        {
            beforeBody?.Invoke(i);
            var description = bodies[i].Description;
            description.Collidable = indices[bodies[i].Shape];
            handles.Add(world.Bodies.Add(description));
        }
        for (int i = 0; i < links.Count; ++i)
        {
            beforeJoint?.Invoke(i);
            Add(world.Solver, links[i].Kind, handles[links[i].A], handles[links[i].B], links[i].Offset);
        }
        return handles;
    }

    /// <summary>A body of random state: one in four is fast, one in four has an inertia that is not diagonal, one in eight is kinematic.</summary>
    public static BodyDescription AnyBody(Random random)
    {
        var pose = new RigidPose(TestWorld.Scatter(random, 14) + new Vector3(0, 8, 0), TestWorld.Turn(random));
        // From where rounding begins to matter, and far beyond it.
        float speed = random.Next(4) == 0 ? MathF.Pow(10, 1.5f + 2.5f * random.NextSingle()) : 3;
        var velocity = new BodyVelocity(TestWorld.Scatter(random, 2 * speed), TestWorld.Scatter(random, 10));
        var inertia = new Box(.5f + random.NextSingle(), .5f + random.NextSingle(), .5f + random.NextSingle()).ComputeInertia(.5f + random.NextSingle());
        if (random.Next(4) == 0)
        {
            inertia.InverseInertiaTensor.YX = inertia.InverseInertiaTensor.XX * .1f;
            inertia.InverseInertiaTensor.ZY = inertia.InverseInertiaTensor.ZZ * -.1f;
        }
        return random.Next(8) == 0
            ? BodyDescription.CreateKinematic(pose, new BodyVelocity(TestWorld.Scatter(random, 2), TestWorld.Scatter(random, 2)), default, neverSleep)
            : BodyDescription.CreateDynamic(pose, velocity, inertia, default, neverSleep);
    }

    static readonly BodyActivityDescription neverSleep = new(-1);

    void AddBody(BodyDescription description, int shape) => bodies.Add((description, shape));

    // A body that goes around another one so that it is fast enough for rounding to matter in a part of each turn: at 16 substeps, or at 4.
    void AddOrbiter(Random random)
    {
        int center = bodies.Count;
        var pose = new RigidPose(new Vector3(0, 100 * center, 300));
        var arm = new Vector3(2 + 2 * random.NextSingle(), 0, 0);
        float speed = (random.Next(2) == 0 ? 10.5f : 42) * (1 + .04f * (random.NextSingle() - .5f));
        AddBody(BodyDescription.CreateKinematic(pose, default, neverSleep), ShapeCount - 1);
        AddBody(BodyDescription.CreateDynamic(new RigidPose(pose.Position + arm), new BodyVelocity(new Vector3(0, speed, 0), default),
            new Sphere(.3f).ComputeInertia(1), default, neverSleep), ShapeCount - 1);
        links.Add(new(0, center, center + 1, arm));
    }

    // Arms that are light and without shapes: the joints are what matters.
    void AddHub(Random random, int arms)
    {
        int hub = bodies.Count;
        var pose = new RigidPose(new Vector3(300 * hub, 10, 0));
        AddBody(BodyDescription.CreateDynamic(pose, new BodyVelocity(default, TestWorld.Scatter(random, 3)), new Box(1, 1, 1).ComputeInertia(50),
            default, neverSleep), ShapeCount - 1);
        for (int i = 0; i < arms; ++i)
        {
            var offset = TestWorld.Scatter(random, 4);
            AddBody(BodyDescription.CreateDynamic(new RigidPose(pose.Position + offset), new Box(.3f, .3f, .3f).ComputeInertia(.2f),
                default, neverSleep), ShapeCount - 1);
            links.Add(new(i % 3 == 0 ? 2 : 0, hub, hub + 1 + i, offset));
        }
    }

    /// <summary>Adds a joint of some kind, unless both bodies are the same or kinematic.</summary>
    /// <returns>The joint, if there is one now.</returns>
    public static ConstraintHandle? Add(Solver solver, int kind, BodyHandle a, BodyHandle b, Vector3 offset)
    {
        bool isBad = a == b;
        try
        {
            return isBad ? null : kind switch
            {
                0 => solver.Add(a, b, new BallSocket { LocalOffsetA = offset }),
                1 => solver.Add(a, b, new Weld { LocalOffset = offset, LocalOrientation = Quaternion.Identity }),
                2 => solver.Add(a, b, new Hinge { LocalHingeAxisA = Vector3.UnitY, LocalHingeAxisB = Vector3.UnitY, LocalOffsetA = offset }),
                3 => solver.Add(a, b, new SwingLimit { AxisLocalA = Vector3.UnitX, AxisLocalB = Vector3.UnitX, MinimumDot = .5f }),
                4 => solver.Add(a, b, new TwistLimit
                {
                    LocalBasisA = Quaternion.Identity,
                    LocalBasisB = Quaternion.Identity,
                    MinimumAngle = -1,
                    MaximumAngle = 1,
                }),
                5 => solver.Add(a, b, new DistanceLimit { MinimumDistance = .5f, MaximumDistance = 3 }),
                _ => solver.Add(a, new OneBodyLinearServo { Target = offset, ServoSettings = new ServoSettings(2, 0, 50), SpringSettings = new(5, 1) }),
            };
        }
        catch (ArgumentException)
        {
            // Both are kinematic.
            return null;
        }
    }
}
