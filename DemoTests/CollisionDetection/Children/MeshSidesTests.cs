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
/// Which triangles of a mesh a convex shape is tested with: what it is beside or in front of by more than the margin is left out; what else is left out has no
/// contacts, or a neighbour has them; whatever the mesh's scale, and whoever asks at the same time.
/// </summary>
public sealed class MeshSidesTests() : ShapesTest(59)
{
    const float Margin = .05f;
    // What places are rounded by.
    const double Slack = 2e-4;

    static readonly Vector3[] scales = [Vector3.One, new(1.5f, .8f, 1.2f), new(-1, 1, 1), new(1, -1, 1)];

    readonly struct Callbacks(HashSet<(int Pair, int Triangle)> tested, Dictionary<(int Pair, int Triangle), int> contacts) : ICollisionCallbacks
    {
        public bool AllowCollisionTesting(int pairId, int childA, int childB) => tested.Add((pairId, childB));

        public void OnChildPairCompleted(int pairId, int childA, int childB, ref ConvexContactManifold manifold) { }

        public void OnPairCompleted<TManifold>(int pairId, ref TManifold manifold) where TManifold : unmanaged, IContactManifold<TManifold> =>
            contacts[(pairId, 0)] = manifold.Count;
    }

    static readonly Func<float, (Func<Shapes, TypedIndex> Add, Func<Vector3, float> Extent)>[] kinds =
    [
        size => (shapes => shapes.Add(new Sphere(size)), _ => size),
        size => (shapes => shapes.Add(new Capsule(size * .5f, size)), axis => .5f * size + .5f * size * MathF.Abs(axis.Y)),
        size => (shapes => shapes.Add(new Box(size, size * 2, size * .3f)),
            axis => .5f * (size * MathF.Abs(axis.X) + 2 * size * MathF.Abs(axis.Y) + .3f * size * MathF.Abs(axis.Z))),
        size => (shapes => shapes.Add(new Cylinder(size, size * .4f)),
            axis => size * MathF.Sqrt(axis.X * axis.X + axis.Z * axis.Z) + .2f * size * MathF.Abs(axis.Y)),
    ];

    [Fact]
    public void A_shape_is_tested_with_what_it_is_neither_beside_nor_in_front_of()
    {
        var (leftOut, boxed) = (0, 0);
        var sample = MeshSample.Terrain(24);
        foreach (var scale in scales)
        {
            var mesh = new Mesh(sample.Vertices, sample.Indices, scale, pool);
            var triangles = new Triangle[mesh.ChildCount];
            for (int i = 0; i < triangles.Length; ++i)
                mesh.GetLocalChild(i, out triangles[i]);
            Compare(triangles, shapes.Add(mesh), ref leftOut, ref boxed);
        }
        // Of all that boxes meet, or the test says nothing.
        Assert.InRange(leftOut, boxed / 8, boxed);
    }

    [Fact]
    public void So_it_is_on_a_height_field()
    {
        const int side = 24;
        var heights = new float[side * side];
        for (int i = 0; i < heights.Length; ++i)
            heights[i] = MathF.Sin(.2f * (i % side)) + MathF.Sin(.17f * (i / side) + 1) + .2f * random.NextSingle();
        var field = new HeightField(side, side, .9f, 1.1f, heights, pool);
        var triangles = new Triangle[field.ChildCount];
        for (int i = 0; i < triangles.Length; ++i)
            field.GetLocalChild(i, out triangles[i]);
        var (leftOut, boxed) = (0, 0);
        Compare(triangles, shapes.Add(field), ref leftOut, ref boxed);
        Assert.InRange(leftOut, boxed / 8, boxed);
    }

    void Compare(Triangle[] triangles, TypedIndex surface, ref int leftOut, ref int boxed)
    {
        foreach (var kind in kinds)
        {
            var (add, extent) = kind(.25f + .25f * random.NextSingle());
            Compare(triangles, surface, add(shapes), extent, ref leftOut, ref boxed);
        }
        // More than there is room for where several ask together.
        var large = kinds[^1](4);
        var (ofLarge, ofLargeBoxes) = (0, 0);
        Compare(triangles, surface, large.Add(shapes), large.Extent, ref ofLarge, ref ofLargeBoxes);
        shapes.RemoveAndDispose(surface, pool);
    }

