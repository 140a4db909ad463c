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
    static ConvexContactManifold Touch(TriangleCone? cone, float degrees, float depth = 1e-3f)
    {
        using var world = new ClusterWorld(isCluster: true);
        if (cone is { } known)
            world.Rules.Cones = _ => known;
        world.Simulation.Statics.Add(new StaticDescription(default(Vector3), world.AddCluster([new(world.Simulation.Shapes.Add(Shape), RigidPose.Identity)])));
        var (sine, cosine) = MathF.SinCos(degrees * MathF.PI / 180);
        world.AddBody(new Sphere(Radius), new RigidPose(new Vector3(-sine, cosine, 0) * (Radius - depth)));
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

    /// <summary>What is over the triangle is pushed along its normal, wherever the nearest way out is.</summary>
    [Fact]
    public void What_is_over_the_triangle_stays_on_it()
    {
        using var world = new ClusterWorld(isCluster: true);
        world.Rules.Cones = _ => Cone(0);
        world.Simulation.Statics.Add(new StaticDescription(default(Vector3), world.AddCluster([new(world.Simulation.Shapes.Add(Shape), RigidPose.Identity)])));
        // A millimetre over the edge, two deep: alone, the way out is to the side.
        world.AddBody(new Box(1, 1, 1), new RigidPose(new Vector3(-.499f, .498f, 0)));
        ConvexContactManifold seen = default;
        world.Behaviour.Configure = manifold =>
        {
            seen = (ConvexContactManifold)manifold;
            return null;
        };
        world.Step();
        Assert.InRange(seen.Count, 2, 4);
        Assert.Equal(Vector3.UnitY, seen.Normal);
        Assert.Equal(.002f, seen.Contact0.Depth, 1e-5);
    }
}
