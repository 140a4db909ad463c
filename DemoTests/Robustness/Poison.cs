using System.Numerics;
using BepuPhysics.Constraints;
using BepuUtilities;

namespace DemoTests.Robustness;

/// <summary>A constraint whose row is multiplied by a factor, which may be NaN.</summary>
public struct Poison : IOneBodyConstraintDescription<Poison>
{
    public float Factor;

    public static int ConstraintTypeId => 101;

    public static TypeProcessor CreateTypeProcessor() => new TypeProcessor<
        OneBody, PoisonWide, Rows1, JointConstraint<OneBody, PoisonWide, PoisonGeometry, Rows1, Rows1, PoisonJoint>>();
}

/// <summary>A bundle, and what the row is made of.</summary>
public struct PoisonWide : IWide<Poison>
{
    public Vector<float> Factor;
}

/// <summary>A bundle, and what the row is made of.</summary>
public struct PoisonGeometry
{
    public Vector<float> Factor;
}

/// <summary>The row.</summary>
public readonly struct PoisonJoint : IJoint<OneBody, PoisonWide, PoisonGeometry, Rows1, Rows1>
{
    public static RowKind Kind => RowKind.Equality;

    public static void Prepare(in OneBody bodies, in PoisonWide prestep, out PoisonGeometry geometry) => geometry.Factor = prestep.Factor;

    public static void PositionError(in OneBody bodies, in PoisonWide prestep, in PoisonGeometry geometry, out Rows1 error) =>
        error.X = Vector<float>.One;

    public static void RelativeVelocity(in PoisonGeometry geometry, in OneBody bodies, out Rows1 velocity) =>
        velocity.X = bodies.A.Linear.Y * geometry.Factor;

    public static void ApplyImpulse(in PoisonGeometry geometry, ref OneBody bodies, in Rows1 impulse) =>
        bodies.A.Linear.Y += impulse.X * bodies.A.InverseMass;

    public static void InverseEffectiveMass(in PoisonGeometry geometry, in OneBody bodies, out Rows1 inverseMass) =>
        inverseMass.X = bodies.A.InverseMass;

    public static SpringSettingsWide Spring(in PoisonWide prestep) => default;
}
