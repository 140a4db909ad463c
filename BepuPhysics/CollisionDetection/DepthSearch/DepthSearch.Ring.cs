using System.Numerics;
using System.Runtime.CompilerServices;
using BepuUtilities;

namespace BepuPhysics.CollisionDetection;

public static partial class DepthSearch<TShapeWideA, TSupportA, TShapeWideB, TSupportB>
{
    /// <summary>Lanes in which support points around the minimum show that no direction is better by more than the slack.</summary>
    [MethodImpl(MethodImplOptions.NoInlining)]
    static Vector<int> CertifyByRing<TStatistics>(in TShapeWideA a, in TShapeWideB b, in SearchFrame frame, in SearchWalk walk,
        Vector<int> openMask, ref SupportRing ring, ref TStatistics statistics)
        where TStatistics : struct, ISearchStatistics
    {
        openMask = ring.Start(walk, frame, openMask);
        if (openMask == Vector<int>.Zero)
            return openMask;
        var doneMask = Vector.OnesComplement(openMask);
        statistics.EvaluatedRing(openMask, 4);
        Support(a, b, frame, ring.Direction(ring.TangentX), doneMask, out ring.Vertex0);
        Support(a, b, frame, ring.Direction(-ring.TangentX), doneMask, out ring.Vertex2);
        ring.Turn();
        Support(a, b, frame, ring.Direction(ring.TangentY), doneMask, out ring.Vertex1);
        Support(a, b, frame, ring.Direction(-ring.TangentY), doneMask, out ring.Vertex3);
        var topMask = openMask & ring.HasTop();
        if (topMask == Vector<int>.Zero)
            return topMask;
        return topMask & CertifySide(a, b, frame, ring, ring.Vertex0.Point, ring.Vertex1.Point, topMask, ref statistics) &
            CertifySide(a, b, frame, ring, ring.Vertex1.Point, ring.Vertex2.Point, topMask, ref statistics) &
            CertifySide(a, b, frame, ring, ring.Vertex2.Point, ring.Vertex3.Point, topMask, ref statistics) &
            CertifySide(a, b, frame, ring, ring.Vertex3.Point, ring.Vertex0.Point, topMask, ref statistics);
    }

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static Vector<int> CertifySide<TStatistics>(in TShapeWideA a, in TShapeWideB b, in SearchFrame frame, in SupportRing ring,
        in Vector3Wide from, in Vector3Wide to, Vector<int> mask, ref TStatistics statistics)
        where TStatistics : struct, ISearchStatistics
    {
        var shown = ring.IsBeyond(to, from, ring.Bottom) | SupportRing.AreEqual(from, to);
        var openMask = Vector.AndNot(mask, shown);
        if (openMask == Vector<int>.Zero)
            return shown;
        statistics.EvaluatedRing(openMask, 1);
        var normal = Vector3Wide.Cross(from - to, ring.Bottom - to);
        normal *= Wide.DivideOrZero(Vector<float>.One, normal.Length());
        Support(a, b, frame, normal, Vector.OnesComplement(openMask), out var vertex);
        return shown | (ring.IsBeyond(to, from, vertex.Point) & ring.IsBeyond(from, ring.Bottom, vertex.Point) & ring.IsBeyond(ring.Bottom, to, vertex.Point));
    }
}
