using System;
using System.Collections.Generic;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuPhysics.CollisionDetection;
using BepuUtilities.Memory;
using Xunit;

namespace DemoTests.CollisionDetection.Seams;

/// <summary>Many sets of children that agree at once, and sets of many children.</summary>
public sealed unsafe class ManySetsTests : IDisposable
{
    const float Radius = .3f, Margin = .2f;

    static readonly CollisionTaskRegistry Registry = DefaultTypes.CreateDefaultCollisionTaskRegistry();
    readonly BufferPool pool = new();

    public void Dispose()
    {
        pool.AssertEmpty();
        pool.Clear();
    }

    // A ball on a floor, with a part of it ahead that is a little higher; by the number of the set.
    static void Fill(int number, Span<ChildResult> results, Span<PlacedChildren> placed)
    {
        var ball = new Sphere(Radius);
        var box = new Box(2, 1, 2);
        var (lip, sunk, ahead) = (.02f + .001f * number, 1e-4f, .22f + .0005f * number);
        Vector3[] offsets = [new(-.8f, sunk - Radius - .5f, 0), new(1 + ahead, lip - Radius - .5f, 0)];
        for (int i = 0; i < offsets.Length; ++i)
        {
            placed[i].Write(new ChildShapes
            {
                TypeA = Sphere.Id,
                ShapeA = &ball,
                TypeB = Box.Id,
                ShapeB = &box,
                OffsetB = offsets[i],
                OrientationA = Quaternion.Identity,
                OrientationB = Quaternion.Identity,
            }, moverIsB: false, Margin);
            placed[i].Motion.Way = new Vector3(.3f, -.02f, 0);
            // The point of the box that is nearest to the ball.
            var nearest = Vector3.Clamp(default, offsets[i] - new Vector3(1, .5f, 1), offsets[i] + new Vector3(1, .5f, 1));
            results[i].Children = new(0, i);
            results[i].Manifold.Count = 1;
            results[i].Manifold.Normal = -Vector3.Normalize(nearest);
            results[i].Manifold.OffsetB = offsets[i];
            results[i].Manifold.Contact0 = new() { Offset = nearest, Depth = Radius - nearest.Length() };
        }
    }

    /// <summary>As many as there are at once follow what they will meet, all of one pair of types: each is told what it is told alone.</summary>
    [Fact]
    public void Sets_that_foresee_at_once_find_what_each_finds_alone()
    {
        const int count = SeamMemory.SetCapacity;
        var (results, placed) = (new ChildResult[2 * count], new PlacedChildren[2 * count]);
        var (alone, aloneAt) = (new ChildResult[2 * count], new PlacedChildren[2 * count]);
        for (int i = 0; i < count; ++i)
        {
            Fill(i, results.AsSpan(2 * i, 2), placed.AsSpan(2 * i, 2));
            Fill(i, alone.AsSpan(2 * i, 2), aloneAt.AsSpan(2 * i, 2));
        }
        var turned = 0;
        fixed (ChildResult* first = results, firstAlone = alone)
        fixed (PlacedChildren* places = placed, placesAlone = aloneAt)
        {
            var memory = new SeamMemory();
            for (int i = 0; i < count; ++i)
                memory.Add(first + 2 * i, places + 2 * i, 2, owner: i, leavesToNeighbours: false, pool);
            SeamRounds.Run(ref memory, Registry, pool);
            for (int i = 0; i < count; ++i)
            {
                Assert.True(memory.Sets[i].HasForeseen);
                foreach (ref var child in memory.TouchingOf(memory.Sets[i]))
                    turned += child.IsTurned ? 1 : 0;
            }
            memory.Begin();
            for (int i = 0; i < count; ++i)
            {
                memory.Add(firstAlone + 2 * i, placesAlone + 2 * i, 2, owner: i, leavesToNeighbours: false, pool);
                SeamRounds.Run(ref memory, Registry, pool);
                memory.Begin();
            }
            memory.Dispose(pool);
        }
        Assert.Equal(count, turned);
        for (int i = 0; i < results.Length; ++i)
        {
            ref var manifold = ref results[i].Manifold;
            Assert.Equal(alone[i].Manifold.Count, manifold.Count);
            Assert.Equal(alone[i].Manifold.Normal, manifold.Normal);
            Assert.Equal((alone[i].Manifold.GetOffset(0), alone[i].Manifold.GetDepth(0)), (manifold.GetOffset(0), manifold.GetDepth(0)));
        }
    }

    /// <summary>Those that have the normal of a leader are all found, once each and in order, however many there are; also when one has changed.</summary>
    [Theory, InlineData(1), InlineData(2), InlineData(63), InlineData(64), InlineData(65), InlineData(128), InlineData(200)]
    public void Who_offers_a_normal_is_found(int count)
    {
        var random = new Random(count);
        var (results, placed) = (new ChildResult[count], new PlacedChildren[count]);
        for (int i = 0; i < count; ++i)
        {
            results[i].Manifold.Count = 1;
            results[i].Manifold.Normal = random.Next(5) < 4 ? NormalOf(random.Next(12)) : NormalOf(0);
        }
        fixed (ChildResult* first = results)
        fixed (PlacedChildren* places = placed)
        {
            var memory = new SeamMemory();
            memory.Add(first, places, count, owner: 0, leavesToNeighbours: false, pool);
            for (int i = 0; i < count; ++i)
                memory.Touching[i].Group = random.Next(2);
            var view = new SeamView(ref memory.Sets[0], memory.Touching.AsSpan());
            NormalOfferers offerers = default;
            ref var leader = ref view.Ranked[count / 2];
            Assert.Equal(OfferersOf(view, leader), ListOf(ref offerers, view, leader));
            for (int i = 0; i < count; i += 3)
                view.Result(view.Ranked[i]).Manifold.Normal = view.Result(leader).Manifold.Normal;
            offerers.Forget();
            Assert.Equal(OfferersOf(view, leader), ListOf(ref offerers, view, leader));
            Assert.Contains(count / 2, ListOf(ref offerers, view, leader));
            memory.Dispose(pool);
        }
    }

    static Vector3 NormalOf(int number) => new(MathF.Sin(number), MathF.Cos(number), 0);

    static List<int> OfferersOf(in SeamView view, in RankedChild leader)
    {
        var list = new List<int>();
        for (int i = 0; i < view.Ranked.Length; ++i)
        {
            ref var child = ref view.Ranked[i];
            if (child.Group == leader.Group && Vector3.Distance(view.Result(child).Manifold.Normal, view.Result(leader).Manifold.Normal) < 1e-3f)
                list.Add(i);
        }
        return list;
    }

    static List<int> ListOf(ref NormalOfferers offerers, in SeamView view, in RankedChild leader)
    {
        var list = new List<int>();
        for (int i = offerers.First(leader, view); i < view.Ranked.Length; i = offerers.Next(i, leader, view))
            list.Add(i);
        return list;
    }
}
