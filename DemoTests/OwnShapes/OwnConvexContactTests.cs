using System;
using System.Collections.Generic;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuPhysics.CollisionDetection;
using BepuUtilities.Memory;
using DemoTests.CollisionDetection;
using DemoTests.Quality;
using DemoTests.Support;
using Xunit;

namespace DemoTests.OwnShapes;

/// <summary>Depths of convex shapes of a game's own and each of the library's, beside the least over all directions, in doubles.</summary>
public sealed class OwnConvexContactTests : IDisposable
{
    const float Margin = .15f;

    // How far a shape reaches along a direction in its own frame.
    delegate double Reach(double x, double y, double z);

    readonly BufferPool pool = new();
    readonly Shapes shapes;
    readonly CollisionTaskRegistry registry = DefaultTypes.CreateDefaultCollisionTaskRegistry();
    readonly Random random = new(LevelSeeds.Of(23));

    public OwnConvexContactTests()
    {
        shapes = new Shapes(pool, 1);
        registry.RegisterConvex<Cone, ConeWide, ConeSupport, ConeFeature>();
        registry.RegisterConvex<Ellipsoid, EllipsoidWide, EllipsoidSupport, PointFeature<EllipsoidWide, EllipsoidSupport>>();
    }

    public void Dispose()
    {
        shapes.Dispose();
        pool.AssertEmpty();
        pool.Clear();
    }

    static double Across(double x, double z) => Math.Sqrt(x * x + z * z);

    (TypedIndex Name, Reach Reach, ConvexHull Owned) Create(string kind)
    {
        switch (kind)
        {
            case "cone":
                return (shapes.Add(new Cone(.4f, 1)), (x, y, z) => Math.Max(.75 * y, .4 * Across(x, z) - .25 * y), default);
            case "ellipsoid":
                return (shapes.Add(new Ellipsoid(.5f, .2f, .4f)), (x, y, z) => Math.Sqrt(.25 * x * x + .04 * y * y + .16 * z * z), default);
            case "sphere":
                return (shapes.Add(new Sphere(.3f)), (_, _, _) => .3, default);
            case "capsule":
                return (shapes.Add(new Capsule(.2f, .6f)), (_, y, _) => .2 + .3 * Math.Abs(y), default);
            case "box":
                return (shapes.Add(new Box(.6f, .8f, 1)), (x, y, z) => .3 * Math.Abs(x) + .4 * Math.Abs(y) + .5 * Math.Abs(z), default);
            case "cylinder":
                return (shapes.Add(new Cylinder(.3f, .8f)), (x, y, z) => .3 * Across(x, z) + .4 * Math.Abs(y), default);
            default:
                // An octahedron.
                Vector3[] points = [new(.5f, 0, 0), new(-.5f, 0, 0), new(0, .4f, 0), new(0, -.4f, 0), new(0, 0, .6f), new(0, 0, -.6f)];
                var hull = new ConvexHull(points, pool, out _);
                return (shapes.Add(hull), (x, y, z) => Math.Max(.5 * Math.Abs(x), Math.Max(.4 * Math.Abs(y), .6 * Math.Abs(z))), hull);
        }
    }

