using System;
using System.Collections.Generic;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuPhysics.Trees;
using BepuUtilities.Memory;
using DemoTests.Scenes;
using Xunit;

namespace DemoTests.Compatibility;

/// <summary>Names without which code of published games does not compile: each does here what it does there.</summary>
public class ClientNamesTests
{
    [Fact]
    public void Triangles_of_a_hull_enclose_it()
    {
        using var pool = new BufferPool();
        Vector3[] corners = [new(0, 0, 0), new(2, 0, 0), new(0, 3, 0), new(2, 3, 0), new(0, 0, 4), new(2, 0, 4), new(0, 3, 4), new(2, 3, 4)];
        var hull = new ConvexHull(corners, pool, out _);
        var triangles = new ConvexHull.ConvexHullTriangleSource(hull);
        MeshInertiaHelper.ComputeClosedInertia(ref triangles, 5, out var volume, out var inertia, out var center);
        Assert.Equal(24, volume, 1e-4f);
        Assert.True(center.Length() < 1e-5f, $"{center}");
        // Of a solid box, m (b2 + c2) / 12.
        Assert.Equal(5 * (9 + 16) / 12f, inertia.XX, 1e-4f);
        Assert.Equal(5 * (4 + 16) / 12f, inertia.YY, 1e-4f);
        Assert.Equal(5 * (4 + 9) / 12f, inertia.ZZ, 1e-4f);
        Assert.False(triangles.GetNextTriangle(out _, out _, out _));
        hull.Dispose(pool);
        var none = new ConvexHull.ConvexHullTriangleSource(default);
        Assert.False(none.GetNextTriangle(out _, out _, out _));
    }

    // Each edge once in each direction, and every triangle with its front to the outside: closed, and nothing twice.
    [Fact]
    public void Triangles_of_any_hull_are_closed_and_face_outwards()
    {
        using var pool = new BufferPool();
        var random = new Random(3);
        for (int n = 0; n < 20; ++n)
        {
            var points = new Vector3[4 + n * 3];
            for (int i = 0; i < points.Length; ++i)
                points[i] = new(random.NextSingle() * 3, MathF.Round(random.NextSingle() * 2), random.NextSingle());
            if (!ConvexHullHelper.CreateShape(points, pool, out _, out var hull))
                continue;
            var edges = new HashSet<(Vector3, Vector3)>();
            var triangles = new ConvexHull.ConvexHullTriangleSource(hull);
            var count = 0;
            for (; triangles.GetNextTriangle(out var a, out var b, out var c); ++count)
            {
                Assert.True(Vector3.Dot(Vector3.Cross(c - a, b - a), a) > 0, $"{a} {b} {c}");
                Assert.True(edges.Add((a, b)) && edges.Add((b, c)) && edges.Add((c, a)));
            }
            Assert.All(edges, edge => Assert.Contains((edge.Item2, edge.Item1), edges));
            // Euler, for triangles on a closed surface.
            Assert.Equal(2 * hull.VertexCount - 4, count);
            hull.Dispose(pool);
        }
    }

    [Fact]
    public void A_pose_gets_where_a_kinematic_body_gets()
    {
        using var world = new TestWorld();
        var random = new Random(4);
        var start = new RigidPose(new Vector3(1, 2, 3), TestWorld.Turn(random));
        var velocity = new BodyVelocity(new Vector3(4, -5, 6), new Vector3(2, 1, -3));
        // Nothing pulls or stops a kinematic body.
        var handle = world.AddKinematic(new Sphere(.5f), start);
        world.Bodies[handle].Velocity = velocity;
        world.Step(60);
        PoseIntegration.Integrate(start, velocity, 1, out var end);
        var pose = world.Bodies[handle].Pose;
        Assert.True((pose.Position - end.Position).Length() < 1e-4f, $"{pose.Position} {end.Position}");
        Assert.True(MathF.Abs(Quaternion.Dot(pose.Orientation, end.Orientation)) > 1 - 1e-6f, $"{pose.Orientation} {end.Orientation}");

        PoseIntegration.Integrate(end, velocity, -1, out end);
        Assert.True((end.Position - start.Position).Length() < 1e-5f, $"{end.Position}");
        Assert.True((end.Orientation - start.Orientation).Length() < 1e-5f, $"{end.Orientation} {start.Orientation}");

        // A quarter about Y takes Z to X, many turns and a quarter as well.
        foreach (var turns in new[] { 0, 50 })
        {
            PoseIntegration.Integrate(Quaternion.Identity, new Vector3(0, MathF.PI * (turns * 2 + .5f), 0), 1, out var quarter);
            Assert.True((Vector3.Transform(Vector3.UnitZ, quarter) - Vector3.UnitX).Length() < 1e-4f, $"{quarter}");
        }
    }

    [Fact]
    public void A_ray_without_a_pool_hits_what_a_ray_with_a_pool_hits()
    {
        using var world = new TestWorld();
        world.AddStatic(new Box(4, 1, 4), RigidPose.Identity);
        var with = default(Nearest);
        world.Simulation.RayCast(new Vector3(1, 5, 1), -Vector3.UnitY, 10, world.Pool, ref with, 7);
        var without = default(Nearest);
        world.Simulation.RayCast(new Vector3(1, 5, 1), -Vector3.UnitY, 10, ref without, 7);
        Assert.Equal((4.5f, 7), (without.T, without.Id));
        Assert.Equal(with, without);
    }

    record struct Nearest(float T, int Id) : IRayHitHandler
    {
        public readonly bool AllowTest(CollidableReference collidable) => true;

        public readonly bool AllowTest(CollidableReference collidable, int childIndex) => true;

        public void OnRayHit(in RayData ray, ref float maximumT, float t, Vector3 normal, CollidableReference collidable, int childIndex) =>
            (T, Id, maximumT) = (t, ray.Id, t);
    }
}
