using System;
using System.Linq;
using System.Numerics;
using BepuPhysics.Collidables;
using BepuPhysics.CollisionDetection;
using DemoTests.CollisionDetection.References;
using Xunit;
using BoxBox = DemoTests.CollisionDetection.FaceHarness<
    BepuPhysics.Collidables.Box, BepuPhysics.Collidables.BoxWide, BepuPhysics.CollisionDetection.BoxFeature,
    BepuPhysics.Collidables.Box, BepuPhysics.Collidables.BoxWide, BepuPhysics.CollisionDetection.BoxFeature>;
using BoxTriangle = DemoTests.CollisionDetection.FaceHarness<
    BepuPhysics.Collidables.Box, BepuPhysics.Collidables.BoxWide, BepuPhysics.CollisionDetection.BoxFeature,
    BepuPhysics.Collidables.Triangle, BepuPhysics.Collidables.TriangleWide, BepuPhysics.CollisionDetection.TriangleFeature>;
using CapsuleBox = DemoTests.CollisionDetection.FaceHarness<
    BepuPhysics.Collidables.Capsule, BepuPhysics.Collidables.CapsuleWide, BepuPhysics.CollisionDetection.CapsuleFeature,
    BepuPhysics.Collidables.Box, BepuPhysics.Collidables.BoxWide, BepuPhysics.CollisionDetection.BoxFeature>;

namespace DemoTests.CollisionDetection;

/// <summary>Pairs whose contacts are known: A above B, the normal up, as in A's frame.</summary>
public class FaceManifoldTests
{
    static readonly Quaternion somewhere = Quaternion.Normalize(new(0.3f, -0.5f, 0.2f, 0.7f));

    static Quaternion Turned(double degrees) => Quaternion.CreateFromAxisAngle(Vector3.UnitY, (float)(degrees * Math.PI / 180));

    /// <summary>A pair whose surfaces are at given heights under A's centre and over B's.</summary>
    static FacePair<TA, TB> Pair<TA, TB>(TA a, TB b, float heightA, float heightB, float depth, Vector3 side, Quaternion orientationB,
        Vector3 witness = default, float margin = 0.1f) =>
        new(a, b, side - Vector3.UnitY * (heightA + heightB - depth), orientationB, somewhere, Vector3.UnitY, depth,
            witness - Vector3.UnitY * heightA, margin);

    /// <summary>The contacts are at these places and no others, each as deep as the pair.</summary>
    static void AssertPlaces(FaceContacts contacts, double height, double depth, double tolerance, params (double X, double Z)[] places)
    {
        Assert.True((contacts.Normal - new Double3(0, 1, 0)).Length < 1e-6);
        Assert.Equal(places.Length, contacts.Contacts.Length);
        Assert.Equal(places.Length, contacts.Contacts.Select(contact => contact.FeatureId).Distinct().Count());
        foreach (var (x, z) in places)
            Assert.Contains(contacts.Contacts, contact => (contact.Offset - new Double3(x, height, z)).Length < tolerance);
        Assert.All(contacts.Contacts, contact => Assert.Equal(depth, contact.Depth, tolerance));
    }

    [Fact]
    public void BoxOnBoxTurnedByHalfARightAngleHasTheLargestSquareInTheOctagon()
    {
        var contacts = BoxBox.Run(Pair(new Box(1, 1, 1), new Box(1, 1, 1), 0.5f, 0.5f, 0.01f, default, Turned(45)));
        Assert.Equal(4, contacts.Contacts.Length);
        var shorter = 0.5 * (Math.Sqrt(2) - 1);
        foreach (var contact in contacts.Contacts)
        {
            double x = Math.Abs(contact.Offset.X), z = Math.Abs(contact.Offset.Z);
            Assert.Equal(0.5, Math.Max(x, z), 2e-5);
            Assert.Equal(shorter, Math.Min(x, z), 2e-5);
            Assert.Equal(-0.495, contact.Offset.Y, 1e-6);
            Assert.Equal(0.01, contact.Depth, 1e-6);
        }
        // The largest square with corners of the octagon.
        var points = contacts.Contacts.Select(contact => new FacePoint(contact.Offset.X, contact.Offset.Z, 0)).ToArray();
        Assert.Equal(2 * (0.25 + shorter * shorter), FaceReference.HullArea(points), 1e-4);
    }

