using System;
using System.Numerics;
using System.Runtime.CompilerServices;
using System.Runtime.Intrinsics;
using BepuPhysics.Constraints.Contact;
using BepuUtilities;

namespace BepuPhysics.CollisionDetection;

/// <summary>An index for each contact of a manifold.</summary>
[InlineArray(4)]
struct FourIndices
{
    int first;
}

/// <summary>Which contacts of a step are where those of the step before were, and so keep their lever arms.</summary>
// A contact gives way a little under its load, so a column of boxes is a column of springs. It sways, and what the box on top has moved to the side is a
// moment at each contact below: load times sway. Where the springs are softer than that moment grows the column buckles, and an exact stack of twenty
// boxes falls by itself. Nothing of this is in the rigid bodies that are meant, which do not sway. So the moment is left out: a patch has the arms that
// it had when it formed, and what its bodies move on their springs is seen in the depths alone. What leaves its place is seen in the arms again: a patch
// has new ones as soon as two of its contacts are elsewhere, or one does not touch any more.
//
// Where only some contacts are elsewhere, as they slide over an edge or another corner of an overlap was chosen, these alone get new arms, less what the
// others have drifted since they got theirs: the arms of a patch are always of one moment, and a new contact does not bring in the sway.
struct KeptArms
{
    // Two contacts are a line, about which bodies roll, and one is a point.
    const int LeastCount = 3;

    // Contacts that have to be where they were: one alone does not say how the others have moved.
    const int LeastKept = 2;

    // How far a contact may be from where its arm says, over the shorter of its two arms. It bounds what kept arms do to a moment. Tipping over does
    // not come that late: there contacts open first.
    const float Tolerance = 0.05f;

    // How far a contact may be from there, as a part of that, before it is asked whether the bodies have turned together.
    const float StillPart = 1 / 25f;

    // Part of the way that contacts have moved, about their middle, by which they may be beside where a turn takes them.
    const float LeftPart = 0.25f;

    // Cosine of 10 degrees: how far the normal may turn in a step.
    const float LeastCosine = 0.98480775f;

    /// <summary>For each new contact the old one whose arm it keeps; -1 where there is none.</summary>
    public FourIndices Places;
    /// <summary>Number of contacts that keep their arms.</summary>
    public int Count;
    /// <summary>A bit for each old contact that is the place of a new one.</summary>
    public int Taken;
    /// <summary>Whether a contact is not quite where it was.</summary>
    public bool HasMoved;

    /// <summary>Whether a patch may keep arms: if it has contacts enough, and all of them touch.</summary>
    /// <param name="oldCount">Contacts of the last step.</param>
    /// <param name="manifold">Those of this one.</param>
    /// <param name="wasHeld">Whether the last step held the patch, by the load path: what it holds touches within its band.</param>
    /// <param name="hasTwoBodies">Whether B is a body.</param>
    // A body that rocks turns about the contacts that are left to it, and these have to be where they are.
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static bool MayKeep(int oldCount, in ConvexContactManifold manifold, bool wasHeld, bool hasTwoBodies)
    {
        if (oldCount < LeastCount || manifold.Count < LeastCount)
            return false;
        // What is held lies at zero, where the sign of a depth is rounding: branches on it would be guesses.
        if (wasHeld)
            return TouchesWithinBand(manifold, hasTwoBodies);
        return manifold.Contact0.Depth > 0 && manifold.Contact1.Depth > 0 && manifold.Contact2.Depth > 0 &&
            (manifold.Count == LeastCount || manifold.Contact3.Depth > 0);
    }

