using System.Collections.Generic;
using System.Numerics;
using BepuPhysics.Collidables;
using BepuPhysics.CollisionDetection;
using DemoTests.Collidables.Meshes;
using Xunit;

namespace DemoTests.CollisionDetection.Children;

/// <summary>
/// A ball is not tested with triangles that it touches beyond a neighbour only. Its contacts are bit for bit those that it has when it is tested with all of
/// them, which is so for whoever may change what they have found: on hills, on spikes, at corners of saddles, and where triangles are not to be touched.
/// </summary>
public sealed class BallSidesTests() : ShapesTest(61)
{
    const int Side = 24;
    const int Refused = 5;

    interface IChange
    {
        static abstract bool IsDone { get; }
    }

    struct Nothing : IChange
    {
        public static bool IsDone => false;
    }

    struct Something : IChange
    {
        public static bool IsDone => true;
    }

    sealed class Log
    {
        public readonly List<(int Pair, Vector3 Normal, Vector3 Offset, float Depth, int Feature)> Contacts = [];
        public int TestedCount;
        public bool Refuses;

        public void Add<TManifold>(int pair, ref TManifold manifold) where TManifold : unmanaged, IContactManifold<TManifold>
        {
            for (int contact = 0; contact < manifold.Count; ++contact)
            {
                var (offset, depth) = (manifold.GetOffset(contact), manifold.GetDepth(contact));
                Contacts.Add((pair, manifold.GetNormal(contact), offset, depth, manifold.GetFeatureId(contact)));
            }
        }
    }

    readonly struct Callbacks<TChange>(Log log) : ICollisionCallbacks where TChange : struct, IChange
    {
        static bool ICollisionCallbacks.ChangesChildren => TChange.IsDone;

        public bool AllowCollisionTesting(int pairId, int childA, int childB)
        {
            ++log.TestedCount;
            return !log.Refuses || (childB + pairId) % Refused != 0;
        }

        public void OnPairCompleted<TManifold>(int pairId, ref TManifold manifold) where TManifold : unmanaged, IContactManifold<TManifold> =>
            log.Add(pairId, ref manifold);

        public void OnChildPairCompleted(int pairId, int childA, int childB, ref ConvexContactManifold manifold) { }
    }

    [Theory]
    [InlineData(false)]
    [InlineData(true)]
    public void Contacts_are_those_of_all_triangles(bool refuses)
    {
        var (tested, all, contacts) = (0, 0, 0);
        foreach (var roughness in new[] { 0, .01f, .1f, .3f, 1, 2 })
        {
            var sample = MeshSample.Terrain(Side);
            for (int i = 0; i < sample.Vertices.Length; ++i)
                sample.Vertices[i] += new Vector3(.3f * Offset(), 1, .3f * Offset()) * (roughness * Offset());
            foreach (var scale in new[] { Vector3.One, new(1.5f, .7f, 1), new(-1, 1, 1) })
            {
                var mesh = new Mesh(sample.Vertices, sample.Indices, scale, pool);
                var balls = Balls(mesh, 400);
                var surface = shapes.Add(mesh);
                var some = Test<Nothing>(surface, balls, refuses);
                var every = Test<Something>(surface, balls, refuses);
                Assert.Equal(every.Contacts, some.Contacts);
                tested += some.TestedCount;
                all += every.TestedCount;
                contacts += every.Contacts.Count;
                shapes.RemoveAndDispose(surface, pool);
            }
        }
        Assert.InRange(contacts, 1000, int.MaxValue);
        // Of a third of the meshes, which are mirrored, all are tested; what is not touched and only near a neighbour is left out for both (BeyondEdgeTests).
        Assert.InRange(tested, 1, all * 4 / 5);
    }

    float Offset() => 2 * random.NextSingle() - 1;

    // Over faces, and at corners.
    (Vector3 Place, float Radius, float Margin)[] Balls(in Mesh mesh, int count)
    {
        var balls = new (Vector3, float, float)[count];
        for (int i = 0; i < count; ++i)
        {
            mesh.GetLocalChild(random.Next(mesh.ChildCount), out var triangle);
            var up = Vector3.Normalize(Vector3.Cross(triangle.C - triangle.A, triangle.B - triangle.A));
            var radius = .02f + random.NextSingle() * random.NextSingle();
            var (b, c) = (random.NextSingle(), random.NextSingle());
            var place = i % 4 == 0 ? triangle.A + .1f * new Vector3(Offset(), Offset(), Offset()) :
                triangle.A + b * (triangle.B - triangle.A) + (1 - b) * c * (triangle.C - triangle.A);
            balls[i] = (place + up * (1.4f * radius * random.NextSingle()), radius, i % 3 == 0 ? 0 : .1f * random.NextSingle());
        }
        return balls;
    }

    Log Test<TChange>(TypedIndex surface, (Vector3 Place, float Radius, float Margin)[] balls, bool refuses) where TChange : struct, IChange
    {
        var log = new Log { Refuses = refuses };
        var batcher = new CollisionBatcher<Callbacks<TChange>>(pool, shapes, registry, 1 / 60f, new(log));
        var added = new TypedIndex[balls.Length];
        for (int i = 0; i < balls.Length; ++i)
        {
            added[i] = shapes.Add(new Sphere(balls[i].Radius));
            batcher.Add(added[i], surface, -balls[i].Place, Quaternion.Identity, Quaternion.Identity, balls[i].Margin, new(i));
        }
        batcher.Flush();
        foreach (var ball in added)
            shapes.Remove(ball);
        log.Contacts.Sort((x, y) => x.Pair.CompareTo(y.Pair) is not 0 and var pairs ? pairs : x.Feature.CompareTo(y.Feature));
        return log;
    }
}