    [Theory]
    [InlineData(0)]
    [InlineData(30)]
    public void SmallBoxOnLargeFaceHasItsFourCorners(double degrees)
    {
        var contacts = BoxBox.Run(Pair(new Box(1, 2, 0.5f), new Box(9, 1, 9), 1, 0.5f, 0.01f, new(1, 0, 2), Turned(degrees)));
        AssertPlaces(contacts, -0.995, 0.01, 1e-5, (-0.5, -0.25), (0.5, -0.25), (0.5, 0.25), (-0.5, 0.25));
        var ids = contacts.Contacts.Select(contact => contact.FeatureId).Order();
        // The same, and the same corners, a little farther on.
        var moved = BoxBox.Run(Pair(new Box(1, 2, 0.5f), new Box(9, 1, 9), 1, 0.5f, 0.011f, new(1.01f, 0, 1.98f), Turned(degrees + 0.2)));
        Assert.Equal(ids, moved.Contacts.Select(contact => contact.FeatureId).Order());
        foreach (var contact in moved.Contacts)
        {
            var before = contacts.Contacts.Single(other => other.FeatureId == contact.FeatureId);
            Assert.True((before.Offset - contact.Offset).Length < 2e-3);
        }
        // And with the small one below.
        contacts = BoxBox.Run(Pair(new Box(9, 1, 9), new Box(1, 2, 0.5f), 0.5f, 1, 0.01f, new(1, 0, 2), Quaternion.Identity));
        AssertPlaces(contacts, -0.495, 0.01, 1e-5, (0.5, 1.75), (1.5, 1.75), (1.5, 2.25), (0.5, 2.25));
    }

    [Fact]
    public void IdenticalFacesHaveFourContacts()
    {
        var contacts = BoxBox.Run(Pair(new Box(1, 1, 2), new Box(1, 1, 2), 0.5f, 0.5f, 0.01f, default, Quaternion.Identity));
        AssertPlaces(contacts, -0.495, 0.01, 1e-5, (-0.5, -1), (0.5, -1), (0.5, 1), (-0.5, 1));
        contacts = BoxBox.Run(Pair(new Box(1, 1, 2), new Box(2, 1, 1), 0.5f, 0.5f, 0.01f, default, Turned(90)));
        AssertPlaces(contacts, -0.495, 0.01, 1e-5, (-0.5, -1), (0.5, -1), (0.5, 1), (-0.5, 1));
    }

    [Theory]
    [InlineData(0f)]
    [InlineData(3e-6f)]
    [InlineData(-3e-6f)]
    public void FacesThatShareAnEdgeTouchAlongIt(float gap)
    {
        var contacts = BoxBox.Run(Pair(new Box(1, 1, 1), new Box(1, 1, 1), 0.5f, 0.5f, 0.01f, new(1 + gap, 0, 0), Quaternion.Identity,
            new(0.5f, 0, 0)));
        AssertPlaces(contacts, -0.495, 0.01, 2e-5, (0.5, -0.5), (0.5, 0.5));
    }

    [Fact]
    public void CornersThatOverlapByAMillimetreAreFourContacts()
    {
        var contacts = BoxBox.Run(Pair(new Box(1, 1, 1), new Box(1, 1, 1), 0.5f, 0.5f, 0.01f, new(0.999f, 0, 0.999f), Quaternion.Identity,
            new(0.4995f, 0, 0.4995f)));
        AssertPlaces(contacts, -0.495, 0.01, 2e-5, (0.5, 0.5), (0.499, 0.5), (0.499, 0.499), (0.5, 0.499));
        // Nothing over nothing: the witness, and nothing else.
        contacts = BoxBox.Run(Pair(new Box(1, 1, 1), new Box(1, 1, 1), 0.5f, 0.5f, -0.01f, new(1.02f, 0, 1.02f), Quaternion.Identity,
            new(0.5f, 0, 0.5f)));
        AssertPlaces(contacts, -0.505, -0.01, 2e-5, (0.5, 0.5));
    }

