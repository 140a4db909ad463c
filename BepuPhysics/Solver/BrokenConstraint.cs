using System;
using System.Runtime.CompilerServices;

namespace BepuPhysics;

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
