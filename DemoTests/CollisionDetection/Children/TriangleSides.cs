using System;
using System.Numerics;
using BepuPhysics.Collidables;

namespace DemoTests.CollisionDetection.Children;

/// <summary>The planes that stand on the edges of a triangle, and its own, in double precision: what is beyond one does not touch it from its front.</summary>
readonly struct TriangleSides
{
    /// <summary>Number of planes.</summary>
    public const int Count = 4;

    readonly (double X, double Y, double Z)[] normals;
    readonly Vector3[] points;

    public TriangleSides(in Triangle triangle)
    {
        points = [triangle.A, triangle.B, triangle.C, triangle.A];
        normals = new (double, double, double)[Count];
        normals[3] = Unit(Cross(Edge(2, 0), Edge(1, 0)));
        for (int i = 0; i < 3; ++i)
        {
            var edge = Edge((i + 1) % 3, i);
            normals[i] = Unit(Cross(normals[3], edge));
        }
    }

    (double X, double Y, double Z) Edge(int to, int from) => ((double)points[to].X - points[from].X, (double)points[to].Y - points[from].Y,
        (double)points[to].Z - points[from].Z);

    static (double X, double Y, double Z) Cross((double X, double Y, double Z) a, (double X, double Y, double Z) b) =>
        (a.Y * b.Z - a.Z * b.Y, a.Z * b.X - a.X * b.Z, a.X * b.Y - a.Y * b.X);

    static (double X, double Y, double Z) Unit((double X, double Y, double Z) v)
    {
        var length = Math.Sqrt(v.X * v.X + v.Y * v.Y + v.Z * v.Z);
        return (v.X / length, v.Y / length, v.Z / length);
    }

    /// <summary>Distance of a point beyond a plane, m.</summary>
    public double Height(int side, Vector3 point) =>
        Along(side, (double)point.X - points[side].X, (double)point.Y - points[side].Y, (double)point.Z - points[side].Z);

    /// <summary>A vector along the normal of a plane.</summary>
    public double Along(int side, double x, double y, double z) => normals[side].X * x + normals[side].Y * y + normals[side].Z * z;
}
