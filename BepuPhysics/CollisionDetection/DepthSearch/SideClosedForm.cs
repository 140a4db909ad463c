using System.Numerics;
using System.Runtime.CompilerServices;
using BepuUtilities;

namespace BepuPhysics.CollisionDetection;

/// <summary>
/// Finds in closed form where the sides of two cylinders are least deep that lie along each other, or nearly: between the nearest points of their axes.
/// </summary>
/// <remarks>
/// Where both points are inside of the axes, the direction is at right angles to both, and exact. An end of an axis stands for its rim: exact but for
/// the square of the angle by which the direction is not at a right angle to that axis. Sides that cross at any angle could be found so as well; but
/// a descent is quick there, and leaves a simplex.
/// </remarks>
static class SideClosedForm
{
    // Cosine of the angle between the direction and an axis up to which it is the side that is touched, and sine of that between axes.
    const float GreatestCosine = SearchTolerances.NearlyParallel;

    /// <summary>Finds direction and points.</summary>
    /// <param name="radiusA">Radius of the first cylinder.</param>
    /// <param name="halfA">Half its length.</param>
    /// <param name="radiusB">Radius of the second.</param>
    /// <param name="halfB">Half its length.</param>
    /// <param name="offset">Position of the second in the frame of the first, whose axis is Y.</param>
    /// <param name="axis">Axis of the second in that frame.</param>
    /// <param name="mask">Lanes to look at.</param>
    /// <param name="direction">In lanes that are found, the direction of least depth.</param>
    /// <param name="onA">In these lanes, a point of the first.</param>
    /// <param name="onB">In these lanes, a point of the second, in the same frame.</param>
    /// <returns>Lanes that were found.</returns>
    [MethodImpl(MethodImplOptions.NoInlining)]
    public static Vector<int> Find(Vector<float> radiusA, Vector<float> halfA, Vector<float> radiusB, Vector<float> halfB, in Vector3Wide offset,
        in Vector3Wide axis, Vector<int> mask, ref Vector3Wide direction, ref Vector3Wide onA, ref Vector3Wide onB)
    {
        var squaredSine = axis.X * axis.X + axis.Z * axis.Z;
        mask &= Vector.LessThan(squaredSine, new Vector<float>(GreatestCosine * GreatestCosine));
        if (mask == Vector<int>.Zero)
            return mask;
        // Of axes that are all but parallel, all but the parts across the first cancel, so these are what is divided.
        var along = Vector3Wide.Dot(offset, axis);
        var placeB = Wide.Clamp(-Wide.DivideOrZero(offset.X * axis.X + offset.Z * axis.Z, squaredSine), -halfB, halfB);
        var free = offset.Y + placeB * axis.Y;
        var placeA = Wide.Clamp(free, -halfA, halfA);
        var isClamped = Vector.OnesComplement(Vector.Equals(free, placeA));
        placeB = Wide.Select(isClamped, Wide.Clamp(placeA * axis.Y - along, -halfB, halfB), placeB);

        var middleB = offset + axis * placeB;
        var between = new Vector3Wide(middleB.X, middleB.Y - placeA, middleB.Z);
        var found = between * (Vector<float>.One / between.Length());
        var cosineB = Vector3Wide.Dot(found, axis);
        var greatest = new Vector<float>(GreatestCosine);
        // Two axes that intersect have no direction: NaN, which is not less.
        mask &= Vector.LessThan(Vector.Abs(found.Y), greatest) & Vector.LessThan(Vector.Abs(cosineB), greatest);
        var acrossA = radiusA / Vector.SquareRoot(found.X * found.X + found.Z * found.Z);
        var radialB = found - axis * cosineB;
        radialB *= radiusB / radialB.Length();
        var pointA = new Vector3Wide(found.X * acrossA, placeA, found.Z * acrossA);
        // The other point of a rim is opposite to the rim, not to the end of the axis.
        var lineB = offset - radialB;
        var isEndOfA = Vector.Equals(Vector.Abs(placeA), halfA);
        var underA = Wide.Clamp(Vector3Wide.Dot(pointA - lineB, axis), -halfB, halfB);
        var pointB = lineB + axis * Wide.Select(isEndOfA, underA, placeB);
        pointA.Y = Wide.Select(isEndOfA, placeA, Wide.Clamp(pointB.Y, -halfA, halfA));
        onA = Vector3Wide.Select(mask, pointA, onA);
        onB = Vector3Wide.Select(mask, pointB, onB);
        direction = Vector3Wide.Select(mask, found, direction);
        return mask;
    }
}
