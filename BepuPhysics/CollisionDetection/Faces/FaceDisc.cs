using System;
using System.Numerics;
using System.Runtime.CompilerServices;
using BepuUtilities;

namespace BepuPhysics.CollisionDetection;

/// <summary>A disc seen along the normal: where a place is in it, in units of its radius.</summary>
/// <remarks>
/// Corners of the overlap need names that stay the same while a disc rests, so those that are its own are sixteen points of its rim, which turn
/// with the shape. What is cut off of the other feature is cut off at the rim itself: one quadratic equation where a polygon has sixteen lines.
/// </remarks>
struct FaceDisc
{
    /// <summary>Number of corners.</summary>
    public const int CornerCount = 16;
    // In radii: an edge that is shorter is a point.
    const float LeastSquaredEdge = 1e-12f;

    Vector<float> xx, xy, x0, zx, zy, z0, inverseRadius;

    // Sines of 22.5 degrees times 0 to 20; the cosines start at the fourth.
    static ReadOnlySpan<float> Sines =>
    [
        0, 0.38268343f, 0.70710678f, 0.92387953f, 1, 0.92387953f, 0.70710678f, 0.38268343f,
        0, -0.38268343f, -0.70710678f, -0.92387953f, -1, -0.92387953f, -0.70710678f, -0.38268343f,
        0, 0.38268343f, 0.70710678f, 0.92387953f, 1,
    ];

    /// <summary>Sine of the angle of a corner, from the Z axis towards the X axis; that of the first also follows the last.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static float Sine(int corner) => Sines[corner];

    /// <summary>Cosine of the angle of a corner.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static float Cosine(int corner) => Sines[corner + CornerCount / 4];

    /// <summary>Builds from the plane of a disc.</summary>
    /// <param name="frame">Frame of the view, in the shape's coordinates, whose Y axis goes through the centre.</param>
    /// <param name="polygon">Height of the plane over the view.</param>
    /// <param name="radius">Radius, m.</param>
    // A place (x, y) of the view is the point O + X x + Y y + N h of the plane, whose height h is linear in x and y.
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public FaceDisc(in FaceFrame frame, in FacePolygon polygon, Vector<float> radius)
    {
        inverseRadius = Vector<float>.One / radius;
        xx = (frame.X.X + frame.Outwards.X * polygon.SlopeX) * inverseRadius;
        xy = (frame.Y.X + frame.Outwards.X * polygon.SlopeY) * inverseRadius;
        x0 = (frame.Origin.X + frame.Outwards.X * polygon.SlopeHeight) * inverseRadius;
        zx = (frame.X.Z + frame.Outwards.Z * polygon.SlopeX) * inverseRadius;
        zy = (frame.Y.Z + frame.Outwards.Z * polygon.SlopeY) * inverseRadius;
        z0 = (frame.Origin.Z + frame.Outwards.Z * polygon.SlopeHeight) * inverseRadius;
    }

    /// <summary>Whether a place is inside of the rim by a distance, m.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public readonly Vector<int> Holds(Vector<float> x, Vector<float> y, Vector<float> inset)
    {
        var placeX = xx * x + xy * y + x0;
        var placeZ = zx * x + zy * y + z0;
        var reach = Vector<float>.One - inset * inverseRadius;
        return Vector.LessThan(placeX * placeX + placeZ * placeZ, reach * reach);
    }

    /// <summary>Cuts an interval of a line to what is inside of the rim.</summary>
    /// <param name="x">Origin of the line.</param>
    /// <param name="y">Origin of the line.</param>
    /// <param name="alongX">From the origin to where the line is at 1.</param>
    /// <param name="alongY">From the origin to where the line is at 1.</param>
    /// <param name="border">What is outside of the rim by less counts as inside, m.</param>
    /// <param name="start">Start of the interval.</param>
    /// <param name="end">End of the interval; before the start where nothing is left.</param>
    // Finite whatever a lane holds: a corner that does not exist must not be out of all bounds.
    // From the foot of the centre on the line, not from its origin: of a long line that is far away, and a small difference of large squares would
    // be left.
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public readonly void Clip(Vector<float> x, Vector<float> y, Vector<float> alongX, Vector<float> alongY, Vector<float> border,
        ref Vector<float> start, ref Vector<float> end)
    {
        var placeX = xx * x + xy * y + x0;
        var placeZ = zx * x + zy * y + z0;
        var speedX = xx * alongX + xy * alongY;
        var speedZ = zx * alongX + zy * alongY;
        var squaredSpeed = speedX * speedX + speedZ * speedZ;
        var inverse = Wide.Mask(Vector.GreaterThan(squaredSpeed, new Vector<float>(LeastSquaredEdge)), Vector<float>.One / squaredSpeed);
        var foot = -(placeX * speedX + placeZ * speedZ) * inverse;
        var footX = placeX + speedX * foot;
        var footZ = placeZ + speedZ * foot;
        var reach = Vector<float>.One + border * inverseRadius;
        var gap = reach * reach - (footX * footX + footZ * footZ);
        var half = Vector.SquareRoot(gap * inverse);
        var isCut = Vector.GreaterThanOrEqual(gap, Vector<float>.Zero);
        start = Wide.Select(isCut, Wide.Max(start, foot - half), Vector<float>.One);
        end = Wide.Select(isCut, Wide.Min(end, foot + half), Vector<float>.Zero);
    }
}
