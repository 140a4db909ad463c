using System.Collections.Generic;
using System.Numerics;
using BepuPhysics.Collidables;
using BepuPhysics.CollisionDetection;
using BepuUtilities;
using DemoTests.Collidables.Meshes;
using Xunit;

namespace DemoTests.CollisionDetection.Children;

/// <summary>
/// Contacts with a mesh are those with each of its triangles alone, bit for bit, and none is missing but of triangles that are not touched, and of which
/// what is near is a neighbour's.
/// </summary>
public sealed class MeshContactTests() : ShapesTest(41)
{
    const float Margin = .2f;
    const int PairCount = 60;

    private protected override void RemoveShapes()
    {
        foreach (var typeId in new[] { Mesh.Id, ConvexHull.Id })
        {
            for (int i = 0; typeId < shapes.RegisteredTypeSpan && shapes[typeId] is { } batch && batch.Count > 0; ++i)
            {
                if (batch.Exists(i))
                    batch.RemoveAndDispose(i, pool);
            }
        }
    }

    sealed class Log
    {
        public readonly Dictionary<(int Pair, int A, int B), ConvexContactManifold> Children = [];
        public readonly Dictionary<int, ConvexContactManifold> Pairs = [];
    }

    readonly struct Callbacks(Log log) : ICollisionCallbacks
    {
        public bool AllowCollisionTesting(int pairId, int childA, int childB) => true;

        public void OnChildPairCompleted(int pairId, int childA, int childB, ref ConvexContactManifold manifold) =>
            log.Children.Add((pairId, childA, childB), manifold);

        public void OnPairCompleted<TManifold>(int pairId, ref TManifold manifold) where TManifold : unmanaged, IContactManifold<TManifold>
        {
            if (manifold is ConvexContactManifold convex)
                log.Pairs.Add(pairId, convex);
        }
    }

    Vector3 Next(float range) => new((random.NextSingle() * 2 - 1) * range, (random.NextSingle() * 2 - 1) * range, (random.NextSingle() * 2 - 1) * range);

    Quaternion NextTurn() => Quaternion.Normalize(new(Next(1), random.NextSingle() - .5f));

    TypedIndex AddConvex(int typeId) => typeId switch
    {
        Sphere.Id => shapes.Add(new Sphere(.4f)),
        Capsule.Id => shapes.Add(new Capsule(.2f, .8f)),
        Box.Id => shapes.Add(new Box(.9f, .5f, .7f)),
        Triangle.Id => shapes.Add(new Triangle(new(-.6f, 0, -.3f), new(.6f, 0, -.3f), new(0, 0, .6f))),
        Cylinder.Id => shapes.Add(new Cylinder(.3f, .7f)),
        _ => AddHull(),
    };

    TypedIndex AddHull()
    {
        var points = new Vector3[12];
        for (int i = 0; i < points.Length; ++i)
            points[i] = Next(.6f);
        return shapes.Add(new ConvexHull(points, pool, out _));
    }

    [Theory]
    [InlineData(Sphere.Id, 1, 1, 1), InlineData(Capsule.Id, 1, 1, 1), InlineData(Box.Id, 1, 1, 1), InlineData(Triangle.Id, 1, 1, 1)]
    [InlineData(Cylinder.Id, 1, 1, 1), InlineData(ConvexHull.Id, 1, 1, 1), InlineData(Box.Id, -1, 1, 1), InlineData(Sphere.Id, .7f, 2, -1.3f)]
    public void A_convex_shape_meets_each_triangle_as_if_alone(int typeId, float x, float y, float z)
    {
        var sample = MeshSample.Terrain(8);
        var mesh = new Mesh(sample.Vertices, sample.Indices, new(x, y, z), pool);
        var meshIndex = shapes.Add(mesh);
        var triangles = new TypedIndex[mesh.ChildCount];
        var centers = new Vector3[mesh.ChildCount];
        for (int i = 0; i < triangles.Length; ++i)
        {
            mesh.GetPosedLocalChild(i, out var child, out var pose);
            (triangles[i], centers[i]) = (shapes.Add(child), pose.Position);
        }
        // Some seeds have fewer contacts in each round than others.
        var contactCount = 0;
        for (int round = 0; round < 10 && contactCount <= 2 * PairCount; ++round)
            contactCount += CompareRound(typeId, mesh, meshIndex, triangles, centers);
        Assert.True(contactCount > 2 * PairCount, $"{contactCount} contacts");
    }

