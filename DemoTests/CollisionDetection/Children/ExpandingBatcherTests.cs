using System;
using System.Collections.Generic;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuPhysics.CollisionDetection;
using BepuUtilities.Memory;
using Xunit;

namespace DemoTests.CollisionDetection.Children;

/// <summary>What a batcher does with pairs that are expanded, without a simulation.</summary>
public sealed class ExpandingBatcherTests : IDisposable
{
    readonly BufferPool pool = new();
    readonly Shapes shapes;
    readonly CollisionTaskRegistry registry = DefaultTypes.CreateDefaultCollisionTaskRegistry();
    readonly ClusterRules rules = new();
    readonly List<Buffer<ClusterChild>> owned = [];

    public ExpandingBatcherTests()
    {
        shapes = new Shapes(pool, 1);
        ClusterWorld.Register(registry, rules);
    }

    public void Dispose()
    {
        foreach (var buffer in owned)
        {
            var returned = buffer;
            pool.Return(ref returned);
        }
        shapes.Dispose();
        pool.AssertEmpty();
        pool.Clear();
    }

    sealed class Log
    {
        public Dictionary<int, List<(int A, int B, ConvexContactManifold Manifold)>> Children = [];
        public Dictionary<int, (Vector3 OffsetB, int Count, bool Convex)> Pairs = [];
        public Action<int>? OnChild;
    }

    readonly struct Callbacks(Log log) : ICollisionCallbacks
    {
        public bool AllowCollisionTesting(int pairId, int childA, int childB) => childA + childB != 5;

        public void OnChildPairCompleted(int pairId, int childA, int childB, ref ConvexContactManifold manifold)
        {
            log.OnChild?.Invoke(pairId);
            if (!log.Children.TryGetValue(pairId, out var children))
                log.Children.Add(pairId, children = []);
            children.Add((childA, childB, manifold));
        }

        public void OnPairCompleted<TManifold>(int pairId, ref TManifold manifold) where TManifold : unmanaged, IContactManifold<TManifold> =>
            log.Pairs.Add(pairId, (manifold is ConvexContactManifold convex ? convex.OffsetB : ((NonconvexContactManifold)(object)manifold).OffsetB,
                manifold.Count, manifold.Convex));
    }

    CollisionBatcher<Callbacks> CreateBatcher(Log log) => new(pool, shapes, registry, 1 / 60f, new(log));

    TypedIndex AddCluster(int count)
    {
        pool.Take(count, out Buffer<ClusterChild> children);
        var box = shapes.Add(new Box(.8f, .6f, .7f));
        var capsule = shapes.Add(new Capsule(.3f, .5f));
        var turn = Quaternion.Normalize(new(.2f, .1f, .3f, 1));
        for (int i = 0; i < count; ++i)
            children[i] = new(i % 2 == 0 ? box : capsule, new RigidPose(new Vector3(i * .25f, i % 3 * .125f, 0), turn));
        owned.Add(children);
        return shapes.Add(new Cluster { Children = children });
    }

    /// <summary>From either side, with both turned: what is found is what the children alone find, told from the centre of A.</summary>
    [Theory, InlineData(false, 1), InlineData(true, 1), InlineData(false, 9), InlineData(true, 9)]
    public void Children_are_tested_as_if_alone(bool clusterIsA, int count)
    {
        var sphere = shapes.Add(new Sphere(.5f));
        var cluster = AddCluster(count);
        var orientation = Quaternion.Normalize(new(.1f, -.4f, .2f, 1));
        var (a, b) = clusterIsA ? (cluster, sphere) : (sphere, cluster);
        var log = new Log();
        rules.Joins = false;
        for (int order = 0; order < 3; ++order)
        {
            rules.Order = (ClusterOrder)order;
            var batcher = CreateBatcher(log);
            for (int i = 0; i < 50; ++i)
                batcher.Add(a, b, Offset(i), orientation, orientation, .1f, new(order * 50 + i));
            batcher.Flush();
        }
        var alone = new Log();
        var tester = CreateBatcher(alone);
        for (int i = 0; i < 50; ++i)
        {
            for (int j = 0; j < count; ++j)
            {
                var child = owned[0][j];
                var place = ClusterPose.Place(child.Pose, orientation);
                if (clusterIsA)
                    tester.Add(child.Shape, sphere, Offset(i) - place.Position, place.Orientation, orientation, .1f, new(i * count + j));
                else
                    tester.Add(sphere, child.Shape, Offset(i) + place.Position, orientation, place.Orientation, .1f, new(i * count + j));
            }
        }
        tester.Flush();
        Assert.Equal(150, log.Pairs.Count);
        for (int id = 0; id < 150; ++id)
        {
            var children = log.Children[id];
            Assert.Equal(count > 5 ? count - 1 : count, children.Count);
            var contacts = 0;
            foreach (var (childA, childB, manifold) in children)
            {
                Assert.Equal(alone.Pairs[id % 50 * count + childA + childB].Count, manifold.Count);
                Assert.Equal(Offset(id % 50), manifold.OffsetB);
                contacts += manifold.Count;
            }
            Assert.Equal((Offset(id % 50), Math.Min(contacts, NonconvexContactManifold.MaximumContactCount)), (log.Pairs[id].OffsetB, log.Pairs[id].Count));
        }
        Assert.Contains(log.Pairs.Values, pair => pair.Count > 0);
    }

    static Vector3 Offset(int i) => new(i % 10 * .25f - 1.5f, i / 10 * .25f - .5f, .125f);

    [Fact]
    public void A_callback_that_throws_leaves_the_batcher_usable()
    {
        var sphere = shapes.Add(new Sphere(.5f));
        var cluster = AddCluster(7);
        var log = new Log { OnChild = id => throw new NotSupportedException() };
        var batcher = CreateBatcher(log);
        for (int i = 0; i < 3; ++i)
            batcher.Add(sphere, cluster, default, Quaternion.Identity, Quaternion.Identity, 0, new(i));
        Assert.Throws<NotSupportedException>(() => batcher.Flush());
        log.OnChild = null;
        batcher.Add(sphere, cluster, default, Quaternion.Identity, Quaternion.Identity, 0, new(7));
        batcher.Flush();
        Assert.True(log.Pairs[7].Count > 0);
    }

    [Fact]
    public void Callbacks_must_not_add()
    {
        var sphere = shapes.Add(new Sphere(.5f));
        var cluster = AddCluster(3);
        var log = new Log();
        var batcher = CreateBatcher(log);
        var refusals = 0;
        log.OnChild = id =>
        {
            try
            {
                batcher.Flush();
            }
            catch (InvalidOperationException)
            {
                ++refusals;
            }
        };
        batcher.Add(sphere, cluster, default, Quaternion.Identity, Quaternion.Identity, new BodyVelocity(new Vector3(1, 0, 0)), default, 0, 1, new(0));
        batcher.Flush();
        Assert.Equal(3, refusals);
    }

    [Fact]
    public void Children_that_have_children_are_refused()
    {
        var inner = AddCluster(2);
        pool.Take(1, out Buffer<ClusterChild> children);
        children[0] = new(inner, RigidPose.Identity);
        owned.Add(children);
        var outer = shapes.Add(new Cluster { Children = children });
        var batcher = CreateBatcher(new Log());
        batcher.Add(shapes.Add(new Sphere(1)), outer, default, Quaternion.Identity, Quaternion.Identity, 0, new(0));
        var refusal = Assert.Throws<InvalidOperationException>(() => batcher.Flush());
        Assert.Contains("Sphere and Cluster", refusal.Message, StringComparison.Ordinal);
        batcher.Dispose();
    }
}
