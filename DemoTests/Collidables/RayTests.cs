using System;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using Xunit;

namespace DemoTests.Collidables;

/// <summary>Rays whose answer is known exactly, and the awkward ones by name.</summary>
public class RayTests
{
    [Fact]
    public void RaysInUnitsOfTheirDirection()
    {
        AssertHit(new Sphere(1), Vector3.Zero, new(5, 0, 0), new(-2, 0, 0), 2, Vector3.UnitX);
        AssertHit(new Capsule(1, 2), Vector3.Zero, new(5, 0.5f, 0), new(-2, 0, 0), 2, Vector3.UnitX);
        AssertHit(new Capsule(1, 2), Vector3.Zero, new(0, 6, 0), new(0, -0.5f, 0), 8, Vector3.UnitY);
        AssertHit(new Box(2, 4, 6), Vector3.Zero, new(0.5f, 0.5f, 5), new(0, 0, -2), 1, Vector3.UnitZ);
        AssertHit(new Box(2, 4, 6), new(10, 0, 0), new(10.5f, -5, 1), new(0, 3, 0), 1, -Vector3.UnitY);
    }

    [Theory]
    [InlineData(1e-38f)]
    [InlineData(1e-25f)]
    [InlineData(1e25f)]
    [InlineData(2e38f)]
    public void DirectionsOfAnyLength(float length)
    {
        // A hit 4 m away at 1e-38 m per unit is beyond the numbers there are: no hit.
        var representable = 4 / (double)length < float.MaxValue;
        Vector3 origin = new(5, 0.5f, 0), direction = new(-length, -length, 0);
        foreach (var hit in (ReadOnlySpan<bool>)[
            new Sphere(1).RayTest(RigidPose.Identity, origin, new(-length, 0, 0), out _, out _),
            new Capsule(1, 2).RayTest(RigidPose.Identity, origin, new(-length, 0, 0), out _, out _),
            new Box(2, 2, 2).RayTest(RigidPose.Identity, origin, new(-length, 0, 0), out _, out _)])
            Assert.Equal(representable, hit);
        Assert.False(new Sphere(1).RayTest(RigidPose.Identity, origin, direction, out _, out _));
    }

    public static TheoryData<float, float, float> NoDirections => new()
    {
        { 0, 0, 0 }, { float.NaN, 0, 0 }, { 1, float.NaN, 0 }, { 0, float.PositiveInfinity, 0 }, { float.NegativeInfinity, 1, float.NaN },
    };

    [Theory]
    [MemberData(nameof(NoDirections))]
    public void NoDirectionHitsNothing(float x, float y, float z)
    {
        foreach (var origin in (ReadOnlySpan<Vector3>)[new(5, 0, 0), Vector3.Zero])
        {
            AssertMiss(new Sphere(1), origin, new(x, y, z));
            AssertMiss(new Capsule(1, 2), origin, new(x, y, z));
            AssertMiss(new Box(1, 1, 1), origin, new(x, y, z));
        }
    }

    [Theory]
    [InlineData(float.NaN)]
    [InlineData(float.PositiveInfinity)]
    [InlineData(3e38f)]
    public void OriginsOutOfReachHitNothing(float x)
    {
        AssertMiss(new Sphere(1), new(x, 2e38f, 0), Vector3.UnitY);
        AssertMiss(new Capsule(1, 2), new(x, 2e38f, 0), Vector3.UnitY);
        AssertMiss(new Box(1, 1, 1), new(x, 2e38f, 0), Vector3.UnitY);
    }

    [Fact]
    public void ShapesBehindAreMissed()
    {
        AssertMiss(new Sphere(1), new(5, 0, 0), Vector3.UnitX);
        AssertMiss(new Capsule(1, 2), new(0, 5, 0), Vector3.UnitY);
        AssertMiss(new Capsule(1, 2), new(0, 0, 3), Vector3.UnitZ);
        AssertMiss(new Box(1, 1, 1), new(0, -3, 0), -Vector3.UnitY);
    }

    [Fact]
    public void RaysFromTheCenterHitAtOnceAgainstTheirDirection()
    {
        AssertHit(new Sphere(1), Vector3.Zero, Vector3.Zero, new(0, 3, 0), 0, -Vector3.UnitY);
        AssertHit(new Capsule(1, 2), Vector3.Zero, Vector3.Zero, new(0, 0, 3), 0, -Vector3.UnitZ);
        AssertHit(new Capsule(1, 2), new(7, 7, 7), new(7, 7.5f, 7), new(0, 2, 0), 0, -Vector3.UnitY);
        // A box always has a nearest face.
        AssertHit(new Box(6, 2, 4), Vector3.Zero, Vector3.Zero, new(0, 0, 3), 0, Vector3.UnitY);
    }

    [Fact]
    public void RaysFromInsideHaveTheNormalOfTheNearestSurface()
    {
        AssertHit(new Sphere(1), Vector3.Zero, new(0.5f, 0, 0), new(-1, 0.2f, 0), 0, Vector3.UnitX);
        AssertHit(new Capsule(1, 2), Vector3.Zero, new(0, 0.9f, -0.5f), new(1, 1, 1), 0, -Vector3.UnitZ);
        AssertHit(new Capsule(1, 2), Vector3.Zero, new(0, 1.5f, 0), new(1, -1, 1), 0, Vector3.UnitY);
        AssertHit(new Box(2, 2, 2), Vector3.Zero, new(0.2f, -0.9f, 0.3f), new(1, 5, 1), 0, -Vector3.UnitY);
    }

