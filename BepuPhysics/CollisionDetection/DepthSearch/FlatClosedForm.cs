using System.Numerics;
using System.Runtime.CompilerServices;
using BepuUtilities;

namespace BepuPhysics.CollisionDetection;

/// <summary>
/// Finds in closed form where a flat face and a cylinder that lies or stands on it, or nearly, are least deep: where to search, for shapes that
/// rest on each other.
/// </summary>
/// <remarks>
/// <para>
/// What rests is tilted by thousandths of a radian, and these decide the direction of least depth: it runs from one face's normal to the
/// other's, and a rim's farthest point around half of the rim, as the bodies turn by as much. A descent takes long to find its way there.
/// </para>
/// <para>
/// But seen along the face's normal n, the depth of two flat features is linear, g.x, over the places x at which they overlap, where g is the
/// slope of the second feature's normal against n; and the least depth of all directions is the greatest of all places: two sides of
/// one linear programme. A direction n + w is the best where w points outwards of the face at the place that is deepest, and g - w outwards of the
/// other feature; that is, w is zero where the place is inside of the face, and a multiple of its edge's normal where it is on an edge.
/// </para>
/// <para>
/// Exact but for the square of the slopes. The search evaluates the direction, and finds in the two points whether it is done: these are a
/// lower bound of the depth, as the direction is an upper one.
/// </para>
/// </remarks>
/// <typeparam name="TShapeWideF">Shape with the face.</typeparam>
/// <typeparam name="TSupportF">Its faces; of a cylinder, its ends.</typeparam>
/// <typeparam name="TShapeWideG">The cylinder.</typeparam>
/// <typeparam name="TSupportG">Its measures.</typeparam>
static partial class FlatClosedForm<TShapeWideF, TSupportF, TShapeWideG, TSupportG>
    where TShapeWideF : unmanaged where TSupportF : struct, ISupport<TShapeWideF>
    where TShapeWideG : unmanaged where TSupportG : struct, ISupport<TShapeWideG>
{
    // Cosine of the angle to the direction up to which a face faces it.
    const float LeastFacingCosine = 0.7f;
    // Tangent of the angle between the face and an end or a side up to which they count as nearly parallel.
    const float GreatestSlope = SearchTolerances.NearlyParallel;
    // Square of the slope of a direction against the face's normal: where an edge hardly cuts a rim it may be anything.
    const float GreatestSquaredTilt = 4 * GreatestSlope * GreatestSlope;
    // Where the cylinder is seen to be depends on the direction that it is seen from, so the place is found again with the direction that was found
    // first.
    const int Rounds = 2;
    const float GreatestSquaredSine = GreatestSlope * GreatestSlope;

    /// <summary>Finds direction and points for lanes with a face that faces the direction, and with an end or a side nearly along it.</summary>
    /// <param name="f">Shapes with faces.</param>
    /// <param name="g">Cylinders.</param>
    /// <param name="offset">Position of the cylinder in the frame of the face's shape, m.</param>
    /// <param name="orientation">Axes of the cylinder in that frame, in the rows.</param>
    /// <param name="mask">Lanes to look at.</param>
    /// <param name="direction">Direction to the cylinder, by which the face is chosen; in lanes that are found, that of least depth.</param>
    /// <param name="onF">In these lanes, a point of the face, in its shape's frame.</param>
    /// <param name="onG">In these lanes, the point of the cylinder that is as far from it as the shapes are deep, in the same frame.</param>
    /// <returns>Lanes that were found.</returns>
    [MethodImpl(MethodImplOptions.NoInlining)]
    public static Vector<int> Find(in TShapeWideF f, in TShapeWideG g, in Vector3Wide offset, in Matrix3x3Wide orientation, Vector<int> mask,
        ref Vector3Wide direction, ref Vector3Wide onF, ref Vector3Wide onG)
    {
        var normal = TSupportF.FaceNormal(f, direction);
        mask &= Vector.GreaterThan(Vector3Wide.Dot(normal, direction), new Vector<float>(LeastFacingCosine));
        var along = Vector3Wide.Dot(orientation.Y, normal);
        var squaredAlong = along * along;
        var endMask = mask & Vector.GreaterThan(squaredAlong, new Vector<float>(1 - GreatestSquaredSine));
        var sideMask = mask & Vector.LessThan(squaredAlong, new Vector<float>(GreatestSquaredSine));
        if ((endMask | sideMask) == Vector<int>.Zero)
            return Vector<int>.Zero;
        TSupportF.GetFace(f, normal, out var face);
        TSupportG.GetCylinder(g, out var radius, out var halfLength);
        if (endMask != Vector<int>.Zero)
            endMask = FindEnd(f, face, offset, orientation.Y, along, radius, halfLength, endMask, ref direction, ref onF, ref onG);
        if (sideMask != Vector<int>.Zero)
            sideMask = FindSide(f, face, offset, orientation.Y, along, radius, halfLength, sideMask, ref direction, ref onF, ref onG);
        return endMask | sideMask;
    }

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static Vector<float> DiscRadius(in TShapeWideF f)
    {
        TSupportF.GetCylinder(f, out var radius, out _);
        return radius;
    }
}
