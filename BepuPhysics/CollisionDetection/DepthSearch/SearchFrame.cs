using System.Numerics;
using System.Runtime.CompilerServices;
using BepuUtilities;

namespace BepuPhysics.CollisionDetection;

/// <summary>What stays the same while a bundle of pairs is searched: where B is, the scale of the search, and its tolerances.</summary>
/// <remarks>
/// The Minkowski difference is scaled by a power of two, so that the larger shape's radius is between 1 and 2: products of four lengths
/// neither overflow nor vanish for shapes of any size, no bit is lost, and guards against zero are constants.
/// </remarks>
struct SearchFrame
{
    // Parts of the smaller and of the larger radius by which a found depth may exceed the least one. The second, and the third, which is a
    // part of the distance of the centres, are what rounding leaves.
    const float SmallerTolerance = 2e-5f;
    const float LargerTolerance = 1e-6f;
    const float DistanceTolerance = 5e-7f;
    // Part of the depth itself: normals are right to 1.8 degrees.
    const float DepthTolerance = 5e-4f;
    // Part of the smaller radius by which a deep result may exceed the least of all directions.
    const float CertificateTolerance = 2e-4f;
    // Part of the size of the difference that a support point must gain to be a new one.
    const float SupportRounding = 4e-7f;

    public Vector3Wide OffsetB;
    public Matrix3x3Wide OrientationB;
    /// <summary>Metres to units of the search, a power of two, and back.</summary>
    public Vector<float> Scale, InverseScale;
    /// <summary>Both margins, m.</summary>
    public Vector<float> Margins;
    /// <summary>Depth of the cores below which the pair is not near.</summary>
    public Vector<float> LeastDepth;
    /// <summary>A point of the difference, the radius of a ball about it that lies in the difference.</summary>
    public Vector3Wide Center;
    public Vector<float> Inner;
    /// <summary>Radius of a ball about <see cref="Center"/> that holds the difference, or the distance of the origin if that is more.</summary>
    public Vector<float> Span;
    /// <summary>The smaller radius, scaled.</summary>
    public Vector<float> Smaller;
    /// <summary>How far the search may stop from its target.</summary>
    public Vector<float> Tolerance;
    public Vector<float> CertificateSlack;
    public Vector<float> Rounding;

    // Inlined it would fill a copy.
    [MethodImpl(MethodImplOptions.NoInlining)]
    public static void Create<TShapeWideA, TSupportA, TShapeWideB, TSupportB>(in TShapeWideA a, in TShapeWideB b,
        in Vector3Wide localOffsetB, in Matrix3x3Wide localOrientationB, Vector<float> speculativeMargin, out SearchFrame frame)
        where TShapeWideA : unmanaged where TShapeWideB : unmanaged
        where TSupportA : struct, ISupport<TShapeWideA> where TSupportB : struct, ISupport<TShapeWideB>
    {
        frame.OffsetB = localOffsetB;
        // Row by row: the matrix as a whole would be copied by a call.
        frame.OrientationB.X = localOrientationB.X;
        frame.OrientationB.Y = localOrientationB.Y;
        frame.OrientationB.Z = localOrientationB.Z;
        TSupportA.GetExtents(a, out var centerA, out var innerA, out var outerA);
        TSupportB.GetExtents(b, out var centerB, out var innerB, out var outerB);
        var marginA = TSupportA.Margin(a);
        var marginB = TSupportB.Margin(b);
        var smaller = Wide.Min(outerA + marginA, outerB + marginB);
        var larger = Wide.Max(outerA + marginA, outerB + marginB);
        // The exponent of the reciprocal; zero for what is no shape.
        var exponent = Vector.AsVectorInt32(larger) & new Vector<int>(0xFF << 23);
        frame.Scale = Vector.AsVectorSingle(new Vector<int>(254 << 23) - exponent);
        frame.InverseScale = Vector.AsVectorSingle(exponent);
        frame.Margins = marginA + marginB;
        frame.LeastDepth = (-speculativeMargin - frame.Margins) * frame.Scale;
        var center = centerA - (localOffsetB + Matrix3x3Wide.TransposeTimes(localOrientationB, centerB));
        var distance = center.Length();
        frame.Center = center * frame.Scale;
        frame.Inner = (innerA + innerB) * frame.Scale;
        frame.Span = Wide.Max(outerA + outerB, distance) * frame.Scale;
        frame.Tolerance = frame.Scale * Wide.Max(
            Wide.Max(smaller * new Vector<float>(SmallerTolerance), larger * new Vector<float>(LargerTolerance)),
            distance * new Vector<float>(DistanceTolerance));
        frame.Smaller = smaller * frame.Scale;
        frame.CertificateSlack = Wide.Max(frame.Smaller * new Vector<float>(CertificateTolerance), frame.Tolerance);
        frame.Rounding = frame.Span * new Vector<float>(SupportRounding);
    }

    /// <summary>How far the search may stop from its target at a depth.</summary>
    // A normal may be wrong by the square root of twice the ratio of tolerance and depth. Where shapes hardly touch, the depth would do
    // with less than the normal.
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public readonly Vector<float> ToleranceAt(Vector<float> depth) =>
        Wide.Min(Tolerance, Wide.Max(Vector.Abs(depth) * new Vector<float>(DepthTolerance), Rounding));

    /// <summary>A point of the difference, from a point of A in A's frame and one of B in B's frame.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public readonly Vector3Wide Difference(in Vector3Wide onA, in Vector3Wide onB) =>
        (onA - OffsetB - Matrix3x3Wide.TransposeTimes(OrientationB, onB)) * Scale;

    /// <summary>Age of a pair that has just been certified: 0 to 7, by the last bits of where it is.</summary>
    // Pairs that began in one step would otherwise all be due again in one step.
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public readonly Vector<int> AgeSpread()
    {
        var bits = Vector.AsVectorInt32(OffsetB.X) * new Vector<int>(0x2C1B3C6D) + Vector.AsVectorInt32(OffsetB.Y);
        bits = bits * new Vector<int>(0x297A2D39) + Vector.AsVectorInt32(OffsetB.Z);
        return Vector.ShiftRightLogical(bits * new Vector<int>(0x1B56C4E9), 29);
    }
}
