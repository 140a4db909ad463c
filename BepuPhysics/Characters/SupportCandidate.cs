using System.Numerics;
using System.Runtime.CompilerServices;
using BepuPhysics.Collidables;
using BepuUtilities;

namespace BepuPhysics.Characters;

/// <summary>A contact of a character. Which of several is the better one depends on nothing but them.</summary>
struct SupportCandidate
{
    /// <summary>From the centre of the character, world axes, m.</summary>
    public Vector3 Offset;
    /// <summary>Towards the character; unit length.</summary>
    public Vector3 Normal;
    /// <summary>Depth, m.</summary>
    public float Depth;
    /// <summary>What it is with.</summary>
    public CollidableReference Other;
    /// <summary>Whether there is one.</summary>
    public bool Exists;

    /// <summary>Takes another one if that is better.</summary>
    /// <param name="other">The other.</param>
    /// <param name="gain">What the other has more of, if anything, of what counts.</param>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public void Improve(in SupportCandidate other, float gain)
    {
        if (other.Exists && (!Exists || gain > 0 || gain == 0 && Precedes(other)))
            this = other;
    }

    // Any order will do that does not depend on which worker saw what, or when.
    readonly bool Precedes(in SupportCandidate other)
    {
        if (other.Other.Packed != Other.Packed)
            return other.Other.Packed < Other.Packed;
        if (other.Offset.X != Offset.X)
            return other.Offset.X < Offset.X;
        if (other.Offset.Y != Offset.Y)
            return other.Offset.Y < Offset.Y;
        return other.Offset.Z != Offset.Z ? other.Offset.Z < Offset.Z : Exact.Dot(other.Normal, Vector3.One) < Exact.Dot(Normal, Vector3.One);
    }
}

/// <summary>The contacts of a character that matter: the deepest that it can stand on, and the one that is most in its way.</summary>
struct SupportCandidates
{
    public SupportCandidate Support;
    public SupportCandidate Obstacle;

    /// <summary>Takes what is better of others.</summary>
    /// <param name="other">The others.</param>
    /// <param name="direction">Where the character wants to go.</param>
    public void Improve(in SupportCandidates other, Vector3 direction)
    {
        Support.Improve(other.Support, other.Support.Depth - Support.Depth);
        Obstacle.Improve(other.Obstacle, Exact.Dot(Obstacle.Normal - other.Obstacle.Normal, direction));
    }
}
