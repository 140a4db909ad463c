using System.Numerics;
using System.Runtime.CompilerServices;
using BepuUtilities;

namespace BepuPhysics.CollisionDetection;

public static partial class DepthSearch<TShapeWideA, TSupportA, TShapeWideB, TSupportB>
{
    /// <summary>Shows that the depth of the lanes that are due is the least of all directions, or finds a better one.</summary>
    [MethodImpl(MethodImplOptions.NoInlining)]
    static void Certify<TStatistics>(in TShapeWideA a, in TShapeWideB b, in SearchFrame frame, Vector<int> dueMask, Vector<int> knownMask,
        ref SearchWalk walk, ref TStatistics statistics)
        where TStatistics : struct, ISearchStatistics
    {
        var certifiedMask = dueMask & FreeTetrahedron.Certifies(walk, frame);
        statistics.TriedTetrahedron(dueMask, certifiedMask);
        var openMask = Vector.AndNot(dueMask, certifiedMask);
        if (openMask == Vector<int>.Zero)
            return;
        if (TSupportA.IsRound || TSupportB.IsRound)
        {
            openMask = Vector.AndNot(openMask, CertifyByRing(a, b, frame, walk, openMask, ref statistics));
            if (openMask == Vector<int>.Zero)
                return;
        }
        // A remembered minimum is left only for a much better one: it must not flicker between two.
        var wanted = Wide.Select(knownMask,
            walk.Depth * new Vector<float>(Hysteresis) - frame.CertificateSlack, walk.Depth - frame.Tolerance);
        var switchedMask = Vector<int>.Zero;
        var seededMask = Vector<int>.Zero;
        for (int lane = 0; lane < Vector<float>.Count; ++lane)
        {
            if (openMask[lane] == 0)
                continue;
            ExpandLane(a, b, frame, lane, wanted[lane], ref walk, ref statistics, ref switchedMask, ref seededMask);
        }
        if (switchedMask != Vector<int>.Zero)
            Walk(a, b, frame, switchedMask, ref seededMask, ref walk, ref statistics);
    }

    /// <summary>Expands a polytope for one lane, and puts the lane's walk where it has found something better than wanted.</summary>
    [MethodImpl(MethodImplOptions.NoInlining)]
    static unsafe void ExpandLane<TStatistics>(in TShapeWideA a, in TShapeWideB b, in SearchFrame frame, int lane, double wanted,
        ref SearchWalk walk, ref TStatistics statistics, ref Vector<int> switchedMask, ref Vector<int> seededMask)
        where TStatistics : struct, ISearchStatistics
    {
        Unsafe.SkipInit(out PolytopeMemory memory);
        var expansion = new DepthExpansion(&memory, frame, walk, lane, wanted);
        Unsafe.SkipInit(out SearchVertex found);
        while (expansion.Next(out var direction))
        {
            SupportLane(a, b, frame, lane, direction, ref found);
            expansion.Add(found, lane, direction);
        }
        statistics.Expanded(lane, expansion.Evaluations, expansion.End);
        if (!expansion.HasSwitched)
            return;
        expansion.Write(ref walk, lane, out var isSeeded);
        GatherScatter.Get(ref switchedMask, lane) = -1;
        GatherScatter.Get(ref seededMask, lane) = isSeeded ? -1 : 0;
    }

    [MethodImpl(MethodImplOptions.NoInlining)]
    static void SupportLane(in TShapeWideA a, in TShapeWideB b, in SearchFrame frame, int lane, in Vector3 direction, ref SearchVertex vertex)
    {
        var doneMask = Vector<int>.AllBitsSet;
        GatherScatter.Get(ref doneMask, lane) = 0;
        Support(a, b, frame, Vector3Wide.Broadcast(direction), doneMask, out vertex);
    }
}
