using System;
using System.Collections.Generic;
using System.Linq;
using System.Numerics;
using BepuPhysics.Collidables;
using BepuPhysics.CollisionDetection;
using Xunit;

namespace DemoTests.CollisionDetection;

/// <summary>How many contacts triangles have, where they are, and which sides they are on.</summary>
public sealed class TriangleManifoldTests
{
    // Clockwise from above.
    static Triangle Floor(float size, bool twoSided = false) =>
        new(new(-size, 0, -size), new(size, 0, -size), new(0, 0, size)) { TwoSided = twoSided };

    static readonly Quaternion Lying = Quaternion.CreateFromAxisAngle(Vector3.UnitZ, MathF.PI / 2);

    static ConvexContactManifold Run(Capsule capsule, Triangle triangle, Vector3 position, Quaternion orientation, float margin = 0) =>
        PairHarness.Run<Capsule, Triangle>(new(capsule, triangle, -position, orientation, Quaternion.Identity), margin);

    static ConvexContactManifold Run(Sphere sphere, Triangle triangle, Vector3 position, float margin = 0) =>
        PairHarness.Run<Sphere, Triangle>(new(sphere, triangle, -position, Quaternion.Identity, Quaternion.Identity), margin);

    static void AssertPlaces(in ConvexContactManifold manifold, params Vector3[] expected)
    {
        List<Vector3> places = [.. Enumerable.Range(0, manifold.Count).Select(manifold.GetOffset)];
        Assert.Equal(expected.Length, places.Count);
        foreach (var place in expected)
            Assert.True(places.Min(p => Vector3.Distance(p, place)) < 1e-4f, $"no contact at {place} among {string.Join(", ", places)}");
    }

    static void AssertVector(Vector3 expected, Vector3 actual) =>
        Assert.True(Vector3.Distance(expected, actual) < 1e-5f, $"{actual} for {expected}");

    [Fact]
    public void TheFrontIsTheSideOfClockwiseCorners()
    {
        var manifold = Run(new Sphere(0.5f), Floor(2), new(0, 0.4f, 0));
        Assert.Equal(1, manifold.Count);
        AssertVector(Vector3.UnitY, manifold.Normal);
        Assert.Equal(0.1f, manifold.GetDepth(0), 1e-6f);
        AssertVector(new(0, -0.45f, 0), manifold.GetOffset(0));
        Assert.Equal(0, Run(new Sphere(0.5f), Floor(2), new(0, -0.4f, 0)).Count);
        var back = Run(new Sphere(0.5f), Floor(2, true), new(0, -0.4f, 0));
        AssertVector(-Vector3.UnitY, back.Normal);
        Assert.Equal(0.1f, back.GetDepth(0), 1e-6f);
    }

    [Fact]
    public void ASphereIsHeldUntilItsCenterHasPassed()
    {
        Assert.Equal(0.499f, Run(new Sphere(0.5f), Floor(2), new(0, 0.001f, 0)).GetDepth(0), 1e-6f);
        Assert.Equal(0, Run(new Sphere(0.5f), Floor(2), new(0, -0.001f, 0)).Count);
        Assert.Equal(0, Run(new Sphere(0.5f), Floor(2), new(2.1f, -0.001f, -2)).Count);
    }

    [Fact]
    public void ACenterOnTheTriangleLeavesByTheFront()
    {
        foreach (var twoSided in (ReadOnlySpan<bool>)[false, true])
        {
            foreach (var position in (ReadOnlySpan<Vector3>)[default, new(-2, 0, -2), new(0, 0, -2)])
            {
                var sphere = Run(new Sphere(0.5f), Floor(2, twoSided), position);
                AssertVector(Vector3.UnitY, sphere.Normal);
                Assert.Equal(0.5f, sphere.GetDepth(0), 1e-6f);
                var point = Run(new Capsule(0.5f, 0), Floor(2, twoSided), position, Quaternion.Identity);
                AssertVector(Vector3.UnitY, point.Normal);
                Assert.Equal(0.5f, point.GetDepth(0), 1e-6f);
                // A capsule in the plane has no better way than up either.
                var lying = Run(new Capsule(0.5f, 1), Floor(2, twoSided), position with { Z = position.Z * 0.5f, X = position.X * 0.2f }, Lying);
                AssertVector(Vector3.UnitY, lying.Normal * MathF.Sign(lying.Normal.Y));
                Assert.Equal(0.5f, lying.GetDepth(0), 1e-6f);
            }
        }
    }

