using System.Numerics;
using BepuUtilities;

namespace BepuPhysics.CollisionDetection;

/// <summary>What became of the contacts of two convex shapes when the pairs of their body agreed.</summary>
/// <remarks>
/// A body that lies across statics agrees on the same in each step. As long as it hardly moves and its pairs find what they found, what they agreed on is
/// remembered: which contacts are left. The contacts themselves are those of the step.
/// </remarks>
struct AgreedPair
{
    /// <summary>The pair, as a key by which pairs are in order.</summary>
    public ulong Key;
    /// <summary>Distance from the centre of the body to its farthest point, m.</summary>
    public float Reach;
    /// <summary>Position of B less that of A, m.</summary>
    public Vector3 OffsetB;
    /// <summary>Orientation of the body.</summary>
    public Quaternion Orientation;
    /// <summary>Unit normal that the contacts had.</summary>
    public Vector3 Normal;
    /// <summary>Features of the contacts.</summary>
    public FeatureIds Features;
    /// <summary>Number of the contacts that the pair had; zero for shapes of children that were near.</summary>
    public byte Count;
    /// <summary>A bit for each of the contacts that is left.</summary>
    public byte Left;
    /// <summary>Steps until the body agrees anew, come what may; zero where nothing is remembered.</summary>
    public short Remaining;
    /// <summary>Of the first pair of a body: the number of its pairs, which follow one another.</summary>
    public int PairCount;
    /// <summary>Of the first pair of a body: how many of its pairs have found the same again in this step.</summary>
    public int HeldCount;
    /// <summary>Of the first pair of a body: whether a pair has found anything else in this step.</summary>
    public bool HasChanged;
    /// <summary>Where the pair waits in this step: the worker, and its place among those of the worker.</summary>
    public int Worker, Index;

    // Part of the body's reach by which it may have moved: a tenth of what it may be deeper than a child that it yields to.
    const float Tolerance = ChildAgreement.Tolerance * 0.1f;

    /// <summary>Takes down what a pair has found.</summary>
    /// <param name="manifold">What it has found.</param>
    /// <param name="orientation">Orientation of the body.</param>
    /// <param name="reach">Distance from the centre of the body to its farthest point, m.</param>
    public void Find(in ConvexContactManifold manifold, in Quaternion orientation, float reach)
    {
        Reach = reach;
        OffsetB = manifold.OffsetB;
        Orientation = orientation;
        Normal = manifold.Normal;
        Count = (byte)manifold.Count;
        for (int i = 0; i < manifold.Count; ++i)
            Features[i] = manifold.GetFeatureId(i);
        Remaining = RetestBound.Lifetime;
    }

    /// <summary>Takes down what is left of it.</summary>
    /// <returns>Whether the contacts that are left are some of those that were found.</returns>
    public bool Leave(in ConvexContactManifold manifold)
    {
        Left = 0;
        if (manifold.Count > 0 && manifold.Normal != Normal)
            return false;
        var place = 0;
        for (int i = 0; i < manifold.Count; ++i, ++place)
        {
            while (place < Count && Features[place] != manifold.GetFeatureId(i))
                ++place;
            if (place == Count)
                return false;
            Left |= (byte)(1 << place);
        }
        return true;
    }

    /// <summary>Whether a pair has found the same again, with its body where it was.</summary>
    /// <param name="manifold">What it has found.</param>
    /// <param name="orientation">Orientation of the body.</param>
    public readonly bool Holds(in ConvexContactManifold manifold, in Quaternion orientation)
    {
        if (Remaining == 0 || manifold.Count != Count)
            return false;
        for (int i = 0; i < Count; ++i)
        {
            if (manifold.GetFeatureId(i) != Features[i])
                return false;
        }
        // What is only near may be anywhere there.
        if (Count == 0)
            return true;
        var turn = orientation - Orientation;
        // A point at a distance of one moves by no more than twice the difference of the orientations.
        return Exact.DistanceSquared(manifold.OffsetB, OffsetB) <= Tolerance * Tolerance * Reach * Reach &&
            Exact.DistanceSquared(manifold.Normal, Normal) <= Tolerance * Tolerance &&
            turn.X * turn.X + turn.Y * turn.Y + turn.Z * turn.Z + turn.W * turn.W <= Tolerance * Tolerance / 4;
    }

    /// <summary>Leaves what was left.</summary>
    public readonly void Apply(ref ConvexContactManifold manifold)
    {
        manifold.Count = 0;
        for (int i = 0; i < Count; ++i)
        {
            if ((Left & 1 << i) == 0)
                continue;
            ConvexContactManifold.GetConvexContactReference(ref manifold, manifold.Count++) =
                ConvexContactManifold.GetConvexContactReference(ref manifold, i);
        }
    }
}
