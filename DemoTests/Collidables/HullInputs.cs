using System;
using System.Collections.Generic;
using System.Linq;
using System.Numerics;
using Demos.References;

namespace DemoTests.Collidables;

/// <summary>Points to make hulls of, and what the hulls must be.</summary>
static class HullInputs
{
    public static Vector3[] Box(float x, float y, float z) =>
        [.. from i in Enumerable.Range(0, 8) select new Vector3((i & 1) == 0 ? -x : x, (i & 2) == 0 ? -y : y, (i & 4) == 0 ? -z : z) * 0.5f];

    public static Vector3[] Sphere(int count, float radius = 1)
    {
        var points = new Vector3[count];
        for (int i = 0; i < count; ++i)
        {
            var y = 1 - (2 * i + 1.0) / count;
            var ring = Math.Sqrt(1 - y * y);
            var angle = i * Math.PI * (3 - Math.Sqrt(5));
            points[i] = new Vector3((float)(ring * Math.Cos(angle)), (float)y, (float)(ring * Math.Sin(angle))) * radius;
        }
        return points;
    }

    /// <summary>Two regular polygons, radius 1, above each other.</summary>
    public static Vector3[] Prism(int sides, float height) =>
        [.. from i in Enumerable.Range(0, 2 * sides)
            let angle = (i >> 1) * Math.Tau / sides
            select new Vector3((float)Math.Cos(angle), (i & 1) == 0 ? -height / 2 : height / 2, (float)Math.Sin(angle))];

    public static double PrismVolume(int sides, double height) => sides * 0.5 * Math.Sin(Math.Tau / sides) * height;

    /// <summary>All points of a cubic grid, side 1.</summary>
    public static Vector3[] Grid(int count) =>
        [.. from x in Enumerable.Range(0, count)
            from y in Enumerable.Range(0, count)
            from z in Enumerable.Range(0, count)
            select new Vector3(x, y, z) / (count - 1) - new Vector3(0.5f)];

    /// <summary>Points of the surface of a cube, side 1, with noise.</summary>
    public static Vector3[] NoisyCube(int count, float noise, Random random)
    {
        var points = new List<Vector3>(Box(1, 1, 1));
        while (points.Count < count)
        {
            var point = new Vector3(random.NextSingle(), random.NextSingle(), random.NextSingle()) - new Vector3(0.5f);
            point[random.Next(3)] = random.Next(2) - 0.5f;
            points.Add(point);
        }
        return [.. points.Select(p => p + noise * InCube(random))];
    }

    public static Vector3 InCube(Random random) => new(
        random.NextSingle() * 2 - 1, random.NextSingle() * 2 - 1, random.NextSingle() * 2 - 1);

    public static Quaternion Turn(Random random) => Quaternion.Normalize(new(
        random.NextSingle() - 0.5f, random.NextSingle() - 0.5f, random.NextSingle() - 0.5f, random.NextSingle() - 0.5f));

    public static Vector3[] Turned(Vector3[] points, Quaternion turn) =>
        [.. points.Select(p => DoubleQuaternion.Normalize(turn).Rotate(p).ToVector3())];

    public static Vector3 ToVector3(this Double3 v) => new((float)v.X, (float)v.Y, (float)v.Z);

    public static Vector3[] Moved(Vector3[] points, Vector3 offset) => [.. points.Select(p => p + offset)];

    public static Vector3[] Scaled(Vector3[] points, Vector3 scale) => [.. points.Select(p => p * scale)];
}
