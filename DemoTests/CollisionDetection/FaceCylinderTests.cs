using System;
using System.Linq;
using System.Numerics;
using BepuPhysics.Collidables;
using BepuPhysics.CollisionDetection;
using DemoTests.CollisionDetection.References;
using Xunit;
using BoxCylinder = DemoTests.CollisionDetection.FaceHarness<
    BepuPhysics.Collidables.Box, BepuPhysics.Collidables.BoxWide, BepuPhysics.CollisionDetection.BoxFeature,
    BepuPhysics.Collidables.Cylinder, BepuPhysics.Collidables.CylinderWide, BepuPhysics.CollisionDetection.CylinderFeature>;
using CylinderCylinder = DemoTests.CollisionDetection.FaceHarness<
    BepuPhysics.Collidables.Cylinder, BepuPhysics.Collidables.CylinderWide, BepuPhysics.CollisionDetection.CylinderFeature,
    BepuPhysics.Collidables.Cylinder, BepuPhysics.Collidables.CylinderWide, BepuPhysics.CollisionDetection.CylinderFeature>;

namespace DemoTests.CollisionDetection;

/// <summary>Ends and sides of cylinders whose contacts are known.</summary>
public class FaceCylinderTests
{
    const double ApothemPart = 0.98078528040323;
    static readonly Quaternion somewhere = Quaternion.Normalize(new(0.3f, -0.5f, 0.2f, 0.7f));

    static FacePoint[] PointsAcrossY(FaceContacts contacts) => [.. contacts.Contacts.Select(c => new FacePoint(c.Offset.X, c.Offset.Z, 0))];

    [Fact]
    public void EndUnderBoxHasASquareOfRimPoints()
    {
        foreach (var turn in new[] { 0f, 0.1f, 1.3f })
        {
            var contacts = BoxCylinder.Run(new(new Box(4, 1, 4), new Cylinder(0.5f, 2), new(0.3f, -1.49f, 0.2f),
                Quaternion.CreateFromAxisAngle(Vector3.UnitY, turn), somewhere, Vector3.UnitY, 0.01f, new(0.3f, -0.5f, 0.2f), 0.1f));
            Assert.Equal(4, contacts.Contacts.Length);
            foreach (var contact in contacts.Contacts)
            {
                Assert.Equal(0.5, (contact.Offset - new Double3(0.3, contact.Offset.Y, 0.2)).Length, 2e-6);
                Assert.Equal(-0.495, contact.Offset.Y, 1e-6);
                Assert.Equal(0.01, contact.Depth, 1e-6);
            }
            Assert.Equal(0.5, FaceReference.HullArea(PointsAcrossY(contacts)), 1e-5);
        }
    }

    [Fact]
    public void CoaxialCylindersHaveTheSmallersRim()
    {
        var pair = new FacePair<Cylinder, Cylinder>(new Cylinder(0.5f, 2), new Cylinder(0.3f, 1), new(0, -1.49f, 0),
            Quaternion.CreateFromAxisAngle(Vector3.UnitY, 0.2f), somewhere, Vector3.UnitY, 0.01f, new(0, -1, 0), 0.1f);
        AssertRim(0.3);
        pair.B = new Cylinder(0.5f, 1);
        // The same rim: two polygons turned by half a side or by nothing.
        pair.LocalOrientationB = Quaternion.CreateFromAxisAngle(Vector3.UnitY, MathF.PI / 16);
        AssertRim(0.5, ApothemPart);
        pair.LocalOrientationB = Quaternion.Identity;
        AssertRim(0.5);

        void AssertRim(double radius, double least = 1)
        {
            var contacts = CylinderCylinder.Run(pair);
            Assert.Equal(4, contacts.Contacts.Length);
            Assert.All(contacts.Contacts, contact => Assert.InRange(
                Math.Sqrt(contact.Offset.X * contact.Offset.X + contact.Offset.Z * contact.Offset.Z), radius * least - 1e-5, radius + 1e-5));
            Assert.All(contacts.Contacts, contact => Assert.Equal(0.01, contact.Depth, 1e-6));
            Assert.True(FaceReference.HullArea(PointsAcrossY(contacts)) > 2 * radius * radius * least * least * 0.99);
        }
    }

    [Fact]
    public void EndsSideBySideHaveTheirLens()
    {
        // Two circles of radius 0.5 whose centres are 0.6 apart meet at (0.3, +-0.4); the lens is 0.4 wide.
        var contacts = CylinderCylinder.Run(new FacePair<Cylinder, Cylinder>(new Cylinder(0.5f, 2), new Cylinder(0.5f, 2), new(0.6f, -1.99f, 0),
            Quaternion.Identity, somewhere, Vector3.UnitY, 0.01f, new(0.3f, -1, 0), 0.1f));
        Assert.Equal(4, contacts.Contacts.Length);
        foreach (var contact in contacts.Contacts)
        {
            double x = contact.Offset.X, z = contact.Offset.Z;
            Assert.True(x * x + z * z < 0.25 + 1e-5 && (x - 0.6) * (x - 0.6) + z * z < 0.25 + 1e-5, $"{x} {z}");
            Assert.Equal(0.01, contact.Depth, 1e-6);
        }
        // The inscribed polygons lack up to 2 % of a radius at their sides.
        Assert.InRange(contacts.Contacts.Max(contact => contact.Offset.Z), 0.38, 0.4 + 1e-5);
        Assert.InRange(contacts.Contacts.Min(contact => contact.Offset.Z), -0.4 - 1e-5, -0.38);
    }

