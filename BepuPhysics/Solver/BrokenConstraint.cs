using System;
using System.Runtime.CompilerServices;

namespace BepuPhysics;

/// <summary>The greatest impulse of a step that a constraint bears.</summary>
/// <remarks>
/// The impulses of all substeps of a step are summed, each by its length over the rows: over the time of the step that is the mean force, or torque,
/// whatever the number of substeps. Where rows have other units (areas, volumes, gears), it is in these.
/// </remarks>
/// <param name="impulse">Greatest impulse along directions, N s.</param>
/// <param name="angularImpulse">Greatest impulse about axes, N m s.</param>
public struct BreakThreshold(float impulse, float angularImpulse = float.PositiveInfinity)
{
    /// <summary>Greatest impulse along directions, N s; positive, infinite where it breaks nothing.</summary>
    public float Impulse = impulse;
    /// <summary>Greatest impulse about axes, N m s; positive, infinite where it breaks nothing.</summary>
    public float AngularImpulse = angularImpulse;

    /// <summary>What every constraint has at first: it never breaks.</summary>
    public static BreakThreshold Unbreakable => new(float.PositiveInfinity);
}

/// <summary>A constraint that the last step removed because it had to bear more than its <see cref="BreakThreshold"/>.</summary>
public struct BrokenConstraint
{
    /// <summary>Handle that the constraint had; it names nothing any more.</summary>
    public ConstraintHandle Handle;
    /// <summary>Id of the constraint's type.</summary>
    public int TypeId;
    /// <summary>Impulse of the step along directions, N s.</summary>
    public float Impulse;
    /// <summary>Impulse of the step about axes, N m s.</summary>
    public float AngularImpulse;
    /// <summary>Number of bodies that it connected.</summary>
    public int BodyCount { readonly get; internal set; }
    ConnectedBodies bodies;

    /// <summary>A body that it connected.</summary>
    /// <param name="index">Index of the body in the constraint, from 0.</param>
    /// <exception cref="ArgumentOutOfRangeException">The constraint connected fewer bodies.</exception>
    public readonly BodyHandle GetBody(int index)
    {
        if ((uint)index >= (uint)BodyCount)
            throw new ArgumentOutOfRangeException(nameof(index), index, $"The constraint connected {BodyCount} bodies.");
        return bodies[index];
    }

    internal void AddBody(BodyHandle body) => bodies[BodyCount++] = body;

    [InlineArray(MaximumBodyCount)]
    struct ConnectedBodies
    {
        BodyHandle first;
    }

    const int MaximumBodyCount = 4;
}
