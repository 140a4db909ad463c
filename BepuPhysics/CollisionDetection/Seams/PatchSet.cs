using System;
using System.Numerics;
using System.Runtime.CompilerServices;
using BepuPhysics.Constraints.Contact;
using BepuUtilities;
using BepuUtilities.Memory;

namespace BepuPhysics.CollisionDetection;

/// <summary>Contacts of children that have one normal.</summary>
struct Patch
{
    /// <summary>Unit normal in world axes, from B to A: that of its deepest contact.</summary>
    public Vector3 Normal;
    /// <summary>Number of contacts of all its children.</summary>
    public int ContactCount;
    /// <summary>Number of its children.</summary>
    public int ChildCount;
    /// <summary>Slot of its first child.</summary>
    public int Slot;
    /// <summary>Contacts that it may have.</summary>
    public int Share;
    /// <summary>The number that it keeps while it exists.</summary>
    public int Number;
    /// <summary>Whether it was there in the last step.</summary>
    public bool IsKnown;
    /// <summary>What is remembered of that.</summary>
    public PatchMemory Memory;
}

/// <summary>The patches of a pair: contacts of children, grouped by their normals.</summary>
/// <remarks>
/// The contacts of a patch have one normal and one friction, as those of two convex shapes, and are reduced by the same rule: a box on two flush boxes has
/// four contacts at its corners, as it has on one.
/// </remarks>
[InlineArray(Capacity)]
unsafe struct PatchSet
{
    Patch first;

    /// <summary>Greatest number of patches.</summary>
    public const int Capacity = 4;

    // Contacts of all patches of a pair.
    const int Room = 2 * Capacity;

    /// <summary>Cosine of 4 degrees: normals that are nearer to each other are one patch.</summary>
    public const float SameNormal = 0.99756405f;

    // Cosine of 2 degrees, for single contacts.
    const float SameSingleNormal = 0.99939083f;

    // Cosine of the greatest angle by which a patch may have turned in a step.
    const float LeastTurnCosine = 0.9f;

    /// <summary>Makes patches of the contacts of children, which have none of their own any more.</summary>
    /// <param name="memory">The children that touch, in their order, and room for candidates.</param>
    /// <param name="results">What was found for each child.</param>
    /// <param name="placed">Shapes and poses of each.</param>
    /// <param name="known">Patches of the last step.</param>
    /// <param name="target">Receives the patches at its end, in the order of their numbers.</param>
    /// <param name="pool">Source of memory.</param>
    /// <returns>Number of patches.</returns>
    public static int Build(ref SeamMemory memory, Span<ChildResult> results, Span<PlacedChildren> placed, in KnownPatches known,
        Span<ChildResult> target, BufferPool pool)
    {
        memory.Reduced.Count = 0;
        fixed (ChildResult* result = results)
        fixed (PlacedChildren* place = placed)
        {
            var count = Begin(ref memory, memory.Ranked.AsSpan(), 0, result, place, known, target, pool);
            PatchReduction.Run(ref memory, memory.Ranked.Span.Memory, pool);
            Finish(memory.Ranked.AsSpan(), memory.Reduced.AsSpan(), result, target);
            return count;
        }
    }

    /// <summary>Begins to make patches: those whose contacts are to be chosen are added to <see cref="SeamMemory.Reduced"/>, the others are done.</summary>
    /// <param name="memory">Receives these.</param>
    /// <param name="ranked">The children that touch, in their order.</param>
    /// <param name="first">Place of the first of them among all that the choice is told of.</param>
    /// <param name="results">What was found for each child.</param>
    /// <param name="placed">Shapes and poses of each.</param>
    /// <param name="known">Patches of the last step.</param>
    /// <param name="target">Receives the patches at its end, in the order of their numbers.</param>
    /// <param name="pool">Source of memory.</param>
    /// <returns>Number of patches.</returns>
    public static int Begin(ref SeamMemory memory, Span<RankedChild> ranked, int first, ChildResult* results, PlacedChildren* placed,
        in KnownPatches known, Span<ChildResult> target, BufferPool pool)
    {
        Unsafe.SkipInit(out PatchSet patches);
        var count = patches.Group(ranked, results);
        if (count == 0)
            return 0;
        patches.Match(count, known);
        patches.SetShares(count, FindNear(ranked, results, placed, count));
        for (int i = 0; i < count; ++i)
            Place(target[(Capacity - count)..], ref patches[i], i, results[patches[i].Slot].Manifold.OffsetB);
        for (int i = 0; i < count; ++i)
        {
            ref var patch = ref patches[i];
            if (patch.ChildCount == 1 && patch.ContactCount <= patch.Share)
                Copy(results[patch.Slot], ref Find(target, patch));
            else
                Reduce(ref memory, patch, i, ranked.Length, first, results, placed, pool);
        }
        return count;
    }

