using System.Numerics;
using System.Runtime.CompilerServices;
using BepuUtilities;

namespace BepuPhysics.CollisionDetection;

public static partial class DepthSearch<TShapeWideA, TSupportA, TShapeWideB, TSupportB>
{
    // Points of circles whose angles differ by less than 60 degrees are one that has moved.
    const float NearCosine = 0.5f;
    // The least curvature, in units of the search, that a spread is measured by.
    const float LeastCurvature = 1e-3f;
    // Angle around a circle, rad, by which a point is moved at most: with a square root's first two terms it stays on the circle to rounding.
    const float GreatestSpread = 0.02f;

    static bool IsRound
    {
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        get => TSupportA.IsRound || TSupportB.IsRound;
    }

    static bool IsBothRound
    {
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        get => TSupportA.IsRound && TSupportB.IsRound;
    }

    /// <summary>Finds the curvature at a new farthest point, and takes the simplex there along circles.</summary>
    /// <param name="frame">Where B is, and scale.</param>
    /// <param name="farthest">The farthest point.</param>
    /// <param name="direction">In which it is that.</param>
    /// <param name="mask">Lanes to change.</param>
    /// <param name="count">Number of vertices that may differ, in the order of the simplex; the others are as the last of them.</param>
    /// <param name="curvature">Curvature.</param>
    /// <param name="simplex">Simplex; what it holds then are points of the shapes, too.</param>
    // Points of one circle, or of the circles at both ends of a cylinder, are then those of one direction: what is left between vertices is what is
    // straight, and across it the simplex shows the way.
    [MethodImpl(MethodImplOptions.NoInlining)]
    static void Follow(in SearchFrame frame, in SearchVertex farthest, in Vector3Wide direction, Vector<int> mask, int count,
        ref SearchCurvature curvature, ref SearchSimplex simplex)
    {
        Vector3Wide radialA = default, radialB = default, tangentA = default, tangentB = default;
        Vector<float> squaredA = default, squaredB = default, weightA = default, weightB = default;
        if (TSupportA.IsRound)
        {
            radialA = TSupportA.Radial(farthest.OnA);
            squaredA = radialA.LengthSquared();
            tangentA = TSupportA.Tangent(radialA);
            weightA = SearchCurvature.FindWeight(radialA, squaredA, direction, frame.Scale);
        }
        if (TSupportB.IsRound)
        {
            radialB = TSupportB.Radial(farthest.OnB);
            squaredB = radialB.LengthSquared();
            tangentB = Matrix3x3Wide.TransposeTimes(frame.OrientationB, TSupportB.Tangent(radialB));
            weightB = -SearchCurvature.FindWeight(Matrix3x3Wide.TransposeTimes(frame.OrientationB, radialB), squaredB, direction, frame.Scale);
        }
        if (TSupportA.IsRound && TSupportB.IsRound)
        {
            curvature.Tangent = Vector3Wide.Select(mask, tangentA, curvature.Tangent);
            curvature.OtherTangent = Vector3Wide.Select(mask, tangentB, curvature.OtherTangent);
            curvature.Weight = Wide.Select(mask, weightA, curvature.Weight);
            curvature.OtherWeight = Wide.Select(mask, weightB, curvature.OtherWeight);
            var triple = Vector3Wide.Dot(Vector3Wide.Cross(tangentA, tangentB), direction);
            curvature.Sum = Wide.Select(mask, weightA * squaredA + weightB * squaredB, curvature.Sum);
            curvature.Product = Wide.Select(mask, weightA * weightB * (triple * triple), curvature.Product);
        }
        else
        {
            curvature.Tangent = Vector3Wide.Select(mask, TSupportA.IsRound ? tangentA : tangentB, curvature.Tangent);
            curvature.Weight = Wide.Select(mask, TSupportA.IsRound ? weightA : weightB, curvature.Weight);
            curvature.Sum = Wide.Select(mask, TSupportA.IsRound ? weightA * squaredA : weightB * squaredB, curvature.Sum);
            curvature.Product = Vector<float>.Zero;
        }
        if (count == 0 || (mask & Vector.GreaterThan(weightA + weightB, Vector<float>.Zero)) == Vector<int>.Zero)
            return;
        var half = new Vector<float>(NearCosine);
        var nearA = Wide.Select(mask & Vector.GreaterThan(weightA, Vector<float>.Zero), squaredA * half, new Vector<float>(float.MaxValue));
        var nearB = Wide.Select(mask & Vector.GreaterThan(weightB, Vector<float>.Zero), squaredB * half, new Vector<float>(float.MaxValue));
        Follow(frame, radialA, radialB, nearA, nearB, mask, ref simplex.A);
        // Lanes that are done keep what they have.
        var keepMask = Vector.OnesComplement(mask);
        if (count > 1)
            Follow(frame, radialA, radialB, nearA, nearB, mask, ref simplex.B);
        else
            simplex.B.Keep(keepMask, simplex.A);
        if (count > 2)
            Follow(frame, radialA, radialB, nearA, nearB, mask, ref simplex.C);
        else
            simplex.C.Keep(keepMask, simplex.B);
    }

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static void Follow(in SearchFrame frame, in Vector3Wide radialA, in Vector3Wide radialB, Vector<float> nearA, Vector<float> nearB,
        Vector<int> mask, ref SearchVertex vertex)
    {
        if (TSupportA.IsRound)
        {
            var isNear = Vector.GreaterThan(Vector3Wide.Dot(radialA, vertex.OnA), nearA);
            vertex.OnA = Vector3Wide.Select(isNear, TSupportA.Follow(vertex.OnA, radialA), vertex.OnA);
        }
        if (TSupportB.IsRound)
        {
            var isNear = Vector.GreaterThan(Vector3Wide.Dot(radialB, vertex.OnB), nearB);
            vertex.OnB = Vector3Wide.Select(isNear, TSupportB.Follow(vertex.OnB, radialB), vertex.OnB);
        }
        vertex.Point = Vector3Wide.Select(mask, frame.Difference(vertex.OnA, vertex.OnB), vertex.Point);
    }

