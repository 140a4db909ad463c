using System.Numerics;
using System.Runtime.InteropServices;
using BepuPhysics.Collidables;
using BepuUtilities;

namespace BepuPhysics.CollisionDetection;

/// <summary>What became of the contacts of two convex shapes when the pairs of their body agreed.</summary>
/// <remarks>
/// A body that lies across statics agrees on the same in each step. As long as it hardly moves and its pairs find what they found, what they agreed on is
/// remembered: which contacts are left. The contacts themselves are those of the step.
/// </remarks>
// A cache line.
[StructLayout(LayoutKind.Sequential, Size = 64)]
struct AgreedPair
{
    /// <summary>What the body lies on.</summary>
    public CollidableReference B;
    /// <summary>Position of B less that of A, m.</summary>
    public Vector3 OffsetB;
    /// <summary>Unit normal that the contacts had.</summary>
    public Vector3 Normal;
    /// <summary>Depth of the deepest contact, m.</summary>
    public float Depth;
    /// <summary>Features of the contacts.</summary>
    public FeatureIds Features;
    /// <summary>Number of the contacts that the pair had; zero for shapes of children that were near.</summary>
    public byte Count;
    /// <summary>A bit for each of the contacts that is left.</summary>
    public byte Left;
    /// <summary>Whether the pair is to be remembered.</summary>
    public bool IsRemembered;
    /// <summary>Where the pair waits in this step: the worker, and its place among those of the worker.</summary>
    public int Worker, Index;

    // Part of the body's reach by which it may have moved: a tenth of a lip that is none.
    const float Tolerance = ChildAgreement.GreatestLip * 0.1f;
    // Times as much for depths. No move that is allowed changes these by more: another shape in the place of one does.
    const float DepthShare = 4;

    /// <summary>Takes down what a pair has found.</summary>
    public void Find(in ConvexContactManifold manifold)
    {
        OffsetB = manifold.OffsetB;
        Normal = manifold.Normal;
        Depth = manifold.GreatestDepth;
        Count = (byte)manifold.Count;
        for (int i = 0; i < manifold.Count; ++i)
            Features[i] = manifold.GetFeatureId(i);
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
    /// <param name="body">The body, as it was.</param>
    public readonly bool Holds(in ConvexContactManifold manifold, in Quaternion orientation, in AgreedBody body)
    {
        if (manifold.Count != Count)
            return false;
        for (int i = 0; i < Count; ++i)
        {
            if (manifold.GetFeatureId(i) != Features[i])
                return false;
        }
        // What is only near may be anywhere there.
        if (Count == 0)
            return true;
        var turn = orientation - body.Orientation;
        // A point at a distance of one moves by no more than twice the difference of the orientations.
        return Exact.DistanceSquared(manifold.OffsetB, OffsetB) <= Tolerance * Tolerance * body.Reach * body.Reach &&
            Exact.DistanceSquared(manifold.Normal, Normal) <= Tolerance * Tolerance &&
            turn.X * turn.X + turn.Y * turn.Y + turn.Z * turn.Z + turn.W * turn.W <= Tolerance * Tolerance / 4 &&
            System.MathF.Abs(manifold.GreatestDepth - Depth) <= DepthShare * Tolerance * body.Reach;
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
