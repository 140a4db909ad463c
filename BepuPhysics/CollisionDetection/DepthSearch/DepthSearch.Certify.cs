using System.Numerics;
using System.Runtime.CompilerServices;
using BepuUtilities;

namespace BepuPhysics.CollisionDetection;

public static partial class DepthSearch<TShapeWideA, TSupportA, TShapeWideB, TSupportB>
{
    /// <summary>Shows that the depth of the lanes that are due is the least of all directions, or finds a better one.</summary>
    [MethodImpl(MethodImplOptions.NoInlining)]
    static void Certify<TStatistics>(in TShapeWideA a, in TShapeWideB b, in SearchFrame frame, Vector<int> dueMask, Vector<int> knownMask,
        ref SearchDescent descent, ref TStatistics statistics)
        where TStatistics : struct, ISearchStatistics
    {
        // A remembered minimum is left only for a much better one: it must not flicker between two. So that is all there is to show, too.
        var least = Wide.Select(knownMask, descent.Depth * new Vector<float>(Hysteresis), descent.Depth) - frame.CertificateSlack;
        var wanted = Wide.Select(knownMask, least, descent.Depth - frame.Tolerance);
        var bound = Wide.Max(least, Vector<float>.Zero);
        var certifiedMask = dueMask & FreeTetrahedron.Certifies(descent, frame, bound);
        statistics.TriedTetrahedron(dueMask, certifiedMask);
        var openMask = Vector.AndNot(dueMask, certifiedMask);
        if (openMask == Vector<int>.Zero)
            return;
        Unsafe.SkipInit(out SupportRing ring);
        ring.Mask = Vector<int>.Zero;
        if (TSupportA.IsRound || TSupportB.IsRound)
        {
            openMask = Vector.AndNot(openMask, CertifyByRing(a, b, frame, descent, bound, openMask, ref ring, ref statistics));
            if (openMask == Vector<int>.Zero)
                return;
        }
        var switchedMask = Vector<int>.Zero;
        var seededMask = Vector<int>.Zero;
        for (int lane = 0; lane < Vector<float>.Count; ++lane)
        {
            if (openMask[lane] == 0)
                continue;
            ExpandLane(a, b, frame, ring, lane, wanted[lane], ref descent, ref statistics, ref switchedMask, ref seededMask);
        }
        if (switchedMask != Vector<int>.Zero)
            Descend(a, b, frame, switchedMask, ref seededMask, ref descent, ref statistics);
    }

    /// <summary>Expands a polytope for one lane, and puts the lane's descent where it has found something better than wanted.</summary>
    [MethodImpl(MethodImplOptions.NoInlining)]
    static unsafe void ExpandLane<TStatistics>(in TShapeWideA a, in TShapeWideB b, in SearchFrame frame, in SupportRing ring,
        int lane, double wanted, ref SearchDescent descent, ref TStatistics statistics, ref Vector<int> switchedMask, ref Vector<int> seededMask)
        where TStatistics : struct, ISearchStatistics
    {
        Unsafe.SkipInit(out PolytopeMemory memory);
        var expansion = new DepthExpansion(&memory, frame, descent, lane, wanted);
        if (ring.Mask[lane] != 0)
        {
            expansion.Offer(ring.Vertex0, lane);
            expansion.Offer(ring.Vertex1, lane);
            expansion.Offer(ring.Vertex2, lane);
            expansion.Offer(ring.Vertex3, lane);
        }
        Unsafe.SkipInit(out SearchVertex found);
        while (expansion.Next(out var direction))
        {
            SupportLane(a, b, frame, lane, direction, ref found);
            expansion.Add(found, lane, direction);
        }
        if (expansion.End == ExpansionEnd.Limit && (TSupportA.IsRound || TSupportB.IsRound))
            ExpandShrunk(a, b, frame, lane, ref expansion);
        statistics.Expanded(lane, expansion.Evaluations, expansion.End);
        if (!expansion.HasSwitched)
            return;
        expansion.Write(ref descent, lane, out var isSeeded);
        GatherScatter.Get(ref switchedMask, lane) = -1;
        GatherScatter.Get(ref seededMask, lane) = isSeeded ? -1 : 0;
    }

    /// <summary>
    /// Goes on where the polytope was full: with the difference of smaller cores, to which a radius is added. Around it directions are less
    /// alike.
    /// </summary>
    // First the one shape smaller, then the other, then both, as far as they can be.
    [MethodImpl(MethodImplOptions.NoInlining)]
    static void ExpandShrunk(in TShapeWideA a, in TShapeWideB b, in SearchFrame frame, int lane, ref DepthExpansion expansion)
    {
        TSupportA.GetExtents(a, out _, out _, out var outerA);
        TSupportB.GetExtents(b, out _, out _, out var outerB);
        var distance = frame.Center.Length() * frame.InverseScale;
        for (int choice = 1; choice < 4 && expansion.End == ExpansionEnd.Limit; ++choice)
        {
            var (coreA, coreB) = (a, b);
            var radiusA = Vector<float>.Zero;
            var radiusB = Vector<float>.Zero;
            if (choice != 2)
                radiusA = TSupportA.Shrink(ref coreA, choice == 1 ? outerB + distance : Vector<float>.Zero);
            if (choice != 1)
                radiusB = TSupportB.Shrink(ref coreB, choice == 2 ? outerA + distance : Vector<float>.Zero);
            if ((choice != 2 && radiusA[lane] == 0) || (choice != 1 && radiusB[lane] == 0))
                continue;
            TSupportA.GetExtents(coreA, out _, out _, out var outerCoreA);
            TSupportB.GetExtents(coreB, out _, out _, out var outerCoreB);
            expansion.Restart(Wide.Max(outerCoreA + outerCoreB, distance)[lane] * (double)frame.Scale[lane],
                (radiusA[lane] + (double)radiusB[lane]) * frame.Scale[lane]);
            Unsafe.SkipInit(out SearchVertex foundOfCores);
            Unsafe.SkipInit(out SearchVertex found);
            while (expansion.Next(out var direction))
            {
                SupportLane(coreA, coreB, frame, lane, direction, ref foundOfCores);
                SupportLane(a, b, frame, lane, direction, ref found);
                expansion.Add(foundOfCores, found, lane, direction);
            }
        }
    }

    [MethodImpl(MethodImplOptions.NoInlining)]
    static void SupportLane(in TShapeWideA a, in TShapeWideB b, in SearchFrame frame, int lane, in Vector3 direction, ref SearchVertex vertex)
    {
        var doneMask = Vector<int>.AllBitsSet;
        GatherScatter.Get(ref doneMask, lane) = 0;
        Support(a, b, frame, Vector3Wide.Broadcast(direction), doneMask, out vertex);
    }
}
