using System;
using System.Numerics;
using System.Runtime.CompilerServices;
using BepuPhysics.Collidables;
using BepuUtilities;

namespace BepuPhysics.CollisionDetection;

/// <summary>A convex shape as it lies in the world, and how far it reaches along directions, one direction after the other.</summary>
/// <remarks>
/// What <see cref="DirectionalDepth{TShapeWideA, TSupportA, TShapeWideB, TSupportB}"/> is for bundles that look for contacts: where nothing but the depth is
/// asked for, as between the directions of a triangle's neighbours, closed forms for one shape need neither lanes nor a round.
/// </remarks>
unsafe struct ShapeReach
{
    readonly int typeId;
    // Axes of a box; that of a capsule or a cylinder is Y. The corners of a triangle.
    readonly Vector3 x, y, z;
    // Half widths of a box; half the length of a capsule or a cylinder is Y. A radius is X.
    readonly Vector3 half;
    readonly Quaternion orientation;
    readonly HullHeader* hull;

    /// <summary>Puts a shape where it is.</summary>
    /// <param name="typeId">Its type, one of those that can be copied.</param>
    /// <param name="shape">The shape.</param>
    /// <param name="orientation">Rotation from its frame to the world.</param>
    public ShapeReach(int typeId, in ShapeCopy shape, in Quaternion orientation)
    {
        Unsafe.SkipInit(out this);
        this.typeId = typeId;
        switch (typeId)
        {
            case Sphere.Id:
                half.X = shape.Read<Sphere>().Radius;
                break;
            case Capsule.Id:
                var capsule = shape.Read<Capsule>();
                (half.X, half.Y) = (capsule.Radius, capsule.HalfLength);
                y = Exact.Rotate(Vector3.UnitY, orientation);
                break;
            case Box.Id:
                var box = shape.Read<Box>();
                half = new(box.HalfWidth, box.HalfHeight, box.HalfLength);
                x = Exact.Rotate(Vector3.UnitX, orientation);
                y = Exact.Rotate(Vector3.UnitY, orientation);
                z = Exact.Rotate(Vector3.UnitZ, orientation);
                break;
            case Triangle.Id:
                var triangle = shape.Read<Triangle>();
                x = Exact.Rotate(triangle.A, orientation);
                y = Exact.Rotate(triangle.B, orientation);
                z = Exact.Rotate(triangle.C, orientation);
                break;
            case Cylinder.Id:
                var cylinder = shape.Read<Cylinder>();
                (half.X, half.Y) = (cylinder.Radius, cylinder.HalfLength);
                y = Exact.Rotate(Vector3.UnitY, orientation);
                break;
            default:
                hull = shape.Read<ConvexHull>().Header;
                this.orientation = orientation;
                break;
        }
    }

    /// <summary>How far the shape reaches along a unit direction from its centre, m.</summary>
    public readonly float Along(in Vector3 direction)
    {
        switch (typeId)
        {
            case Sphere.Id:
                return half.X;
            case Capsule.Id:
                return MathF.Abs(Exact.Dot(y, direction)) * half.Y + half.X;
            case Box.Id:
                return MathF.Abs(Exact.Dot(x, direction)) * half.X + MathF.Abs(Exact.Dot(y, direction)) * half.Y +
                    MathF.Abs(Exact.Dot(z, direction)) * half.Z;
            case Triangle.Id:
                return MathHelper.Max(Exact.Dot(x, direction), MathHelper.Max(Exact.Dot(y, direction), Exact.Dot(z, direction)));
            case Cylinder.Id:
                return MathF.Abs(Exact.Dot(y, direction)) * half.Y + Exact.Length(Exact.Cross(y, direction)) * half.X;
            default:
                return Along(hull, Exact.RotateByInverse(direction, orientation));
        }
    }

    /// <summary>How far a hull reaches along a direction in its own frame, m.</summary>
    // The lanes after the last vertex of a hull hold copies.
    public static float Along(HullHeader* hull, in Vector3 direction)
    {
        var (x, y, z) = (new Vector<float>(direction.X), new Vector<float>(direction.Y), new Vector<float>(direction.Z));
        var points = hull->Points;
        var farthest = points->X * x + points->Y * y + points->Z * z;
        for (int i = 1; i < hull->VertexBundleCount; ++i)
            farthest = Wide.Max(farthest, points[i].X * x + points[i].Y * y + points[i].Z * z);
        return Wide.SpreadGreatest(farthest)[0];
    }

    /// <summary>How far a shape reaches along a unit direction from its centre, m: to rounding what <see cref="Along(in Vector3)"/> says, for one direction.
    /// </summary>
    /// <param name="typeId">Its type, one of those that can be copied.</param>
    /// <param name="shape">The shape.</param>
    /// <param name="orientation">Rotation from its frame to the world.</param>
    /// <param name="direction">The direction.</param>
    public static float AlongOnce(int typeId, in ShapeCopy shape, in Quaternion orientation, in Vector3 direction)
    {
        if (typeId == Sphere.Id)
            return shape.Read<Sphere>().Radius;
        // The direction to the shape's frame, and not the shape's axes to the world.
        var local = Exact.RotateByInverse(direction, orientation);
        switch (typeId)
        {
            case Capsule.Id:
                var capsule = shape.Read<Capsule>();
                return MathF.Abs(local.Y) * capsule.HalfLength + capsule.Radius;
            case Box.Id:
                var box = shape.Read<Box>();
                return MathF.Abs(local.X) * box.HalfWidth + MathF.Abs(local.Y) * box.HalfHeight + MathF.Abs(local.Z) * box.HalfLength;
            case Triangle.Id:
                var triangle = shape.Read<Triangle>();
                return MathHelper.Max(
                    Exact.Dot(triangle.A, local), MathHelper.Max(Exact.Dot(triangle.B, local), Exact.Dot(triangle.C, local)));
            case Cylinder.Id:
                var cylinder = shape.Read<Cylinder>();
                return MathF.Abs(local.Y) * cylinder.HalfLength + MathF.Sqrt(local.X * local.X + local.Z * local.Z) * cylinder.Radius;
            default:
                return Along(shape.Read<ConvexHull>().Header, local);
        }
    }

    /// <summary>Distance from the centre that no point of a shape is beyond, m.</summary>
    /// <param name="typeId">Its type, one of those that can be copied.</param>
    /// <param name="shape">The shape.</param>
    public static float SizeOf(int typeId, in ShapeCopy shape)
    {
        switch (typeId)
        {
            case Sphere.Id:
                return shape.Read<Sphere>().Radius;
            case Capsule.Id:
                var capsule = shape.Read<Capsule>();
                return capsule.Radius + capsule.HalfLength;
            case Box.Id:
                var box = shape.Read<Box>();
                return box.HalfWidth + box.HalfHeight + box.HalfLength;
            case Triangle.Id:
                var triangle = shape.Read<Triangle>();
                return Exact.Length(triangle.A) + Exact.Length(triangle.B) + Exact.Length(triangle.C);
            case Cylinder.Id:
                var cylinder = shape.Read<Cylinder>();
                return cylinder.Radius + cylinder.HalfLength;
            default:
                return shape.Read<ConvexHull>().Header->OuterRadius;
        }
    }
}
