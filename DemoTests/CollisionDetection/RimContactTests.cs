using System;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuPhysics.CollisionDetection;
using Demos.References;
using Xunit;

namespace DemoTests.CollisionDetection;

/// <summary>Where a contact at a rim goes, against a search along the rim in double precision.</summary>
public class RimContactTests
{
    // Second order in the turn, .005 of the radius at the greatest, is what this is about; what is left is third order.
    const double GreatestTurn = .1;
    const double Tolerance = 2e-4;
    readonly Random random = new(14);

    [Fact]
    public void The_contact_goes_to_the_lowest_point_of_later_and_its_depth_is_that_of_the_rim_there()
    {
        for (int i = 0; i < 2000; ++i)
        {
            var place = RandomPlace();
            var end = random.Next(2) * 2 - 1;
            var lowest = place.Position + Lowest(place.Cylinder, place.Orientation, place.Normal, end);
            var rotation = Rotation(place);
            var later = rotation.Rotate(place.Position) + Lowest(place.Cylinder, rotation * place.Orientation, place.Normal, end);
            var manifold = Contact(place, lowest, depth: .01f);
            var found = manifold.Contact0;
            Move(place, ref manifold);
            double size = place.Cylinder.Radius + place.Cylinder.HalfLength + place.Position.Length();
            var way = (Double3)manifold.Contact0.Offset - found.Offset;
            Assert.InRange((way - (later - lowest)).Length / size, 0, 5 * Tolerance);
            // What the solver sees then, and what there is.
            Double3 arm = manifold.Contact0.Offset - place.Center;
            double seen = manifold.Contact0.Depth - Double3.Dot(place.Normal, Double3.Cross(place.Turn, arm));
            double there = found.Depth - Double3.Dot(place.Normal, later - lowest);
            Assert.InRange(Math.Abs(seen - there) / size, 0, Tolerance);
            Assert.Equal(found.FeatureId, manifold.Contact0.FeatureId);
        }
    }

    [Fact]
    public void The_contact_of_a_ball_beside_the_centre_goes_to_where_it_will_be_lowest_and_others_stay()
    {
        for (int i = 0; i < 2000; ++i)
        {
            var place = RandomPlace();
            var radius = place.Cylinder.Radius;
            Double3 middle = place.Position;
            var below = (Double3)place.Normal * radius;
            var lowest = middle - below;
            var later = Rotation(place).Rotate(middle) - below;
            var manifold = Contact(place, lowest, depth: .01f);
            var found = manifold;
            RimContacts.MoveAhead(found, radius, place.Position, place.Center, place.Normal, place.Turn, ref manifold);
            double size = radius + middle.Length;
            var way = (Double3)manifold.Contact0.Offset - found.Contact0.Offset;
            Assert.InRange((way - (later - lowest)).Length / size, 0, 5 * Tolerance);
            Double3 arm = manifold.Contact0.Offset - place.Center;
            double seen = manifold.Contact0.Depth - Double3.Dot(place.Normal, Double3.Cross(place.Turn, arm));
            double there = found.Contact0.Depth - Double3.Dot(place.Normal, later - lowest);
            Assert.InRange(Math.Abs(seen - there) / size, 0, Tolerance);
            var beside = Double3.Cross(place.Normal, place.Turn);
            StaysAt(place, lowest + beside * (.2 * radius / beside.Length), isBall: true);
            StaysAt(place with { Turn = Vector3.Normalize(place.Position) * .1f }, lowest, isBall: true);
        }
    }

    [Fact]
    public void Contacts_that_are_not_the_lowest_points_of_rims_stay_where_they_are()
    {
        for (int i = 0; i < 500; ++i)
        {
            var place = RandomPlace();
            var lowest = place.Position + Lowest(place.Cylinder, place.Orientation, place.Normal, 1);
            var axis = ((DoubleQuaternion)place.Orientation).Rotate(new(0, 1, 0));
            var middle = lowest - axis * place.Cylinder.HalfLength;
            var around = Double3.Cross(place.Normal, axis);
            StaysAt(place, place.Position + axis * place.Cylinder.HalfLength);
            StaysAt(place, middle);
            StaysAt(place, lowest + around * (.2 * place.Cylinder.Radius / around.Length));
        }
    }

    [Fact]
    public void What_turns_about_its_axis_alone_keeps_every_bit()
    {
        for (int i = 0; i < 500; ++i)
        {
            var place = RandomPlace() with { Position = default };
            place = place with { Turn = Vector3.Transform(Vector3.UnitY, place.Orientation) * .1f };
            StaysAt(place, Lowest(place.Cylinder, place.Orientation, place.Normal, 1));
        }
    }

