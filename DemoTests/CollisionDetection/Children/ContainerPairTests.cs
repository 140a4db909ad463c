using System;
using System.Collections.Generic;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuPhysics.CollisionDetection;
using BepuUtilities.Memory;
using Xunit;

namespace DemoTests.CollisionDetection.Children;

/// <summary>Two shapes made of children: each child of one meets those of the other as it does where it is the only one.</summary>
public sealed class ContainerPairTests : IDisposable
{
    const int ChildCount = 5;

    readonly BufferPool pool = new();
    readonly Shapes shapes;
    readonly CollisionTaskRegistry registry = DefaultTypes.CreateDefaultCollisionTaskRegistry();
    readonly CompoundChild[] children;

    public ContainerPairTests()
    {
        shapes = new Shapes(pool, 1);
        TypedIndex[] convex = [shapes.Add(new Box(.4f, .3f, .5f)), shapes.Add(new Capsule(.2f, .4f)), shapes.Add(new Cylinder(.3f, .2f))];
        children = new CompoundChild[ChildCount];
        for (int i = 0; i < ChildCount; ++i)
        {
            children[i] = new CompoundChild(
                new RigidPose(new Vector3(.3f * i - .6f, .1f * (i % 3), .2f * (i % 2)), Quaternion.Normalize(new(.1f * i, .3f, -.2f * i, 1))), convex[i % 3]);
        }
    }

    public void Dispose()
    {
        shapes.Dispose();
        pool.Clear();
    }

    readonly struct Callbacks(Dictionary<(int, int), ConvexContactManifold> found) : ICollisionCallbacks
    {
        public bool AllowCollisionTesting(int pairId, int childA, int childB) => true;

        public void OnChildPairCompleted(int pairId, int childA, int childB, ref ConvexContactManifold manifold) => found.Add((childA, childB), manifold);

        public void OnPairCompleted<TManifold>(int pairId, ref TManifold manifold) where TManifold : unmanaged, IContactManifold<TManifold> { }
    }

    TypedIndex AddCompound(bool isBig, int first, int count)
    {
        pool.Take(count, out Buffer<CompoundChild> own);
        for (int i = 0; i < count; ++i)
            own[i] = children[first + i];
        return isBig ? shapes.Add(new BigCompound(own, shapes, pool)) : shapes.Add(new Compound(own));
    }

    TypedIndex AddOther(bool isMesh)
    {
        if (!isMesh)
            return AddCompound(isBig: true, 0, ChildCount);
        Vector3[] corners = [new(-1, 0, -1), new(1, 0, -1), new(-1, 0, 1), new(1, .1f, 1), new(0, .3f, 0)];
        int[] indices = [0, 4, 2, 4, 3, 2, 1, 3, 4, 0, 1, 4];
        return shapes.Add(new Mesh(corners, indices, Vector3.One, pool));
    }

    Dictionary<(int A, int B), ConvexContactManifold> Test(TypedIndex a, TypedIndex b, Vector3 offsetB, Quaternion orientationA, Quaternion orientationB)
    {
        var found = new Dictionary<(int, int), ConvexContactManifold>();
        var batcher = new CollisionBatcher<Callbacks>(pool, shapes, registry, 1 / 60f, new(found));
        batcher.Add(a, b, offsetB, orientationA, orientationB, .2f, new PairContinuation(0));
        batcher.Flush();
        return found;
    }

    static void AssertSame(in ConvexContactManifold expected, in ConvexContactManifold actual)
    {
        Assert.Equal(expected.Count, actual.Count);
        for (int i = 0; i < expected.Count; ++i)
        {
            Assert.Equal(expected.Normal, actual.Normal);
            Assert.Equal(expected.GetOffset(i), actual.GetOffset(i));
            Assert.Equal(expected.GetDepth(i), actual.GetDepth(i));
        }
    }

    /// <summary>A child of the first is placed once for all that it meets: it is where it would be if it were placed for each of them.</summary>
    [Theory]
    [InlineData(false, false, false), InlineData(false, false, true), InlineData(false, true, false), InlineData(false, true, true)]
    [InlineData(true, false, false), InlineData(true, false, true), InlineData(true, true, false), InlineData(true, true, true)]
    public void Each_child_meets_what_it_meets_alone(bool isBig, bool isMesh, bool isSecond)
    {
        var compound = AddCompound(isBig, 0, ChildCount);
        var other = AddOther(isMesh);
        var offset = new Vector3(.1f, .15f, -.1f);
        var (turn, otherTurn) = (Quaternion.Normalize(new(.1f, .2f, .05f, 1)), Quaternion.Normalize(new(-.05f, .4f, .1f, 1)));
        var together = isSecond
            ? Test(other, compound, offset, otherTurn, turn)
            : Test(compound, other, -offset, turn, otherTurn);
        var (all, touching) = (0, 0);
        for (int i = 0; i < ChildCount; ++i)
        {
            var single = AddCompound(isBig, i, 1);
            var alone = isSecond
                ? Test(other, single, offset, otherTurn, turn)
                : Test(single, other, -offset, turn, otherTurn);
            foreach (var (pair, manifold) in alone)
            {
                AssertSame(manifold, together[isSecond ? (pair.A, i) : (i, pair.B)]);
                touching += manifold.Count > 0 ? 1 : 0;
            }
            all += alone.Count;
        }
        Assert.Equal(all, together.Count);
        Assert.True(touching >= ChildCount && all > ChildCount, $"{touching} of {all}");
    }
}
