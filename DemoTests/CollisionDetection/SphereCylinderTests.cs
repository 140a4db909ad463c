using System;
using System.Collections.Generic;
using System.Linq;
using System.Numerics;
using BepuPhysics.Collidables;
using DemoTests.CollisionDetection.References;
using Xunit;
using Xunit.Abstractions;

namespace DemoTests.CollisionDetection;

/// <summary>Spheres against cylinders, coins and rods among them.</summary>
public sealed class SphereCylinderTests(ITestOutputHelper output)
{
    const float Margin = 0.2f;

    static PairCase<Sphere, Cylinder>[] CreateCases(int count)
    {
        var random = new PairRandom(41);
        var cases = new PairCase<Sphere, Cylinder>[count];
        for (int i = 0; i < count; ++i)
        {
            var sphere = new Sphere(random.NextLogarithmic(0.01, 1));
            var cylinder = new Cylinder(random.NextLogarithmic(0.01, 1), random.NextLogarithmic(0.02, 2));
            var orientation = random.NextOrientation();
            // A point of the surface, or of the axis, and how far from it along a direction that could be a normal there.
            var around = Vector3.Normalize(random.NextDirection() with { Y = 0 } + new Vector3(1e-4f, 0, 0));
            var side = random.Next(2) == 0 ? 1 : -1;
            var (point, normal) = random.Next(4) switch
            {
                0 => (around * cylinder.Radius + Vector3.UnitY * (cylinder.HalfLength * random.Next(-1, 1)), around),
                1 => (around * (cylinder.Radius * random.Next(0, 1)) + Vector3.UnitY * (cylinder.HalfLength * side), Vector3.UnitY * side),
                2 => (around * cylinder.Radius + Vector3.UnitY * (cylinder.HalfLength * side),
                    Vector3.Normalize(around * random.Next(0, 1) + Vector3.UnitY * (side * random.Next(0.01, 1)))),
                _ => (Vector3.UnitY * (cylinder.HalfLength * random.Next(-1.2, 1.2)), around),
            };
            var size = Math.Min(sphere.Radius, Math.Min(cylinder.Radius, cylinder.HalfLength));
            var gap = (i % 5) switch
            {
                0 => size * random.Next(0, 0.3),
                1 => size * random.Next(-1e-5, 1e-5),
                2 => -size * random.Next(0, 0.05),
                3 => -sphere.Radius - cylinder.Radius * random.Next(-1, 1),
                _ => -sphere.Radius + (random.Next(2) == 0 ? 0 : size * random.NextLogarithmic(1e-8, 1e-2)),
            };
            var center = Vector3.Transform(point + normal * (sphere.Radius + gap), orientation);
            cases[i] = new(sphere, cylinder, -center, random.NextOrientation(), orientation);
        }
        return cases;
    }

    [Fact]
    public void SphereCylinder()
    {
        const double Tolerance = 1e-6;
        var cases = CreateCases(100_000);
        var manifolds = PairHarness.Run(cases, Margin);
        List<double> depthErrors = [], relativeErrors = [], normalErrors = [], placeErrors = [];
        for (int i = 0; i < cases.Length; ++i)
        {
            var (sphere, cylinder, offset, _, orientation) = cases[i];
            var center = -new Double3(offset);
            var axis = Double3.RotatedAxis(orientation, 1);
            double Distance(Double3 point) => SignedDistance(cylinder, axis, point);
            var size = sphere.Radius + Math.Sqrt(cylinder.Radius * (double)cylinder.Radius + cylinder.HalfLength * (double)cylinder.HalfLength);
            var smaller = Math.Min(sphere.Radius, Math.Sqrt(cylinder.Radius * (double)cylinder.Radius + cylinder.HalfLength * (double)cylinder.HalfLength));
            var distance = Distance(center);
            var depth = sphere.Radius - distance;
            ref var manifold = ref manifolds[i];
            Assert.True(manifold.Count == 1 || depth < -Margin + Tolerance * size, "missed");
            Assert.True(manifold.Count == 0 || depth > -Margin - Tolerance * size, "needless");
            if (manifold.Count == 0)
                continue;
            depthErrors.Add(Math.Abs(depth - manifold.GetDepth(0)) / size);
            relativeErrors.Add(Math.Abs(depth - manifold.GetDepth(0)) / smaller);
            // The support of the cylinder along the normal says how deep the pair is there, for any normal.
            var normal = new Double3(manifold.Normal);
            Assert.Equal(1, normal.Length, 5e-6);
            normal *= 1 / normal.Length;
            var along = Double3.Dot(axis, normal);
            var extent = cylinder.HalfLength * Math.Abs(along) + cylinder.Radius * (normal - axis * along).Length;
            var error = Math.Abs(extent - Double3.Dot(center, normal) + sphere.Radius - depth) / size;
            normalErrors.Add(Math.Max(0, error - 3e-7 * size / Math.Abs(distance)));
            // Halfway between the two surfaces along the normal.
            var place = new Double3(manifold.GetOffset(0));
            var halfway = normal * (manifold.GetDepth(0) * 0.5);
            placeErrors.Add(Math.Max(
                Math.Abs((place - halfway).Length - sphere.Radius), Math.Abs(Distance(center + place + halfway))) / size);
        }
        output.WriteLine($"Sphere-Cylinder, {depthErrors.Count} pairs; p50, p99.9, worst:");
        Print("depth by size of the pair", depthErrors);
        Print("depth by size of the smaller", relativeErrors);
        Print("depth along the normal", normalErrors);
        Print("place of contacts", placeErrors);
        Assert.True(depthErrors[^1] < Tolerance);
        Assert.True(normalErrors[^1] < Tolerance);
        Assert.True(placeErrors[^1] < Tolerance);
    }

