using System.Numerics;
using System.Runtime.CompilerServices;

namespace BepuPhysics.CollisionDetection;

public static partial class DepthSearch<TShapeWideA, TSupportA, TShapeWideB, TSupportB>
{
    /// <summary>Lanes in which support points around the minimum show that no direction is less deep than a bound.</summary>
    /// <param name="a">First shapes.</param>
    /// <param name="b">Second shapes.</param>
    /// <param name="frame">Tolerances.</param>
    /// <param name="descent">Where the descent ended.</param>
    /// <param name="bound">Depth that no direction may be below.</param>
    /// <param name="openMask">Lanes to look at.</param>
    /// <param name="ring">The points that were found.</param>
    /// <param name="statistics">Counts.</param>
    [MethodImpl(MethodImplOptions.NoInlining)]
    static Vector<int> CertifyByRing<TStatistics>(in TShapeWideA a, in TShapeWideB b, in SearchFrame frame, in SearchDescent descent,
        Vector<float> bound, Vector<int> openMask, ref SupportRing ring, ref TStatistics statistics)
        where TStatistics : struct, ISearchStatistics
    {
        ring.Start(descent, frame, bound, openMask);
        if (ring.Mask == Vector<int>.Zero)
            return Vector<int>.Zero;
        var doneMask = Vector.OnesComplement(ring.Mask);
        statistics.EvaluatedRing(ring.Mask, SupportRing.VertexCount);
        Support(a, b, frame, ring.Tilt(ring.Along), doneMask, out ring.Vertex0);
        Support(a, b, frame, ring.Tilt(-ring.Along), doneMask, out ring.Vertex2);
        var across = ring.Across(descent.Direction);
        Support(a, b, frame, ring.Tilt(across), doneMask, out ring.Vertex1);
        Support(a, b, frame, ring.Tilt(-across), doneMask, out ring.Vertex3);
        return ring.Certifies();
    }
}
