using System;
using System.Collections.Generic;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuPhysics.CollisionDetection;
using BepuPhysics.Constraints;
using BepuUtilities;
using BepuUtilities.Memory;
using Demos.References;
using DemoTests.Support;

namespace DemoTests.Accuracy;

/// <summary>Bodies in joints, some of which bounce, and what an impact has to make of them.</summary>
sealed class JointedImpactWorld : IDisposable
{
    readonly BufferPool pool = new();
    readonly float dt;
    readonly float restitution;
    readonly List<BodyHandle> bodies = [];
    readonly List<(int A, int B, Vector3 OffsetA, Vector3 OffsetB, Vector3[] AxesOfA)> holds = [];

    // What does not bounce is stopped as it meets, too.
    public JointedImpactWorld(float restitution, float dt, float friction = 0, float gravity = 0, SolveDescription? description = null)
    {
        (this.restitution, this.dt) = (restitution, dt);
        var callbacks = new DefaultNarrowPhaseCallbacks(new PairMaterialProperties(friction, 2, SpringSettings.Rigid))
        {
            Surface = new() { Restitution = restitution, ExactImpacts = restitution == 0 },
        };
        Simulation = Simulation.Create(
            pool, callbacks, new DefaultPoseIntegratorCallbacks(new Vector3(0, -gravity, 0)), description ?? SolveDescription.Default);
    }

    public Simulation Simulation { get; }

    public int Count => bodies.Count;

    public BodyReference this[int body] => Simulation.Bodies[bodies[body]];

    public void Step(IThreadDispatcher? dispatcher = null) => Simulation.Timestep(dt, dispatcher);

    /// <summary>Adds a box or a ball; without collidable it is met by nobody.</summary>
    public int Add<TShape>(in TShape shape, float mass, RigidPose pose, BodyVelocity velocity = default, bool collides = true, float margin = 0)
        where TShape : unmanaged, IConvexShape
    {
        var collidable = collides
            ? new CollidableDescription(Simulation.Shapes.Add(shape), margin, float.MaxValue, ContinuousDetection.Passive)
            : default;
        bodies.Add(Simulation.Bodies.Add(
            BodyDescription.CreateDynamic(pose, velocity, shape.ComputeInertia(mass), collidable, new BodyActivityDescription(-1))));
        return bodies.Count - 1;
    }

    /// <summary>Adds a kinematic body without a shape.</summary>
    public int AddAnchor(Vector3 position, BodyVelocity velocity = default)
    {
        bodies.Add(Simulation.Bodies.Add(BodyDescription.CreateKinematic(new RigidPose(position), velocity, default, new BodyActivityDescription(-1))));
        return bodies.Count - 1;
    }

    /// <summary>Holds two bodies together at a point.</summary>
    public ConstraintHandle Socket(int a, int b, Vector3 point)
    {
        var (ofA, ofB) = (Local(a, point), Local(b, point));
        holds.Add((a, b, ofA, ofB, []));
        return Simulation.Solver.Add(bodies[a], bodies[b], new BallSocket { LocalOffsetA = ofA, LocalOffsetB = ofB });
    }

    /// <summary>Holds two bodies together at a point, and lets them turn about an axis.</summary>
    public ConstraintHandle Hinge(int a, int b, Vector3 point, Vector3 axis)
    {
        var (ofA, ofB) = (Local(a, point), Local(b, point));
        var axisOfA = QuaternionEx.Transform(axis, Quaternion.Conjugate(this[a].Pose.Orientation));
        var axisOfB = QuaternionEx.Transform(axis, Quaternion.Conjugate(this[b].Pose.Orientation));
        var across = Vector3.Normalize(Vector3.Cross(axisOfA, MathF.Abs(axisOfA.X) < .7f ? Vector3.UnitX : Vector3.UnitY));
        holds.Add((a, b, ofA, ofB, [across, Vector3.Cross(axisOfA, across)]));
        return Simulation.Solver.Add(
            bodies[a], bodies[b], new Hinge { LocalOffsetA = ofA, LocalOffsetB = ofB, LocalHingeAxisA = axisOfA, LocalHingeAxisB = axisOfB });
    }