    /// <summary>
    /// Makes a triangle again of simplices that have shrunk to a point or an edge: with points on either side, as far away as the tolerance
    /// allows. The next step then finds itself done as long as the minimum is in between.
    /// </summary>
    [MethodImpl(MethodImplOptions.NoInlining)]
    static void Spread(in SearchFrame frame, Vector<int> mask, ref SearchDescent descent)
    {
        ref var simplex = ref descent.Simplex;
        var sameAB = SearchVertex.AreOne(simplex.A.Point, simplex.B.Point);
        var sameBC = SearchVertex.AreOne(simplex.B.Point, simplex.C.Point);
        var sameCA = SearchVertex.AreOne(simplex.C.Point, simplex.A.Point);
        mask &= (sameAB | sameBC | sameCA) & Vector.GreaterThan(descent.Curvature.Sum, Vector<float>.Zero);
        if (mask == Vector<int>.Zero)
            return;
        ref readonly var curvature = ref descent.Curvature;
        var pointMask = sameAB & sameBC;
        var across = Vector3Wide.Cross(Vector3Wide.Select(sameAB, simplex.C.Point, simplex.B.Point) - simplex.A.Point, descent.Direction);
        across = Vector3Wide.Select(pointMask, curvature.AnyTangent(IsBothRound), across);
        var squaredAcross = across.LengthSquared();
        mask &= Vector.GreaterThan(squaredAcross, new Vector<float>(SearchTolerances.SquaredSamePoint));
        var first = across * (Vector<float>.One / Vector.SquareRoot(squaredAcross));
        var second = Vector3Wide.Cross(descent.Direction, first);
        var tolerance = frame.ToleranceAt(descent.Depth);
        var least = new Vector<float>(LeastCurvature);
        first *= Vector.SquareRoot(tolerance / Wide.Max(curvature.Along(first, IsBothRound), least));
        second *= Wide.Mask(pointMask, Vector.SquareRoot(tolerance / Wide.Max(curvature.Along(second, IsBothRound), least)));
        // Of an edge the two vertices that are one go to either side, of a point the three go all around.
        var one = Vector<float>.One;
        var back = Wide.Select(pointMask, new Vector<float>(-0.5f), -one);
        Rotate(frame, curvature, first * Wide.Mask(sameAB | sameCA, one), mask, ref simplex.A);
        Rotate(frame, curvature, first * Wide.Select(sameAB, back, Wide.Mask(sameBC, one)) + second, mask, ref simplex.B);
        Rotate(frame, curvature, first * Wide.Mask(sameBC | sameCA, back) - second, mask, ref simplex.C);
    }

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static void Rotate(in SearchFrame frame, in SearchCurvature curvature, in Vector3Wide rotation, Vector<int> mask, ref SearchVertex vertex)
    {
        if (TSupportA.IsRound)
        {
            var angle = curvature.Weight * frame.InverseScale * Vector3Wide.Dot(curvature.Tangent, rotation);
            vertex.OnA = Vector3Wide.Select(mask, Rotate<TShapeWideA, TSupportA>(vertex.OnA, angle), vertex.OnA);
        }
        if (TSupportB.IsRound)
        {
            var weight = IsBothRound ? curvature.OtherWeight : curvature.Weight;
            var angle = weight * frame.InverseScale * -Vector3Wide.Dot(IsBothRound ? curvature.OtherTangent : curvature.Tangent, rotation);
            vertex.OnB = Vector3Wide.Select(mask, Rotate<TShapeWideB, TSupportB>(vertex.OnB, angle), vertex.OnB);
        }
        vertex.Point = Vector3Wide.Select(mask, frame.Difference(vertex.OnA, vertex.OnB), vertex.Point);
    }

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static Vector3Wide Rotate<TShapeWide, TSupport>(in Vector3Wide point, Vector<float> angle)
        where TShapeWide : unmanaged where TSupport : struct, ISupport<TShapeWide>
    {
        var greatest = new Vector<float>(GreatestSpread);
        angle = Wide.Clamp(angle, -greatest, greatest);
        var radial = TSupport.Radial(point);
        return point + (TSupport.Tangent(radial) * angle - radial * (angle * angle * new Vector<float>(0.5f)));
    }
}
