using System;
using System.Collections.Generic;
using System.Linq;
using System.Numerics;
using BepuPhysics.Collidables;
using BepuPhysics.CollisionDetection;
using Xunit;

namespace DemoTests.CollisionDetection;

/// <summary>How many contacts there are, where they are, and what they are called.</summary>
public sealed class ManifoldTests
{
    static List<Vector3> Places(in ConvexContactManifold manifold) => [.. Enumerable.Range(0, manifold.Count).Select(manifold.GetOffset)];

    static void AssertPlaces(in ConvexContactManifold manifold, params Vector3[] expected)
    {
        var places = Places(manifold);
        Assert.Equal(expected.Length, places.Count);
        foreach (var place in expected)
            Assert.True(places.Min(p => Vector3.Distance(p, place)) < 1e-4f, $"no contact at {place} among {string.Join(", ", places)}");
    }

    [Theory]
    [InlineData(0, 0)]
    [InlineData(0.3f, 0.2f)]
    [InlineData(0.9f, -0.7f)]
    [InlineData(0.95f, 0.5f)]
    public void BoxOnBoxHasTheCornersOfTheOverlap(float x, float z)
    {
        var box = new Box(1, 1, 1);
        var manifold = PairHarness.Run<Box, Box>(new(box, box, new(x, -0.99f, z), Quaternion.Identity, Quaternion.Identity), 0.1f);
        AssertVector(Vector3.UnitY, manifold.Normal);
        // The overlap, with the place halfway between the surfaces.
        float minX = Math.Max(-0.5f, x - 0.5f), maxX = Math.Min(0.5f, x + 0.5f);
        float minZ = Math.Max(-0.5f, z - 0.5f), maxZ = Math.Min(0.5f, z + 0.5f);
        AssertPlaces(manifold, new(minX, -0.495f, minZ), new(minX, -0.495f, maxZ), new(maxX, -0.495f, minZ), new(maxX, -0.495f, maxZ));
        for (int i = 0; i < manifold.Count; ++i)
            Assert.Equal(0.01f, manifold.GetDepth(i), 1e-6f);
    }

    static void AssertVector(Vector3 expected, Vector3 actual) =>
        Assert.True(Vector3.Distance(expected, actual) < 1e-5f, $"{actual} for {expected}");

    [Theory]
    [InlineData(0.1f, 30)]
    [InlineData(30, 0.1f)]
    public void SmallAndLargeBoxHaveTheCornersOfTheSmall(float sizeA, float sizeB)
    {
        var turn = Quaternion.CreateFromAxisAngle(Vector3.UnitY, 0.4f);
        var distance = (sizeA + sizeB) / 2;
        var manifold = PairHarness.Run<Box, Box>(
            new(new(sizeA, sizeA, sizeA), new(sizeB, sizeB, sizeB), new(0.5f, -distance, 0.25f), Quaternion.Identity, turn), 0.01f);
        Assert.Equal(4, manifold.Count);
        var places = Places(manifold);
        Assert.Equal(0.1f * MathF.Sqrt(2), places.Max(p => places.Max(q => Vector3.Distance(p, q))), 1e-4f);
    }

    [Fact]
    public void TurnedBoxOnBoxKeepsMostOfTheOverlap()
    {
        // The overlap of two unit squares turned by 45 degrees is a regular octagon; four of its corners hold half of its area and more.
        var turn = Quaternion.CreateFromAxisAngle(Vector3.UnitY, MathF.PI / 4);
        var manifold = PairHarness.Run<Box, Box>(new(new(1, 1, 1), new(1, 1, 1), new(0, -1, 0), Quaternion.Identity, turn), 0.01f);
        Assert.Equal(4, manifold.Count);
        var places = Places(manifold).OrderBy(p => Math.Atan2(p.Z, p.X)).ToList();
        var area = Enumerable.Range(0, 4).Sum(i => places[i].X * places[(i + 1) % 4].Z - places[i].Z * places[(i + 1) % 4].X) / 2;
        Assert.InRange(Math.Abs(area), 0.5f, 0.83f);
    }

    [Fact]
    public void CrossedEdgesHaveOneContact()
    {
        var a = Quaternion.CreateFromAxisAngle(Vector3.UnitX, MathF.PI / 4);
        var b = Quaternion.CreateFromAxisAngle(Vector3.UnitZ, MathF.PI / 4);
        var distance = MathF.Sqrt(2) - 0.01f;
        var manifold = PairHarness.Run<Box, Box>(new(new(1, 1, 1), new(1, 1, 1), new(0, -distance, 0), a, b), 0);
        var deepest = Enumerable.Range(0, manifold.Count).MaxBy(manifold.GetDepth);
        AssertVector(Vector3.UnitY, manifold.Normal);
        Assert.Equal(0.01f, manifold.GetDepth(deepest), 1e-5f);
        foreach (var place in Places(manifold))
            Assert.True(Vector3.Distance(place, new(0, -distance / 2, 0)) < 0.02f, $"{place}");
    }

    [Fact]
    public void EqualBoxesInOnePlaceHaveContacts()
    {
        var box = new Box(1, 2, 3);
        var manifold = PairHarness.Run<Box, Box>(new(box, box, default, Quaternion.Identity, Quaternion.Identity));
        Assert.Equal(4, manifold.Count);
        AssertVector(Vector3.UnitX, Vector3.Abs(manifold.Normal));
        Assert.Equal(1, manifold.GetDepth(0), 1e-6f);
    }

