using System;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuUtilities.Memory;
using Demos.References;
using FsCheck;
using FsCheck.Fluent;
using Xunit;

namespace DemoTests.Collidables;

/// <summary>What is particular to cylinders: round bounds, flat ends, the axis.</summary>
public sealed class CylinderTests
{
    [Fact]
    public void BoundsAreThoseOfTwoDiscs() =>
        Prop.ForAll((from shape in ShapeGenerators.Cylinders from orientation in ShapeGenerators.Orientations select (shape, orientation)).ToArbitrary(), c =>
        {
            c.shape.ComputeBounds(c.orientation, out var min, out var max);
            var rotation = DoubleQuaternion.Normalize(c.orientation);
            var axis = rotation.Rotate(new(0, 1, 0));
            double x = Reach(axis.X), y = Reach(axis.Y), z = Reach(axis.Z);
            var expected = new Double3(x, y, z);
            var tolerance = ShapeOracle.Size(c.shape).Largest * 1e-6;
            return (expected - max).Length <= tolerance && (expected + (Double3)min).Length <= tolerance;

            // The farthest point of both ends along a coordinate axis.
            double Reach(double along) => c.shape.HalfLength * Math.Abs(along) + c.shape.Radius * Math.Sqrt(Math.Max(0, 1 - along * along));
        }).Check(ShapeGenerators.Reproducible(500));

    [Fact]
    public void ThinCoinsHaveExactBoundsWhenTheyLieFlat()
    {
        new Cylinder(1000, 0.002f).ComputeBounds(Quaternion.Identity, out var min, out var max);
        Assert.Equal(new(1000, 0.001f, 1000), max);
        Assert.Equal(-max, min);
        new Cylinder(0.001f, 2000).ComputeBounds(Quaternion.Identity, out min, out max);
        Assert.Equal(new(0.001f, 1000, 0.001f), max);
        Assert.Equal(-max, min);
    }

    [Fact]
    public void RaysMeetSideAndEnds()
    {
        var cylinder = new Cylinder(1, 4);
        AssertHit(cylinder, new(5, 1.5f, 0), new(-2, 0, 0), 2, Vector3.UnitX);
        AssertHit(cylinder, new(0.5f, 6, 0), new(0, -0.5f, 0), 8, Vector3.UnitY);
        AssertHit(cylinder, new(0.5f, -6, 0), new(0, 1, 0), 4, -Vector3.UnitY);
        AssertHit(cylinder, new(0, 4, -2), new(0, -1, 1), 2, Vector3.UnitY);
        AssertHit(cylinder, new(0.6f, 0, 5), new(0, 0, -1), 4.2f, new(0.6f, 0, 0.8f));
        AssertMiss(cylinder, new(5, 2.1f, 0), new(-1, 0, 0));
        AssertMiss(cylinder, new(1.000001f, 6, 0), new(0, -1, 0));
        AssertMiss(cylinder, new(1.000001f, 6, 0), new(1e-30f, -1, 0));
        AssertMiss(cylinder, new(5, 0, 0), Vector3.UnitX);
        AssertMiss(cylinder, new(0, 5, 0), Vector3.UnitY);
        AssertHit(cylinder, new(0.999999f, 6, 0), new(1e-25f, -1, 0), 4, Vector3.UnitY);
        AssertHit(cylinder, new(0.999f, 6, 0), new(1e-18f, -1, 1e-20f), 4, Vector3.UnitY);
    }

    [Fact]
    public void RaysFromInsideHaveTheNormalOfTheNearestSurface()
    {
        var cylinder = new Cylinder(1, 4);
        AssertHit(cylinder, new(0.9f, 1, 0), new(-1, 2, 1), 0, Vector3.UnitX);
        AssertHit(cylinder, new(0.5f, 1.9f, 0), new(-1, -2, 1), 0, Vector3.UnitY);
        AssertHit(cylinder, new(0.5f, -1.9f, 0), new(-1, 2, 1), 0, -Vector3.UnitY);
        // On the axis no part of the side is nearest: against the ray across the axis.
        AssertHit(cylinder, default, new(0, 2, 3), 0, -Vector3.UnitZ);
        AssertHit(cylinder, default, new(0, 2, 0), 0, Vector3.UnitX);
        AssertHit(cylinder, new(0, 1.5f, 0), new(1, 1, 1), 0, Vector3.UnitY);
    }

    [Fact]
    public void WhatIsNotARayHitsNothing()
    {
        foreach (var origin in (ReadOnlySpan<Vector3>)[default, new(5, 0, 0), new(float.NaN, 0, 0), new(3e38f, 2e38f, 0), new(float.PositiveInfinity, 0, 0)])
        {
            foreach (var direction in (ReadOnlySpan<Vector3>)[default, new(float.NaN, 1, 0), new(0, float.PositiveInfinity, 0)])
                AssertMiss(new Cylinder(1, 2), origin, direction);
        }
        AssertMiss(new Cylinder(1, 2), new(float.NaN, 0, 0), Vector3.UnitX);
        AssertMiss(new Cylinder(1, 2), new(3e38f, 2e38f, 0), Vector3.UnitY);
    }

    [Theory]
    [InlineData(1e-6f)]
    [InlineData(1e-3f)]
    [InlineData(1e3f)]
    [InlineData(1e7f)]
    public void TheSmallestAndTheLargestKeepTheirRays(float size)
    {
        RigidPose pose = new(new Vector3(size, 0, 0), Quaternion.CreateFromAxisAngle(Vector3.UnitZ, 0.5f));
        Assert.Null(RayPropertyTests.Disagreement(
            new Cylinder(size, size), pose, new(0.3f * size, 4 * size, 0.2f * size), new(size * 0.2f, -size, 0)));
    }

    [Theory]
    [InlineData(0f)]
    [InlineData(-1f)]
    [InlineData(1e-7f)]
    [InlineData(1e8f)]
    [InlineData(float.NaN)]
    [InlineData(float.PositiveInfinity)]
    public void BadSizesAreRefusedByFieldAndValue(float size)
    {
        using var pool = new BufferPool();
        var shapes = new Shapes(pool, 1);
        var exception = Assert.Throws<ArgumentOutOfRangeException>(() => shapes.Add(new Cylinder { Radius = size, HalfLength = 1 }));
        Assert.Equal((nameof(Cylinder.Radius), (object)size), (exception.ParamName, exception.ActualValue));
        exception = Assert.Throws<ArgumentOutOfRangeException>(() => shapes.Add(new Cylinder { Radius = 1, HalfLength = size }));
        Assert.Equal((nameof(Cylinder.HalfLength), (object)size), (exception.ParamName, exception.ActualValue));
        Assert.Throws<ArgumentOutOfRangeException>(() => new Cylinder { Radius = 1, HalfLength = size }.ComputeInertia(1));
        Assert.Equal(0, shapes.RegisteredTypeSpan);
        shapes.Dispose();
    }

    static void AssertHit(Cylinder shape, Vector3 origin, Vector3 direction, float t, Vector3 normal)
    {
        Assert.True(shape.RayTest(RigidPose.Identity, origin, direction, out var actualT, out var actualNormal));
        Assert.Equal(t, actualT, 1e-5f);
        Assert.True((normal - actualNormal).Length() < 1e-5f, $"Expected {normal}, got {actualNormal}.");
    }

    static void AssertMiss(Cylinder shape, Vector3 origin, Vector3 direction)
    {
        Assert.False(shape.RayTest(RigidPose.Identity, origin, direction, out var t, out var normal));
        Assert.Equal((0, Vector3.Zero), (t, normal));
    }
}
