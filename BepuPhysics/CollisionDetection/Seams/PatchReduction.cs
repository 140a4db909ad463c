using System;
using System.Numerics;
using System.Runtime.CompilerServices;
using BepuUtilities;
using BepuUtilities.Memory;

namespace BepuPhysics.CollisionDetection;

/// <summary>The choice of the contacts of patches that have more, or that several children share: all patches of a pair at once, a lane for each.</summary>
// By the rule of FaceReduction: the deepest or, of a level patch, an end of its greatest length; the one farthest from it; the ones farthest to
// either side. Contacts of two children at one place, where these meet, are one.
static unsafe class PatchReduction
{
    // Parts of the mover's inner radius: contacts that are nearer to each other than ten of the first are one, and that is more than a sphere's two
    // normals at a seam may differ by and be one; depths that are as good; by how much the first contact of the last step counts as deeper.
    const float Border = 2e-4f;
    const float LevelTolerance = 5e-5f;
    const float DepthPreference = 8e-5f;
    const float SpanPreference = 1.05f;
    const float SideLean = 1e-4f;
    // What is above the deepest by more than this at the end of the step does not touch.
    const float Apart = 2e-2f;

    struct Frames
    {
        public Vector3Wide X, Y, Origin;
        public Vector<float> Size;
    }

    // One lane of these.
    struct Frame
    {
        public Vector3 X, Y, Origin;
        public float Preference;
    }

    /// <summary>Chooses contacts. Their names are <see cref="SeamMemory.Kept"/>, patch by patch.</summary>
    /// <param name="memory">The children that touch, with their patches, and room for candidates.</param>
    /// <param name="results">What was found for each child.</param>
    /// <param name="placed">Shapes and poses of each.</param>
    /// <param name="patches">The patches.</param>
    /// <param name="count">Number of patches.</param>
    /// <param name="reduces">A bit for each patch that is to be reduced.</param>
    /// <param name="pool">Source of memory.</param>
    public static void Reduce(ref SeamMemory memory, Span<ChildResult> results, Span<PlacedChildren> placed, in PatchSet patches, int count,
        int reduces, BufferPool pool)
    {
        var greatest = 0;
        var normals = Vector3Wide.Zero;
        Frames frames = default;
        for (int i = 0; i < count; ++i)
        {
            greatest = Math.Max(greatest, patches[i].ContactCount);
            Lanes.Write(patches[i].Normal, ref normals, i);
            Lanes.Write(results[patches[i].Slot].Manifold.Contact0.Offset, ref frames.Origin, i);
            GatherScatter.Get(ref frames.Size, i) = placed[patches[i].Slot].InnerRadius();
        }
        Vector3Wide.BuildOrthonormalBasis(normals, out frames.X, out frames.Y);
        Span<float> limits = stackalloc float[PatchSet.Capacity];
        FindLimits(memory.Ranked.AsSpan(), results, placed, patches, reduces, frames.Size, limits);
        var left = Fill(ref memory, results, placed, patches, reduces, limits, greatest, ref frames, pool);
        Choose(memory.Candidates.Span.Memory, greatest, frames.Size, out var deepest, out var farthest, out var sides, out var secondExists);
        // What is carried by those that touch does not need the others. In place of one that touches it would be carried by fewer, and rock.
        for (int i = 0; i < count; ++i)
            left &= (sides.LeftExists[i] | sides.RightExists[i]) == 0 ? -1 : ~(1 << i);
        if (left != 0)
        {
            for (int i = 0; i < count; ++i)
                limits[i] = (left & 1 << i) != 0 ? float.MinValue : limits[i];
            Fill(ref memory, results, placed, patches, reduces, limits, greatest, ref frames, pool);
            Choose(memory.Candidates.Span.Memory, greatest, frames.Size, out deepest, out farthest, out sides, out secondExists);
        }
        memory.Kept.Count = 0;
        for (int i = 0; i < count; ++i)
        {
            if ((reduces & 1 << i) == 0)
                continue;
            var end = memory.Kept.Count + patches[i].Share;
            Add(ref memory, deepest, i, end);
            if (secondExists[i] != 0)
                Add(ref memory, farthest, i, end);
            // The larger side first: there may be room for one.
            for (int side = 0; side < 2; ++side)
            {
                if ((sides.TipIsLeft[i] != 0) == (side == 0))
                    AddIf(sides.LeftExists | sides.BeyondMask, ref memory, sides.Left, i, end);
                else
                    AddIf(sides.RightExists | sides.BeyondMask, ref memory, sides.Right, i, end);
            }
        }
    }

    // The least depth that contacts of each patch must have at the end of the step to touch. Where there is room for all, or too few touch to carry anything,
    // none is left out.
    static void FindLimits(Span<RankedChild> ranked, Span<ChildResult> results, Span<PlacedChildren> placed, in PatchSet patches, int reduces,
        Vector<float> sizes, Span<float> limits)
    {
        for (int lane = 0; lane < limits.Length; ++lane)
        {
            limits[lane] = float.MinValue;
            if ((reduces & 1 << lane) == 0 || patches[lane].ContactCount <= patches[lane].Share)
                continue;
            var (deepest, touching) = (float.MinValue, 0);
            foreach (ref var child in ranked)
            {
                ref var manifold = ref results[child.Slot].Manifold;
                for (int i = 0; child.Patch == lane && i < manifold.Count; ++i)
                {
                    deepest = MathHelper.Max(deepest, manifold.GetDepth(i));
                    touching += manifold.GetDepth(i) >= -Apart * sizes[lane] ? 1 : 0;
                }
            }
            if (touching == patches[lane].ContactCount)
                continue;
            var limit = MathHelper.Min(0, deepest) - Apart * sizes[lane];
            touching = 0;
            foreach (ref var child in ranked)
            {
                for (int i = 0; child.Patch == lane && i < results[child.Slot].Manifold.Count; ++i)
                    touching += Touches(results[child.Slot], i, placed[child.Slot].Motion, patches[lane].Normal, limit) ? 1 : 0;
            }
            if (touching > 2)
                limits[lane] = limit;
        }
    }

