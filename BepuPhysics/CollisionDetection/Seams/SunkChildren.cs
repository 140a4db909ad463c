using System;
using System.Numerics;
using BepuPhysics.Collidables;
using BepuPhysics.Constraints.Contact;
using BepuUtilities;
using BepuUtilities.Memory;

namespace BepuPhysics.CollisionDetection;

/// <summary>Keeps what was pressed through a triangle in front of it.</summary>
/// <remarks>
/// <para>
/// A triangle has a front and no depth: what has its middle behind it, or comes out at its back sooner than at its front, is let through.
/// Contacts give way by some millimetres when they are hit, and so half of a thin slab may be behind what it has just hit. So a triangle
/// that is not touched, and lies across what the pair was held by in the last step, holds the other shape along its own normal, if that
/// is about as deep in it as half of its thickness, and no deeper than the contacts of the last step and the way since then can have made
/// it.
/// </para>
/// <para>
/// Two triangles, which both have no depth, do not cross any more as soon as one has sunk into the other as a whole. So that is asked for
/// wherever two lie across what held them: as long as they are no deeper than that was, and their way since then.
/// </para>
/// <para>
/// A triangle that is touched beyond one of its edges, and so left to its neighbour, is in front of what touches it: beside a step that
/// is as high as half of a box, the top of the step is not below the box.
/// </para>
/// <para>What has come from behind was not held, and is deeper than what holds it. So is what a game has put there.</para>
/// </remarks>
static class SunkChildren
{
    // Cosine of the greatest angle between the normal of a triangle and that of the contacts that held in the last step: 45 degrees. What
    // is thin turns fast.
    const float LeastCosine = 0.7f;

    // Part of the inner radius from which on a shape may be taken to be at the back of what it touches.
    const float Deep = 0.75f;

    // Part of the inner radius by which it has to have come, or been pressed, in the last step: what lies beside a step half as high did
    // neither.
    const float LeastWay = 1 / 16f;

    // By how much it may be deeper than it may have become, as a part of that: the way of a contact is taken to be straight.
    const float Deeper = 2;

    // Of what is thin, the square of the part of its distance from the centre by which a contact is below that.
    const float ThinSquare = 1 / 64f;

    /// <summary>Whether triangles that a pair does not touch may have to hold it: if it touches nothing any more, or is thin along what held it.</summary>
    /// <param name="set">The children of the pair.</param>
    /// <param name="count">Number of them.</param>
    /// <param name="touching">Those that touch.</param>
    /// <param name="known">What the pair was held by in the last step.</param>
    public static unsafe bool MayHave(in SeamSet set, int count, ReadOnlySpan<RankedChild> touching, in KnownPatches known)
    {
        if (HasSunkFaces(set, count))
            return true;
        var touches = false;
        foreach (ref readonly var child in touching)
        {
            ref var result = ref set.Results[child.Slot];
            if (result.Manifold.Count == 0)
                continue;
            touches = true;
            ref var placed = ref set.Placed[child.Slot];
            var arm = result.Manifold.Contact0.Offset - result.OffsetA;
            if (placed.MoverIsB)
                arm -= placed.OffsetB;
            var greatest = ThinSquare * Exact.LengthSquared(arm);
            for (int i = 0; i < known.Count; ++i)
            {
                var below = Exact.Dot(arm, known[i].Normal);
                if (below * below < greatest)
                    return true;
            }
        }
        return !touches;
    }

    // Two triangles that face each other do not cross any more when one has sunk into the other.
    static unsafe bool HasSunkFaces(in SeamSet set, int count)
    {
        for (int i = 0; i < count; ++i)
        {
            if (set.Results[i].Manifold.Count == 0 && set.Placed[i].AreTriangles && IsOneSided(set.Placed[i]))
                return true;
        }
        return false;
    }

    static bool IsOneSided(in PlacedChildren placed) => placed.AreKnown &&
        IsOneSided(placed.TypeA, placed.ShapeA) && IsOneSided(placed.TypeB, placed.ShapeB) && (placed.TypeA == Triangle.Id || placed.TypeB == Triangle.Id);

    static bool IsOneSided(int type, in ShapeCopy shape) => type != Triangle.Id || !shape.Read<Triangle>().TwoSided;

