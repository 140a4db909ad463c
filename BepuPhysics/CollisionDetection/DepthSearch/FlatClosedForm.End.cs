using System.Numerics;
using System.Runtime.CompilerServices;
using BepuUtilities;

namespace BepuPhysics.CollisionDetection;

static partial class FlatClosedForm<TShapeWideF, TSupportF, TShapeWideG, TSupportG>
{
    /// <summary>A face and the end of a cylinder.</summary>
    [MethodImpl(MethodImplOptions.NoInlining)]
    static Vector<int> FindEnd(in TShapeWideF f, in SearchFace face, in Vector3Wide offset, in Vector3Wide axis, Vector<float> along,
        Vector<float> radius, Vector<float> halfLength, Vector<int> mask, ref Vector3Wide direction, ref Vector3Wide onF, ref Vector3Wide onG)
    {
        // Out of the cylinder at the other end.
        var normal = axis * Wide.CopySign(Vector<float>.One, along);
        var slope = face.Place(normal) * (Vector<float>.One / Vector.Abs(along));
        var inverseSlope = Wide.DivideOrZero(Vector<float>.One, slope.Length());
        var middle = offset - normal * halfLength;
        var underMiddle = face.Place(middle);
        var gap = Vector3Wide.Dot(middle, face.Normal) - face.Height;
        var tilt = slope * new Vector<float>(0.5f);
        var isRim = Vector<int>.Zero;
        Vector2Wide place = default;
        for (int i = 0; i < Rounds; ++i)
        {
            // The end's centre, followed to the plane of the face. Without a slope it stands for the place where the rim reaches farthest.
            var center = underMiddle - tilt * gap;
            var far = center + slope * (radius * inverseSlope);
            mask &= TSupportF.IsCylinder
                ? DeepestOverDisc(DiscRadius(f), center, radius, slope, inverseSlope, far, out place, out tilt, out isRim)
                : DeepestOverPolygon(face, center, radius, slope, far, out place, out tilt, out isRim);
        }
        mask &= Vector.LessThan(tilt.LengthSquared(), new Vector<float>(GreatestSquaredTilt));
        if (mask == Vector<int>.Zero)
            return mask;
        direction = Vector3Wide.Select(mask, face.Tilt(tilt), direction);
        // Under the end's lowest point; or from the face to the end's plane, and inside of its rim.
        var uphill = face.Across(slope * inverseSlope);
        uphill -= normal * Vector3Wide.Dot(uphill, normal);
        var lowest = middle + uphill * Wide.DivideOrZero(radius, uphill.Length());
        var underLowest = lowest - face.Normal * (Vector3Wide.Dot(lowest, face.Normal) - face.Height);
        var point = Vector3Wide.Select(isRim, underLowest, face.Normal * face.Height + face.Across(place));
        onF = Vector3Wide.Select(mask, point, onF);
        var other = point + direction * (Vector3Wide.Dot(middle - point, normal) / Vector3Wide.Dot(direction, normal));
        var fromMiddle = other - middle;
        var inward = Wide.Min(Vector<float>.One, radius / fromMiddle.Length());
        onG = Vector3Wide.Select(mask, Vector3Wide.Select(isRim, lowest, middle + fromMiddle * inward), onG);
        return mask;
    }

