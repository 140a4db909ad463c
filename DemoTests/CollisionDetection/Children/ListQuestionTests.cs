using System;
using System.Collections.Generic;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuPhysics.CollisionDetection;
using BepuUtilities.Memory;
using DemoTests.Collidables.Meshes;
using Xunit;

namespace DemoTests.CollisionDetection.Children;

/// <summary>
/// Which triangles the children of a compound are tested with: those whose boxes meet the child's own, as they are in the frame of the mesh, and that it is
/// neither beside nor in front of. Boxes of the tree that are turned into the frame of a compound are wider, and meet more.
/// </summary>
public sealed class ListQuestionTests() : ShapesTest(43)
{
    const float Margin = .01f;
    // What places are rounded by.
    const double Slack = 1e-4;

    static readonly Vector3[] Halves = [new(.9f, .05f, .06f), new(.05f, .8f, .04f), new(.3f, .3f, .3f)];
    static readonly Vector3[] Places = [new(1.5f, 0, 0), new(-1, .5f, .4f), new(0, -.4f, -1.2f)];

    private protected override void RemoveShapes()
    {
        shapes[Compound.Id]!.RemoveAndDispose(0, pool);
        shapes[Mesh.Id]!.RemoveAndDispose(0, pool);
    }

    readonly struct Callbacks(HashSet<(int Child, int Triangle)> tested) : ICollisionCallbacks
    {
        public bool AllowCollisionTesting(int pairId, int childA, int childB) => tested.Add((childA, childB));

        public void OnChildPairCompleted(int pairId, int childA, int childB, ref ConvexContactManifold manifold) { }

        public void OnPairCompleted<TManifold>(int pairId, ref TManifold manifold) where TManifold : unmanaged, IContactManifold<TManifold> { }
    }

    [Fact]
    public void Children_are_tested_with_what_their_own_boxes_meet()
    {
        pool.Take(Halves.Length, out Buffer<CompoundChild> children);
        for (int i = 0; i < Halves.Length; ++i)
            children[i] = new(new RigidPose(Places[i]), shapes.Add(new Box(2 * Halves[i].X, 2 * Halves[i].Y, 2 * Halves[i].Z)));
        var compound = shapes.Add(new Compound(children));
        var sample = MeshSample.Terrain(24);
        var mesh = new Mesh(sample.Vertices, sample.Indices, Vector3.One, pool);
        var meshIndex = shapes.Add(mesh);
        var (found, possible) = (0, 0);
        var triangles = new Triangle[mesh.ChildCount];
        for (int i = 0; i < triangles.Length; ++i)
            mesh.GetLocalChild(i, out triangles[i]);
        var owners = new TriangleOwners(triangles);
        for (int pair = 0; pair < 40; ++pair)
        {
            var turn = Quaternion.Normalize(new(random.NextSingle() - .5f, random.NextSingle() - .5f, random.NextSingle() - .5f, random.NextSingle() - .5f));
            mesh.GetLocalChild(random.Next(mesh.ChildCount), out var near);
            var place = (near.A + near.B + near.C) / 3;
            var tested = new HashSet<(int, int)>();
            var batcher = new CollisionBatcher<Callbacks>(pool, shapes, registry, 1 / 60f, new(tested));
            batcher.Add(compound, meshIndex, -place, turn, Quaternion.Identity, Margin, new(pair));
            batcher.Flush();
            for (int child = 0; child < Halves.Length; ++child)
            {
                for (int i = 0; i < mesh.ChildCount; ++i)
                {
                    mesh.GetLocalChild(i, out var triangle);
                    var gap = Gap(child, turn, place, triangle) - Margin;
                    var isTested = tested.Contains((child, i));
                    // What else is left out is apart all the same.
                    var isSound = isTested ? gap < Slack : gap > -Slack || IsApart(owners, child, turn, place, i);
                    Assert.True(isSound, $"child {child}, triangle {i}: tested {isTested}, it is {gap:g3} m apart");
                    (found, possible) = (found + (isTested ? 1 : 0), possible + 1);
                }
            }
        }
        Assert.InRange(found, 100, possible / 20);
    }

    bool IsApart(TriangleOwners owners, int child, Quaternion turn, Vector3 place, int triangle)
    {
        var box = shapes.Add(new Box(2 * Halves[child].X, 2 * Halves[child].Y, 2 * Halves[child].Z));
        var pose = new RigidPose(place + Vector3.Transform(Places[child], turn), turn);
        var count = owners.Test(shapes, registry, pool, box, pose, Margin, triangle).Count;
        shapes.Remove(box);
        return count == 0;
    }

    // Distance of a child and a triangle along the direction in which they are farthest apart: of the boxes around them, and of the child itself out of each
    // edge and from the front.
    static double Gap(int child, Quaternion turn, Vector3 place, in Triangle triangle)
    {
        double x = turn.X, y = turn.Y, z = turn.Z, w = turn.W;
        double[,] axes =
        {
            { 1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w) },
            { 2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w) },
            { 2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y) },
        };
        var gap = double.MinValue;
        for (int axis = 0; axis < 3; ++axis)
        {
            double center = place[axis], half = 0;
            for (int i = 0; i < 3; ++i)
            {
                center += axes[axis, i] * Places[child][i];
                half += Math.Abs(axes[axis, i]) * Halves[child][i];
            }
            var least = Math.Min(triangle.A[axis], Math.Min(triangle.B[axis], triangle.C[axis]));
            var greatest = Math.Max(triangle.A[axis], Math.Max(triangle.B[axis], triangle.C[axis]));
            gap = Math.Max(gap, Math.Max(least - (center + half), center - half - greatest));
        }
        var sides = new TriangleSides(triangle);
        for (int side = 0; side < TriangleSides.Count; ++side)
        {
            var (along, half) = (sides.Height(side, place), 0.0);
            for (int i = 0; i < 3; ++i)
            {
                var cosine = sides.Along(side, axes[0, i], axes[1, i], axes[2, i]);
                along += cosine * Places[child][i];
                half += Math.Abs(cosine) * Halves[child][i];
            }
            gap = Math.Max(gap, along - half);
        }
        return gap;
    }
}
