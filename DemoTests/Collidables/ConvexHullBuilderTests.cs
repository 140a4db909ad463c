using System;
using System.Diagnostics;
using System.Linq;
using System.Numerics;
using BepuPhysics.Collidables;
using BepuUtilities.Memory;
using Xunit;
using Xunit.Abstractions;

namespace DemoTests.Collidables;

public class ConvexHullBuilderTests(ITestOutputHelper output)
{
    public static TheoryData<string, Vector3[], double> ClosedForms
    {
        get
        {
            var random = new Random(1);
            var data = new TheoryData<string, Vector3[], double>();
            foreach (var size in (float[])[1e-3f, 1, 1e3f])
            {
                data.Add($"box {size}", HullInputs.Box(size, 2 * size, 3 * size), 6.0 * size * size * size);
                var turn = HullInputs.Turn(random);
                data.Add($"turned box {size}", HullInputs.Turned(HullInputs.Box(size, 2 * size, 3 * size), turn), 6.0 * size * size * size);
                data.Add($"grid {size}", HullInputs.Scaled(HullInputs.Grid(12), new(size)), (double)size * size * size);
                data.Add($"turned grid {size}", HullInputs.Turned(HullInputs.Scaled(HullInputs.Grid(12), new(size)), turn), (double)size * size * size);
                foreach (var sides in (int[])[3, 6, 17, 64, 500, 5000])
                {
                    var prism = HullInputs.Scaled(HullInputs.Prism(sides, 0.7f), new(size));
                    var volume = HullInputs.PrismVolume(sides, 0.7) * Math.Pow(size, 3);
                    data.Add($"prism {sides} {size}", prism, volume);
                    data.Add($"turned prism {sides} {size}", HullInputs.Turned(prism, turn), volume);
                }
            }
            foreach (var noise in (float[])[1e-7f, 1e-6f, 1e-5f, 1e-4f])
                data.Add($"noisy cube {noise}", HullInputs.NoisyCube(2000, noise, random), 1);
            foreach (var thickness in (float[])[1e-1f, 1e-2f, 1e-3f, 1e-4f, 2e-5f])
            {
                var turn = HullInputs.Turn(random);
                data.Add($"sliver {thickness}", HullInputs.Box(1, thickness, 1), thickness);
                data.Add($"needle {thickness}", HullInputs.Box(thickness, 1, thickness), thickness * thickness);
                data.Add($"disc {thickness}", HullInputs.Prism(1000, thickness), HullInputs.PrismVolume(1000, thickness));
                if (thickness < 1e-4f)
                    continue;
                data.Add($"turned sliver {thickness}", HullInputs.Turned(HullInputs.Box(1, thickness, 1), turn), thickness);
                data.Add($"turned needle {thickness}", HullInputs.Turned(HullInputs.Box(thickness, 1, thickness), turn), thickness * thickness);
                data.Add($"turned disc {thickness}", HullInputs.Turned(HullInputs.Prism(1000, thickness), turn), HullInputs.PrismVolume(1000, thickness));
            }
            foreach (var count in (int[])[1000, 10_000, 100_000])
                data.Add($"sphere {count}", HullInputs.Sphere(count), Math.PI * 4 / 3);
            data.Add("doubled box", [.. Enumerable.Repeat(HullInputs.Box(1, 1, 1), 100).SelectMany(p => p)], 1);
            data.Add("far box", HullInputs.Moved(HullInputs.Box(1, 1, 1), new(1e4f, -1e4f, 1e4f)), 1);
            data.Add("far prism", HullInputs.Moved(HullInputs.Prism(20, 2), new(1e4f)), HullInputs.PrismVolume(20, 2));
            return data;
        }
    }

    [Theory, MemberData(nameof(ClosedForms), DisableDiscoveryEnumeration = true)]
    public void VolumesAreThoseOfClosedForms(string name, Vector3[] points, double volume)
    {
        using var pool = new BufferPool();
        var watch = Stopwatch.StartNew();
        Assert.True(ConvexHullHelper.TryCreateShape(points, pool, out var center, out var hull, out var failure), failure.ToString());
        var milliseconds = watch.Elapsed.TotalMilliseconds;
        var checker = new HullChecker(hull);
        var fault = checker.FindFault();
        var outside = checker.FarthestOutside(points, center);
        output.WriteLine($"{name}: {points.Length} points, {checker.Vertices.Count} V, {checker.Faces.Count} F, " +
            $"volume {checker.Volume / volume - 1:e1}, outside {outside:e1}, {milliseconds:f2} ms");
        Assert.Null(fault);
        Assert.True(Math.Abs(checker.Volume / volume - 1) < 0.01);
        Assert.True(outside < 1e-4 + 1e-7 * center.Length() / checker.Size);
        hull.Dispose(pool);
        pool.AssertEmpty();
    }

    /// <summary>
    /// Flat cones and prisms with a rim like a razor, every point three times with some noise: points that are near the planes of both sides
    /// of an edge are far outside once another point has made the edge blunt.
    /// </summary>
    [Theory, InlineData(2990), InlineData(15476), InlineData(40010)]
    public void PointsBesideAnEdgeThatBecameBluntAreInside(int seed)
    {
        using var pool = new BufferPool();
        var points = ConvexHullFuzzTests.Generate(seed, out _);
        // Of a size that a shape can have however thin: by a power of two, which rounds nothing.
        var scale = MathF.ScaleB(1, -MathF.ILogB(points.Max(p => p.Length())));
        points = [.. points.Select(p => p * scale)];
        Assert.True(ConvexHullHelper.TryCreateShape(points, pool, out var center, out var hull, out var failure), failure.ToString());
        var checker = new HullChecker(hull);
        Assert.Null(checker.FindFault());
        // Four roundings of the largest coordinate, as documented, and those of the vertices in the hull's frame.
        var largest = points.Max(p => Math.Max(Math.Abs(p.X), Math.Max(Math.Abs(p.Y), Math.Abs(p.Z))));
        var allowed = 2.4e-7 * largest / checker.Size + 2e-7;
        Assert.InRange(checker.FarthestOutside(points, center), double.MinValue, allowed);
        hull.Dispose(pool);
        pool.AssertEmpty();
    }

    /// <summary>Time is for the reader: what else the machine does is part of it.</summary>
    [Fact]
    public void TimeGrowsWithTheNumberOfPoints()
    {
        var random = new Random(7);
        foreach (var count in (int[])[1000, 1000, 10_000, 100_000])
        {
            Measure("sphere", HullInputs.Sphere(count));
            Measure("cube full", [.. Enumerable.Range(0, count).Select(_ => HullInputs.InCube(random))]);
            Measure("cube surface", HullInputs.NoisyCube(count, 0, random));
            Measure("disc", HullInputs.Prism(count / 2, 0.001f));
            Measure("flat circle with an apex", [.. HullInputs.Prism(count / 2, 1).Select(p => p.Y > 0 ? p with { Y = -0.5f } : Vector3.UnitY)]);
        }
    }

    void Measure(string name, Vector3[] points)
    {
        using var pool = new BufferPool();
        var watch = Stopwatch.StartNew();
        Assert.True(ConvexHullHelper.CreateShape(points, pool, out _, out var hull));
        output.WriteLine($"{name}, {points.Length} points: {watch.Elapsed.TotalMilliseconds:f1} ms, {hull.VertexCount} V, {hull.FaceCount} F, " +
            $"{pool.GetTotalAllocatedByteCount() / 1e6:f1} MB");
        hull.Dispose(pool);
        pool.AssertEmpty();
    }
}
