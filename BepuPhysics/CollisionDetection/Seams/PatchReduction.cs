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
    /// <summary>Part of the mover's inner radius: what is above the deepest by more than this at the end of the step does not touch.</summary>
    public const float Apart = 5e-3f;
    // Depth of a candidate that does not touch, where it is one of the last two at most.
    const float Aside = -1e30f;

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
        var leaning = FindLimits(memory.Ranked.AsSpan(), results, placed, patches, reduces, frames.Size, limits);
        var left = Fill(ref memory, results, placed, patches, reduces, limits, leaning, greatest, ref frames, pool);
        Choose(memory.Candidates.Span.Memory, greatest, frames.Size, out var deepest, out var farthest, out var sides, out var secondExists);
        // What is carried by those that touch does not need the others. In place of one that touches it would be carried by fewer, and rock.
        var inLine = ~(sides.LeftExists | sides.RightExists);
        left &= (int)Wide.Bits(inLine);
        if (left != 0)
        {
            Fill(ref memory, results, placed, patches, reduces, limits, leaning | left, greatest, ref frames, pool);
            Choose(memory.Candidates.Span.Memory, greatest, frames.Size, out deepest, out farthest, out sides, out secondExists);
        }
        inLine &= secondExists;
        if (inLine != Vector<int>.Zero)
            ChooseEnds(memory.Candidates.Span.Memory, greatest, frames.Size, inLine, farthest, ref deepest, ref sides);
        memory.Kept.Count = 0;
        memory.Kept.EnsureCapacity(PatchSet.Capacity * ConvexContactManifold.MaximumContactCount, pool);
        for (int i = 0; i < count; ++i)
        {
            if ((reduces & 1 << i) == 0)
                continue;
            var room = memory.Kept.Count + patches[i].Share;
            Add(ref memory, deepest, i, room);
            if (secondExists[i] != 0)
                Add(ref memory, farthest, i, room);
            // The larger side first: there may be room for one.
            for (int side = 0; side < 2; ++side)
            {
                if ((sides.TipIsLeft[i] != 0) == (side == 0))
                    AddIf(sides.LeftExists | sides.BeyondMask, ref memory, sides.Left, i, room);
                else
                    AddIf(sides.RightExists | sides.BeyondMask, ref memory, sides.Right, i, room);
            }
        }
    }

    // The least depth that contacts of each patch must have at the end of the step to touch; all do where there is room for all. Returns a bit for each patch
    // of which too few touch to carry anything.
    static int FindLimits(Span<RankedChild> ranked, Span<ChildResult> results, Span<PlacedChildren> placed, in PatchSet patches, int reduces,
        Vector<float> sizes, Span<float> limits)
    {
        var leaning = 0;
        for (int lane = 0; lane < limits.Length; ++lane)
        {
            limits[lane] = float.MinValue;
            if ((reduces & 1 << lane) == 0 || patches[lane].ContactCount <= patches[lane].Share)
                continue;
            var (deepest, approach, touching) = (float.MinValue, 0f, 0);
            foreach (ref var child in ranked)
            {
                ref var manifold = ref results[child.Slot].Manifold;
                for (int i = 0; child.Patch == lane && i < manifold.Count; ++i)
                {
                    deepest = MathHelper.Max(deepest, manifold.GetDepth(i));
                    approach = MathHelper.Max(approach, Approach(results[child.Slot], i, placed[child.Slot].Motion, patches[lane].Normal));
                    touching += manifold.GetDepth(i) >= -Apart * sizes[lane] ? 1 : 0;
                }
            }
            if (touching == patches[lane].ContactCount)
                continue;
            limits[lane] = MathHelper.Min(0, deepest) - Apart * sizes[lane];
            // What is thin is hit exactly, and turned within the step: another of its corners comes down by up to twice the way, and may be through.
            limits[lane] -= MathHelper.Max(0, approach - ThinImpacts.ThinWay * sizes[lane]);
            touching = 0;
            foreach (ref var child in ranked)
            {
                for (int i = 0; child.Patch == lane && i < results[child.Slot].Manifold.Count; ++i)
                    touching += Touches(results[child.Slot], i, placed[child.Slot].Motion, patches[lane].Normal, limits[lane]) ? 1 : 0;
            }
            leaning |= touching > 2 ? 0 : 1 << lane;
        }
        return leaning;
    }

    // Whether a contact is that deep, or is at the end of the step.
    static bool Touches(in ChildResult result, int index, in ChildMotion motion, in Vector3 normal, float limit)
    {
        ref readonly var contact = ref result.Manifold.Read(index);
        if (contact.Depth >= limit)
            return true;
        return contact.Depth + Approach(result, index, motion, normal) >= limit;
    }

    // By how much a contact comes nearer within the step, m.
    static float Approach(in ChildResult result, int index, in ChildMotion motion, in Vector3 normal) =>
        -Exact.Dot(motion.Way + Exact.Cross(motion.Turn, result.Manifold.Read(index).Offset - result.OffsetA), normal);

    // Contacts that do not touch are candidates only of the patches of a mask. Returns a bit for each patch some of whose contacts were left out.
    static int Fill(ref SeamMemory memory, Span<ChildResult> results, Span<PlacedChildren> placed, in PatchSet patches, int reduces,
        ReadOnlySpan<float> limits, int leaning, int greatest, ref Frames frames, BufferPool pool)
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
                var touches = Touches(result, i, placed[child.Slot].Motion, patch.Normal, limits[lane]);
                if (!touches && (leaning & 1 << lane) == 0)
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
                GatherScatter.Get(ref candidate.Depth, lane) = touches ? contact.Depth + (isFirst ? frame.Preference : 0) : Aside;
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
        // The two that are farthest apart of those that touch. What does not is the second where only one does.
        ContactReduction<FaceCandidate>.ChooseFarthest(candidates, count, best, new Vector<float>(Aside), best, out farthest);
        var border = size * new Vector<float>(Border);
        secondExists = ContactReduction<FaceCandidate>.IsFarEnough(farthest, border);
        if (!Vector.EqualsAll(secondExists, Vector<int>.AllBitsSet))
        {
            ContactReduction<FaceCandidate>.ChooseFarthest(candidates, count, best, none, best, out var other);
            farthest.Replace(~secondExists, other);
            farthest.Score = Wide.Select(secondExists, farthest.Score, other.Score);
            secondExists = ContactReduction<FaceCandidate>.IsFarEnough(farthest, border);
        }
        var level = best.Depth - size * new Vector<float>(LevelTolerance);
        ContactReduction<FaceCandidate>.ChooseFarthest(candidates, count, farthest, level, best, out deepest);
        ContactReduction<FaceCandidate>.ChooseSides(candidates, count, none, deepest, farthest, SideLean, secondExists, out sides);
    }

    // Of contacts in a line the deepest need not be an end: what is carried by it and the far end alone tips over it, and is stopped by the end that was left
    // out, which is the deepest then. So an end that touches, or is nearly as deep, takes its place. As a third one the deepest would carry a part of what two
    // do, and lift it; only where it stands out of the line from end to end, over an edge of a mesh, does it bear what they do not.
    [MethodImpl(MethodImplOptions.NoInlining)]
    static void ChooseEnds(FaceCandidate* candidates, int count, Vector<float> size, Vector<int> inLine, in ContactChoice farthest,
        ref ContactChoice deepest, ref ContactSides sides)
    {
        var apart = size * new Vector<float>(Apart);
        var limit = Wide.Min(deepest.Depth - apart, Vector<float>.Zero);
        ContactReduction<FaceCandidate>.ChooseFarthest(candidates, count, farthest, limit, deepest, out var end);
        var fromFar = Distance(farthest, deepest);
        var length = Distance(farthest, end);
        var line = farthest.Depth + (end.Depth - farthest.Depth) * (fromFar / length);
        var standsOut = inLine & Vector.LessThan(fromFar, length) & Vector.GreaterThan(deepest.Depth, line + apart);
        sides.Left.Replace(standsOut, deepest);
        sides.LeftExists |= standsOut;
        deepest.Replace(inLine, end);
    }

    static Vector<float> Distance(in ContactChoice a, in ContactChoice b)
    {
        var x = a.X - b.X;
        var y = a.Y - b.Y;
        return Vector.SquareRoot(x * x + y * y);
    }

    static void AddIf(Vector<int> exists, ref SeamMemory memory, in ContactChoice choice, int lane, int room)
    {
        if (exists[lane] != 0)
            Add(ref memory, choice, lane, room);
    }

    // There is room for the contacts of all patches.
    static void Add(ref SeamMemory memory, in ContactChoice choice, int lane, int room)
    {
        if (memory.Kept.Count < room)
            memory.Kept.AddUnsafely(choice.Name[lane]);
    }
}
