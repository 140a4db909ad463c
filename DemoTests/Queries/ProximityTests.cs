using System;
using System.Collections.Generic;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using Demos.Accuracy;
using DemoTests.Scenes;
using Xunit;

namespace DemoTests.Queries;

/// <summary>Distances of which the answer is known in closed form, and questions that are refused.</summary>
public sealed class ProximityTests : IDisposable
{
    readonly TestWorld world = new(new AccuracySettings { Contacts = ContactScope.None });

    public void Dispose() => world.Dispose();

    Proximity Nearest<TShape>(in TShape shape, in RigidPose pose, float maximumDistance = float.PositiveInfinity) where TShape : unmanaged, IConvexShape
    {
        Assert.True(world.Simulation.FindNearest(shape, pose, maximumDistance, world.Pool, out var nearest));
        return nearest;
    }

    Proximity Nearest(Vector3 point)
    {
        Assert.True(world.Simulation.FindNearest(point, float.PositiveInfinity, world.Pool, out var nearest));
        return nearest;
    }

    [Fact]
    public void Two_spheres_are_as_far_apart_as_their_centres_less_their_radii()
    {
        var handle = world.AddStatic(new Sphere(1), new Vector3(3, 4, 0));

        var near = Nearest(new Sphere(.5f), RigidPose.Identity);

        Assert.Equal(handle, near.Collidable.StaticHandle);
        Assert.Equal(5 - 1.5f, near.Distance, 1e-6f);
        Assert.Equal(new Vector3(-.6f, -.8f, 0), near.Normal);
        Assert.InRange(Vector3.Distance(new(3 - .6f, 4 - .8f, 0), near.Place), 0, 1e-6f);
        Assert.False(near.Overlaps);
    }

    [Theory]
    [InlineData(1e-3f)]
    [InlineData(1)]
    [InlineData(1e3f)]
    public void A_point_is_nearest_to_the_corner_edge_or_face_of_a_box_that_it_is_beside(float size)
    {
        world.AddStatic(new Box(2 * size, 4 * size, 6 * size), Vector3.Zero);

        var corner = Nearest(new Vector3(2, 4, 5) * size);
        var edge = Nearest(new Vector3(4, 6, .5f) * size);
        var face = Nearest(new Vector3(.3f, -7, 1) * size);

        Assert.Equal(3 * size, corner.Distance, 1e-6f * size);
        Assert.Equal(new Vector3(1, 2, 3) * size, corner.Place);
        Assert.Equal(5 * size, edge.Distance, 1e-6f * size);
        Assert.InRange(Vector3.Distance(new Vector3(.6f, .8f, 0), edge.Normal), 0, 1e-6f);
        Assert.Equal(5 * size, face.Distance, 1e-6f * size);
        Assert.Equal(-Vector3.UnitY, face.Normal);
    }

    [Fact]
    public void A_point_inside_overlaps_and_has_neither_place_nor_normal()
    {
        world.AddStatic(new Cylinder(1, 2), Vector3.Zero);

        var inside = Nearest(new Vector3(.5f, .3f, .2f));

        Assert.True(inside.Overlaps);
        Assert.Equal((0, Vector3.Zero, Vector3.Zero), (inside.Distance, inside.Place, inside.Normal));
    }

    [Fact]
    public void A_tilted_box_is_as_high_over_a_half_space_as_its_lowest_corner()
    {
        world.AddStatic(new HalfSpace(Vector3.UnitY), new Vector3(0, -2, 0));
        var turn = Quaternion.CreateFromAxisAngle(Vector3.UnitZ, MathF.PI / 4);

        var near = Nearest(new Box(2, 2, 2), new RigidPose(new(7, 3, 1), turn));

        Assert.Equal(5 - MathF.Sqrt(2), near.Distance, 1e-6f);
        Assert.Equal(Vector3.UnitY, near.Normal);
        Assert.Equal(-2, near.Place.Y, 1e-6f);
        Assert.True(Nearest(new Box(2, 2, 2), new RigidPose(new(7, -3, 1), turn)).Overlaps);
    }

    [Fact]
    public void A_triangle_is_near_in_front_only_and_a_two_sided_one_from_both_sides()
    {
        var triangle = new Triangle(new(-1, 0, -1), new(1, 0, -1), new(0, 0, 1));
        world.AddStatic(triangle, Vector3.Zero);
        world.AddStatic(triangle with { TwoSided = true }, new Vector3(100, 0, 0));
        int front = 0;
        foreach (var side in new[] { 1f, -1f })
        {
            front += world.Simulation.FindNearest(new Vector3(0, side, 0), 2, world.Pool, out _) ? 1 : 0;
            Assert.True(world.Simulation.FindNearest(new Vector3(100, side, 0), 2, world.Pool, out var both));
            Assert.Equal(new Vector3(0, side, 0), both.Normal);
        }
        Assert.Equal(1, front);
    }

