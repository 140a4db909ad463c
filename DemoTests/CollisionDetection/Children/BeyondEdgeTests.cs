using System;
using System.Collections.Generic;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuPhysics.CollisionDetection;
using DemoTests.Collidables.Meshes;
using Xunit;

namespace DemoTests.CollisionDetection.Children;

/// <summary>
/// A shape is not tested with triangles that it does not touch, and of which all that is near is a neighbour's. That changes no contact: each of them alone has
/// none, or those of a direction that the neighbour has; and mirrored meshes, whose triangles are all tested, have the mirror image.
/// </summary>
public sealed class BeyondEdgeTests() : ShapesTest(67)
{
    const int Side = 24;
    const float Slack = 1e-3f;
    static readonly float[] roughnesses = [0, .01f, .1f, .3f, 1];

    readonly struct Callbacks(HashSet<(int Pair, int Triangle)> tested, (int Count, float Depth)[] results) : ICollisionCallbacks
    {
        public bool AllowCollisionTesting(int pairId, int childA, int childB) => tested.Add((pairId, childB));

        public void OnChildPairCompleted(int pairId, int childA, int childB, ref ConvexContactManifold manifold) { }

        public void OnPairCompleted<TManifold>(int pairId, ref TManifold manifold) where TManifold : unmanaged, IContactManifold<TManifold>
        {
            var depth = float.MinValue;
            for (int i = 0; i < manifold.Count; ++i)
                depth = float.Max(depth, manifold.GetDepth(i));
            results[pairId] = (manifold.Count, depth);
        }
    }

    readonly record struct Placed(TypedIndex Shape, RigidPose Pose, float Margin);

    // Wheels, boxes, capsules, a hull that is its own mirror image, and balls.
    TypedIndex[] Movers()
    {
        var corners = new Vector3[16];
        for (int i = 0; i < corners.Length; ++i)
            corners[i] = new((i & 1) == 0 ? .2f : -.2f, (i & 2) == 0 ? .1f : -.1f, ((i & 4) == 0 ? .3f : -.3f) * ((i & 8) == 0 ? 1 : .5f));
        for (int i = 8; i < corners.Length; ++i)
            corners[i].X *= 1.5f;
        return
        [
            shapes.Add(new Cylinder(.4f, .18f)), shapes.Add(new Cylinder(.1f, .9f)), shapes.Add(new Box(.3f, .5f, .8f)), shapes.Add(new Box(.9f, .04f, .9f)),
            shapes.Add(new Capsule(.15f, .5f)), shapes.Add(new Sphere(.3f)), shapes.Add(new ConvexHull(corners, pool, out _)),
        ];
    }

    float Offset() => 2 * random.NextSingle() - 1;

    MeshSample Hills(float roughness)
    {
        var sample = MeshSample.Terrain(Side);
        for (int i = 0; i < sample.Vertices.Length; ++i)
            sample.Vertices[i] += new Vector3(.3f * Offset(), 1, .3f * Offset()) * (roughness * Offset());
        return sample;
    }

    // Over faces and at corners, touching and near.
    Placed[] Place(in Mesh mesh, TypedIndex[] movers, int count)
    {
        var placed = new Placed[count];
        for (int i = 0; i < count; ++i)
        {
            mesh.GetLocalChild(random.Next(mesh.ChildCount), out var triangle);
            var up = Vector3.Normalize(Vector3.Cross(triangle.C - triangle.A, triangle.B - triangle.A));
            var (b, c) = (random.NextSingle(), random.NextSingle());
            var place = i % 4 == 0 ? triangle.A + .1f * new Vector3(Offset(), Offset(), Offset()) :
                triangle.A + b * (triangle.B - triangle.A) + (1 - b) * c * (triangle.C - triangle.A);
            var orientation = Quaternion.Normalize(new(Offset(), Offset(), Offset(), Offset()));
            // Every second one rolls or stands.
            if (i % 2 == 0)
            {
                orientation = Quaternion.CreateFromAxisAngle(Vector3.UnitY, 3 * Offset()) *
                    Quaternion.CreateFromAxisAngle(Vector3.UnitZ, i % 6 == 0 ? 0 : MathF.PI / 2);
            }
            var pose = new RigidPose(place + up * (.02f + .45f * random.NextSingle()), orientation);
            placed[i] = new(movers[i % movers.Length], pose, i % 3 == 0 ? 0 : .15f * random.NextSingle());
        }
        return placed;
    }

    HashSet<(int Pair, int Triangle)> Test(TypedIndex surface, Placed[] placed, bool isMirrored, out (int Count, float Depth)[] results)
    {
        var tested = new HashSet<(int, int)>();
        results = new (int, float)[placed.Length];
        var batcher = new CollisionBatcher<Callbacks>(pool, shapes, registry, 1 / 60f, new(tested, results));
        for (int i = 0; i < placed.Length; ++i)
        {
            var (position, q) = (placed[i].Pose.Position, placed[i].Pose.Orientation);
            if (isMirrored)
            {
                position.X = -position.X;
                q = new(q.X, -q.Y, -q.Z, q.W);
            }
            batcher.Add(placed[i].Shape, surface, -position, q, Quaternion.Identity, placed[i].Margin, new(i));
        }
        batcher.Flush();
        return tested;
    }

