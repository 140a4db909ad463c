using System;
using System.Numerics;
using System.Runtime.CompilerServices;
using BepuPhysics.Collidables;
using BepuPhysics.Trees;
using BepuUtilities;
using BepuUtilities.Collections;
using BepuUtilities.Memory;

namespace BepuPhysics.CollisionDetection;

/// <summary>A convex part of a body against the children of another one, those first whose boxes it meets first.</summary>
/// <remarks>
/// In the frame of the container the part moves along a line, unless the container turns. Around all places that it gets to by turning
/// there is a box, and only children whose boxes that box meets are tested, up to the first impact that is known.
/// </remarks>
static unsafe class ContainerSweep<TContainer> where TContainer : unmanaged, IContainer
{
    /// <summary>A node or child that is still to be looked at, and when its box is met.</summary>
    struct Pending
    {
        public int Index;
        public float T;
    }

    const int InitialCapacity = 64;
    // Beyond anything that has a place.
    const double Farthest = 1e15;

    /// <summary>Tests a part of A against the container B.</summary>
    /// <param name="motion">How the bodies move.</param>
    /// <param name="part">The part of A.</param>
    /// <param name="partIndex">Its number.</param>
    /// <param name="container">The container.</param>
    /// <param name="filter">Chooses children.</param>
    /// <param name="isFlipped">Whether the filter knows A as B.</param>
    /// <param name="shapes">Shapes that children refer to.</param>
    /// <param name="pool">Source of temporary memory.</param>
    /// <param name="hit">The first impact.</param>
    public static void Test<TFilter>(in SweepMotion motion, ref ImpactBody part, int partIndex, in TContainer container,
        ref TFilter filter, bool isFlipped, Shapes shapes, BufferPool pool, ref SweepHit hit) where TFilter : ISweepFilter
    {
        if (IsInside(motion, part, container))
        {
            hit.Overlap();
            return;
        }
        var stack = new QuickList<Pending>(InitialCapacity, pool);
        var below = default(Buffer<NodeChild>);
        try
        {
            Walk(motion, ref part, partIndex, container, ref filter, isFlipped, shapes, ref stack, ref below, pool, ref hit);
        }
        finally
        {
            stack.Dispose(pool);
            if (below.Allocated)
                pool.Return(ref below);
        }
    }

    static void Walk<TFilter>(in SweepMotion motion, ref ImpactBody part, int partIndex, in TContainer container,
        ref TFilter filter, bool isFlipped, Shapes shapes, ref QuickList<Pending> stack, ref Buffer<NodeChild> below, BufferPool pool,
        ref SweepHit hit)
        where TFilter : ISweepFilter
    {
        var count = ContainerPlaces.Open(container, 0, shapes, ref below, pool);
        var slabs = CreateSlabs(motion, part, below, count);
        var scratch = stackalloc Vector4[IContainer.ScratchByteCount / 16];
        Push(slabs, below, count, motion, hit, ref stack, pool);
        while (stack.Count > 0 && !hit.Overlaps)
        {
            var pending = stack.Pop();
            if (pending.T > hit.LatestT(motion))
                continue;
            if (pending.Index >= 0)
            {
                count = ContainerPlaces.Open(container, pending.Index, shapes, ref below, pool);
                Push(slabs, below, count, motion, hit, ref stack, pool);
                continue;
            }
            var index = ~pending.Index;
            if (!(isFlipped ? filter.AllowTest(index, partIndex) : filter.AllowTest(partIndex, index)))
                continue;
            container.GetChild(index, shapes, (byte*)scratch, out var child);
            if (!ImpactCore.Exists(child.TypeId))
                continue;
            var core = ImpactCore.Of(child.TypeId, child.Shape);
            part.Restart();
            if (!motion.BallsMeet(part, core, child.Pose.Position, hit.LatestT(motion)))
                continue;
            var body = new ImpactBody(core, child.Pose, motion.OrientationB, motion.AngularB);
            hit.Test(motion, ref part, ref body, partIndex, index);
        }
    }

    // The nearest last, so that it is taken first.
    static void Push(in SlabTest slabs, Buffer<NodeChild> below, int count, in SweepMotion motion, in SweepHit hit,
        ref QuickList<Pending> stack, BufferPool pool)
    {
        var maximumT = (float)Math.Min(hit.LatestT(motion), float.MaxValue);
        var first = stack.Count;
        stack.EnsureCapacity(first + count, pool);
        for (int i = 0; i < count; ++i)
        {
            if (!slabs.Meets(below.Memory + i, maximumT, out var t))
                continue;
            var place = stack.Count++;
            for (; place > first && stack[place - 1].T < t; --place)
                stack[place] = stack[place - 1];
            stack[place] = new() { Index = below[i].Index, T = t };
        }
    }

    // The place of the part in the container's frame, and its way there. Where the container turns there is no such way, and everything
    // is met at once.
    static SlabTest CreateSlabs(in SweepMotion motion, in ImpactBody part, Buffer<NodeChild> below, int count)
    {
        if (motion.AngularB.X != 0 || motion.AngularB.Y != 0 || motion.AngularB.Z != 0 || part.Core.IsPlane)
            return new SlabTest(new((float)-Farthest), new((float)Farthest), default);
        var farthest = Vector3.Zero;
        for (int i = 0; i < count; ++i)
            farthest = Exact.Max(farthest, Exact.Max(Vector3.Abs(below[i].Min), Vector3.Abs(below[i].Max)));
        var relative = motion.LinearA - motion.LinearB;
        part.GetBounds(motion.OrientationB, motion.MaximumT, out var min, out var max);
        var place = motion.OrientationB.TurnBack(-motion.OffsetB);
        var pad = SweepBounds.Pad(part, motion, place.Length + Exact.Length(farthest), relative.Length);
        return new SlabTest(
            SweepBounds.Lower(place + min, pad), SweepBounds.Upper(place + max, pad), motion.OrientationB.TurnBack(relative).ToSingle());
    }

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static bool IsInside(in SweepMotion motion, in ImpactBody part, in TContainer container) =>
        TContainer.MayBeSolid && container.IsSolid && !part.Core.IsPlane &&
        container.FindWayOut(motion.OrientationB.TurnBack(part.Arm - motion.OffsetB).ToSingle(), out _);
}
