using System;
using System.Collections.Generic;
using System.Linq;
using System.Numerics;
using BepuPhysics.Collidables;
using Demos.References;
using Xunit;

namespace DemoTests.CollisionDetection;

/// <summary>A box that stands half on what ends under it: the overlap has four corners, and all of them carry.</summary>
// The edge runs under the middle of the box, along X = Z. Its two corners are farther from each other than either is from another
// one, but for a diagonal: where the box leans towards one of them, both others lie on one side of the line through the first two contacts.
public sealed class QuadrilateralOverlapTests
{
    const float Yaw = 0.3f, HalfWidth = 0.5f, HalfHeight = 0.3f, HalfLength = 0.4f, Depth = 1e-3f, Margin = 0.1f;
    const int DirectionCount = 48;

    static readonly Box standing = new(2 * HalfWidth, 2 * HalfHeight, 2 * HalfLength);

    public static TheoryData<float> Tilts => [0, 2e-5f, 1e-4f, 5e-4f, 2e-3f];

    [Theory]
    [MemberData(nameof(Tilts))]
    public void OnATriangle(float tilt) =>
        AssertAll(tilt, new Triangle(new(-20, 0, -20), new(20, 0, 20), new(-20, 0, 20)), Quaternion.Identity, default);

    [Theory]
    [MemberData(nameof(Tilts))]
    public void OnABox(float tilt) =>
        AssertAll(tilt, new Box(20, 2, 20), Quaternion.CreateFromAxisAngle(Vector3.UnitY, MathF.PI / 4),
            new(-10 * MathF.Sqrt(0.5f), -1, 10 * MathF.Sqrt(0.5f)));

    [Theory]
    [MemberData(nameof(Tilts))]
    public void OnAHull(float tilt)
    {
        // A slab whose edge is the same.
        Vector3[] points = [.. new Vector3[] { new(-20, 0, -20), new(20, 0, 20), new(-20, 0, 20) }.SelectMany(p => new[] { p, p - Vector3.UnitY })];
        using var pool = new BepuUtilities.Memory.BufferPool();
        var hull = new ConvexHull(points, pool, out var center);
        AssertAll(tilt, hull, Quaternion.Identity, center);
        hull.Dispose(pool);
    }

    static void AssertAll<TShape>(float tilt, TShape floor, Quaternion turn, Vector3 position) where TShape : unmanaged, IConvexShape
    {
        var expected = Corners();
        Assert.Equal(4, expected.Count);
        for (int i = 0; i < DirectionCount; ++i)
        {
            double direction = i * Math.Tau / DirectionCount;
            var axis = new Vector3((float)Math.Cos(direction), 0, (float)Math.Sin(direction));
            var lean = Quaternion.CreateFromAxisAngle(axis, tilt) * Quaternion.CreateFromAxisAngle(Vector3.UnitY, Yaw);
            var manifold = PairHarness.Run<Box, TShape>(new(standing, floor, position - Vector3.UnitY * (HalfHeight - Depth), lean, turn), Margin);
            var places = Enumerable.Range(0, manifold.Count).Select(manifold.GetOffset).ToList();
            foreach (var (x, z) in expected)
            {
                // The normal may be either surface's: over the box's height the places differ by as much as it leans.
                Assert.True(places.Any(p => Math.Abs(p.X - x) + Math.Abs(p.Z - z) < 1e-4 + 2 * tilt),
                    $"none at {x}, {z}, leaning to {direction}: {string.Join(", ", places)}");
            }
            Assert.Equal(4, manifold.Count);
        }
    }

    /// <summary>Corners of the upright box's base on the side where Z is greater than X, and where its outline crosses that edge.</summary>
    static List<(double X, double Z)> Corners()
    {
        var turn = DoubleQuaternion.FromAxisAngle(new(0, 1, 0), Yaw);
        var outline = new[] { (-1, -1), (1, -1), (1, 1), (-1, 1) }.Select(c => turn.Rotate(new(c.Item1 * HalfWidth, 0, c.Item2 * HalfLength))).ToList();
        var result = new List<(double X, double Z)>();
        for (int i = 0; i < outline.Count; ++i)
        {
            var from = outline[i];
            var to = outline[(i + 1) % outline.Count];
            double before = from.Z - from.X, after = to.Z - to.X;
            if (before > 0)
                result.Add((from.X, from.Z));
            if (before > 0 != after > 0)
                result.Add((from.X + (to.X - from.X) * before / (before - after), from.Z + (to.Z - from.Z) * before / (before - after)));
        }
        return result;
    }
}
