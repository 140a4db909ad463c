using System.Collections.Generic;
using System.Numerics;

namespace Demos.Scenes.BuiltIn;

/// <summary>Random hulls: points on an ellipsoid that keep some distance from each other, so that all are corners.</summary>
static class RandomHull
{
    // Part of the largest half axis that each of the others may lack.
    const float Flattening = 0.25f;

    /// <summary>Points of a hull, and the mass of its ellipsoid at one kilogram per cubic metre.</summary>
    public static Vector3[] Create(SceneRandom random, int pointCount, float radius, out float mass)
    {
        var axes = new Vector3(random.Next(1 - Flattening, 1), random.Next(1 - Flattening, 1), random.Next(1 - Flattening, 1)) * radius;
        mass = 4.18879f * axes.X * axes.Y * axes.Z;
        float leastSquaredDistance = 0.9f * radius * radius / pointCount;
        var points = new List<Vector3>(pointCount);
        while (points.Count < pointCount)
        {
            Vector3 point = random.NextDirection() * axes;
            if (points.TrueForAll(other => SquaredLength(point - other) > leastSquaredDistance))
                points.Add(point);
        }
        return [.. points];
    }

    static float SquaredLength(Vector3 v) => v.X * v.X + v.Y * v.Y + v.Z * v.Z;
}