    [Fact]
    public void What_is_left_out_alone_has_nothing_or_a_neighbours()
    {
        var movers = Movers();
        var (ofNeighbours, leftOut) = (0, 0);
        foreach (var roughness in roughnesses)
        {
            var sample = Hills(roughness);
            foreach (var scale in new[] { Vector3.One, new(1.5f, .7f, 1) })
            {
                var mesh = new Mesh(sample.Vertices, sample.Indices, scale, pool);
                var triangles = new Triangle[mesh.ChildCount];
                for (int i = 0; i < triangles.Length; ++i)
                    mesh.GetLocalChild(i, out triangles[i]);
                var owners = new TriangleOwners(triangles);
                var surface = shapes.Add(mesh);
                var placed = Place(mesh, movers, 210);
                var tested = Test(surface, placed, false, out _);
                for (int i = 0; i < placed.Length; ++i)
                {
                    for (int triangle = 0; triangle < triangles.Length; ++triangle)
                    {
                        if (tested.Contains((i, triangle)) || !IsNear(placed[i], triangles[triangle]))
                            continue;
                        var alone = owners.Test(shapes, registry, pool, placed[i].Shape, placed[i].Pose, placed[i].Margin, triangle);
                        ++leftOut;
                        ofNeighbours += alone.Count > 0 ? 1 : 0;
                        Assert.True(owners.HasNothing(alone, triangle), $"roughness {roughness}, mover {i % movers.Length}, triangle {triangle}");
                    }
                }
                shapes.RemoveAndDispose(surface, pool);
            }
        }
        // Or the test says nothing.
        Assert.InRange(ofNeighbours, 20, leftOut);
    }

    static bool IsNear(in Placed placed, in Triangle triangle)
    {
        var least = Vector3.Min(triangle.A, Vector3.Min(triangle.B, triangle.C)) - new Vector3(.8f);
        var greatest = Vector3.Max(triangle.A, Vector3.Max(triangle.B, triangle.C)) + new Vector3(.8f);
        return Vector3.Clamp(placed.Pose.Position, least, greatest) == placed.Pose.Position;
    }

    [Fact]
    public void Mirrored_meshes_have_the_mirror_image_of_the_contacts()
    {
        var movers = Movers();
        var (tested, all, touching, lost, gained) = (0, 0, 0, 0, 0);
        foreach (var roughness in roughnesses)
        {
            var sample = Hills(roughness);
            var mesh = new Mesh(sample.Vertices, sample.Indices, Vector3.One, pool);
            var placed = Place(mesh, movers, 4200);
            var surface = shapes.Add(mesh);
            var mirrored = shapes.Add(new Mesh(sample.Vertices, sample.Indices, new(-1, 1, 1), pool));
            tested += Test(surface, placed, false, out var some).Count;
            all += Test(mirrored, placed, true, out var every).Count;
            for (int i = 0; i < placed.Length; ++i)
            {
                touching += every[i].Count > 0 ? 1 : 0;
                // At the margin rounding decides.
                lost += every[i].Count > 0 && every[i].Depth > -placed[i].Margin + Slack && some[i].Depth < every[i].Depth - Slack ? 1 : 0;
                gained += some[i].Count > 0 && some[i].Depth > -placed[i].Margin + Slack && every[i].Depth < some[i].Depth - Slack ? 1 : 0;
            }
            shapes.RemoveAndDispose(surface, pool);
            shapes.RemoveAndDispose(mirrored, pool);
        }
        Assert.InRange(touching, 5000, int.MaxValue);
        // Where two directions out of what is deep are as good to rounding, each may be found; and at corners of saddles.
        Assert.InRange(lost, 0, touching / 1000);
        Assert.InRange(gained, 0, touching / 1000);
        Assert.InRange(tested, 1, all * 98 / 100);
    }

    /// <summary>A wheel that rolls on gentle hills stands on one triangle, mostly, and is near those around it only where that one is.</summary>
    [Fact]
    public void A_wheel_is_not_tested_with_triangles_that_it_only_straddles_an_edge_of()
    {
        var sample = Hills(.02f);
        var mesh = new Mesh(sample.Vertices, sample.Indices, new(3, 1, 3), pool);
        var wheel = shapes.Add(new Cylinder(.4f, .18f));
        var placed = new Placed[2000];
        for (int i = 0; i < placed.Length; ++i)
        {
            mesh.GetLocalChild(random.Next(mesh.ChildCount), out var triangle);
            var up = Vector3.Normalize(Vector3.Cross(triangle.C - triangle.A, triangle.B - triangle.A));
            var (b, c) = (random.NextSingle(), random.NextSingle());
            var place = triangle.A + b * (triangle.B - triangle.A) + (1 - b) * c * (triangle.C - triangle.A);
            var across = Vector3.Normalize(Vector3.Cross(up, new(Offset(), 0, Offset())));
            var orientation = Quaternion.Normalize(new(across.Z, 0, -across.X, 1 + across.Y));
            placed[i] = new(wheel, new(place + up * .4f, orientation), .2f);
        }
        var surface = shapes.Add(mesh);
        var tested = Test(surface, placed, false, out var results).Count;
        shapes.RemoveAndDispose(surface, pool);
        Assert.All(results, result => Assert.True(result.Count > 0));
        // 1.57; it is 2.21 where those are tested whose edge is below the wheel.
        Assert.InRange(tested / (float)placed.Length, 1, 1.7f);
    }

    private protected override void RemoveShapes()
    {
        if (shapes[ConvexHull.Id] is { } hulls)
        {
            for (int i = 0; i < hulls.Capacity; ++i)
            {
                if (shapes.Exists(new(ConvexHull.Id, i)))
                    shapes.RemoveAndDispose(new(ConvexHull.Id, i), pool);
            }
        }
    }
}