    void Print(string name, List<double> errors)
    {
        errors.Sort();
        output.WriteLine($"  {name,-30} {errors[errors.Count / 2],10:e1} {errors[(int)(errors.Count * 0.999)],10:e1} {errors[^1],10:e1}");
    }

    /// <summary>Distance of a point from the surface of a cylinder around the origin, negative inside.</summary>
    static double SignedDistance(Cylinder cylinder, Double3 axis, Double3 point)
    {
        var along = Double3.Dot(axis, point);
        double side = (point - axis * along).Length - cylinder.Radius, end = Math.Abs(along) - cylinder.HalfLength;
        return side <= 0 || end <= 0 ? Math.Max(side, end) : Math.Sqrt(side * side + end * end);
    }

    [Fact]
    public void ACenterOnTheAxisLeavesByTheNearestSurface()
    {
        Vector3[] positions = [default, new(0, 0.2f, 0), new(0, 0.9f, 0), new(0, -0.9f, 0), new(1e-30f, 0, 0)];
        foreach (var position in positions)
        {
            var manifold = PairHarness.Run<Sphere, Cylinder>(
                new(new(0.3f), new(0.5f, 2), -position, Quaternion.Identity, Quaternion.Identity));
            var byEnd = MathF.Abs(position.Y) > 0.5f;
            Assert.Equal(1, manifold.Count);
            Assert.Equal(0.3f + (byEnd ? 0.1f : 0.5f), manifold.GetDepth(0), 1e-6f);
            Assert.Equal(byEnd ? MathF.Sign(position.Y) : 0, manifold.Normal.Y, 1e-6f);
            Assert.Equal(1, manifold.Normal.Length(), 1e-6f);
        }
    }

    [Fact]
    public void ResultsDoNotDependOnTheOtherPairsNorOnTheOrderOfShapes()
    {
        var cases = CreateCases(333);
        var expected = PairHarness.Run(cases, Margin);
        var random = new PairRandom(3);
        int[] order = [.. Enumerable.Range(0, cases.Length).OrderBy(_ => random.Next())];
        var shuffled = PairHarness.Run(cases, Margin, order, 11);
        var swapped = PairHarness.Run(
            [.. cases.Select(x => new PairCase<Cylinder, Sphere>(x.B, x.A, -x.OffsetB, x.OrientationB, x.OrientationA))], Margin);
        for (int i = 0; i < cases.Length; ++i)
        {
            Assert.Equal(expected[i].Count, shuffled[i].Count);
            Assert.Equal(expected[i].Count, swapped[i].Count);
            if (expected[i].Count == 0)
                continue;
            Assert.Equal((expected[i].Normal, expected[i].GetDepth(0), expected[i].GetOffset(0)),
                (shuffled[i].Normal, shuffled[i].GetDepth(0), shuffled[i].GetOffset(0)));
            Assert.Equal((expected[i].Normal, expected[i].GetDepth(0)), (-swapped[i].Normal, swapped[i].GetDepth(0)));
        }
    }
}
