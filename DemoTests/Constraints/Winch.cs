using System;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuPhysics.Constraints;
using BepuUtilities;
using Demos.Accuracy;
using DemoTests.Scenes;
using Xunit;

namespace DemoTests.Constraints;

/// <summary>Draws a point of body A and a point of body B together at a speed: a motor that a game could make.</summary>
public struct Winch : ITwoBodyConstraintDescription<Winch>
{
    /// <summary>Where the rope is fixed, in A's frame, m.</summary>
    public Vector3 LocalOffsetA;
    /// <summary>Where the rope is fixed, in B's frame, m.</summary>
    public Vector3 LocalOffsetB;
    /// <summary>Speed at which the points come nearer, m/s; negative lets them go.</summary>
    public float Speed;
    /// <summary>Greatest force, N, and softness.</summary>
    public MotorSettings Settings;

    public static int ConstraintTypeId => 110;

    public static TypeProcessor CreateTypeProcessor() => new TypeProcessor<
        TwoBodies, WinchWide, Rows1, JointConstraint<TwoBodies, WinchWide, WinchGeometry, Rows1, Rows1, WinchJoint>>();

    public static void Validate(in Winch description)
    {
        if (!float.IsFinite(description.LocalOffsetA.Length() + description.LocalOffsetB.Length() + description.Speed))
            throw new ArgumentException("Offsets and speed of a winch must be finite.", nameof(description));
        if (!MotorSettings.Validate(description.Settings))
            throw new ArgumentException($"{nameof(Settings)} must not be negative.", nameof(description));
    }
}

/// <summary>A bundle of <see cref="Winch"/>.</summary>
public struct WinchWide : IWide<Winch>
{
    public Vector3Wide LocalOffsetA;
    public Vector3Wide LocalOffsetB;
    public Vector<float> Speed;
    public MotorSettingsWide Settings;
}

/// <summary>The rope.</summary>
public struct WinchGeometry
{
    /// <summary>From A's end to B's, unit length; zero where the ends coincide.</summary>
    public Vector3Wide Direction;
    public Vector3Wide AngularA;
    public Vector3Wide AngularB;
}

/// <summary>Row of <see cref="Winch"/>.</summary>
// u = (xB + rB - xA - rA) / its length
// J v = u (vA + wA x rA - vB - wB x rB) = speed
// J = [ u, rA x u, -u, -(rB x u) ]
// K = 1/mA + 1/mB + (rA x u) IA^-1 (rA x u) + (rB x u) IB^-1 (rB x u)
public readonly struct WinchJoint : IMotor<TwoBodies, WinchWide, WinchGeometry, Rows1, Rows1>
{
    public static void Prepare(in TwoBodies bodies, in WinchWide prestep, out WinchGeometry geometry)
    {
        var offsetA = bodies.A.Orientation * prestep.LocalOffsetA;
        var offsetB = bodies.B.Orientation * prestep.LocalOffsetB;
        var rope = (bodies.B.Position - bodies.A.Position) + (offsetB - offsetA);
        geometry.Direction = rope * Wide.DivideOrZero(Vector<float>.One, rope.Length());
        geometry.AngularA = Vector3Wide.Cross(offsetA, geometry.Direction);
        geometry.AngularB = Vector3Wide.Cross(offsetB, geometry.Direction);
    }

    public static void TargetVelocity(in TwoBodies bodies, in WinchWide prestep, in WinchGeometry geometry, out Rows1 velocity) =>
        velocity.X = prestep.Speed;

    public static void RelativeVelocity(in WinchGeometry geometry, in TwoBodies bodies, out Rows1 velocity) =>
        velocity.X = Vector3Wide.Dot(bodies.A.Linear - bodies.B.Linear, geometry.Direction) +
            Vector3Wide.Dot(bodies.A.Angular, geometry.AngularA) - Vector3Wide.Dot(bodies.B.Angular, geometry.AngularB);

    public static void ApplyImpulse(in WinchGeometry geometry, ref TwoBodies bodies, in Rows1 impulse)
    {
        bodies.A.Linear += geometry.Direction * (impulse.X * bodies.A.InverseMass);
        bodies.A.Angular += bodies.A.InverseInertia * (geometry.AngularA * impulse.X);
        bodies.B.Linear -= geometry.Direction * (impulse.X * bodies.B.InverseMass);
        bodies.B.Angular -= bodies.B.InverseInertia * (geometry.AngularB * impulse.X);
    }

    public static void InverseEffectiveMass(in WinchGeometry geometry, in TwoBodies bodies, out Rows1 inverseMass) =>
        inverseMass.X = (bodies.A.InverseMass + bodies.B.InverseMass) * geometry.Direction.LengthSquared() +
            Symmetric3x3Wide.VectorSandwich(geometry.AngularA, bodies.A.InverseInertia) +
            Symmetric3x3Wide.VectorSandwich(geometry.AngularB, bodies.B.InverseInertia);

    public static MotorSettingsWide Motor(in WinchWide prestep) => prestep.Settings;
}

public class WinchTests : MotorTests<Winch>
{
    private protected override Winch Describe(JointSamples samples, MotorSettings settings) => new()
    {
        LocalOffsetA = samples.Vector(1),
        LocalOffsetB = samples.Vector(1),
        Speed = samples.Uniform(-3, 3),
        Settings = settings,
    };

    private protected override double[] Target(Winch d, DoublePose[] poses) => [d.Speed];

    private protected override double[] Velocity(Winch d, DoublePose[] poses, double[] v)
    {
        var armA = poses[0].ToWorld(d.LocalOffsetA);
        var armB = poses[1].ToWorld(d.LocalOffsetB);
        var rope = poses[1].Position + armB - poses[0].Position - armA;
        var velocityA = new DoubleVector(v[0], v[1], v[2]) + DoubleVector.Cross(new(v[3], v[4], v[5]), armA);
        var velocityB = new DoubleVector(v[6], v[7], v[8]) + DoubleVector.Cross(new(v[9], v[10], v[11]), armB);
        return [DoubleVector.Dot(rope, velocityA - velocityB) / rope.Length];
    }

    [Fact]
    public void A_crane_lifts_its_load_and_holds_no_more_than_it_can()
    {
        using var world = new TestWorld(new AccuracySettings { Contacts = ContactScope.None });
        var crane = world.AddKinematic(new Sphere(0.1f), new RigidPose(new Vector3(0, 10, 0)));
        var load = world.AddDynamic(new Sphere(0.5f), 4, new RigidPose(Vector3.Zero));
        var winch = new Winch { Speed = 1, Settings = new(100, 0) };
        var rope = world.Solver.Add(crane, load, winch);
        world.Step(120);
        Assert.Equal(1, world.Bodies[load].Velocity.Linear.Y, 1e-3f);
        Assert.Equal(2, world.Bodies[load].Pose.Position.Y, 0.05f);
        // 4 kg weigh 39.24 N: at half of that, the load falls at half of g.
        winch.Settings.MaximumForce = 19.62f;
        world.Solver.ApplyDescription(rope, winch);
        world.Step(60);
        Assert.Equal(1 - 9.81f / 2, world.Bodies[load].Velocity.Linear.Y, 0.05f);
    }
}
