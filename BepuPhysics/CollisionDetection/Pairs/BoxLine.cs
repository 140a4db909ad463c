using System.Numerics;
using System.Runtime.CompilerServices;
using BepuUtilities;

namespace BepuPhysics.CollisionDetection;

/// <summary>Parts of lines against boxes.</summary>
static class BoxLine
{
    /// <summary>Finds the place on a part of a line that is nearest to a box; in the middle of those that are equally near.</summary>
    /// <param name="start">Where the place is zero, from the box's centre in its axes.</param>
    /// <param name="direction">Way per unit of place; of any length.</param>
    /// <param name="extents">Half the sizes of the box.</param>
    /// <param name="first">Where the part starts.</param>
    /// <param name="last">Where it ends; no less.</param>
    /// <param name="place">The place.</param>
    // A coordinate is between the planes of its two faces while the place is between those where the line crosses them, and beyond, its
    // distance grows with the speed along it. So half the derivative of the squared distance is the sum of squared speeds times distances of
    // the place from those intervals. It never decreases, and is linear between the six ends of intervals. The last of those where it is not
    // positive and the first where it is not negative enclose the root.
    [MethodImpl(MethodImplOptions.NoInlining)]
    public static void FindNearest(in Vector3Wide start, in Vector3Wide direction, in Vector3Wide extents, in Vector<float> first,
        in Vector<float> last, out Vector<float> place)
    {
        Cross(start.X, direction.X, extents.X, out var enterX, out var leaveX);
        Cross(start.Y, direction.Y, extents.Y, out var enterY, out var leaveY);
        Cross(start.Z, direction.Z, extents.Z, out var enterZ, out var leaveZ);
        var squares = direction * direction;
        var low = first;
        var high = last;
        // A coordinate has no part in the derivative at the ends of its own interval.
        Narrow(enterX, Slope(enterX, enterY, leaveY, squares.Y) + Slope(enterX, enterZ, leaveZ, squares.Z), first, last, ref low, ref high);
        Narrow(leaveX, Slope(leaveX, enterY, leaveY, squares.Y) + Slope(leaveX, enterZ, leaveZ, squares.Z), first, last, ref low, ref high);
        Narrow(enterY, Slope(enterY, enterX, leaveX, squares.X) + Slope(enterY, enterZ, leaveZ, squares.Z), first, last, ref low, ref high);
        Narrow(leaveY, Slope(leaveY, enterX, leaveX, squares.X) + Slope(leaveY, enterZ, leaveZ, squares.Z), first, last, ref low, ref high);
        Narrow(enterZ, Slope(enterZ, enterX, leaveX, squares.X) + Slope(enterZ, enterY, leaveY, squares.Y), first, last, ref low, ref high);
        Narrow(leaveZ, Slope(leaveZ, enterX, leaveX, squares.X) + Slope(leaveZ, enterY, leaveY, squares.Y), first, last, ref low, ref high);
        low = Wide.Min(low, last);
        high = Wide.Max(high, first);
        // Where there is no root between the ends, one of these is nearest, and is returned to the bit.
        var zero = Vector<float>.Zero;
        var lowSlope = Wide.Min(zero, Slope(low, enterX, leaveX, squares.X) + Slope(low, enterY, leaveY, squares.Y) +
            Slope(low, enterZ, leaveZ, squares.Z));
        var highSlope = Slope(high, enterX, leaveX, squares.X) + Slope(high, enterY, leaveY, squares.Y) +
            Slope(high, enterZ, leaveZ, squares.Z);
        var rise = highSlope - lowSlope;
        var part = Wide.Select(Vector.GreaterThan(rise, zero), -lowSlope / rise, new Vector<float>(0.5f));
        place = Wide.Select(Vector.LessThan(highSlope, zero), high, low + (high - low) * part);
    }

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static void Cross(Vector<float> start, Vector<float> speed, Vector<float> extent, out Vector<float> enter, out Vector<float> leave)
    {
        var inverse = Vector<float>.One / Wide.CopySign(Wide.Max(Vector.Abs(speed), new Vector<float>(PairTolerances.LeastSpeed)), speed);
        var middle = -start * inverse;
        var reach = extent * Vector.Abs(inverse);
        enter = middle - reach;
        leave = middle + reach;
    }

    /// <summary>What a coordinate has in the derivative.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static Vector<float> Slope(Vector<float> place, Vector<float> enter, Vector<float> leave, Vector<float> squaredSpeed) =>
        (place - Wide.Clamp(place, enter, leave)) * squaredSpeed;

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static void Narrow(Vector<float> place, Vector<float> slope, Vector<float> first, Vector<float> last,
        ref Vector<float> low, ref Vector<float> high)
    {
        low = Wide.Max(low, Wide.Select(Vector.LessThanOrEqual(slope, Vector<float>.Zero), place, first));
        high = Wide.Min(high, Wide.Select(Vector.GreaterThanOrEqual(slope, Vector<float>.Zero), place, last));
    }
}