    /// <summary>Holds two bodies together as they are.</summary>
    public ConstraintHandle Weld(int a, int b)
    {
        var inverse = Quaternion.Conjugate(this[a].Pose.Orientation);
        var offset = QuaternionEx.Transform(this[b].Pose.Position - this[a].Pose.Position, inverse);
        holds.Add((a, b, offset, default, [Vector3.UnitX, Vector3.UnitY, Vector3.UnitZ]));
        return Simulation.Solver.Add(
            bodies[a], bodies[b],
            new Weld { LocalOffset = offset, LocalOrientation = QuaternionEx.Concatenate(this[b].Pose.Orientation, inverse) });
    }

    Vector3 Local(int body, Vector3 point) => QuaternionEx.Transform(point - this[body].Pose.Position, Quaternion.Conjugate(this[body].Pose.Orientation));

    /// <summary>What velocities have to be after A has met B at a point, along a normal that shows to A.</summary>
    public IReadOnlyList<double[]> Expect(int a, int b, Vector3 point, Vector3 normal)
    {
        var oracle = new JointedImpactOracle();
        for (int i = 0; i < Count; ++i)
        {
            var inertia = this[i].LocalInertia;
            var tensor = inertia.InverseInertiaTensor;
            Double3[] axes = [Turned(i, Vector3.UnitX), Turned(i, Vector3.UnitY), Turned(i, Vector3.UnitZ)];
            oracle.AddBody(inertia.InverseMass, new(tensor.XX, tensor.YY, tensor.ZZ), axes, this[i].Velocity.Linear, this[i].Velocity.Angular);
        }
        foreach (var hold in holds)
        {
            Double3 armA = Turned(hold.A, hold.OffsetA), armB = Turned(hold.B, hold.OffsetB);
            oracle.HoldAlong(hold.A, hold.B, new(1, 0, 0), armA, armB);
            oracle.HoldAlong(hold.A, hold.B, new(0, 1, 0), armA, armB);
            oracle.HoldAlong(hold.A, hold.B, new(0, 0, 1), armA, armB);
            foreach (var axis in hold.AxesOfA)
                oracle.HoldAbout(hold.A, hold.B, Turned(hold.A, axis));
        }
        return oracle.Solve(a, b, normal, point - this[a].Pose.Position, point - this[b].Pose.Position, restitution);
    }

    Vector3 Turned(int body, Vector3 v) => QuaternionEx.Transform(v, this[body].Pose.Orientation);

    /// <summary>The greatest difference of a velocity, turns as speeds on an arm, of all bodies but one.</summary>
    public double Difference(IReadOnlyList<double[]> expected, int except, double arm)
    {
        double worst = 0;
        for (int i = 0; i < Count; ++i)
        {
            if (i != except)
                worst = Math.Max(worst, Difference(i, expected[i], arm));
        }
        return worst;
    }

    /// <summary>The same of one body.</summary>
    public double Difference(int body, double[] expected, double arm)
    {
        var velocity = this[body].Velocity;
        var linear = (Double3)velocity.Linear - new Double3(expected[0], expected[1], expected[2]);
        var angular = (Double3)velocity.Angular - new Double3(expected[3], expected[4], expected[5]);
        return Math.Max(linear.Length, angular.Length * arm);
    }

    /// <summary>Kinetic energy.</summary>
    public double Energy()
    {
        double energy = 0;
        for (int i = 0; i < Count; ++i)
        {
            var inertia = this[i].LocalInertia;
            if (inertia.InverseMass == 0)
                continue;
            var spin = (Double3)QuaternionEx.Transform(this[i].Velocity.Angular, Quaternion.Conjugate(this[i].Pose.Orientation));
            var tensor = inertia.InverseInertiaTensor;
            energy += (((Double3)this[i].Velocity.Linear).LengthSquared / inertia.InverseMass +
                spin.X * spin.X / tensor.XX + spin.Y * spin.Y / tensor.YY + spin.Z * spin.Z / tensor.ZZ) / 2;
        }
        return energy;
    }

    public void Dispose()
    {
        Simulation.Dispose();
        pool.AssertEmpty();
        pool.Clear();
    }
}
