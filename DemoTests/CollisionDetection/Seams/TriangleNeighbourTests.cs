using System;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuPhysics.CollisionDetection;
using DemoTests.CollisionDetection.Children;
using Xunit;

namespace DemoTests.CollisionDetection.Seams;

/// <summary>A triangle is touched at an edge from the directions between its normal and its neighbour's.</summary>
public class TriangleNeighbourTests
{
    const float Radius = .5f;

    // Edge AB is along Z at X = 0; the triangle is at positive X, seen from above, its neighbour at negative X.
    static readonly Triangle Shape = new(new(0, 0, 2), new(0, 0, -2), new(3, 0, 0));

    static TriangleCone Cone(float degrees, int freeMask = 0)
    {
        var (sine, cosine) = MathF.SinCos(degrees * MathF.PI / 180);
        return new() { Cosines = new(cosine, 1, 1), Sines = new(sine, 0, 0), FreeMask = freeMask };
    }

    // A ball that touches the edge, a millimetre deep, from a direction that is so far from the triangle's normal.
    static ConvexContactManifold Touch(TriangleCone? cone, float degrees) => Touch(Shape, cone, default, -Vector3.UnitX, degrees);

    // The same at a place of a triangle in the plane Y = 0; the direction leans to another in that plane.
    static ConvexContactManifold Touch(in Triangle triangle, TriangleCone? cone, Vector3 place, Vector3 aside, float degrees)
    {
        const float Depth = 1e-3f;
        var (sine, cosine) = MathF.SinCos(degrees * MathF.PI / 180);
        var direction = new Vector3(0, cosine, 0) + sine * Vector3.Normalize(aside);
        return See(triangle, cone, new Sphere(Radius), place + direction * (Radius - Depth));
    }

    static ConvexContactManifold See<TShape>(in Triangle triangle, TriangleCone? cone, in TShape shape, Vector3 place) where TShape : unmanaged, IConvexShape
    {
        using var world = new ClusterWorld(isCluster: true);
        if (cone is { } known)
            world.Rules.Cones = _ => known;
        var surface = world.AddCluster([new(world.Simulation.Shapes.Add(triangle), RigidPose.Identity)]);
        world.Simulation.Statics.Add(new StaticDescription(default(Vector3), surface));
        world.AddBody(shape, new RigidPose(place));
        ConvexContactManifold seen = default;
        world.Behaviour.Configure = manifold =>
        {
            seen = (ConvexContactManifold)manifold;
            return null;
        };
        // The first step tests before anything has moved, but for a part of gravity.
        world.Step();
        return seen;
    }

    [Theory]
    [InlineData(0, .2f, false)]
    [InlineData(0, 30, false)]
    [InlineData(30, 20, true)]
    [InlineData(30, 29, true)]
    [InlineData(30, 31, false)]
    [InlineData(30, 60, false)]
    [InlineData(90, 60, true)]
    [InlineData(90, 85, true)]
    public void An_edge_is_touched_as_far_as_the_surface_bends(float edge, float direction, bool touches)
    {
        var manifold = Touch(Cone(edge), direction);
        Assert.Equal(touches ? 1 : 0, manifold.Count);
        if (!touches)
            return;
        var (sine, cosine) = MathF.SinCos(direction * MathF.PI / 180);
        Assert.Equal(0, (manifold.Normal - new Vector3(-sine, cosine, 0)).Length(), 1e-3);
    }

    [Fact]
    public void A_free_edge_and_a_triangle_of_no_surface_are_touched_from_everywhere()
    {
        Assert.Equal(1, Touch(Cone(0, freeMask: 1), 60).Count);
        Assert.Equal(1, Touch(null, 60).Count);
    }

    /// <summary>What is over the triangle is pushed along its normal, wherever the nearest way out is; where it bends away by 30 degrees as well.</summary>
    [Theory, InlineData(0), InlineData(30)]
    public void What_is_over_the_triangle_stays_on_it(float edge)
    {
        // A millimetre over the edge, two deep: alone, the way out is to the side. Along the neighbour's normal it is .5 + 1.73 mm.
        var seen = See(Shape, Cone(edge), new Box(1, 1, 1), new Vector3(-.499f, .498f, 0));
        Assert.InRange(seen.Count, 2, 4);
        Assert.Equal(Vector3.UnitY, seen.Normal);
        Assert.Equal(.002f, seen.Contact0.Depth, 1e-5);
    }

    /// <summary>
    /// Of an obtuse triangle the corner opposite a flat edge is farther that way than the edge: if its own two edges are free, it is touched from there.
    /// </summary>
    [Fact]
    public void An_edge_does_not_bound_what_touches_the_corner_opposite()
    {
        var corner = new Vector3(1, 0, -6);
        var obtuse = new Triangle(new(0, 0, 2), new(0, 0, -2), corner);
        var aside = new Vector3(-.2f, 0, -1);
        var manifold = Touch(obtuse, Cone(0, freeMask: 2 + 4), corner, aside, 60);
        Assert.Equal(1, manifold.Count);
        Assert.Equal(.5f, manifold.Normal.Y, 1e-3);
        Assert.Equal(0, Touch(obtuse, Cone(0), corner, aside, 60).Count);
    }

    /// <summary>Nor what touches another edge of it, where that is by rounding a little farther at the end that the two share.</summary>
    [Theory, InlineData(0), InlineData(1e-5f), InlineData(-1e-5f)]
    public void An_edge_does_not_bound_what_touches_the_next(float turn)
    {
        // Edge CA is along X, and free; AB comes back beyond it at an angle of 45 degrees, flat.
        var obtuse = new Triangle(default, new(-2, 0, -2), new(4, 0, 0));
        var cone = new TriangleCone { Cosines = Vector3.One, FreeMask = 2 + 4 };
        var aside = new Vector3(-turn, 0, 1);
        Assert.Equal(1, Touch(obtuse, cone, default, aside, 60).Count);
        Assert.Equal(1, Touch(obtuse, cone, new Vector3(2, 0, 0), aside, 60).Count);
    }

    /// <summary>At a corner of a flat surface both edges bound.</summary>
    [Theory, InlineData(.2f), InlineData(30)]
    public void A_corner_of_a_flat_surface_is_not_touched_from_aside(float degrees)
    {
        foreach (var aside in new[] { new Vector3(-1, 0, -1), new Vector3(-1, 0, -.1f), new Vector3(0, 0, -1) })
            Assert.Equal(0, Touch(Shape, Cone(0), Shape.B, aside, degrees).Count);
        Assert.Equal(1, Touch(Shape, Cone(0, freeMask: 3), Shape.B, new Vector3(-1, 0, -1), degrees).Count);
    }

    /// <summary>A triangle a hundred times as long as wide is bounded by its long edge as any other.</summary>
    [Theory, InlineData(.03f), InlineData(.2f), InlineData(5)]
    public void An_edge_of_a_sliver_bounds(float degrees)
    {
        var sliver = new Triangle(new(0, 0, 5), new(0, 0, -5), new(.1f, 0, 0));
        Assert.Equal(0, Touch(sliver, Cone(0), default, -Vector3.UnitX, degrees).Count);
        Assert.Equal(1, Touch(sliver, Cone(0, freeMask: 1), default, -Vector3.UnitX, degrees).Count);
    }
}