    [Fact]
    public void What_hardly_turns_keeps_every_bit()
    {
        for (int i = 0; i < 500; ++i)
        {
            var place = RandomPlace() with { Position = default };
            place = place with { Turn = Vector3.Normalize(place.Turn) * 9e-5f };
            StaysAt(place, Lowest(place.Cylinder, place.Orientation, place.Normal, 1));
        }
    }

    [Fact]
    public void An_end_that_lies_flat_has_no_lowest_point()
    {
        var place = RandomPlace() with { Position = default, Orientation = Quaternion.Identity, Normal = Vector3.UnitY };
        StaysAt(place, new Double3(place.Cylinder.Radius, -place.Cylinder.HalfLength, 0));
        StaysAt(place, new Double3(0, -place.Cylinder.HalfLength, 0));
    }

    void StaysAt(in Place place, Double3 offset, bool isBall = false)
    {
        var manifold = Contact(place, offset, depth: .02f);
        var found = manifold.Contact0;
        if (isBall)
            RimContacts.MoveAhead(manifold, place.Cylinder.Radius, place.Position, place.Center, place.Normal, place.Turn, ref manifold);
        else
            Move(place, ref manifold);
        Assert.Equal(found.Offset, manifold.Contact0.Offset);
        Assert.Equal(found.Depth, manifold.Contact0.Depth);
    }

    static void Move(in Place place, ref ConvexContactManifold manifold)
    {
        var found = manifold;
        var pose = new RigidPose(place.Position, place.Orientation);
        RimContacts.MoveAhead(found, place.Cylinder, pose, place.Center, place.Normal, place.Turn, ref manifold);
    }

    // A test may find a contact anywhere between the two surfaces.
    ConvexContactManifold Contact(in Place place, Double3 offset, float depth)
    {
        var manifold = new ConvexContactManifold { Count = 1, Normal = place.Normal };
        manifold.Contact0.Offset = place.Center + ToSingle(offset) + place.Normal * (depth * random.NextSingle());
        manifold.Contact0.Depth = depth;
        manifold.Contact0.FeatureId = 7;
        return manifold;
    }

    static DoubleQuaternion Rotation(in Place place)
    {
        Double3 turn = place.Turn;
        return DoubleQuaternion.FromAxisAngle(turn * (1 / turn.Length), turn.Length);
    }

    // By halving the part of the rim in which it is: nothing of the closed form is used.
    static Double3 Lowest(in Cylinder cylinder, DoubleQuaternion orientation, Double3 normal, int end)
    {
        var (radius, middle) = (cylinder.Radius, cylinder.HalfLength * (double)end);
        Double3 At(double angle) => orientation.Rotate(new(radius * Math.Cos(angle), middle, radius * Math.Sin(angle)));
        double best = 0, step = Math.PI / 8;
        for (int i = 0; i < 16; ++i)
        {
            if (Double3.Dot(normal, At(i * step)) < Double3.Dot(normal, At(best)))
                best = i * step;
        }
        for (; step > 1e-9; step /= 2)
        {
            foreach (double angle in new[] { best - step, best + step })
            {
                if (Double3.Dot(normal, At(angle)) < Double3.Dot(normal, At(best)))
                    best = angle;
            }
        }
        return At(best);
    }

    // Not so flat that a small turn takes the lowest point to the other side.
    Place RandomPlace()
    {
        Place place;
        do
        {
            place = new(
                new Cylinder(.2f + random.NextSingle(), .2f + random.NextSingle()), RandomVector(), RandomVector(), RandomOrientation(),
                Vector3.Normalize(RandomVector()), Vector3.Normalize(RandomVector()) * ((float)GreatestTurn * random.NextSingle()));
        }
        while (Math.Abs(Vector3.Dot(Vector3.Transform(Vector3.UnitY, place.Orientation), place.Normal)) > .9f ||
            Vector3.Cross(Vector3.Transform(Vector3.UnitY, place.Orientation), place.Turn).Length() < 1e-3f);
        return place;
    }

    Quaternion RandomOrientation() => Quaternion.Normalize(new(RandomVector(), random.NextSingle() * 2 - 1));

    Vector3 RandomVector() => new(random.NextSingle() * 2 - 1, random.NextSingle() * 2 - 1, random.NextSingle() * 2 - 1);

    static Vector3 ToSingle(Double3 v) => new((float)v.X, (float)v.Y, (float)v.Z);

    readonly record struct Place(Cylinder Cylinder, Vector3 Center, Vector3 Position, Quaternion Orientation, Vector3 Normal, Vector3 Turn);
}
