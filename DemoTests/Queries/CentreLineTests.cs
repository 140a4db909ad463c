using System;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuPhysics.CollisionDetection;
using BepuUtilities.Memory;
using Xunit;

namespace DemoTests.Queries;

/// <summary>What is apart along the line through the centres, beside planes across it in doubles.</summary>
public sealed unsafe class CentreLineTests : IDisposable
{
    readonly BufferPool pool = new();

    public void Dispose() => pool.Dispose();

    static Quaternion NextOrientation(Random random) => Quaternion.Normalize(
        new(random.NextSingle() - .5f, random.NextSingle() - .5f, random.NextSingle() - .5f, random.NextSingle() - .4f));

    static Vector3 NextVector(Random random) => new(random.NextSingle() - .5f, random.NextSingle() - .5f, random.NextSingle() - .5f);

    [Fact]
    public void WhatIsApartAlongTheLineIsSaidToBe()
    {
        var random = new Random(3);
        var points = new Vector3[20];
        foreach (ref var point in points.AsSpan())
            point = NextVector(random) * 2;
        var sphere = new Sphere(.7f);
        var capsule = new Capsule(.3f, 2);
        var box = new Box(1, .2f, 3);
        var cylinder = new Cylinder(.8f, .5f);
        var hull = new ConvexHull(points, pool, out _);
        var shapes = new void*[] { &sphere, &capsule, &box, &cylinder, &hull };
        int[] types = [Sphere.Id, Capsule.Id, Box.Id, Cylinder.Id, ConvexHull.Id];
        int apart = 0, near = 0;
        for (int i = 0; i < 50_000; ++i)
        {
            int a = random.Next(shapes.Length), b = random.Next(shapes.Length);
            Quaternion turnA = NextOrientation(random), turnB = NextOrientation(random);
            var offset = NextVector(random) * 4;
            var margin = random.Next(2) * random.NextSingle();
            var says = CentreLine.ShowsApart(types[a], shapes[a], turnA, types[b], shapes[b], turnB, offset, margin);
            var gap = Gap(types[a], shapes[a], turnA, types[b], shapes[b], turnB, offset);
            if (Math.Abs(gap - margin) > 1e-4)
                Assert.Equal(gap > margin, says);
            else
                Assert.False(says && gap < margin, $"{types[a]} and {types[b]} are {gap} m apart, at a margin of {margin}.");
            near += says ? 0 : 1;
            apart += says ? 1 : 0;
        }
        Assert.True(near > 10_000 && apart > 10_000, $"{near} near, {apart} apart");
        hull.Dispose(pool);
    }

    // Between two planes across the line, with the shapes on their outer sides, in doubles.
    static double Gap(int typeA, void* shapeA, Quaternion turnA, int typeB, void* shapeB, Quaternion turnB, Vector3 offset)
    {
        var a = new ImpactBody(ImpactCore.Of(typeA, shapeA), DoubleMatrix3x3.FromQuaternion(turnA), default);
        var b = new ImpactBody(ImpactCore.Of(typeB, shapeB), DoubleMatrix3x3.FromQuaternion(turnB), default);
        var line = new DoubleVector3(offset);
        var direction = line * (1 / line.Length);
        return line.Length - a.Extent(direction) - a.Core.Margin - b.Extent(-direction) - b.Core.Margin;
    }

    [Fact]
    public void ShapesWithoutAnInsideOrWithTheSameCentreAreNeverSaidToBeApart()
    {
        var sphere = new Sphere(1);
        var triangle = new Triangle(Vector3.Zero, Vector3.UnitX, Vector3.UnitZ);
        var turn = Quaternion.Identity;
        Assert.False(CentreLine.ShowsApart(Sphere.Id, &sphere, turn, Triangle.Id, &triangle, turn, new(100, 0, 0), 0));
        Assert.False(CentreLine.ShowsApart(Triangle.Id, &triangle, turn, Sphere.Id, &sphere, turn, new(100, 0, 0), 0));
        Assert.False(CentreLine.ShowsApart(Sphere.Id, &sphere, turn, Sphere.Id, &sphere, turn, default, 0));
        Assert.True(CentreLine.ShowsApart(Sphere.Id, &sphere, turn, Sphere.Id, &sphere, turn, new(2.001f, 0, 0), 0));
        Assert.False(CentreLine.ShowsApart(Sphere.Id, &sphere, turn, Sphere.Id, &sphere, turn, new(2.001f, 0, 0), .002f));
    }
}