    static void Reduce(ref SeamMemory memory, in Patch patch, int number, int childCount, int first, ChildResult* results, PlacedChildren* placed,
        BufferPool pool)
    {
        memory.Reduced.EnsureCapacity(SeamMemory.SetCapacity, pool);
        ref var reduced = ref memory.Reduced.Allocate(pool);
        reduced.Results = results;
        reduced.Placed = placed;
        (reduced.FirstChild, reduced.ChildCount) = (first, childCount);
        reduced.Patch = patch;
        reduced.Number = number;
        reduced.Clear();
    }

    /// <summary>Takes the contacts that were chosen; the children have none of their own any more.</summary>
    /// <param name="ranked">The children that touch.</param>
    /// <param name="reduced">Those of the patches of which some were chosen.</param>
    /// <param name="results">What was found for each child.</param>
    /// <param name="target">The patches, at its end.</param>
    public static void Finish(Span<RankedChild> ranked, Span<ReducedPatch> reduced, ChildResult* results, Span<ChildResult> target)
    {
        foreach (ref var patch in reduced)
        {
            ref var result = ref Find(target, patch.Patch);
            result.Lever = patch.Lever;
            foreach (var name in patch.Kept)
                Add(results, name, ref result.Manifold);
        }
        foreach (ref var child in ranked)
            results[child.Slot].Manifold.Count = 0;
    }

    /// <summary>Makes a patch of the contacts of a child that is alone, as <see cref="Build"/> would; the child has none of its own any more.</summary>
    /// <param name="child">What was found for the child: some contacts.</param>
    /// <param name="known">Patches of the last step.</param>
    /// <param name="target">Receives the patch.</param>
    public static void BuildOfOne(ref ChildResult child, in KnownPatches known, ref ChildResult target)
    {
        var nearest = FindNearest(known, child.Manifold.Normal, 0);
        Begin(ref target, nearest < 0 ? 0 : known.Number(nearest), child.Manifold.Normal, child.Manifold.OffsetB);
        Copy(child, ref target);
        child.Manifold.Count = 0;
    }

    static void Add(ChildResult* results, int name, ref ConvexContactManifold manifold)
    {
        ref var result = ref results[name / ConvexContactManifold.MaximumContactCount];
        ref var contact = ref ConvexContactManifold.GetConvexContactReference(ref manifold, manifold.Count++);
        contact = ConvexContactManifold.GetConvexContactReference(ref result.Manifold, name % ConvexContactManifold.MaximumContactCount);
        contact.FeatureId = result.Children.Mix(contact.FeatureId);
    }

