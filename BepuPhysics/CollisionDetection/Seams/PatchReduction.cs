using System;
using System.Numerics;
using System.Runtime.CompilerServices;
using BepuPhysics.Constraints.Contact;
using BepuUtilities;
using BepuUtilities.Memory;

namespace BepuPhysics.CollisionDetection;

/// <summary>The choice of the contacts of patches that have more, or that several children share: a lane for each, of one pair or of many.</summary>
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
        public Vector3Wide X, Y;
        public Vector<float> Size;
    }

    /// <summary>Chooses the contacts of all patches of <see cref="SeamMemory.Reduced"/>.</summary>
    /// <param name="memory">The patches, and room for candidates.</param>
    /// <param name="ranked">Their children, in their order.</param>
    /// <param name="pool">Source of memory.</param>
    public static void Run(ref SeamMemory memory, RankedChild* ranked, BufferPool pool)
    {
        var all = memory.Reduced.AsSpan();
        for (int start = 0; start < all.Length; start += Vector<float>.Count)
            Reduce(ref memory, all.Slice(start, Math.Min(Vector<float>.Count, all.Length - start)), ranked, pool);
    }

    static void Reduce(ref SeamMemory memory, Span<ReducedPatch> patches, RankedChild* ranked, BufferPool pool)
    {
        var greatest = 0;
        var normals = Vector3Wide.Zero;
        Frames frames = default;
        for (int lane = 0; lane < patches.Length; ++lane)
        {
            greatest = Math.Max(greatest, patches[lane].Patch.ContactCount);
            Lanes.Write(patches[lane].Patch.Normal, ref normals, lane);
            GatherScatter.Get(ref frames.Size, lane) = patches[lane].Placed[patches[lane].Patch.Slot].InnerRadius();
        }
        Vector3Wide.BuildOrthonormalBasis(normals, out frames.X, out frames.Y);
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
        var first = candidates.Span.Memory;
        var left = 0;
        for (int lane = 0; lane < patches.Length; ++lane)
        {
            ref var patch = ref patches[lane];
            Gather(ref memory, patch, ranked, frames, lane, pool);
            FindLimit(memory.Contacts.AsSpan(), ref patch, frames.Size[lane]);
            left |= Fill(memory.Contacts.AsSpan(), patch, frames.Size[lane], first, lane) ? 1 << lane : 0;
        }
        Choose(first, greatest, frames.Size, out var deepest, out var farthest, out var sides, out var secondExists);
        // What is carried by those that touch does not need the others. In place of one that touches it would be carried by fewer, and rock.
        var inLine = ~(sides.LeftExists | sides.RightExists);
        left &= (int)Wide.Bits(inLine);
        if (left != 0)
        {
            for (int lanes = left; lanes != 0; lanes &= lanes - 1)
            {
                var lane = BitOperations.TrailingZeroCount(lanes);
                patches[lane].IsLeaning = true;
                Gather(ref memory, patches[lane], ranked, frames, lane, pool);
                Fill(memory.Contacts.AsSpan(), patches[lane], frames.Size[lane], first, lane);
            }
            Choose(first, greatest, frames.Size, out deepest, out farthest, out sides, out secondExists);
        }
        inLine &= secondExists;
        if (inLine != Vector<int>.Zero)
            ChooseEnds(first, greatest, frames.Size, inLine, farthest, ref deepest, ref sides);
        for (int lane = 0; lane < patches.Length; ++lane)
        {
            ref var patch = ref patches[lane];
            patch.Add(deepest.Name[lane]);
            if (secondExists[lane] != 0)
                patch.Add(farthest.Name[lane]);
            // The larger side first: there may be room for one.
            for (int side = 0; side < 2; ++side)
            {
                if ((sides.TipIsLeft[lane] != 0) == (side == 0))
                    AddIf(sides.LeftExists | sides.BeyondMask, ref patch, sides.Left, lane);
                else
                    AddIf(sides.RightExists | sides.BeyondMask, ref patch, sides.Right, lane);
            }
            var turn = Exact.Dot(patch.Placed[patch.Patch.Slot].Motion.Turn, patch.Patch.Normal);
            patch.Lever = MathF.Abs(turn) < PatchLever.LeastTurn
                ? FaceLever.OfOneFace
                : PatchLever.Find(candidates.AsSpan(), patch, lane);
        }
    }

    // What of the contacts of a patch is asked for, in the order of its children.
    static void Gather(ref SeamMemory memory, in ReducedPatch reduced, RankedChild* ranked, in Frames frames, int lane, BufferPool pool)
    {
        ref readonly var patch = ref reduced.Patch;
        ref var contacts = ref memory.Contacts;
        contacts.Count = 0;
        contacts.EnsureCapacity(patch.ContactCount, pool);
        var (frameX, frameY) = (Read(frames.X, lane), Read(frames.Y, lane));
        var origin = reduced.Results[patch.Slot].Manifold.Contact0.Offset;
        for (int child = 0; child < reduced.ChildCount; ++child)
        {
            ref var rank = ref ranked[reduced.FirstChild + child];
            if (rank.Patch != reduced.Number)
                continue;
            ref var result = ref reduced.Results[rank.Slot];
            ref readonly var motion = ref reduced.Placed[rank.Slot].Motion;
            for (int i = 0; i < result.Manifold.Count; ++i)
            {
                ref var contact = ref ConvexContactManifold.GetConvexContactReference(ref result.Manifold, i);
                var place = contact.Offset - origin;
                // Of a patch of several pairs it is known of each contact.
                var isFirst = (rank.Remembered & 1 << i) != 0;
                var isRemembered = isFirst;
                if (patch.IsKnown)
                {
                    var feature = result.Children.Mix(contact.FeatureId);
                    isFirst |= feature == patch.Memory.First;
                    isRemembered = isFirst || feature == patch.Memory.Second;
                }
                ref var added = ref contacts.AllocateUnsafely();
                added.X = Exact.Dot(place, frameX);
                added.Y = Exact.Dot(place, frameY);
                added.Depth = contact.Depth;
                // By how much it comes nearer within the step, m.
                added.Approach = -Exact.Dot(motion.Way + Exact.Cross(motion.Turn, contact.Offset - result.OffsetA), patch.Normal);
                added.Name = rank.Slot * ConvexContactManifold.MaximumContactCount + i;
                added.Weight = isRemembered ? SpanPreference : 1;
                added.IsFirst = isFirst;
            }
        }
    }

    static Vector3 Read(in Vector3Wide wide, int lane) => Lanes.Read<Vector3, Vector3Wide>(ref Unsafe.AsRef(in wide), lane);

    // The least depth that contacts of a patch must have at the end of the step to touch; all do where there is room for all. Where too few touch to carry
    // anything, the patch leans.
    static void FindLimit(ReadOnlySpan<ReducedContact> contacts, ref ReducedPatch reduced, float size)
    {
        reduced.Limit = float.MinValue;
        reduced.IsLeaning = false;
        if (reduced.Patch.ContactCount <= reduced.Patch.Share)
            return;
        var (deepest, approach, touching) = (float.MinValue, 0f, 0);
        foreach (ref readonly var contact in contacts)
        {
            deepest = MathHelper.Max(deepest, contact.Depth);
            approach = MathHelper.Max(approach, contact.Approach);
            touching += contact.Depth >= -Apart * size ? 1 : 0;
        }
        if (touching == reduced.Patch.ContactCount)
            return;
        reduced.Limit = MathHelper.Min(0, deepest) - Apart * size;
        // What is thin is hit exactly, and turned within the step: another of its corners comes down by up to twice the way, and may be through.
        reduced.Limit -= MathHelper.Max(0, approach - ThinImpacts.ThinWay * size);
        touching = 0;
        foreach (ref readonly var contact in contacts)
            touching += Touches(contact, reduced.Limit) ? 1 : 0;
        reduced.IsLeaning = touching <= 2;
    }

    // Whether a contact is that deep, or is at the end of the step.
    static bool Touches(in ReducedContact contact, float limit) => contact.Depth >= limit || contact.Depth + contact.Approach >= limit;

    // Contacts that do not touch are candidates only where a patch leans. Returns whether some were left out.
    static bool Fill(ReadOnlySpan<ReducedContact> contacts, in ReducedPatch reduced, float size, FaceCandidate* candidates, int lane)
    {
        var preference = size * DepthPreference;
        var left = false;
        foreach (ref readonly var contact in contacts)
        {
            var touches = Touches(contact, reduced.Limit);
            if (!touches && !reduced.IsLeaning)
            {
                left = true;
                continue;
            }
            ref var candidate = ref *candidates++;
            GatherScatter.Get(ref candidate.X, lane) = contact.X;
            GatherScatter.Get(ref candidate.Y, lane) = contact.Y;
            GatherScatter.Get(ref candidate.Depth, lane) = touches ? contact.Depth + (contact.IsFirst ? preference : 0) : Aside;
            GatherScatter.Get(ref candidate.Weight, lane) = contact.Weight;
            GatherScatter.Get(ref candidate.Name, lane) = contact.Name;
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

    static void AddIf(Vector<int> exists, ref ReducedPatch patch, in ContactChoice choice, int lane)
    {
        if (exists[lane] != 0)
            patch.Add(choice.Name[lane]);
    }
}