    [Fact]
    public void EdgesThatCrossTouchWhereTheyCross()
    {
        // A stands on an edge along z, B shows one along x. The slope of both faces is 45 degrees.
        var onEdge = Quaternion.CreateFromAxisAngle(Vector3.UnitZ, MathF.PI / 4);
        var height = MathF.Sqrt(0.5f);
        var toA = Quaternion.Conjugate(onEdge);
        var up = Vector3.Transform(Vector3.UnitY, toA);
        var orientationB = Quaternion.CreateFromAxisAngle(Vector3.UnitX, MathF.PI / 4);
        var witness = -Vector3.UnitY * height + new Vector3(0, 0, 0.2f);
        var pair = new FacePair<Box, Box>(new Box(1, 1, 1), new Box(1, 1, 1),
            Vector3.Transform(new Vector3(0.1f, -2 * height + 0.01f, 0.2f), toA), toA * orientationB, onEdge, up, 0.01f,
            Vector3.Transform(witness, toA), 0.02f);
        var contacts = BoxBox.Run(pair);
        var deepest = contacts.Contacts.MaxBy(contact => contact.Depth);
        Assert.Equal(0.01, deepest.Depth, 1e-5);
        var expected = Vector3.Transform(witness + new Vector3(0, 0.005f, 0), toA);
        Assert.True((deepest.Offset - new Double3(expected)).Length < 2e-5);
        Assert.All(contacts.Contacts, contact => Assert.True(contact.Depth >= -0.02));
    }

    [Theory]
    [InlineData(1000f)]
    [InlineData(1e-3f)]
    public void FacesOfVeryDifferentSizesKeepTheSmallOnesCorners(float ratio)
    {
        // Close to the large one's corner, where its coordinates are coarsest.
        var near = 0.5f * ratio - 3;
        if (ratio > 1)
        {
            var contacts = BoxBox.Run(Pair(new Box(1, 1, 1), new Box(ratio, ratio, ratio), 0.5f, 0.5f * ratio, 0.01f, new(near, 0, -near),
                Turned(90)));
            AssertPlaces(contacts, -0.495, 0.01, 5e-4, (-0.5, -0.5), (0.5, -0.5), (0.5, 0.5), (-0.5, 0.5));
        }
        else
        {
            var contacts = BoxBox.Run(Pair(new Box(1, 1, 1), new Box(ratio, ratio, ratio), 0.5f, 0.5f * ratio, 1e-5f, new(0.4f, 0, -0.4f),
                Turned(0), new(0.4f, 0, -0.4f)));
            var half = 0.5 * ratio;
            AssertPlaces(contacts, -0.5, 1e-5, 1e-5, (0.4 - half, -0.4 - half), (0.4 + half, -0.4 - half), (0.4 + half, -0.4 + half),
                (0.4 - half, -0.4 + half));
        }
    }

    [Fact]
    public void TriangleOnBox()
    {
        // Larger than the box, then smaller. Seen from above A, B, C run clockwise.
        var large = new Triangle(new(-9, 0, 9), new(0, 0, -9), new(9, 0, 9));
        var contacts = BoxTriangle.Run(Pair(new Box(1, 1, 1), large, 0.5f, 0, 0.01f, default, Quaternion.Identity));
        AssertPlaces(contacts, -0.495, 0.01, 2e-5, (-0.5, -0.5), (0.5, -0.5), (0.5, 0.5), (-0.5, 0.5));
        var small = new Triangle(new(-0.3f, 0, 0.3f), new(0, 0, -0.3f), new(0.3f, 0, 0.3f));
        contacts = BoxTriangle.Run(Pair(new Box(1, 1, 1), small, 0.5f, 0, 0.01f, default, Quaternion.Identity));
        AssertPlaces(contacts, -0.495, 0.01, 2e-5, (-0.3, 0.3), (0, -0.3), (0.3, 0.3));
    }

