using System.Diagnostics.CodeAnalysis;
using System.Numerics;
using System.Runtime.CompilerServices;
using BepuUtilities;

namespace BepuPhysics.Constraints;

/// <summary>What bounds the impulse of a row. The same for all constraints of a type.</summary>
enum RowLimit
{
    /// <summary>Nothing.</summary>
    None,
    /// <summary>It is not negative.</summary>
    Positive,
    /// <summary>It and those of the constraint's other rows have a Euclidean length of at most <see cref="ConstraintRow.MaximumImpulse"/>.</summary>
    Length,
    /// <summary>It and that of the neighbour of the same kind have a length of at most the friction coefficient times the sum of the positive rows.</summary>
    Friction,
    /// <summary>It is at most the friction coefficient times the sum of the positive rows, each times its lever, either way.</summary>
    Twist,
}

/// <summary>Part of a row that belongs to one body.</summary>
struct RowJacobian
{
    /// <summary>Derivative by the velocity of the centre of mass.</summary>
    public Vector3 Linear;
    /// <summary>Derivative by the angular velocity, world axes.</summary>
    public Vector3 Angular;
}

/// <summary>A bundle of <see cref="RowJacobian"/>.</summary>
struct RowJacobianWide : IWide<RowJacobian>
{
    /// <inheritdoc cref="RowJacobian.Linear"/>
    public Vector3Wide Linear;
    /// <inheritdoc cref="RowJacobian.Angular"/>
    public Vector3Wide Angular;
}

/// <summary>One row of a constraint, for solvers that do not know its type.</summary>
/// <remarks>
/// With J over the velocities v of the bodies, M their masses, K = J M^-1 J^T and lambda the impulses that were accumulated, a sweep changes them by
/// <code>change = K^-1 (TargetVelocity - J v) MassScale - ImpulseScale lambda,   v += M^-1 J^T change</code>
/// within what <see cref="RowLimit"/> says. A solver that takes all rows at once solves the same equation with softness on the diagonal:
/// J v + (ImpulseScale / MassScale) K lambda = TargetVelocity. The rows of a joint share K as a block, and so do the two of friction; the others of a
/// contact stand alone.
/// </remarks>
struct ConstraintRow
{
    /// <summary>Jacobian, body by body; zero where the constraint has fewer.</summary>
    public RowJacobian A, B, C, D;
    /// <summary>C, m or rad: of a joint as it defines it, of a contact the distance between the surfaces; zero for what holds velocities.</summary>
    public float PositionError;
    /// <summary>J v that the row is after in this substep, m/s or rad/s: correction, speed of a servo, target of a motor.</summary>
    public float TargetVelocity;
    /// <summary>Factor on the velocity that is missing: 1 without softness, 0 where the row does nothing in this sweep.</summary>
    public float MassScale;
    /// <summary>Factor on the accumulated impulse: 0 without softness.</summary>
    public float ImpulseScale;
    /// <summary>The accumulated impulse, N s or N m s.</summary>
    public float Impulse;
    /// <summary>Least impulse, N s or N m s; for <see cref="RowLimit.Friction"/> and <see cref="RowLimit.Twist"/> under the present load.</summary>
    public float MinimumImpulse;
    /// <summary>Greatest impulse, N s or N m s; for <see cref="RowLimit.Friction"/> and <see cref="RowLimit.Twist"/> under the present load.</summary>
    public float MaximumImpulse;
    /// <summary>Coefficient of rows of friction and twist, zero for others.</summary>
    public float FrictionCoefficient;
    /// <summary>Lever of a contact's normal row about the centre of its patch, m: what its impulse counts for twist.</summary>
    public float Lever;
    /// <summary>Not zero where the game gave no frequency and no softness: the row is meant to be as stiff as can be.</summary>
    public int HardMask;

    /// <summary>Whether the row is meant to be as stiff as can be.</summary>
    internal readonly bool IsHard => HardMask != 0;
}

/// <summary>A bundle of <see cref="ConstraintRow"/>.</summary>
struct ConstraintRowWide : IWide<ConstraintRow>
{
    /// <inheritdoc cref="ConstraintRow.A"/>
    public RowJacobianWide A, B, C, D;
    /// <inheritdoc cref="ConstraintRow.PositionError"/>
    public Vector<float> PositionError;
    /// <inheritdoc cref="ConstraintRow.TargetVelocity"/>
    public Vector<float> TargetVelocity;
    /// <inheritdoc cref="ConstraintRow.MassScale"/>
    public Vector<float> MassScale;
    /// <inheritdoc cref="ConstraintRow.ImpulseScale"/>
    public Vector<float> ImpulseScale;
    /// <inheritdoc cref="ConstraintRow.Impulse"/>
    public Vector<float> Impulse;
    /// <inheritdoc cref="ConstraintRow.MinimumImpulse"/>
    public Vector<float> MinimumImpulse;
    /// <inheritdoc cref="ConstraintRow.MaximumImpulse"/>
    public Vector<float> MaximumImpulse;
    /// <inheritdoc cref="ConstraintRow.FrictionCoefficient"/>
    public Vector<float> FrictionCoefficient;
    /// <inheritdoc cref="ConstraintRow.Lever"/>
    public Vector<float> Lever;
    /// <inheritdoc cref="ConstraintRow.HardMask"/>
    public Vector<int> HardMask;

    /// <summary>Jacobian of the body in a slot.</summary>
    [UnscopedRef]
    internal ref RowJacobianWide Of(int slot) => ref Unsafe.Add(ref A, slot);
}
