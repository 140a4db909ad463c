using System;
using System.Numerics;
using BepuPhysics.Collidables;
using BepuUtilities;

namespace BepuPhysics;

/// <summary>Whether two convex shapes are apart as far as the line through their centres tells.</summary>
/// <remarks>
/// A question has a handful of pairs of different types, and each takes a bundle of its own: the test of one pair costs as much as that of eight.
/// Of those whose bounds overlap more than half are apart, and most of these are so along that line.
/// </remarks>
static unsafe class CentreLine
{
    // Of what is compared: beyond what it loses by being of floats.
    const float Slack = 1e-5f;

    /// <summary>Whether two shapes are surely farther apart than a margin; false for shapes that are not convex, or have no centre.</summary>
    /// <param name="typeA">Type of the first shape.</param>
    /// <param name="shapeA">The first shape.</param>
    /// <param name="orientationA">Its orientation.</param>
    /// <param name="typeB">Type of the second shape.</param>
    /// <param name="shapeB">The second shape.</param>
    /// <param name="orientationB">Its orientation.</param>
    /// <param name="offsetB">Position of the second shape less that of the first, m.</param>
    /// <param name="margin">The margin, m.</param>
    public static bool ShowsApart(int typeA, void* shapeA, in Quaternion orientationA, int typeB, void* shapeB, in Quaternion orientationB,
        in Vector3 offsetB, float margin)
    {
        // The line keeps its length, so all of this is that many times as long.
        var length = Exact.Length(offsetB);
        var reach = Reach(typeA, shapeA, Exact.RotateByInverse(offsetB, orientationA), length)
            + Reach(typeB, shapeB, Exact.RotateByInverse(-offsetB, orientationB), length) + margin * length;
        return reach * (1 + Slack) < length * length;
    }

    // How far a shape reaches along a direction in its frame.
    static float Reach(int type, void* shape, in Vector3 direction, float length)
    {
        switch (type)
        {
            case Sphere.Id:
                return ((Sphere*)shape)->Radius * length;
            case Capsule.Id:
                ref var capsule = ref *(Capsule*)shape;
                return capsule.HalfLength * MathF.Abs(direction.Y) + capsule.Radius * length;
            case Box.Id:
                ref var box = ref *(Box*)shape;
                return Exact.Dot(Vector3.Abs(direction), new Vector3(box.HalfWidth, box.HalfHeight, box.HalfLength));
            case Cylinder.Id:
                ref var cylinder = ref *(Cylinder*)shape;
                return cylinder.HalfLength * MathF.Abs(direction.Y) + cylinder.Radius * Exact.Length(direction with { Y = 0 });
            case ConvexHull.Id:
                return Reach(*(ConvexHull*)shape, direction);
            default:
                return float.PositiveInfinity;
        }
    }

    static float Reach(in ConvexHull hull, in Vector3 direction)
    {
        Vector<float> x = new(direction.X), y = new(direction.Y), z = new(direction.Z);
        var farthest = new Vector<float>(float.MinValue);
        foreach (ref var points in hull.Points.AsSpan())
            farthest = Wide.Max(farthest, points.X * x + points.Y * y + points.Z * z);
        var reach = farthest[0];
        for (int lane = 1; lane < Vector<float>.Count; ++lane)
            reach = MathHelper.Max(reach, farthest[lane]);
        return reach;
    }
}