    /// <summary>Leaves of the contacts of several pairs of one body with one normal those that it would have with one.</summary>
    /// <remarks>More contacts would carry it on more springs, and lift it.</remarks>
    /// <param name="memory">The children that touch, in their order; those that lose contacts are marked as having yielded.</param>
    /// <param name="results">What was found for each child, and then what is left of it.</param>
    /// <param name="placed">Shapes and poses of each.</param>
    /// <param name="pool">Source of memory.</param>
    public static void Thin(ref SeamMemory memory, Span<ChildResult> results, Span<PlacedChildren> placed, BufferPool pool)
    {
        Unsafe.SkipInit(out PatchSet patches);
        var ranked = memory.Ranked.AsSpan();
        memory.Reduced.Count = 0;
        fixed (ChildResult* result = results)
        fixed (PlacedChildren* place = placed)
        {
            var count = patches.Group(ranked, result);
            for (int i = 0; i < count; ++i)
            {
                patches[i].Share = ConvexContactManifold.MaximumContactCount;
                if (HasSeveralPairs(ranked, i))
                    Reduce(ref memory, patches[i], i, ranked.Length, 0, result, place, pool);
            }
            PatchReduction.Run(ref memory, memory.Ranked.Span.Memory, pool);
        }
        foreach (ref var patch in memory.Reduced.AsSpan())
        {
            foreach (ref var child in ranked)
            {
                if (child.Patch != patch.Number)
                    continue;
                ref var result = ref results[child.Slot];
                result.Lever = patch.Lever;
                child.HasYielded |= patch.Lever != FaceLever.OfOneFace;
                LeaveKept(patch.Kept, ref child, ref result.Manifold);
            }
        }
    }

    static void LeaveKept(ReadOnlySpan<int> kept, ref RankedChild child, ref ConvexContactManifold manifold)
    {
        var before = manifold.Count;
        manifold.Count = 0;
        for (int i = 0; i < before; ++i)
        {
            if (!kept.Contains(child.Slot * ConvexContactManifold.MaximumContactCount + i))
                continue;
            ConvexContactManifold.GetConvexContactReference(ref manifold, manifold.Count++) =
                ConvexContactManifold.GetConvexContactReference(ref manifold, i);
        }
        child.HasYielded |= manifold.Count != before;
    }

    static bool HasSeveralPairs(Span<RankedChild> ranked, int patch)
    {
        var pair = 0;
        foreach (ref var child in ranked)
        {
            if (child.Patch != patch)
                continue;
            if (pair != 0 && pair != child.Pair)
                return true;
            pair = child.Pair;
        }
        return false;
    }

    // By normals, in the order of children, so that the first of a patch is its deepest.
    int Group(Span<RankedChild> ranked, ChildResult* results)
    {
        var count = 0;
        foreach (ref var child in ranked)
        {
            child.Patch = -1;
            ref var manifold = ref results[child.Slot].Manifold;
            if (manifold.Count == 0)
                continue;
            var best = -1;
            var cosine = 0f;
            for (int i = 0; i < count; ++i)
            {
                var other = Exact.Dot(this[i].Normal, manifold.Normal);
                if (other > cosine)
                    (cosine, best) = (other, i);
            }
            // What touches at a point has no use for a second contact along one normal, and needs the plane that is ahead.
            var isSame = cosine >= (best >= 0 && manifold.Count == 1 && results[this[best].Slot].Manifold.Count == 1 ? SameSingleNormal : SameNormal);
            if (!isSame && count < Capacity)
            {
                best = count++;
                this[best] = new() { Normal = manifold.Normal, Slot = child.Slot };
            }
            // Where there is no room for more, what is across all patches is left out.
            if (best < 0)
                continue;
            child.Patch = best;
            this[best].ContactCount += manifold.Count;
            ++this[best].ChildCount;
        }
        return count;
    }

    // Each patch of the last step goes on as the one whose normal is nearest.
    void Match(int count, in KnownPatches known)
    {
        var taken = 0;
        var numbers = 0;
        for (int i = 0; i < count; ++i)
        {
            var best = FindNearest(known, this[i].Normal, taken);
            if (best < 0)
                continue;
            taken |= 1 << best;
            this[i].IsKnown = true;
            this[i].Memory = known[best];
            this[i].Number = known.Number(best);
            numbers |= 1 << this[i].Number;
        }
        for (int i = 0; i < count; ++i)
        {
            if (this[i].IsKnown)
                continue;
            this[i].Number = BitOperations.TrailingZeroCount(~numbers);
            numbers |= 1 << this[i].Number;
        }
    }

