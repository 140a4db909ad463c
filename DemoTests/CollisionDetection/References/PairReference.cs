using System;

namespace DemoTests.CollisionDetection.References;

/// <summary>Depth of a pair of rounded boxes by enumeration of all features and all axes, in double precision.</summary>
static class PairReference
{
    /// <summary>Depth along a unit direction from B to A.</summary>
    public static double DepthAlong(RoundedBox a, RoundedBox b, Double3 normal) =>
        a.Extent(normal) + b.Extent(normal) - Double3.Dot(normal, a.Center - b.Center);

    /// <summary>Least distance by which a move parts two shapes that overlap, or the negated distance of two that do not.</summary>
    public static double Depth(RoundedBox a, RoundedBox b)
    {
        var distance = CoreDistance(a, b);
        if (distance > 0)
            return a.Radius + b.Radius - distance;
        return a.Radius + b.Radius + (a.IsBox || b.IsBox ? AxisDepth(a, b) : 0);
    }

    /// <summary>Least depth of the cores along any normal of a face of their Minkowski difference.</summary>
    public static double AxisDepth(RoundedBox a, RoundedBox b)
    {
        var depth = double.MaxValue;
        for (int i = 0; i < 3; ++i)
        {
            if (a.IsBox)
                Try(a.Axes[i]);
            if (b.IsBox)
                Try(b.Axes[i]);
            for (int j = 0; j < 3; ++j)
            {
                if (a.Half[i] > 0 && b.Half[j] > 0)
                    Try(Double3.Cross(a.Axes[i], b.Axes[j]));
            }
        }
        return depth;

        void Try(Double3 axis)
        {
            var length = axis.Length;
            if (length < 1e-9)
                return;
            var normal = axis * (1 / length);
            var extents = a.Extent(normal) + b.Extent(normal) - a.Radius - b.Radius;
            depth = Math.Min(depth, extents - Math.Abs(Double3.Dot(normal, a.Center - b.Center)));
        }
    }

    /// <summary>Distance of the cores: corners from bodies, both ways, and edges from edges. Zero where they meet.</summary>
    public static double CoreDistance(RoundedBox a, RoundedBox b)
    {
        if ((a.IsBox || b.IsBox) && AxisDepth(a, b) >= 0)
            return 0;
        var distance = double.MaxValue;
        for (int i = 0; i < 8; ++i)
        {
            distance = Math.Min(distance, b.CoreDistance(a.Corner(i)));
            distance = Math.Min(distance, a.CoreDistance(b.Corner(i)));
        }
        for (int i = 0; i < 3; ++i)
        {
            for (int j = 0; j < 3; ++j)
            {
                if (a.Half[i] > 0 && b.Half[j] > 0)
                    distance = Math.Min(distance, EdgeDistance(a, i, b, j));
            }
        }
        return distance;
    }

    /// <summary>Distance of inner points of the edges along two axes; that of their ends is found elsewhere.</summary>
    static double EdgeDistance(RoundedBox a, int axisA, RoundedBox b, int axisB)
    {
        var u = a.Axes[axisA];
        var v = b.Axes[axisB];
        var cross = Double3.Cross(u, v);
        var squared = Double3.Dot(cross, cross);
        var distance = double.MaxValue;
        if (squared < 1e-18)
            return distance;
        for (int i = 0; i < 8; ++i)
        {
            if ((i >> axisA & 1) != 0 || IsDuplicate(a, axisA, i))
                continue;
            var startA = a.Corner(i);
            for (int j = 0; j < 8; ++j)
            {
                if ((j >> axisB & 1) != 0 || IsDuplicate(b, axisB, j))
                    continue;
                var offset = b.Corner(j) - startA;
                var s = Double3.Dot(Double3.Cross(offset, v), cross) / squared;
                var t = Double3.Dot(Double3.Cross(offset, u), cross) / squared;
                if (s >= 0 && s <= 2 * a.Half[axisA] && t >= 0 && t <= 2 * b.Half[axisB])
                    distance = Math.Min(distance, (offset + v * t - u * s).Length);
            }
        }
        return distance;
    }

    // The four edges of a segment along its axis are one.
    static bool IsDuplicate(RoundedBox shape, int axis, int corner) => !shape.IsBox && (corner & ~(1 << axis)) != 0;
}