    // Along the front of the triangle that lies across what held the pair; of two, which both have to, along that of the one that is
    // nearer to it.
    static bool TryFindNormal(in PlacedChildren placed, in KnownPatches known, out Vector3 normal)
    {
        var isA = placed.TypeA == Triangle.Id;
        normal = Exact.Normalize(TriangleNeighbours.FaceVector(placed, isA));
        if (isA)
            normal = -normal;
        var patch = Find(known, normal);
        if (patch < 0)
            return false;
        if (!placed.AreTriangles)
            return true;
        var front = Exact.Normalize(TriangleNeighbours.FaceVector(placed, isA: false));
        var cosine = Exact.Dot(front, known[patch].Normal);
        if (cosine < LeastCosine)
            return false;
        if (cosine >= Exact.Dot(normal, known[patch].Normal))
            normal = front;
        return true;
    }

    /// <summary>Adds the children that are held to those of a pair that touch.</summary>
    /// <param name="memory">The set, of which nothing is waited for.</param>
    /// <param name="set">The children of the pair.</param>
    /// <param name="count">Number of them.</param>
    /// <param name="known">What the pair was held by in the last step.</param>
    /// <param name="motion">How deep that became in it, and how the two moved.</param>
    /// <param name="pool">Source of memory.</param>
    public static unsafe void Hold(ref SeamMemory memory, ref SeamSet set, int count, in KnownPatches known, in LastMotion motion, BufferPool pool)
    {
        for (int i = 0; i < count; ++i)
        {
            ref var placed = ref set.Placed[i];
            if (set.Results[i].Manifold.Count > 0 || set.Results[i].IsLeftToNeighbours || !IsOneSided(placed))
                continue;
            if (TryFindNormal(placed, known, out var normal))
                memory.Tests.Add(placed, normal, float.MaxValue, placed.SpeculativeMargin, i, pool);
        }
        if (memory.Tests.Count == 0)
            return;
        memory.Tests.Execute();
        var first = memory.Touching.Count;
        for (int i = 0; i < set.Count; ++i)
            memory.Touching.Add(memory.Touching[set.First + i], pool);
        for (int i = 0; i < memory.Tests.FoundCount; ++i)
        {
            ref var test = ref memory.Tests[i];
            ref var result = ref set.Results[test.Owner];
            result.Replace(test);
            // A search that begins at the back may stay there.
            result.KeepsHistory &= !(result.Manifold.Count > 0 && result.Manifold.GreatestDepth > 0);
            ref var owner = ref set.Placed[test.Owner];
            if (Holds(result.Manifold, known, motion, owner.AreTriangles ? 0 : owner.InnerRadius()))
                memory.Touching.Add(new() { Slot = test.Owner, Class = 1 }, pool);
            else
                result.Manifold.Count = 0;
        }
        if (memory.Touching.Count == first + set.Count)
            return;
        set.First = first;
        set.Count = memory.Touching.Count - first;
        set.Count = SeamMemory.Sort(memory.TouchingOf(set), set.Results);
    }

    // The patch of the last step whose normal is nearest, or none.
    static int Find(in KnownPatches known, in Vector3 normal)
    {
        var cosine = LeastCosine;
        var best = -1;
        for (int i = 0; i < known.Count; ++i)
        {
            var other = Exact.Dot(known[i].Normal, normal);
            if (other > cosine)
                (cosine, best) = (other, i);
        }
        return best;
    }

    static bool Holds(in ConvexContactManifold manifold, in KnownPatches known, in LastMotion motion, float innerRadius)
    {
        if (manifold.Count == 0)
            return false;
        var before = motion.Depth(Find(known, manifold.Normal));
        var greatest = 0f;
        for (int i = 0; i < manifold.Count; ++i)
        {
            var arm = manifold.GetOffset(i);
            var row = new ContactRow(manifold.Normal, Exact.Cross(arm, manifold.Normal), Exact.Cross(manifold.Normal, arm - manifold.OffsetB));
            var way = MathHelper.Max(0, -row.Along(motion.OfA, motion.OfB));
            if (!(manifold.GetDepth(i) <= innerRadius + Deeper * (before + way)))
                return false;
            greatest = MathHelper.Max(greatest, before + way);
        }
        return manifold.GreatestDepth > Deep * innerRadius && greatest >= LeastWay * innerRadius;
    }
}