    [Fact]
    public void ALyingCapsuleHasContactsAtItsEnds()
    {
        var manifold = Run(new Capsule(0.5f, 1), Floor(4), new(0, 0.49f, 0), Lying);
        AssertVector(Vector3.UnitY, manifold.Normal);
        AssertPlaces(manifold, new(-0.5f, -0.495f, 0), new(0.5f, -0.495f, 0));
        Assert.NotEqual(manifold.GetFeatureId(0), manifold.GetFeatureId(1));
    }

    [Fact]
    public void ALongCapsuleHasContactsAtTheBorder()
    {
        // At z = 0 the floor of size 4 reaches from -2 to 2.
        var manifold = Run(new Capsule(0.5f, 10), Floor(4), new(0, 0.49f, 0), Lying);
        AssertPlaces(manifold, new(-2, -0.495f, 0), new(2, -0.495f, 0));
        manifold = Run(new Capsule(0.5f, 2), Floor(4), new(1.5f, 0.49f, 0), Lying);
        AssertPlaces(manifold, new(-1, -0.495f, 0), new(0.5f, -0.495f, 0));
    }

    [Fact]
    public void ACapsuleAlongAnEdgeHasContactsAtItsEnds()
    {
        // Along the edge at z = -4, over it and beside it.
        foreach (var beside in (ReadOnlySpan<float>)[0, 1e-7f, -1e-7f, 0.2f, 0.4f])
        {
            var height = MathF.Sqrt(0.25f - beside * beside) - 0.01f;
            var manifold = Run(new Capsule(0.5f, 2), Floor(4), new(0, height, -4 - beside), Lying);
            Assert.Equal(2, manifold.Count);
            Assert.Equal(manifold.GetDepth(0), manifold.GetDepth(1), 1e-5f);
            Assert.Equal(2, MathF.Abs(manifold.GetOffset(0).X - manifold.GetOffset(1).X), 1e-4f);
        }
    }

    [Fact]
    public void AStandingCapsuleHasOneContact()
    {
        var manifold = Run(new Capsule(0.5f, 2), Floor(4), new(0, 1.49f, 0), Quaternion.Identity);
        AssertVector(Vector3.UnitY, manifold.Normal);
        AssertPlaces(manifold, new Vector3(0, -1.495f, 0));
    }

    [Fact]
    public void ACrossingCapsuleIsHeldUntilItsCenterHasPassed()
    {
        var manifold = Run(new Capsule(0.1f, 2), Floor(40), new(0, 0.3f, 0), Quaternion.Identity);
        AssertVector(Vector3.UnitY, manifold.Normal);
        Assert.Equal(0.8f, manifold.GetDepth(0), 1e-5f);
        AssertVector(new(0, -0.7f, 0), manifold.GetOffset(0));
        Assert.Equal(0, Run(new Capsule(0.1f, 2), Floor(40), new(0, -0.3f, 0), Quaternion.Identity).Count);
        manifold = Run(new Capsule(0.1f, 2), Floor(40, true), new(0, -0.3f, 0), Quaternion.Identity);
        AssertVector(-Vector3.UnitY, manifold.Normal);
        Assert.Equal(0.8f, manifold.GetDepth(0), 1e-5f);
    }

