using System;

namespace Demos.References;

/// <summary>Overlap of two boxes by the separating axis theorem with all fifteen axes, in double precision.</summary>
public static class BoxOverlapOracle
{
    /// <summary>Least translation that parts the boxes; zero or below when they are apart.</summary>
    public static double Depth(
        Double3 halfExtentsA, Double3 positionA, DoubleQuaternion orientationA,
        Double3 halfExtentsB, Double3 positionB, DoubleQuaternion orientationB)
    {
        var offset = positionB - positionA;
        Double3[] axesA = Axes(orientationA), axesB = Axes(orientationB);
        double least = double.MaxValue;
        foreach (var axis in axesA)
            least = Math.Min(least, DepthAlong(axis));
        foreach (var axis in axesB)
            least = Math.Min(least, DepthAlong(axis));
        foreach (var a in axesA)
        {
            foreach (var b in axesB)
            {
                var cross = Double3.Cross(a, b);
                double length = cross.Length;
                // Nearly parallel edges span no face of their own: the face axes already cover them.
                if (length > 1e-9)
                    least = Math.Min(least, DepthAlong(cross * (1 / length)));
            }
        }
        return least;

        double DepthAlong(Double3 axis) =>
            Reach(axesA, halfExtentsA, axis) + Reach(axesB, halfExtentsB, axis) - Math.Abs(Double3.Dot(offset, axis));
    }

    static Double3[] Axes(DoubleQuaternion q) => [q.Rotate(new(1, 0, 0)), q.Rotate(new(0, 1, 0)), q.Rotate(new(0, 0, 1))];

    static double Reach(Double3[] axes, Double3 halfExtents, Double3 axis) =>
        halfExtents.X * Math.Abs(Double3.Dot(axes[0], axis))
        + halfExtents.Y * Math.Abs(Double3.Dot(axes[1], axis))
        + halfExtents.Z * Math.Abs(Double3.Dot(axes[2], axis));
}