    /// <summary>The deepest place of the overlap of a disc about the origin and another.</summary>
    /// <param name="radiusF">Radius of the first disc.</param>
    /// <param name="center">Centre of the second.</param>
    /// <param name="radius">Radius of the second.</param>
    /// <param name="slope">How the depth grows over the place.</param>
    /// <param name="inverseSlope">One over the length of that; zero where there is none.</param>
    /// <param name="far">Where the second disc reaches farthest along the slope.</param>
    /// <param name="place">The place.</param>
    /// <param name="tilt">Slope of the direction of least depth.</param>
    /// <param name="isRim">Lanes in which it is where the second disc reaches farthest, inside of the first.</param>
    /// <returns>Lanes in which the discs overlap.</returns>
    // Where one rim reaches farthest, if that is inside of the other; otherwise the corner of the lens that does. There, with the vectors p and q from
    // the centres to the corner, g = s p + t q, and both are positive.
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static Vector<int> DeepestOverDisc(Vector<float> radiusF, in Vector2Wide center, Vector<float> radius, in Vector2Wide slope, Vector<float> inverseSlope,
        in Vector2Wide far, out Vector2Wide place, out Vector2Wide tilt, out Vector<int> isRim)
    {
        var squaredF = radiusF * radiusF;
        var squared = radius * radius;
        var farF = slope * (radiusF * inverseSlope);
        var isFarF = Vector.LessThanOrEqual((farF - center).LengthSquared(), squared);
        isRim = Vector.AndNot(Vector.LessThanOrEqual(far.LengthSquared(), squaredF), isFarF);

        var squaredDistance = center.LengthSquared();
        var inverse = Wide.DivideOrZero(Vector<float>.One, squaredDistance);
        var part = (squaredDistance + squaredF - squared) * (inverse * new Vector<float>(0.5f));
        var squaredHalf = squaredF * inverse - part * part;
        var half = Wide.CopySign(Vector.SquareRoot(squaredHalf), slope.Y * center.X - slope.X * center.Y);
        var corner = new Vector2Wide(center.X * part - center.Y * half, center.Y * part + center.X * half);
        var q = corner - center;
        var inverseArea = Vector<float>.One / (corner.X * q.Y - corner.Y * q.X);
        var s = (slope.X * q.Y - slope.Y * q.X) * inverseArea;
        var t = (corner.X * slope.Y - corner.Y * slope.X) * inverseArea;
        var isCorner = Vector.GreaterThanOrEqual(squaredHalf, Vector<float>.Zero) & Vector.GreaterThanOrEqual(s, Vector<float>.Zero) &
            Vector.GreaterThanOrEqual(t, Vector<float>.Zero);

        place = Vector2Wide.Select(isFarF, farF, Vector2Wide.Select(isRim, far, corner));
        tilt = Vector2Wide.Select(isFarF, slope, Vector2Wide.Select(isRim, default, corner * s));
        return isFarF | isRim | isCorner;
    }

    /// <summary>The deepest place of the overlap of a polygon and a disc; parameters as of <see cref="DeepestOverDisc"/>.</summary>
    // Where the rim reaches farthest, if that is inside of the polygon; the corner that reaches farthest, if it is inside of the rim; otherwise where
    // the rim crosses an edge. With the edge's normal m and the vector q from the centre to the crossing, g = s m + t q, both positive.
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static Vector<int> DeepestOverPolygon(in SearchFace face, in Vector2Wide center, Vector<float> radius, in Vector2Wide slope, in Vector2Wide far,
        out Vector2Wide place, out Vector2Wide tilt, out Vector<int> isRim)
    {
        var zero = Vector<float>.Zero;
        var squared = radius * radius;
        isRim = Vector<int>.AllBitsSet;
        var foundMask = Vector<int>.Zero;
        place = far;
        tilt = new(zero, zero);
        var corner = face.Corner(0);
        var farthest = corner;
        var reach = Vector2Wide.Dot(corner, slope);
        for (int i = 1; i <= TSupportF.FaceVertexCount; ++i)
        {
            var next = face.Corner(i < TSupportF.FaceVertexCount ? i : 0);
            var edge = next - corner;
            var outward = new Vector2Wide(edge.Y, -edge.X);
            isRim &= Vector.LessThanOrEqual(Vector2Wide.Dot(far - corner, outward), zero);
            // All in lengths of the edge.
            var toCenter = center - corner;
            var squaredEdge = edge.LengthSquared();
            var inverse = Vector<float>.One / squaredEdge;
            var inside = -Vector2Wide.Dot(toCenter, outward) * inverse;
            var squaredHalf = squared * inverse - inside * inside;
            var rise = Vector2Wide.Dot(slope, edge);
            var half = Wide.CopySign(Vector.SquareRoot(squaredHalf), rise);
            var start = Vector2Wide.Dot(toCenter, edge) * inverse + half;
            var s = (Vector2Wide.Dot(slope, outward) - rise * inside / half) * inverse;
            var isCrossing = Vector.GreaterThanOrEqual(squaredHalf, zero) & Vector.GreaterThanOrEqual(start, zero) &
                Vector.LessThanOrEqual(start, Vector<float>.One) & Vector.GreaterThanOrEqual(s, zero);
            foundMask |= isCrossing;
            place = Vector2Wide.Select(isCrossing, corner + edge * start, place);
            tilt = Vector2Wide.Select(isCrossing, outward * s, tilt);

            var nextReach = Vector2Wide.Dot(next, slope);
            var isFarther = Vector.GreaterThan(nextReach, reach);
            farthest = Vector2Wide.Select(isFarther, next, farthest);
            reach = Wide.Max(nextReach, reach);
            corner = next;
        }
        var isCorner = Vector.AndNot(Vector.LessThanOrEqual((farthest - center).LengthSquared(), squared), isRim);
        place = Vector2Wide.Select(isRim, far, Vector2Wide.Select(isCorner, farthest, place));
        tilt = Vector2Wide.Select(isCorner, slope, Vector2Wide.Select(isRim, default, tilt));
        return foundMask | isRim | isCorner;
    }
}