    [Fact]
    public void RaysAlongTheSidesOfABox()
    {
        var box = new Box(2, 2, 2);
        foreach (var side in (ReadOnlySpan<float>)[-1, 1])
        {
            Assert.True(box.RayTest(RigidPose.Identity, new(5, side * 0.999999f, 0), -Vector3.UnitX, out _, out _));
            Assert.True(box.RayTest(RigidPose.Identity, new(5, side, 0), -Vector3.UnitX, out _, out _));
            Assert.True(box.RayTest(RigidPose.Identity, new(5, side, side), -Vector3.UnitX, out _, out _));
            AssertMiss(box, new(5, side * 1.000001f, 0), -Vector3.UnitX);
            AssertMiss(box, new(5, 0, side * 1.000001f), -Vector3.UnitX);
            // All but parallel, by as little as a float can tell.
            AssertMiss(box, new(5, side * 1.000001f, 0), new(-1, 1e-38f, -1e-30f));
            Assert.True(box.RayTest(RigidPose.Identity, new(5, side, 0), new(-1, side * -1e-38f, 1e-20f), out var t, out var normal));
            Assert.Equal(4, t, 1e-5f);
            Assert.Equal(1, MathF.Abs(normal.X) + MathF.Abs(normal.Y), 1e-6f);
        }
    }

    [Fact]
    public void RaysAlongTheAxisOfACapsule()
    {
        var capsule = new Capsule(0.5f, 2);
        AssertHit(capsule, Vector3.Zero, new(0.3f, 5, 0), -Vector3.UnitY, 5 - 1.4f, new(0.6f, 0.8f, 0));
        AssertHit(capsule, Vector3.Zero, new(0.3f, -5, 0), Vector3.UnitY, 5 - 1.4f, new(0.6f, -0.8f, 0));
        AssertMiss(capsule, new(0.500001f, 5, 0), -Vector3.UnitY);
        AssertMiss(capsule, new(0.500001f, 5, 0), new(1e-30f, -1, 0));
        Assert.True(capsule.RayTest(RigidPose.Identity, new(0.499999f, 5, 0), new(1e-25f, -1, 0), out _, out _));
    }

    [Theory]
    [InlineData(1e2f)]
    [InlineData(1e4f)]
    [InlineData(1e6f)]
    public void FarOriginsKeepTheirPrecision(float distance)
    {
        // Along an axis nothing is lost but the rounding of the distance itself; a quadratic from the origin would lose the whole shape.
        foreach (var offset in (ReadOnlySpan<float>)[0, 0.4f, 0.499f])
        {
            Assert.True(new Sphere(0.5f).RayTest(RigidPose.Identity, new(distance, offset, 0), -Vector3.UnitX, out var t, out var normal));
            Assert.Equal(distance - MathF.Sqrt(0.25f - offset * offset), t, distance * 1e-7f);
            Assert.Equal(offset * 2, normal.Y, 1e-5f);
            Assert.True(new Capsule(0.5f, 3).RayTest(RigidPose.Identity, new(distance, 0.3f, offset), -Vector3.UnitX, out t, out normal));
            Assert.Equal(offset * 2, normal.Z, 1e-5f);
            Assert.True(new Box(1, 1, 1).RayTest(RigidPose.Identity, new(distance, offset, offset), -Vector3.UnitX, out t, out normal));
            Assert.Equal(Vector3.UnitX, normal);
        }
        AssertMiss(new Sphere(0.5f), new(distance, 0.501f, 0), -Vector3.UnitX);
        AssertMiss(new Capsule(0.5f, 3), new(distance, 0.3f, 0.501f), -Vector3.UnitX);
        AssertMiss(new Box(1, 1, 1), new(distance, 0.501f, 0), -Vector3.UnitX);
    }

    [Fact]
    public void TheSmallestAndTheLargestShapes()
    {
        foreach (var size in (ReadOnlySpan<float>)[1e-6f, 1e-3f, 1e3f, 1e7f])
        {
            RigidPose pose = new(new Vector3(size, 0, 0), Quaternion.CreateFromAxisAngle(Vector3.UnitZ, 0.5f));
            Vector3 origin = new(0.3f * size, 4 * size, 0.2f * size), direction = new(size * 0.2f, -size, 0);
            Assert.Null(RayPropertyTests.Disagreement(new Sphere(size), pose, origin, direction));
            Assert.Null(RayPropertyTests.Disagreement(new Capsule(size, size), pose, origin, direction));
            Assert.Null(RayPropertyTests.Disagreement(new Box(size, 2 * size, size), pose, origin, direction));
        }
    }

    static void AssertHit<TShape>(TShape shape, Vector3 position, Vector3 origin, Vector3 direction, float t, Vector3 normal)
        where TShape : unmanaged, IConvexShape
    {
        Assert.True(shape.RayTest(position, origin, direction, out var actualT, out var actualNormal));
        Assert.Equal(t, actualT, 1e-5f);
        Assert.True((normal - actualNormal).Length() < 1e-5f, $"Expected {normal}, got {actualNormal}.");
    }

    static void AssertMiss<TShape>(TShape shape, Vector3 origin, Vector3 direction) where TShape : unmanaged, IConvexShape
    {
        Assert.False(shape.RayTest(RigidPose.Identity, origin, direction, out var t, out var normal));
        Assert.Equal(0, t);
        Assert.Equal(Vector3.Zero, normal);
    }
}