    // All at once, so that they ask together.
    void Compare(Triangle[] triangles, TypedIndex surface, TypedIndex shape, Func<Vector3, float> extent, ref int leftOut, ref int boxed)
    {
        const int pairCount = 40;
        var tested = new HashSet<(int, int)>();
        var batcher = new CollisionBatcher<Callbacks>(pool, shapes, registry, 1 / 60f, new(tested, []));
        var poses = new RigidPose[pairCount];
        var owners = new TriangleOwners(triangles);
        for (int pair = 0; pair < pairCount; ++pair)
        {
            var near = triangles[random.Next(triangles.Length)];
            var up = Vector3.Normalize(Vector3.Cross(near.C - near.A, near.B - near.A));
            poses[pair] = new((near.A + near.B + near.C) / 3 + up * (.6f * random.NextSingle()),
                Quaternion.Normalize(new(random.NextSingle() - .5f, random.NextSingle() - .5f, random.NextSingle() - .5f, random.NextSingle() - .5f)));
            batcher.Add(shape, surface, -poses[pair].Position, poses[pair].Orientation, Quaternion.Identity, Margin, new(pair));
        }
        batcher.Flush();
        for (int pair = 0; pair < pairCount; ++pair)
        {
            for (int i = 0; i < triangles.Length; ++i)
            {
                var (ofBoxes, ofSides) = Gaps(poses[pair], extent, triangles[i]);
                var isTested = tested.Contains((pair, i));
                var gap = Math.Max(ofBoxes, ofSides) - Margin;
                var isSound = isTested ? gap < Slack :
                    gap > -Slack || owners.HasNothing(owners.Test(shapes, registry, pool, shape, poses[pair], Margin, i), i);
                Assert.True(isSound, $"pair {pair}, triangle {i}: tested {isTested}, it is {gap:g3} m apart");
                leftOut += ofBoxes < Margin && !isTested ? 1 : 0;
                boxed += ofBoxes < Margin ? 1 : 0;
            }
        }
    }

    static (double OfBoxes, double OfSides) Gaps(in RigidPose pose, Func<Vector3, float> extent, in Triangle triangle)
    {
        var (ofBoxes, ofSides) = (double.MinValue, double.MinValue);
        for (int axis = 0; axis < 3; ++axis)
        {
            var unit = Vector3.Zero;
            unit[axis] = 1;
            var half = extent(Vector3.Transform(unit, Quaternion.Conjugate(pose.Orientation)));
            var least = Math.Min(triangle.A[axis], Math.Min(triangle.B[axis], triangle.C[axis]));
            var greatest = Math.Max(triangle.A[axis], Math.Max(triangle.B[axis], triangle.C[axis]));
            ofBoxes = Math.Max(ofBoxes, Math.Max(least - (pose.Position[axis] + half), pose.Position[axis] - half - greatest));
        }
        var sides = new TriangleSides(triangle);
        for (int side = 0; side < TriangleSides.Count; ++side)
        {
            var normal = new Vector3((float)sides.Along(side, 1, 0, 0), (float)sides.Along(side, 0, 1, 0), (float)sides.Along(side, 0, 0, 1));
            ofSides = Math.Max(ofSides, sides.Height(side, pose.Position) - extent(Vector3.Transform(normal, Quaternion.Conjugate(pose.Orientation))));
        }
        return (ofBoxes, ofSides);
    }

    [Theory, InlineData(1f, 1f), InlineData(1e-5f, 1f), InlineData(1e-3f, 1f), InlineData(1e3f, 1f), InlineData(1f, 1e-4f)]
    public void What_touches_a_triangle_is_tested_with_it_whatever_its_form(float size, float thickness)
    {
        // Thin ones have normals that floats can hardly tell. Each triangle alone is the reference.
        var sample = MeshSample.Soup(120, 7, size * 4, size);
        for (int i = 0; i < sample.Vertices.Length; ++i)
            sample.Vertices[i].Y *= thickness;
        var mesh = new Mesh(sample.Vertices, sample.Indices, Vector3.One, pool);
        var meshIndex = shapes.Add(mesh);
        TypedIndex[] movers =
            [shapes.Add(new Sphere(size * .3f)), shapes.Add(new Box(size, size * .2f, size * .6f)), shapes.Add(new Cylinder(size * .4f, size * .2f))];
        var tested = new HashSet<(int, int)>();
        var touching = 0;
        for (int pair = 0; pair < 240; ++pair)
        {
            var mover = movers[pair % movers.Length];
            var pose = new RigidPose(sample.Vertices[random.Next(sample.Vertices.Length)] + size * .3f * new Vector3(
                random.NextSingle() - .5f, random.NextSingle() - .5f, random.NextSingle() - .5f),
                Quaternion.Normalize(new(random.NextSingle() - .5f, random.NextSingle() - .5f, random.NextSingle() - .5f, random.NextSingle() - .5f)));
            var margin = size * .02f;
            var batcher = new CollisionBatcher<Callbacks>(pool, shapes, registry, 1 / 60f, new(tested, []));
            batcher.Add(mover, meshIndex, -pose.Position, pose.Orientation, Quaternion.Identity, margin, new(pair));
            batcher.Flush();
            for (int i = 0; i < mesh.ChildCount; ++i)
            {
                if (mesh.IsLeftOut(i))
                    continue;
                mesh.GetPosedLocalChild(i, out var triangle, out var place);
                var alone = shapes.Add(triangle);
                var contacts = new Dictionary<(int, int), int>();
                var single = new CollisionBatcher<Callbacks>(pool, shapes, registry, 1 / 60f, new([], contacts));
                single.Add(mover, alone, place.Position - pose.Position, pose.Orientation, Quaternion.Identity, margin, new(0));
                single.Flush();
                if (contacts[(0, 0)] > 0)
                {
                    ++touching;
                    Assert.Contains((pair, i), tested);
                }
                shapes.RemoveAndDispose(alone, pool);
            }
        }
        Assert.True(touching > 60, $"{touching} touch");
        shapes.RemoveAndDispose(meshIndex, pool);
    }
}