    [Fact]
    public void SideOnBoxHasTheEndsOfItsLine()
    {
        // B's axis is along x; it reaches from -0.7 to 1.3 and A from -0.5 to 0.5.
        var axisAlongX = Quaternion.CreateFromAxisAngle(Vector3.UnitZ, -MathF.PI / 2);
        var pair = new FacePair<Box, Cylinder>(new Box(4, 1, 4), new Cylinder(0.5f, 2), new(0.3f, -0.99f, 0.2f), axisAlongX, somewhere,
            Vector3.UnitY, 0.01f, new(0.3f, -0.5f, 0.2f), 0.1f);
        AssertEnds(BoxCylinder.Run(pair), -0.7, 1.3);
        pair.A = new Box(1, 1, 1);
        AssertEnds(BoxCylinder.Run(pair), -0.5, 0.5);

        static void AssertEnds(FaceContacts contacts, double from, double to)
        {
            Assert.Equal(2, contacts.Contacts.Length);
            foreach (var place in new[] { from, to })
                Assert.Contains(contacts.Contacts, contact => (contact.Offset - new Double3(place, -0.495, 0.2)).Length < 2e-5);
            Assert.All(contacts.Contacts, contact => Assert.Equal(0.01, contact.Depth, 2e-6));
        }
    }

    [Theory]
    [InlineData(0.0, 2)]
    [InlineData(1e-4, 2)]
    [InlineData(1e-2, 2)]
    [InlineData(0.5, 1)]
    [InlineData(1.5, 1)]
    public void SidesThatLieAlongEachOtherHaveTwoContactsAndCrossingOnesOne(double angle, int count)
    {
        // Both axes across the normal, B's turned away from A's around it.
        var turned = Quaternion.CreateFromAxisAngle(Vector3.UnitX, (float)angle);
        var contacts = CylinderCylinder.Run(new FacePair<Cylinder, Cylinder>(new Cylinder(0.5f, 2), new Cylinder(0.5f, 2), new(-0.99f, 0, 0),
            turned, somewhere, Vector3.UnitX, 0.01f, new(-0.5f, 0, 0), 0.1f));
        Assert.Equal(count, contacts.Contacts.Length);
        Assert.All(contacts.Contacts, contact => Assert.Equal(0.01, contact.Depth, 2e-6));
        // Where the other's line is at most a fiftieth of the radius to the side.
        var reach = count == 1 ? 0 : angle < 5e-3 ? 1 : 0.01 / Math.Sin(angle);
        foreach (var contact in contacts.Contacts)
        {
            Assert.Equal(-0.495, contact.Offset.X, 2e-6);
            Assert.Equal(reach, Math.Abs(contact.Offset.Y), 1e-3);
            Assert.Equal(0, contact.Offset.Z, 2e-5);
        }
    }

    [Fact]
    public void TiltedEndTouchesAtTheWitness()
    {
        // Tilted by 10 degrees around z and turned around its axis so that the lowest point of the rim is in the middle of a side.
        var tilt = Quaternion.CreateFromAxisAngle(Vector3.UnitZ, MathF.PI / 18);
        var turn = Quaternion.CreateFromAxisAngle(Vector3.UnitY, MathF.PI / 16);
        var orientation = tilt * turn;
        // The rim's highest point: at the end over +x.
        var rim = Vector3.Transform(new Vector3(0.5f, 1, 0), tilt);
        var offset = new Vector3(0.1f, -0.49f - rim.Y, 0);
        var contacts = BoxCylinder.Run(new(new Box(4, 1, 4), new Cylinder(0.5f, 2), offset, orientation, somewhere, Vector3.UnitY, 0.01f,
            new(offset.X + rim.X, -0.5f, 0), 0.05f));
        var deepest = contacts.Contacts.MaxBy(contact => contact.Depth);
        Assert.Equal(0.01, deepest.Depth, 1e-6);
        Assert.True((deepest.Offset - new Double3(offset.X + rim.X, -0.495, 0)).Length < 1e-5);
        Assert.Equal(contacts.Contacts.Length, contacts.Contacts.Select(contact => contact.FeatureId).Distinct().Count());
    }

    [Fact]
    public void OneSidedTrianglesOverAnEndAreTouchedFromTheFrontOnly()
    {
        // The triangle is A, above; its front has to look down.
        var down = new Triangle(new(-0.2f, 0, 0.2f), new(0.2f, 0, 0.2f), new(0, 0, -0.2f));
        var pair = new FacePair<Triangle, Cylinder>(down, new Cylinder(0.5f, 2), new(0, -0.99f, 0), Quaternion.Identity, somewhere, Vector3.UnitY,
            0.01f, default, 0.1f);
        Assert.Equal(3, Run(pair).Contacts.Length);
        var up = new Triangle(down.A, down.C, down.B);
        Assert.Empty(Run(pair with { A = up }).Contacts);
        up.TwoSided = true;
        Assert.Equal(3, Run(pair with { A = up }).Contacts.Length);

        static FaceContacts Run(FacePair<Triangle, Cylinder> pair) =>
            FaceHarness<Triangle, TriangleWide, TriangleFeature, Cylinder, CylinderWide, CylinderFeature>.Run(pair);
    }
}