    [Fact]
    public void Inside_of_a_solid_mesh_everything_overlaps_and_outside_it_is_as_far_as_its_surface()
    {
        var mesh = Cube(2, isSolid: true);
        world.Statics.Add(new StaticDescription(Vector3.Zero, world.Simulation.Shapes.Add(mesh)));

        Assert.True(Nearest(Vector3.Zero).Overlaps);
        var outside = Nearest(new Vector3(3, .2f, .1f));
        Assert.Equal(2, outside.Distance, 1e-6f);
        Assert.Equal(Vector3.UnitX, outside.Normal);
        mesh.Dispose(world.Pool);
    }

    [Fact]
    public void Inside_of_a_mesh_that_is_none_there_are_only_backs()
    {
        var mesh = Cube(2, isSolid: false);
        world.Statics.Add(new StaticDescription(Vector3.Zero, world.Simulation.Shapes.Add(mesh)));

        Assert.False(world.Simulation.FindNearest(new Vector3(.1f, .2f, .3f), float.PositiveInfinity, world.Pool, out _));
        mesh.Dispose(world.Pool);
    }

    Mesh Cube(float size, bool isSolid)
    {
        var triangles = new List<Triangle>();
        foreach (var axis in new[] { Vector3.UnitX, Vector3.UnitY, Vector3.UnitZ, -Vector3.UnitX, -Vector3.UnitY, -Vector3.UnitZ })
        {
            var a = new Vector3(axis.Y, axis.Z, axis.X);
            var b = Vector3.Cross(axis, a);
            Vector3 Corner(float u, float v) => (axis + a * u + b * v) * (size / 2);
            triangles.Add(new(Corner(-1, -1), Corner(1, 1), Corner(1, -1)));
            triangles.Add(new(Corner(-1, -1), Corner(-1, 1), Corner(1, 1)));
        }
        return new Mesh(triangles.ToArray().AsSpan(), Vector3.One, world.Pool) { Solid = isSolid };
    }

    [Fact]
    public void The_greatest_distance_counts_as_near_and_the_next_float_below_does_not()
    {
        world.AddStatic(new Sphere(1), new Vector3(4, 0, 0));
        var shape = new Sphere(1);

        Assert.Equal(2, Nearest(shape, RigidPose.Identity, 2).Distance);
        Assert.False(world.Simulation.FindNearest(shape, RigidPose.Identity, MathF.BitDecrement(2), world.Pool, out _));
    }

    [Fact]
    public void Of_what_is_equally_near_the_lowest_reference_is_the_nearest()
    {
        var handles = new List<StaticHandle>();
        for (int i = 0; i < 20; ++i)
            handles.Add(world.AddStatic(new Sphere(1), new Vector3(3 * MathF.Cos(i), 3 * MathF.Sin(i), 0)));
        for (int i = 0; i < 20; ++i)
            handles.Add(world.AddStatic(new Sphere(1), new Vector3(0, 0, i % 2 == 0 ? 2 : -2)));

        Assert.Equal(handles[20], Nearest(Vector3.Zero).Collidable.StaticHandle);
    }

    [Fact]
    public void Layers_choose_what_is_near()
    {
        var near = world.AddStatic(new Sphere(1), new Vector3(3, 0, 0));
        var far = world.AddStatic(new Sphere(1), new Vector3(9, 0, 0));
        world.Simulation.Layers[new CollidableReference(near)] = new CollisionLayers(2, uint.MaxValue);

        Assert.True(world.Simulation.FindNearest(Vector3.Zero, 100, world.Pool, out var nearest, new CollisionLayers(1, ~2u)));
        Assert.Equal(far, nearest.Collidable.StaticHandle);
        Assert.False(world.Simulation.OverlapsAny(new Sphere(2.5f), RigidPose.Identity, world.Pool, new CollisionLayers(1, ~2u)));
        Assert.True(world.Simulation.OverlapsAny(new Sphere(2.5f), RigidPose.Identity, world.Pool));
    }

    [Fact]
    public void An_empty_world_has_nothing_near() =>
        Assert.False(world.Simulation.FindNearest(Vector3.Zero, float.PositiveInfinity, world.Pool, out _));

    [Fact]
    public void Bad_input_is_refused()
    {
        world.AddStatic(new Sphere(1), Vector3.Zero);
        var simulation = world.Simulation;
        var pool = world.Pool;
        Assert.Throws<ArgumentException>(() => simulation.OverlapsAny(new HalfSpace(Vector3.UnitY), RigidPose.Identity, pool));
        Assert.ThrowsAny<ArgumentException>(() => simulation.OverlapsAny(new Sphere(float.NaN), RigidPose.Identity, pool));
        Assert.ThrowsAny<ArgumentException>(() => simulation.FindNearest(new Vector3(float.NaN), 1, pool, out _));
        Assert.ThrowsAny<ArgumentException>(() => simulation.FindNearest(Vector3.Zero, -1, pool, out _));
        Assert.ThrowsAny<ArgumentException>(() => simulation.FindNearest(Vector3.Zero, float.NaN, pool, out _));
        Assert.ThrowsAny<ArgumentException>(
            () => simulation.FindNearest(new Sphere(1), new RigidPose(default, new Quaternion(0, 0, 0, 0)), 1, pool, out _));
        Assert.Throws<ArgumentNullException>(() => simulation.FindNearest(Vector3.Zero, 1, null!, out _));
    }
}
