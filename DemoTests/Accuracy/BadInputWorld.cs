using System;
using System.Collections.Generic;
using System.Numerics;
using System.Runtime.InteropServices;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuPhysics.Constraints;
using Demos.Accuracy;
using DemoTests.Constraints;

namespace DemoTests.Accuracy;

/// <summary>
/// A small world of healthy bodies in contact and in joints, with handles that are no longer valid, and a hash of all that a game can see
/// of it.
/// </summary>
sealed class BadInputWorld : IDisposable
{
    const int FutureStepCount = 10;
    static readonly Lazy<ulong[]> undisturbedFuture = new(() =>
    {
        using var world = new BadInputWorld();
        return world.Future();
    });

    readonly AccuracyWorld world = new(AccuracySettings.For(Effort.Default) with { SubstepCount = 2 });
    readonly Dictionary<Type, ConstraintHandle> joints = [];
    readonly List<StaticHandle> statics = [];

    public BadInputWorld()
    {
        statics.Add(world.AddStatic(new Box(50, 2, 50), new RigidPose(new Vector3(0, -1, 0))));
        Stack.OfEqual(world, 3);
        FreeBody = world.AddDynamic(new Sphere(.5f), 1, new RigidPose(new Vector3(5, 3, 0)), new BodyVelocity(new Vector3(1, 0, 0)));
        OtherBody = world.AddDynamic(
            new Capsule(.25f, 1), 1, new RigidPose(new Vector3(8, .6f, 0)), new BodyVelocity(default, new Vector3(0, 0, 1)));
        JoinPairs();

        RemovedBody = Bodies.Add(HealthyBody());
        RemovedStatic = Simulation.Statics.Add(HealthyStatic());
        var loose = new DistanceLimit { MaximumDistance = 100, SpringSettings = world.Settings.Spring };
        RemovedJoint = Solver.Add(FreeBody, OtherBody, loose);
        RemovedShape = Simulation.Shapes.Add(new Box(1, 2, 3));
        Simulation.Statics.Remove(RemovedStatic);
        Bodies.Remove(RemovedBody);
        Simulation.Shapes.Remove(RemovedShape);
        for (int i = 0; i < 5; ++i)
            world.Step(1 / 60f);
        // Last: a contact that begins would be given its handle.
        Solver.Remove(RemovedJoint);
    }

    /// <summary>What a world does that nobody troubles: a hash per step, the last one with the handles that are given out next.</summary>
    public static ulong[] UndisturbedFuture => undisturbedFuture.Value;

    public Simulation Simulation => world.Simulation;

    public Bodies Bodies => world.Bodies;

    public Solver Solver => world.Simulation.Solver;

    public BodyHandle FreeBody { get; }

    public BodyHandle OtherBody { get; }

    public BodyHandle RemovedBody { get; }

    public StaticHandle Ground => statics[0];

    public StaticHandle RemovedStatic { get; }

    public ConstraintHandle RemovedJoint { get; }

    public TypedIndex RemovedShape { get; }

    /// <summary>A constraint of that type between two bodies.</summary>
    public ConstraintHandle Joint<T>() => Joint(typeof(T));

    /// <summary>A constraint of the type with that description.</summary>
    public ConstraintHandle Joint(Type description) => joints[description];

    public BodyDescription HealthyBody() => BodyDescription.CreateDynamic(
        new RigidPose(new Vector3(0, 20, 0)), new Sphere(.5f).ComputeInertia(1),
        new CollidableDescription(Bodies[FreeBody].Collidable.Shape), new BodyActivityDescription(-1));

    public StaticDescription HealthyStatic() => new(new Vector3(0, -20, 0), Quaternion.Identity, Bodies[FreeBody].Collidable.Shape);

    /// <summary>Hash of the state, step by step, and of what an addition of each kind then returns.</summary>
    public ulong[] Future()
    {
        var hashes = new ulong[FutureStepCount + 2];
        hashes[0] = Hash();
        for (int i = 1; i <= FutureStepCount; ++i)
        {
            world.Step(1 / 60f);
            hashes[i] = Hash();
        }
        // A refused addition must not have used up an index.
        var shape = Simulation.Shapes.Add(new Sphere(.3f));
        var other = Simulation.Shapes.Add(new Box(1, 1, 1));
        var body = Bodies.Add(HealthyBody());
        var joint = Solver.Add(body, FreeBody, new DistanceLimit { MaximumDistance = 100, SpringSettings = world.Settings.Spring });
        var hash = new Fnv();
        var still = Simulation.Statics.Add(HealthyStatic());
        foreach (int value in new[] { (int)shape.Packed, (int)other.Packed, body.Value, joint.Value, still.Value })
            hash.Add(value);
        hashes[^1] = hash.Value;
        return hashes;
    }