    [Fact]
    public void CapsuleOnBoxHasContactsAtItsEnds()
    {
        var lying = Quaternion.CreateFromAxisAngle(Vector3.UnitZ, MathF.PI / 2);
        var manifold = PairHarness.Run<Capsule, Box>(new(new(0.5f, 2), new(10, 1, 10), new(0, -0.99f, 0), lying, Quaternion.Identity));
        AssertVector(Vector3.UnitY, manifold.Normal);
        AssertPlaces(manifold, new(-1, -0.495f, 0), new(1, -0.495f, 0));
    }

    [Fact]
    public void CapsuleOverTheBorderHasAContactThere()
    {
        var lying = Quaternion.CreateFromAxisAngle(Vector3.UnitZ, MathF.PI / 2);
        var manifold = PairHarness.Run<Capsule, Box>(new(new(0.5f, 2), new(2, 1, 10), new(-0.75f, -0.99f, 0), lying, Quaternion.Identity));
        AssertVector(Vector3.UnitY, manifold.Normal);
        AssertPlaces(manifold, new(-1, -0.495f, 0), new(0.25f, -0.495f, 0));
    }

    [Fact]
    public void CapsulesAlongEachOtherHaveTheEndsOfTheirCommonStretch()
    {
        var lying = Quaternion.CreateFromAxisAngle(Vector3.UnitZ, MathF.PI / 2);
        var manifold = PairHarness.Run<Capsule, Capsule>(new(new(0.5f, 2), new(0.5f, 2), new(0.5f, -0.99f, 0), lying, lying));
        AssertVector(Vector3.UnitY, manifold.Normal);
        AssertPlaces(manifold, new(-0.5f, -0.495f, 0), new(1, -0.495f, 0));
    }

    [Fact]
    public void CrossedCapsulesHaveOneContact()
    {
        var lying = Quaternion.CreateFromAxisAngle(Vector3.UnitZ, MathF.PI / 2);
        var across = Quaternion.CreateFromAxisAngle(Vector3.UnitX, MathF.PI / 2);
        var manifold = PairHarness.Run<Capsule, Capsule>(new(new(0.5f, 2), new(0.5f, 2), new(0.5f, -0.99f, 0.25f), lying, across));
        AssertPlaces(manifold, new Vector3(0.5f, -0.495f, 0));
    }

    [Fact]
    public void DegenerateSegmentsHaveFiniteContacts()
    {
        var lying = Quaternion.CreateFromAxisAngle(Vector3.UnitZ, MathF.PI / 2);
        Vector3[] offsets = [default, new(0.5f, 0, 0), new(1, 0, 0), new(0, 0.5f, 0), new(0.5f, 0.5f, 0.5f)];
        foreach (var offset in offsets)
        {
            foreach (var turn in new[] { Quaternion.Identity, lying })
            {
                foreach (var length in new[] { 0f, 1f })
                {
                    Check(PairHarness.Run<Capsule, Capsule>(new(new(0.3f, 1), new(0.3f, length), offset, turn, lying)), 0.6f);
                    Check(PairHarness.Run<Capsule, Box>(new(new(0.3f, length), new(1, 1, 1), offset, turn, Quaternion.Identity)), 1.3f);
                    Check(PairHarness.Run<Sphere, Capsule>(new(new(0.3f), new(0.3f, length), offset, Quaternion.Identity, turn)), 0.6f);
                }
            }
            Check(PairHarness.Run<Sphere, Box>(new(new(0.3f), new(1, 1, 1), offset, Quaternion.Identity, Quaternion.Identity)), 0.8f);
            Check(PairHarness.Run<Sphere, Sphere>(new(new(0.3f), new(0.3f), offset, Quaternion.Identity, Quaternion.Identity)), 0.6f);
        }

        static void Check(in ConvexContactManifold manifold, float maximumDepth)
        {
            for (int i = 0; i < manifold.Count; ++i)
            {
                manifold.GetContact(i, out var offset, out var normal, out var depth, out _);
                Assert.Equal(1, normal.Length(), 1e-5f);
                Assert.InRange(depth, 0, maximumDepth + 1e-5f);
                Assert.InRange(offset.Length(), 0, 3);
            }
        }
    }

    [Fact]
    public void CentersInOnePlaceHaveTheDepthOfTheRadii()
    {
        var manifold = PairHarness.Run<Sphere, Sphere>(new(new(0.3f), new(0.5f), default, Quaternion.Identity, Quaternion.Identity));
        Assert.Equal(1, manifold.Count);
        Assert.Equal(Vector3.UnitY, manifold.Normal);
        Assert.Equal(0.8f, manifold.GetDepth(0), 1e-6f);
        manifold = PairHarness.Run<Sphere, Box>(new(new(0.3f), new(1, 2, 3), default, Quaternion.Identity, Quaternion.Identity));
        Assert.Equal(0.8f, manifold.GetDepth(0), 1e-6f);
        Assert.Equal(1, Math.Abs(manifold.Normal.X), 1e-6f);
    }

    [Fact]
    public void ContactsOfARestingBoxKeepTheirNames()
    {
        var random = new PairRandom(5);
        foreach (var offset in new[] { new Vector3(0, -1, 0), new Vector3(0.3f, -1, 0.2f) })
        {
            HashSet<string> names = [];
            for (int i = 0; i < 500; ++i)
            {
                // Smaller than the borders' tolerance where edges coincide, as in a stack.
                var noise = random.NextDirection() * 1e-6f;
                var turn = Quaternion.CreateFromAxisAngle(random.NextDirection(), 1e-6f);
                var manifold = PairHarness.Run<Box, Box>(new(new(1, 1, 1), new(1, 1, 1), offset + noise, turn, Quaternion.Identity), 0.01f);
                names.Add(string.Join(" ", Enumerable.Range(0, manifold.Count).Select(manifold.GetFeatureId).Order()));
            }
            Assert.Single(names);
        }
    }
}
