using BepuUtilities.Memory;

namespace BepuPhysics;

/// <summary>The bodies of a set with motion and inertia side by side: what is read and written through it is theirs.</summary>
/// <remarks>Valid until bodies are added or removed. For code that was written for bodies whose dynamics lie in one place; here they lie in three.</remarks>
public readonly struct BodyDynamicsView
{
    readonly Buffer<MotionState> motions;
    readonly Buffer<BodyInertia> localInertias;
    readonly Buffer<BodyInertia> worldInertias;

    internal BodyDynamicsView(in BodySet set)
    {
        motions = set.MotionStates;
        localInertias = set.LocalInertias;
        worldInertias = set.WorldInertias;
    }

    /// <summary>Number of bodies that there is room for.</summary>
    public int Length => motions.Length;

    /// <summary>Motion and inertia of a body.</summary>
    /// <param name="index">Index of the body within its set.</param>
    public BodyDynamicsReference this[int index] => new(ref motions[index], ref localInertias[index], ref worldInertias[index]);
}