    // Twice the band: what is beyond it has not been taken out yet.
    static bool TouchesWithinBand(in ConvexContactManifold manifold, bool hasTwoBodies)
    {
        // Of three contacts the last lane holds the first once more.
        ref readonly var last = ref manifold.Count == LeastCount ? ref manifold.Contact0 : ref manifold.Contact3;
        var x = Vector128.Create(manifold.Contact0.Offset.X, manifold.Contact1.Offset.X, manifold.Contact2.Offset.X, last.Offset.X);
        var y = Vector128.Create(manifold.Contact0.Offset.Y, manifold.Contact1.Offset.Y, manifold.Contact2.Offset.Y, last.Offset.Y);
        var z = Vector128.Create(manifold.Contact0.Offset.Z, manifold.Contact1.Offset.Z, manifold.Contact2.Offset.Z, last.Offset.Z);
        var depths = Vector128.Create(manifold.Contact0.Depth, manifold.Contact1.Depth, manifold.Contact2.Depth, last.Depth);
        var extents = Extents(manifold.Normal, x, y, z);
        if (hasTwoBodies)
        {
            var aboutB = Extents(manifold.Normal,
                x - Vector128.Create(manifold.OffsetB.X), y - Vector128.Create(manifold.OffsetB.Y), z - Vector128.Create(manifold.OffsetB.Z));
            extents = Least(extents, aboutB);
        }
        // The least of all lanes, in each of them.
        extents = Least(extents, Vector128.Shuffle(extents, Vector128.Create(2, 3, 0, 1)));
        extents = Least(extents, Vector128.Shuffle(extents, Vector128.Create(1, 0, 3, 2)));
        return Vector128.GreaterThanOrEqualAll(depths, extents * (-2 * ContactMaterialWide.BandPerExtent));
    }

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static Vector128<float> Extents(in Vector3 normal, Vector128<float> x, Vector128<float> y, Vector128<float> z) =>
        Vector128.Abs(x * Vector128.Create(normal.X) + y * Vector128.Create(normal.Y) + z * Vector128.Create(normal.Z));

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static Vector128<float> Least(Vector128<float> a, Vector128<float> b) => Vector128.ConditionalSelect(Vector128.LessThan(a, b), a, b);

    /// <summary>Finds the contacts that are where they were.</summary>
    /// <param name="old">The patch of the last step.</param>
    /// <param name="manifold">The contacts of this step, of which <see cref="MayKeep"/> is true.</param>
    /// <returns>Whether the patch keeps its arms.</returns>
    // About both bodies: either may have moved. What nothing moves has no moment either, wherever its centre may be.
    public bool TryFind(in OldArms old, in ConvexContactManifold manifold)
    {
        Count = 0;
        Taken = 0;
        var moved = 0u;
        if (!(Exact.Dot(old.Normal, manifold.Normal) > LeastCosine))
            return false;
        var shorter = LengthSquared(old.X, old.Y, old.Z);
        var movedB = manifold.OffsetB - old.OffsetB;
        if (old.KnowsB)
        {
            var aboutB = DistanceSquared(old.X, old.Y, old.Z, old.OffsetB);
            shorter = Vector128.ConditionalSelect(Vector128.LessThan(aboutB, shorter), aboutB, shorter);
        }
        var allowed = shorter * (Tolerance * Tolerance);
        var still = allowed * (StillPart * StillPart);
        var left = (1u << old.Count) - 1;
        for (int i = 0; i < manifold.Count; ++i)
        {
            ref readonly var contact = ref manifold.Read(i);
            var x = Vector128.Create(contact.Offset.X) - old.X;
            var y = Vector128.Create(contact.Offset.Y) - old.Y;
            var z = Vector128.Create(contact.Offset.Z) - old.Z;
            var distance = LengthSquared(x, y, z);
            if (old.KnowsB)
            {
                var aboutB = DistanceSquared(x, y, z, movedB);
                distance = Vector128.ConditionalSelect(Vector128.GreaterThan(aboutB, distance), aboutB, distance);
            }
            var near = Vector128.LessThan(distance, allowed).ExtractMostSignificantBits() & left;
            var same = Vector128.Equals(old.Features, Vector128.Create(contact.FeatureId)).ExtractMostSignificantBits() & near;
            Places[i] = -1;
            if (near == 0)
                continue;
            var place = BitOperations.TrailingZeroCount(same != 0 ? same : near);
            // Rarely more than one is near.
            if (same == 0 && !BitOperations.IsPow2(near))
                place = Nearest(distance, near);
            Places[i] = place;
            left &= ~(1u << place);
            ++Count;
            moved |= Vector128.GreaterThan(distance, still).ExtractMostSignificantBits() & (1u << place);
        }
        Taken = (1 << old.Count) - 1 & ~(int)left;
        HasMoved = moved != 0;
        return Count >= LeastKept;
    }

