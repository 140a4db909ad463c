using System;
using System.Collections.Generic;
using System.Linq;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuPhysics.CollisionDetection;
using BepuPhysics.Constraints;
using BepuUtilities.Memory;
using Demos.Accuracy;

namespace DemoTests.Accuracy;

/// <summary>How a scene is looked at; what happens in it must not depend on that.</summary>
sealed record Outlook
{
    /// <summary>Whether x is turned round.</summary>
    public bool IsMirrored { get; init; }

    /// <summary>Velocity of everything, floors included.</summary>
    public Vector3 Velocity { get; init; }

    /// <summary>Factor of lengths, speeds and gravity, and its cube of masses.</summary>
    public float Scale { get; init; } = 1;

    /// <summary>Whether bodies are added from the last to the first.</summary>
    public bool IsReversed { get; init; }

    /// <summary>Whether floors are kinematic bodies.</summary>
    public bool HasKinematicFloors { get; init; }
}

/// <summary>A box, or a ball where only the first size is given.</summary>
sealed record LawBody(Vector3 Size, Vector3 Position, Vector3 Velocity = default, Vector3 Spin = default, Quaternion? Turn = null, bool IsFixed = false);

/// <summary>Ties each body to the next at a point, and about an axis where there is one.</summary>
sealed record LawJoint(Vector3 Anchor, Vector3 Axis = default);

/// <summary>A few bodies.</summary>
sealed record LawScene(LawBody[] Bodies, LawJoint[] Joints, float Restitution = 0, float Friction = .5f, float Gravity = 9.81f);

/// <summary>A scene as it is seen from some outlook.</summary>
sealed class LawWorld : IDisposable
{
    public const float Dt = 1 / 64f;
    // Who turns sees no farther than he moves; who passes by does.
    const float Margin = .05f;
    readonly BufferPool pool = new();
    readonly Simulation simulation;
    readonly LawScene scene;
    readonly Outlook outlook;
    readonly BodyHandle[] handles;
    int steps;

    public LawWorld(LawScene scene, Outlook outlook)
    {
        (this.scene, this.outlook) = (scene, outlook);
        float scale = outlook.Scale;
        var callbacks = new DefaultNarrowPhaseCallbacks(new PairMaterialProperties(scene.Friction, 2 * scale, SpringSettings.Rigid))
        {
            Surface = new() { Restitution = scene.Restitution },
        };
        var gravity = new WorldGravity(new() { Gravity = new Vector3(0, -scene.Gravity * scale, 0) });
        simulation = Simulation.Create(pool, callbacks, gravity, SolveDescription.Default);
        handles = new BodyHandle[scene.Bodies.Length];
        var order = Enumerable.Range(0, handles.Length);
        foreach (int i in outlook.IsReversed ? order.Reverse() : order)
            Add(i, scale);
        for (int i = 0; i < scene.Joints.Length; ++i)
            Add(scene.Joints[i], i, scale);
    }

    void Add(int index, float scale)
    {
        var body = scene.Bodies[index];
        var pose = new RigidPose(Seen(body.Position) * scale, Seen(body.Turn ?? Quaternion.Identity));
        var velocity = new BodyVelocity((Seen(body.Velocity) + outlook.Velocity) * scale, SeenSpin(body.Spin));
        float mass = scale * scale * scale;
        var size = body.Size * scale;
        var box = new Box(size.X, size.Y, size.Z);
        var isBall = size.Y == 0;
        var shape = isBall ? simulation.Shapes.Add(new Sphere(size.X)) : simulation.Shapes.Add(box);
        var collidable = new CollidableDescription(
            shape, Margin * scale, float.MaxValue, new ContinuousDetection { Mode = ContinuousDetectionMode.Passive });
        var never = new BodyActivityDescription(-1);
        if (body.IsFixed && !isBall && !outlook.HasKinematicFloors)
            simulation.Statics.Add(new StaticDescription(pose, shape));
        else if (body.IsFixed)
            handles[index] = simulation.Bodies.Add(BodyDescription.CreateKinematic(pose, velocity, isBall ? default : collidable, never));
        else
            handles[index] = simulation.Bodies.Add(BodyDescription.CreateDynamic(
                pose, velocity, isBall ? new Sphere(size.X).ComputeInertia(mass) : box.ComputeInertia(mass), collidable, never));
    }

    // Bodies of joints are not turned to begin with.
    void Add(LawJoint joint, int index, float scale)
    {
        var offsetA = Seen(joint.Anchor - scene.Bodies[index].Position) * scale;
        var offsetB = Seen(joint.Anchor - scene.Bodies[index + 1].Position) * scale;
        var (a, b) = (handles[index], handles[index + 1]);
        if (joint.Axis == default)
            simulation.Solver.Add(a, b, new BallSocket { LocalOffsetA = offsetA, LocalOffsetB = offsetB, SpringSettings = SpringSettings.Rigid });
        else
            simulation.Solver.Add(a, b, new Hinge
            {
                LocalOffsetA = offsetA,
                LocalOffsetB = offsetB,
                LocalHingeAxisA = Seen(joint.Axis),
                LocalHingeAxisB = Seen(joint.Axis),
                SpringSettings = SpringSettings.Rigid,
            });
    }

    Vector3 Seen(Vector3 v) => outlook.IsMirrored ? v with { X = -v.X } : v;

    // What turns turns the other way about all axes but that of the mirror.
    Vector3 SeenSpin(Vector3 spin) => outlook.IsMirrored ? new(spin.X, -spin.Y, -spin.Z) : spin;

    Quaternion Seen(Quaternion turn) => outlook.IsMirrored ? new(turn.X, -turn.Y, -turn.Z, turn.W) : turn;

    public void Step()
    {
        simulation.Timestep(Dt);
        ++steps;
    }

    /// <summary>Centres and one corner of each body that is free, as if nobody looked.</summary>
    public IEnumerable<Vector3> Points()
    {
        for (int i = 0; i < handles.Length; ++i)
        {
            if (scene.Bodies[i].IsFixed)
                continue;
            var pose = simulation.Bodies[handles[i]].Pose;
            var center = Seen(pose.Position / outlook.Scale - outlook.Velocity * (steps * Dt));
            yield return center;
            yield return center + Vector3.Transform(scene.Bodies[i].Size / 2, Seen(pose.Orientation));
        }
    }

    public void Dispose()
    {
        simulation.Dispose();
        pool.AssertEmpty();
        pool.Clear();
    }
}