    // Whether a contact is that deep, or is at the end of the step.
    static bool Touches(in ChildResult result, int index, in ChildMotion motion, in Vector3 normal, float limit)
    {
        ref readonly var contact = ref result.Manifold.Read(index);
        if (contact.Depth >= limit)
            return true;
        var way = motion.Way + Exact.Cross(motion.Turn, contact.Offset - result.OffsetA);
        return contact.Depth - Exact.Dot(way, normal) >= limit;
    }

    // A bit for each patch some of whose contacts were left out.
    static int Fill(ref SeamMemory memory, Span<ChildResult> results, Span<PlacedChildren> placed, in PatchSet patches, int reduces,
        ReadOnlySpan<float> limits, int greatest, ref Frames frames, BufferPool pool)
    {
        var left = 0;
        ref var candidates = ref memory.Candidates;
        candidates.Count = 0;
        candidates.EnsureCapacity(greatest, pool);
        for (int i = 0; i < greatest; ++i)
        {
            ref var candidate = ref candidates.AllocateUnsafely();
            candidate.X = candidate.Y = candidate.Weight = Vector<float>.Zero;
            candidate.Name = Vector<int>.Zero;
            candidate.Depth = new Vector<float>(IContactCandidate.None);
        }
        Span<int> counts = [0, 0, 0, 0];
        Span<Frame> lanes = stackalloc Frame[PatchSet.Capacity];
        for (int lane = 0; lane < lanes.Length; ++lane)
        {
            lanes[lane].X = Lanes.Read<Vector3, Vector3Wide>(ref frames.X, lane);
            lanes[lane].Y = Lanes.Read<Vector3, Vector3Wide>(ref frames.Y, lane);
            lanes[lane].Origin = Lanes.Read<Vector3, Vector3Wide>(ref frames.Origin, lane);
            lanes[lane].Preference = frames.Size[lane] * DepthPreference;
        }
        foreach (ref var child in memory.Ranked.AsSpan())
        {
            var lane = child.Patch;
            if (lane < 0 || (reduces & 1 << lane) == 0)
                continue;
            ref var result = ref results[child.Slot];
            ref var frame = ref lanes[lane];
            ref readonly var patch = ref patches[lane];
            for (int i = 0; i < result.Manifold.Count; ++i)
            {
                ref var contact = ref ConvexContactManifold.GetConvexContactReference(ref result.Manifold, i);
                if (!Touches(result, i, placed[child.Slot].Motion, patch.Normal, limits[lane]))
                {
                    left |= 1 << lane;
                    continue;
                }
                ref var candidate = ref candidates[counts[lane]++];
                var place = contact.Offset - frame.Origin;
                // Of a patch of several pairs it is known of each contact.
                var isFirst = (child.Remembered & 1 << i) != 0;
                var isRemembered = isFirst;
                if (patch.IsKnown)
                {
                    var feature = result.Children.Mix(contact.FeatureId);
                    isFirst |= feature == patch.Memory.First;
                    isRemembered = isFirst || feature == patch.Memory.Second;
                }
                GatherScatter.Get(ref candidate.X, lane) = Exact.Dot(place, frame.X);
                GatherScatter.Get(ref candidate.Y, lane) = Exact.Dot(place, frame.Y);
                GatherScatter.Get(ref candidate.Depth, lane) = contact.Depth + (isFirst ? frame.Preference : 0);
                GatherScatter.Get(ref candidate.Weight, lane) = isRemembered ? SpanPreference : 1;
                GatherScatter.Get(ref candidate.Name, lane) = child.Slot * ConvexContactManifold.MaximumContactCount + i;
            }
        }
        return left;
    }

    [MethodImpl(MethodImplOptions.NoInlining)]
    static void Choose(FaceCandidate* candidates, int count, Vector<float> size, out ContactChoice deepest, out ContactChoice farthest,
        out ContactSides sides, out Vector<int> secondExists)
    {
        var none = new Vector<float>(IContactCandidate.None);
        ContactChoice best = default;
        best.Score = best.Depth = none;
        for (int i = 0; i < count; ++i)
            best.Offer(candidates[i].Depth, candidates[i], i);
        ContactReduction<FaceCandidate>.ChooseFarthest(candidates, count, best, none, best, out farthest);
        var level = best.Depth - size * new Vector<float>(LevelTolerance);
        ContactReduction<FaceCandidate>.ChooseFarthest(candidates, count, farthest, level, best, out deepest);
        secondExists = ContactReduction<FaceCandidate>.IsFarEnough(farthest, size * new Vector<float>(Border));
        ContactReduction<FaceCandidate>.ChooseSides(candidates, count, none, deepest, farthest, SideLean, secondExists, out sides);
    }

    static void AddIf(Vector<int> exists, ref SeamMemory memory, in ContactChoice choice, int lane, int end)
    {
        if (exists[lane] != 0)
            Add(ref memory, choice, lane, end);
    }

    // There is room for the contacts of all patches.
    static void Add(ref SeamMemory memory, in ContactChoice choice, int lane, int end)
    {
        if (memory.Kept.Count < end)
            memory.Kept.AddUnsafely(choice.Name[lane]);
    }
}