    /// <summary>All that a game can read of the bodies, the statics and the settings, bit for bit.</summary>
    public ulong Hash()
    {
        var hash = new Fnv();
        hash.Add(Bodies.CountBodies());
        hash.Add(Simulation.Statics.Count);
        hash.Add(Solver.CountConstraints());
        hash.Add(Solver.SubstepCount);
        hash.Add(Solver.VelocityIterationCount);
        hash.Add(Solver.RelaxationIterationCount);
        hash.Add((int)Solver.LoadPath);
        hash.Add((int)Solver.DirectJoints);
        hash.Add(Solver.Governor.HasValue ? 1 : 0);
        hash.Add(Solver.Governor.GetValueOrDefault().TargetError);
        hash.Add(Solver.Governor.GetValueOrDefault().LeastSubstepCount);
        hash.Add(Solver.Governor.GetValueOrDefault().GreatestSubstepCount);
        foreach (var handle in world.Dynamics)
        {
            var body = Bodies[handle];
            var bounds = body.BoundingBox;
            // Field by field: the padding of a pose is nobody's state.
            hash.Add(body.Pose.Position);
            hash.Add(body.Pose.Orientation);
            hash.Add(body.Velocity.Linear);
            hash.Add(body.Velocity.Angular);
            hash.Add(body.LocalInertia.InverseInertiaTensor);
            hash.Add(body.LocalInertia.InverseMass);
            hash.Add(body.Collidable.Shape.Packed);
            hash.Add(body.Collidable.MinimumSpeculativeMargin);
            hash.Add(body.Collidable.MaximumSpeculativeMargin);
            hash.Add(body.Activity.SleepThreshold);
            hash.Add(bounds.Min);
            hash.Add(bounds.Max);
        }
        foreach (var handle in statics)
        {
            Simulation.Statics.GetDescription(handle, out var description);
            hash.Add(description.Pose.Position);
            hash.Add(description.Pose.Orientation);
            hash.Add(description.Shape.Packed);
        }
        return hash.Value;
    }

    public void Dispose() => world.Dispose();

    void JoinPairs()
    {
        var spring = world.Settings.Spring;
        var half = new Vector3(.5f, 0, 0);
        Join(0, new BallSocket { LocalOffsetA = half, LocalOffsetB = -half, SpringSettings = spring });
        Join(1, new Weld { LocalOffset = 2 * half, LocalOrientation = Quaternion.Identity, SpringSettings = spring });
        var axis = Vector3.UnitZ;
        Join(2, new Hinge
        {
            LocalOffsetA = half,
            LocalHingeAxisA = axis,
            LocalOffsetB = -half,
            LocalHingeAxisB = axis,
            SpringSettings = spring,
        });
        Join(3, new SwingLimit { AxisLocalA = Vector3.UnitX, AxisLocalB = Vector3.UnitX, MinimumDot = .5f, SpringSettings = spring });
        var basis = Quaternion.Identity;
        Join(4, new TwistLimit { LocalBasisA = basis, LocalBasisB = basis, MinimumAngle = -1, MaximumAngle = 1, SpringSettings = spring });
        Join(5, new DistanceLimit { MinimumDistance = .5f, MaximumDistance = 1.5f, SpringSettings = spring });
        Join(6, new AngularAxisMotor { LocalAxisA = axis, TargetVelocity = 1, Settings = new(5, 0) });
        var pulled = world.AddDynamic(new Sphere(.25f), 1, new RigidPose(new Vector3(-6, 5, 5)));
        joints.Add(typeof(OneBodyLinearServo), Solver.Add(pulled, new OneBodyLinearServo
        {
            Target = new Vector3(-5, 5, 5),
            ServoSettings = ServoSettings.Default,
            SpringSettings = new SpringSettings(5, 1),
        }));
        JoinOthers();
    }

    // The types that have no place above: random ones of their kind, on bodies of their own.
    void JoinOthers()
    {
        var row = 8;
        foreach (var type in JointTypes.All)
        {
            if (!joints.ContainsKey(type.Description))
                joints.Add(type.Description, type.AddTo(Solver, AddRow(row++, type.BodyCount), type.NewColumn()));
        }
    }

    BodyHandle[] AddRow(int row, int count)
    {
        var bodies = new BodyHandle[count];
        for (int i = 0; i < count; ++i)
            bodies[i] = world.AddDynamic(new Sphere(.25f), 1 + i, new RigidPose(new Vector3(-6 + i, 5 + i % 3 * .5f, -3 * row)));
        return bodies;
    }

    void Join<T>(int row, in T joint) where T : unmanaged, ITwoBodyConstraintDescription<T>
    {
        var spin = new BodyVelocity(default, new Vector3(1, 2, 3));
        var a = world.AddDynamic(new Sphere(.25f), 1, new RigidPose(new Vector3(-6, 5, -3 * row)), spin);
        var b = world.AddDynamic(new Sphere(.25f), 2, new RigidPose(new Vector3(-5, 5, -3 * row)));
        joints.Add(typeof(T), Solver.Add(a, b, joint));
    }

    /// <summary>The 64-bit hash of Fowler, Noll and Vo, over raw bits.</summary>
    struct Fnv()
    {
        public ulong Value { get; private set; } = 0xCBF29CE484222325;

        public void Add<T>(in T value) where T : unmanaged
        {
            foreach (byte part in MemoryMarshal.AsBytes(new ReadOnlySpan<T>(in value)))
                Value = (Value ^ part) * 0x100000001B3;
        }
    }
}