    // Over a net of directions, and then by ever smaller tilts of the best ones.
    static double LeastDepth(Reach reachA, in Quaternion turnA, Reach reachB, in Quaternion turnB, in Vector3 offset)
    {
        var (a, b, apart) = (Matrix4x4.CreateFromQuaternion(turnA), Matrix4x4.CreateFromQuaternion(turnB), offset);
        double Depth(double x, double y, double z)
        {
            // Rows of a matrix are the turned axes.
            double Along(in Matrix4x4 m, Reach reach, double sign) => reach(
                sign * (m.M11 * x + m.M12 * y + m.M13 * z), sign * (m.M21 * x + m.M22 * y + m.M23 * z), sign * (m.M31 * x + m.M32 * y + m.M33 * z));
            return Along(a, reachA, -1) + Along(b, reachB, 1) + apart.X * x + apart.Y * y + apart.Z * z;
        }
        const int Count = 3000;
        var starts = new (double Depth, double X, double Y, double Z)[Count];
        for (int i = 0; i < Count; ++i)
        {
            var y = 1 - 2 * (i + .5) / Count;
            var (sine, cosine) = Math.SinCos(i * 2.39996322972865332);
            var across = Math.Sqrt(1 - y * y);
            starts[i] = (Depth(across * cosine, y, across * sine), across * cosine, y, across * sine);
        }
        Array.Sort(starts, (p, q) => p.Depth.CompareTo(q.Depth));
        var least = double.MaxValue;
        var noise = new Random(1);
        foreach (var start in starts.AsSpan(0, 16))
        {
            var best = start;
            for (double size = .05; size > 1e-6; size *= .85)
            {
                for (int i = 0; i < 40; ++i)
                {
                    double Tilt() => size * (noise.NextDouble() * 2 - 1);
                    double x = best.X + Tilt(), y = best.Y + Tilt(), z = best.Z + Tilt();
                    var length = Math.Sqrt(x * x + y * y + z * z);
                    var depth = Depth(x / length, y / length, z / length);
                    if (depth < best.Depth)
                        best = (depth, x / length, y / length, z / length);
                }
            }
            least = Math.Min(least, best.Depth);
        }
        return least;
    }

    [Theory]
    [InlineData("cone", "sphere"), InlineData("cone", "capsule"), InlineData("cone", "box"), InlineData("cone", "cylinder"), InlineData("cone", "hull")]
    [InlineData("cone", "cone"), InlineData("cone", "ellipsoid"), InlineData("ellipsoid", "ellipsoid"), InlineData("ellipsoid", "sphere")]
    [InlineData("ellipsoid", "box"), InlineData("ellipsoid", "cylinder"), InlineData("ellipsoid", "hull"), InlineData("box", "ellipsoid")]
    public void Depths_are_the_least_of_all_directions(string kindA, string kindB)
    {
        var (a, b) = (Create(kindA), Create(kindB));
        const int pairs = 60;
        var manifolds = new ConvexContactManifold[pairs];
        var completions = new int[pairs];
        var expected = new List<double>();
        using (var batcher = new CollisionBatcher<ManifoldCollector>(pool, shapes, registry, 1 / 60f, new(manifolds, completions)))
        {
            for (int i = 0; i < pairs; ++i)
            {
                var (turnA, turnB) = (NextTurn(), NextTurn());
                var offset = Vector3.Transform(Vector3.UnitX, NextTurn()) * (.2f + .8f * random.NextSingle());
                batcher.Add(a.Name, b.Name, offset, turnA, turnB, Margin, new(i));
                expected.Add(LeastDepth(a.Reach, turnA, b.Reach, turnB, offset));
            }
            batcher.Flush();
        }
        var touching = 0;
        for (int i = 0; i < pairs; ++i)
        {
            Assert.Equal(1, completions[i]);
            var depth = float.MinValue;
            for (int contact = 0; contact < manifolds[i].Count; ++contact)
                depth = Math.Max(depth, manifolds[i].GetDepth(contact));
            if (expected[i] > -Margin + 1e-3)
            {
                ++touching;
                Assert.True(manifolds[i].Count > 0, $"pair {i} of depth {expected[i]} has no contact");
                Assert.Equal(expected[i], depth, 3e-4);
            }
            else if (expected[i] < -Margin - 1e-3)
                Assert.False(manifolds[i].Count > 0, $"pair {i} of depth {expected[i]} has a contact");
        }
        Assert.True(touching > 20, $"{touching} touch");
        shapes.Clear();
        foreach (var hull in new[] { a.Owned, b.Owned })
        {
            var owned = hull;
            owned.Dispose(pool);
        }
    }

    Quaternion NextTurn() => Quaternion.Normalize(
        new(random.NextSingle() - .5f, random.NextSingle() - .5f, random.NextSingle() - .5f, random.NextSingle() - .5f));
}