    // The patch of the last step that is nearest to a normal, of those that are not taken; negative where none is near.
    static int FindNearest(in KnownPatches known, in Vector3 normal, int taken)
    {
        var best = -1;
        var cosine = LeastTurnCosine;
        for (int i = 0; i < known.Count; ++i)
        {
            var other = Exact.Dot(known[i].Normal, normal);
            if ((taken & 1 << i) == 0 && other > cosine)
                (cosine, best) = (other, i);
        }
        return best;
    }

    // Eight contacts in all: four for each of two patches; of three, three for those that are known longest, which do not change from step to step
    // as the deepest may; two for each of four. What one does not need goes to the next. What is only coming near has one if others need the rest: with less
    // than three contacts what holds the body would let it rock.
    void SetShares(int count, int near)
    {
        if (count * ConvexContactManifold.MaximumContactCount <= Room)
        {
            for (int i = 0; i < count; ++i)
                this[i].Share = ConvexContactManifold.MaximumContactCount;
            return;
        }
        // Numbers are below the capacity, and each is that of one patch.
        Span<int> places = [-1, -1, -1, -1];
        for (int i = 0; i < count; ++i)
            places[this[i].Number] = i;
        var apart = count - BitOperations.PopCount((uint)near);
        var room = Room - apart;
        var rest = count - apart;
        var left = 0;
        for (int pass = 0; pass < 2; ++pass)
        {
            foreach (int i in places)
            {
                if (i < 0 || (near & 1 << i) != 0 != (pass == 0))
                    continue;
                var share = Math.Min(ConvexContactManifold.MaximumContactCount, (room + rest - 1) / rest);
                --rest;
                room -= share;
                this[i].Share = Math.Min(ConvexContactManifold.MaximumContactCount, share + left);
                left = Math.Max(0, this[i].Share - this[i].ContactCount);
            }
            rest = apart;
            room += apart;
        }
    }

    // A bit for each patch that touches, or is about to; for all where none is, or where there is room for all.
    static int FindNear(Span<RankedChild> ranked, ChildResult* results, PlacedChildren* placed, int count)
    {
        var all = (1 << count) - 1;
        if (count < 3)
            return all;
        var near = 0;
        foreach (ref var child in ranked)
        {
            ref var manifold = ref results[child.Slot].Manifold;
            if (child.Patch >= 0 && (near & 1 << child.Patch) == 0 && manifold.GreatestDepth >= -PatchReduction.Apart * placed[child.Slot].InnerRadius())
                near |= 1 << child.Patch;
        }
        return near == 0 ? all : near;
    }

    // Inserts the patch into those that are placed already.
    static void Place(Span<ChildResult> target, ref Patch patch, int count, Vector3 offsetB)
    {
        var place = count;
        for (; place > 0 && target[place - 1].Children.B > patch.Number; --place)
            target[place] = target[place - 1];
        Begin(ref target[place], patch.Number, patch.Normal, offsetB);
    }

    static void Begin(ref ChildResult target, int number, in Vector3 normal, in Vector3 offsetB)
    {
        target.Children = ChildIds.Patch(number);
        target.KeepsHistory = false;
        target.Lever = FaceLever.OfOneFace;
        target.OffsetA = default;
        target.Manifold.OffsetB = offsetB;
        target.Manifold.Normal = normal;
        target.Manifold.Count = 0;
    }

    /// <summary>The result of a patch.</summary>
    public static ref ChildResult Find(Span<ChildResult> target, in Patch patch)
    {
        var i = Capacity - 1;
        while (target[i].Children.B != patch.Number)
            --i;
        return ref target[i];
    }

    static void Copy(in ChildResult source, ref ChildResult target)
    {
        target.Lever = source.Lever;
        ref var manifold = ref target.Manifold;
        manifold.Count = source.Manifold.Count;
        manifold.Contact0 = source.Manifold.Contact0;
        manifold.Contact1 = source.Manifold.Contact1;
        manifold.Contact2 = source.Manifold.Contact2;
        manifold.Contact3 = source.Manifold.Contact3;
        for (int i = 0; i < manifold.Count; ++i)
        {
            ref var contact = ref ConvexContactManifold.GetConvexContactReference(ref manifold, i);
            contact.FeatureId = source.Children.Mix(contact.FeatureId);
        }
    }
}
