using System;
using System.Numerics;
using BepuPhysics.Collidables;

namespace BepuPhysics.CollisionDetection;

/// <summary>A body that lies across statics, as it was when its pairs agreed.</summary>
struct AgreedBody
{
    /// <summary>The body.</summary>
    public CollidableReference Body;
    /// <summary>Place of the first of its pairs, which follow one another, and how many these are.</summary>
    public int First, Count;
    /// <summary>How many of its pairs have found the same again in this step.</summary>
    public int HeldCount;
    /// <summary>Whether a pair has found anything else in this step.</summary>
    public bool HasChanged;
    /// <summary>Steps until the body agrees anew, come what may; and how many these were at first.</summary>
    public short Remaining, Lifetime;
    /// <summary>Its orientation.</summary>
    public Quaternion Orientation;
    /// <summary>Distance from its centre to its farthest point, m.</summary>
    public float Reach;

    /// <summary>Steps after which a body agrees anew at first, and at most.</summary>
    public const int FirstLifetime = RetestBound.Lifetime, GreatestLifetime = 16 * FirstLifetime;

    /// <summary>Whether all of its pairs, and no others, have found the same again.</summary>
    public readonly bool Holds => HeldCount == Count && !HasChanged;

    /// <summary>How long what it agrees on is to be believed if it has lain still for the whole of its lifetime.</summary>
    public readonly int NextLifetime => Math.Min(2 * Lifetime, GreatestLifetime);
}