    [Fact]
    public void ACapsuleFromBehindIsNotCaughtByEdges()
    {
        // A square floor of two triangles, and a capsule that pokes through it from below near their common edge, at all tilts.
        Triangle first = new(new(-2, 0, -2), new(2, 0, -2), new(2, 0, 2)), second = new(new(-2, 0, -2), new(2, 0, 2), new(-2, 0, 2));
        var random = new PairRandom(4);
        for (int i = 0; i < 500; ++i)
        {
            var turn = Quaternion.CreateFromAxisAngle(Vector3.Normalize(random.NextDirection() with { Y = 0 }), random.Next(0, 1.4));
            var position = new Vector3(random.Next(-1, 1), -0.01f - random.Next(0, 1), 0);
            position.Z = position.X + random.Next(-0.3, 0.3);
            Assert.Equal(0, Run(new Capsule(0.2f, 1), first, position, turn, 0.1f).Count);
            Assert.Equal(0, Run(new Capsule(0.2f, 1), second, position, turn, 0.1f).Count);
        }
    }

    [Fact]
    public void NormalsOfOneSidedTrianglesDoNotPointBehind()
    {
        // Beside the border, the centre above the plane and the nearest point below it.
        var tilted = Quaternion.CreateFromAxisAngle(Vector3.UnitX, -0.6f);
        var offset = Vector3.Transform(new(0, 0.8f, 0), tilted) + new Vector3(0, -0.05f, -2.1f);
        Assert.True(offset.Y > 0);
        Assert.Equal(1, Run(new Capsule(0.2f, 2), Floor(2, true), offset, tilted).Count);
        var manifold = Run(new Capsule(0.2f, 2), Floor(2), offset, tilted);
        Assert.True(manifold.Count == 0 || manifold.Normal.Y > -1e-3f);
    }

    [Fact]
    public void NoCapsuleFallsThroughAClosedSurface()
    {
        // Four triangles around a ridge: the capsule across it, with its centre anywhere along, always has a contact.
        Vector3 top0 = new(0, 1, -3), top1 = new(0, 1, 3), left0 = new(-3, -2, -3), left1 = new(-3, -2, 3), right0 = new(3, -2, -3), right1 = new(3, -2, 3);
        Triangle[] roof = [new(top0, top1, left0), new(left0, top1, left1), new(top0, right0, top1), new(top1, right0, right1)];
        foreach (var triangle in roof)
            Assert.True(Vector3.Cross(triangle.C - triangle.A, triangle.B - triangle.A).Y > 0);
        var random = new PairRandom(6);
        for (int i = 0; i < 500; ++i)
        {
            var place = random.Next(-0.9, 0.9);
            var turn = Quaternion.CreateFromAxisAngle(Vector3.UnitZ, MathF.PI / 2 + random.Next(-0.6, 0.6));
            turn = Quaternion.CreateFromAxisAngle(Vector3.UnitY, random.Next(-0.3, 0.3)) * turn;
            var axis = Vector3.Transform(Vector3.UnitY, turn);
            var normal = Vector3.Normalize(Vector3.Cross(axis, Vector3.UnitZ));
            normal *= MathF.Sign(normal.Y);
            var position = new Vector3(0, 1, random.Next(-1, 1)) + normal * 0.19f + axis * place;
            var deepest = roof.SelectMany(x => Depths(Run(new Capsule(0.2f, 2), x, position, turn))).DefaultIfEmpty(-1).Max();
            Assert.Equal(0.01f, deepest, 1e-4f);
        }

        static IEnumerable<float> Depths(ConvexContactManifold manifold) => Enumerable.Range(0, manifold.Count).Select(manifold.GetDepth);
    }

    [Fact]
    public void SizesFarFromOneMetreKeepTheirContacts()
    {
        foreach (var size in (ReadOnlySpan<float>)[1e-4f, 1e-2f, 1e2f, 1e5f])
        {
            var manifold = Run(new Capsule(0.5f * size, size), Floor(4 * size), new(0, 0.49f * size, 0), Lying);
            Assert.Equal(2, manifold.Count);
            Assert.Equal(0.01f, manifold.GetDepth(0) / size, 1e-5f);
            AssertVector(Vector3.UnitY, manifold.Normal);
            var sphere = Run(new Sphere(0.5f * size), Floor(4 * size), new(0, 0.49f * size, 0));
            Assert.Equal(0.01f, sphere.GetDepth(0) / size, 1e-5f);
        }
    }
}