    [Fact]
    public void OneSidedTrianglesAreTouchedFromTheFrontOnly()
    {
        var front = new Triangle(new(-0.3f, 0, 0.3f), new(0, 0, -0.3f), new(0.3f, 0, 0.3f));
        var back = new Triangle(front.A, front.C, front.B);
        Assert.NotEmpty(BoxTriangle.Run(Pair(new Box(1, 1, 1), front, 0.5f, 0, 0.01f, default, Quaternion.Identity)).Contacts);
        Assert.Empty(BoxTriangle.Run(Pair(new Box(1, 1, 1), back, 0.5f, 0, 0.01f, default, Quaternion.Identity)).Contacts);
        Assert.Empty(BoxTriangle.Run(Pair(new Box(1, 1, 1), back, 0.5f, 0, -0.01f, default, Quaternion.Identity)).Contacts);
        back.TwoSided = true;
        AssertPlaces(BoxTriangle.Run(Pair(new Box(1, 1, 1), back, 0.5f, 0, 0.01f, default, Quaternion.Identity)),
            -0.495, 0.01, 2e-5, (-0.3, 0.3), (0, -0.3), (0.3, 0.3));
    }

    [Fact]
    public void TriangleOnEdgeTouchesAlongTheEdge()
    {
        // It stands in the plane of x and y, its front to either side.
        foreach (var turn in new[] { 0f, MathF.PI })
        {
            var standing = new Triangle(new(-0.3f, 0, 0), new(0, -0.5f, 0), new(0.3f, 0, 0));
            var contacts = BoxTriangle.Run(Pair(new Box(1, 1, 1), standing, 0.5f, 0, 0.01f, new(0.4f, 0, 0.1f),
                Quaternion.CreateFromAxisAngle(Vector3.UnitY, turn), new(0.4f, 0, 0.1f)));
            AssertPlaces(contacts, -0.495, 0.01, 2e-5, (0.1, 0.1), (0.5, 0.1));
        }
    }

    [Fact]
    public void CapsuleOnBox()
    {
        var upInA = Vector3.UnitX;
        var pair = new FacePair<Capsule, Box>(new Capsule(0.2f, 1), new Box(4, 1, 4), -upInA * (0.2f + 0.5f - 0.01f),
            Quaternion.CreateFromAxisAngle(Vector3.UnitZ, -MathF.PI / 2),
            somewhere, upInA, 0.01f, -upInA * 0.2f, 0.1f);
        AssertSegment(CapsuleBox.Run(pair), -0.5, 0.5, -0.195);
        // It sticks out on one side: B ends at y = 0.3 in A's frame.
        pair.LocalOffsetB += new Vector3(0, -1.7f, 0);
        AssertSegment(CapsuleBox.Run(pair), -0.5, 0.3, -0.195);
    }

    static void AssertSegment(FaceContacts contacts, double from, double to, double height)
    {
        Assert.Equal(2, contacts.Contacts.Length);
        foreach (var place in new[] { from, to })
            Assert.Contains(contacts.Contacts, contact => (contact.Offset - new Double3(height, place, 0)).Length < 2e-5);
        Assert.All(contacts.Contacts, contact => Assert.Equal(0.01, contact.Depth, 1e-5));
    }

    [Fact]
    public void SphereHasItsWitness()
    {
        var pair = Pair(new Sphere(0.5f), new Box(1, 1, 1), 0.5f, 0.5f, -0.03f, new(0.2f, 0, 0.3f), Quaternion.Identity);
        var contacts = FaceHarness<Sphere, SphereWide, SphereFeature, Box, BoxWide, BoxFeature>.Run(pair);
        AssertPlaces(contacts, -0.515, -0.03, 1e-6, (0, 0));
        pair.SpeculativeMargin = 0.02f;
        Assert.Empty(FaceHarness<Sphere, SphereWide, SphereFeature, Box, BoxWide, BoxFeature>.Run(pair).Contacts);
    }
}