    /// <summary>Turns arms by as much as the contacts that keep them have turned about the normal, if that is more than it takes to move a contact.</summary>
    /// <param name="old">The patch of the last step.</param>
    /// <param name="manifold">The contacts of this step.</param>
    /// <returns>Whether they were turned.</returns>
    // What lies on a turntable turns with it, and neither leans for that. With arms that stay as they are until the next ones are found, the friction of its
    // contacts is for a velocity that points where the two were going a while ago: it spirals outwards.
    public readonly bool Turn(ref OldArms old, in ConvexContactManifold manifold)
    {
        Vector3 oldMean = default, mean = default;
        for (int i = 0; i < manifold.Count; ++i)
        {
            if (Places[i] < 0)
                continue;
            oldMean += old[Places[i]];
            mean += manifold.Read(i).Offset;
        }
        oldMean *= 1f / Count;
        mean *= 1f / Count;
        float along = 0, across = 0;
        for (int i = 0; i < manifold.Count; ++i)
        {
            if (Places[i] < 0)
                continue;
            var (before, now) = (old[Places[i]] - oldMean, manifold.Read(i).Offset - mean);
            along += Exact.Dot(before, now);
            across += Exact.Dot(Exact.Cross(before, now), manifold.Normal);
        }
        if (!(MathF.Abs(across) > Tolerance * StillPart * along))
            return false;
        var turn = new ArmTurn(manifold.Normal, across / along);
        // Contacts that slip, or are found in other places, are not where any turn takes them.
        float moved = 0, left = 0;
        for (int i = 0; i < manifold.Count; ++i)
        {
            if (Places[i] < 0)
                continue;
            var (before, now) = (old[Places[i]] - oldMean, manifold.Read(i).Offset - mean);
            moved += Exact.DistanceSquared(before, now);
            left += Exact.DistanceSquared(turn.Apply(before), now);
        }
        if (!(left < LeftPart * LeftPart * moved))
            return false;
        (old.X, old.Y, old.Z) = turn.Apply(old.X, old.Y, old.Z);
        var turned = turn.Apply(old.OffsetB);
        // Unless the one turns on the other, which stays where it is.
        if (old.KnowsB && Exact.LengthSquared(turned - manifold.OffsetB) < Exact.LengthSquared(old.OffsetB - manifold.OffsetB))
            old.OffsetB = turned;
        return true;
    }

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static Vector128<float> LengthSquared(Vector128<float> x, Vector128<float> y, Vector128<float> z) => x * x + y * y + z * z;

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    internal static Vector128<float> DistanceSquared(Vector128<float> x, Vector128<float> y, Vector128<float> z, in Vector3 place) =>
        LengthSquared(x - Vector128.Create(place.X), y - Vector128.Create(place.Y), z - Vector128.Create(place.Z));

    /// <summary>The nearest of some contacts; the first of several, -1 where there is none.</summary>
    /// <param name="distances">Square of the distance of each.</param>
    /// <param name="candidates">A bit for each that is asked about.</param>
    internal static int Nearest(Vector128<float> distances, uint candidates)
    {
        int nearest = -1;
        for (; candidates != 0; candidates &= candidates - 1)
        {
            var candidate = BitOperations.TrailingZeroCount(candidates);
            if (nearest < 0 || distances.GetElement(candidate) < distances.GetElement(nearest))
                nearest = candidate;
        }
        return nearest;
    }

    /// <summary>How far the contacts that keep their arms are from where these say, on average, m.</summary>
    public readonly Vector3 Drift(in OldArms old, in ConvexContactManifold manifold)
    {
        Vector3 drift = default;
        for (int i = 0; i < manifold.Count; ++i)
        {
            if (Places[i] >= 0)
                drift += manifold.Read(i).Offset - old[Places[i]];
        }
        return drift * (1f / Count);
    }
}

/// <summary>The arms of three or four contacts of the last step, a lane for each contact.</summary>
struct OldArms
{
    /// <summary>Positions relative to the centre of A, world axes.</summary>
    public Vector128<float> X, Y, Z;
    /// <summary>Features.</summary>
    public Vector128<int> Features;
    /// <summary>Position of B relative to A when the arms were found.</summary>
    public Vector3 OffsetB;
    /// <summary>Normal of the last step.</summary>
    public Vector3 Normal;
    /// <summary>Number of contacts; lanes beyond hold something else.</summary>
    public int Count;
    /// <inheritdoc cref="ContactPatch.KnowsB"/>
    public bool KnowsB;

    /// <summary>Arm of a contact.</summary>
    public readonly Vector3 this[int contact] => new(X.GetElement(contact), Y.GetElement(contact), Z.GetElement(contact));

    /// <summary>The contact nearest to a place among those that are left; -1 where none is.</summary>
    /// <param name="taken">A bit for each contact that is not left.</param>
    /// <param name="place">Place relative to the centre of A.</param>
    public readonly int FindNearest(int taken, in Vector3 place) =>
        KeptArms.Nearest(KeptArms.DistanceSquared(X, Y, Z, place), (1u << Count) - 1 & ~(uint)taken);
}