    // Number of contacts.
    int CompareRound(int typeId, Mesh mesh, TypedIndex meshIndex, TypedIndex[] triangles, Vector3[] centers)
    {
        Log together = new(), alone = new();
        var corners = new Triangle[triangles.Length];
        for (int i = 0; i < corners.Length; ++i)
            mesh.GetLocalChild(i, out corners[i]);
        var owners = new TriangleOwners(corners);
        var turns = new Quaternion[PairCount];
        var batcher = new CollisionBatcher<Callbacks>(pool, shapes, registry, 1 / 60f, new(together));
        var tester = new CollisionBatcher<Callbacks>(pool, shapes, registry, 1 / 60f, new(alone));
        for (int pair = 0; pair < PairCount; ++pair)
        {
            var convex = AddConvex(typeId);
            Quaternion meshTurn = NextTurn(), convexTurn = NextTurn();
            turns[pair] = meshTurn;
            mesh.GetLocalChild(random.Next(mesh.ChildCount), out var near);
            var offset = Exact.Rotate(-((near.A + near.B + near.C) / 3 + Next(.5f)), meshTurn);
            // From either side.
            batcher.Add(convex, meshIndex, offset, convexTurn, meshTurn, Margin, new(2 * pair));
            batcher.Add(meshIndex, convex, -offset, meshTurn, convexTurn, Margin, new(2 * pair + 1));
            for (int i = 0; i < triangles.Length; ++i)
            {
                var place = Exact.Rotate(centers[i], meshTurn);
                tester.Add(convex, triangles[i], offset + place, convexTurn, Exact.Concatenate(Quaternion.Identity, meshTurn), Margin,
                    new(2 * (pair * triangles.Length + i)));
                tester.Add(triangles[i], convex, -offset - place, Exact.Concatenate(Quaternion.Identity, meshTurn), convexTurn, Margin,
                    new(2 * (pair * triangles.Length + i) + 1));
            }
        }
        batcher.Flush();
        tester.Flush();
        batcher.Dispose();
        tester.Dispose();
        var contactCount = 0;
        for (int pair = 0; pair < PairCount; ++pair)
        {
            for (int i = 0; i < triangles.Length; ++i)
            {
                var expected = alone.Pairs[2 * (pair * triangles.Length + i)];
                if (!together.Children.ContainsKey((2 * pair, 0, i)))
                {
                    Assert.True(typeId == Triangle.Id ? expected.Count == 0 : owners.HasNothing(expected, i, turns[pair]), $"pair {pair}, triangle {i}");
                    Assert.False(together.Children.ContainsKey((2 * pair + 1, i, 0)));
                    continue;
                }
                contactCount += AssertSame(expected, together.Children.GetValueOrDefault((2 * pair, 0, i)), default);
                AssertSame(alone.Pairs[2 * (pair * triangles.Length + i) + 1], together.Children.GetValueOrDefault((2 * pair + 1, i, 0)), null);
            }
        }
        return contactCount;
    }

    // Contacts of a mesh that is A are told from its own centre, so their places are left out.
    static int AssertSame(ConvexContactManifold expected, ConvexContactManifold actual, Vector3? offset)
    {
        Assert.Equal(expected.Count, actual.Count);
        for (int i = 0; i < expected.Count; ++i)
        {
            expected.GetContact(i, out var place, out var normal, out var depth, out var feature);
            actual.GetContact(i, out var actualPlace, out var actualNormal, out var actualDepth, out var actualFeature);
            Assert.Equal((normal, depth, feature), (actualNormal, actualDepth, actualFeature));
            if (offset is not null)
                Assert.Equal(place, actualPlace);
        }
        return expected.Count;
    }

    /// <summary>Two meshes that go down each other's trees find every two triangles that touch.</summary>
    [Theory, InlineData(1, 1, 1), InlineData(-1.5f, .5f, 1)]
    public void Two_meshes_meet_in_all_pairs_of_triangles_that_meet(float x, float y, float z)
    {
        var torus = MeshSample.Torus(2, .6f, 14, 8);
        var terrain = MeshSample.Terrain(6);
        Mesh a = new(torus.Vertices, torus.Indices, new(x, y, z), pool), b = new(terrain.Vertices, terrain.Indices, Vector3.One, pool);
        TypedIndex indexA = shapes.Add(a), indexB = shapes.Add(b);
        var contactCount = 0;
        for (int pair = 0; pair < 6; ++pair)
        {
            Quaternion turnA = NextTurn(), turnB = NextTurn();
            var offset = Next(1);
            Log together = new(), alone = new();
            var batcher = new CollisionBatcher<Callbacks>(pool, shapes, registry, 1 / 60f, new(together));
            batcher.Add(indexA, indexB, offset, turnA, turnB, Margin, new(0));
            batcher.Flush();
            batcher.Dispose();
            var tester = new CollisionBatcher<Callbacks>(pool, shapes, registry, 1 / 60f, new(alone));
            for (int i = 0; i < a.ChildCount; ++i)
            {
                a.GetPosedLocalChild(i, out var triangleA, out var poseA);
                var first = shapes.Add(triangleA);
                for (int j = 0; j < b.ChildCount; ++j)
                {
                    b.GetPosedLocalChild(j, out var triangleB, out var poseB);
                    var second = shapes.Add(triangleB);
                    var between = offset + Exact.Rotate(poseB.Position, turnB) - Exact.Rotate(poseA.Position, turnA);
                    tester.Add(first, second, between, Exact.Concatenate(Quaternion.Identity, turnA), Exact.Concatenate(Quaternion.Identity, turnB), Margin,
                        new(i * b.ChildCount + j));
                }
                tester.Flush();
                shapes[Triangle.Id]!.Clear();
            }
            tester.Dispose();
            foreach (var (id, expected) in alone.Pairs)
                contactCount += AssertSame(expected, together.Children.GetValueOrDefault((0, id / b.ChildCount, id % b.ChildCount)), null);
        }
        Assert.True(contactCount > 50, $"{contactCount} contacts");
    }
}
