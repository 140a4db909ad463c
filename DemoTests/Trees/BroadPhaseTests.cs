using System;
using System.Collections.Generic;
using System.Linq;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuPhysics.CollisionDetection;
using BepuPhysics.Trees;
using BepuUtilities;
using BepuUtilities.Memory;
using Xunit;

namespace DemoTests.Trees;

public class BroadPhaseTests
{
    [Theory]
    [InlineData(0, 0), InlineData(1, 0), InlineData(0, 5), InlineData(1, 1), InlineData(2, 1), InlineData(9, 1), InlineData(300, 0),
     InlineData(300, 300),
     InlineData(1500, 40), InlineData(2600, 40), InlineData(260, 3000)]
    public void EveryNumberOfWorkersFindsEachPairOnceAndKeepsTheSameTree(int activeCount, int staticCount)
    {
        byte[]? expectedTree = null;
        // Boxes move alike whatever the threads.
        var expectedPairs = new List<((int, int)[] Self, (int, int)[] Static)>();
        foreach (var threadCount in new[] { 0, 1, 2, 3, 8 })
        {
            using var dispatcher = threadCount > 0 ? new ThreadDispatcher(threadCount) : null;
            using var world = new World(activeCount, staticCount);
            for (var step = 0; step < 6; ++step)
            {
                world.Step(step, dispatcher);
                world.BroadPhase.Validate();
                if (expectedPairs.Count == step)
                    expectedPairs.Add((world.BruteForceSelf(), world.BruteForceStatic()));
                var (self, still) = world.FindOverlaps(dispatcher);
                Assert.Equal(expectedPairs[step].Self, self);
                Assert.Equal(expectedPairs[step].Static, still);
            }
            var tree = TreeBytes.Of(world.BroadPhase.ActiveTree);
            expectedTree ??= tree;
            Assert.Equal(expectedTree, tree);
        }
    }

    [Fact]
    public void LeavesFollowTheirCollidables()
    {
        using var world = new World(50, 20);
        var broadPhase = world.BroadPhase;
        Assert.True(broadPhase.RemoveActiveAt(10, out var moved));
        Assert.Equal(49, moved.RawHandleValue);
        Assert.Equal(moved, broadPhase.ActiveLeaves[10]);
        Assert.False(broadPhase.RemoveActiveAt(48, out _));
        Assert.True(broadPhase.RemoveStaticAt(0, out moved));
        Assert.Equal(CollidableMobility.Static, moved.Mobility);
        Assert.Equal(19, moved.RawHandleValue);
        Assert.Throws<ArgumentOutOfRangeException>(() => broadPhase.RemoveActiveAt(48, out _));
        Assert.Throws<ArgumentOutOfRangeException>(() => broadPhase.RemoveStaticAt(-1, out _));
        broadPhase.Update();
        broadPhase.Validate();
    }

    [Fact]
    public unsafe void ActiveBoundsCountFromTheNextUpdateAndStaticOnesAtOnce()
    {
        using var world = new World(100, 100);
        var far = new BoundingBox(new(1000), new(1001));
        world.BroadPhase.GetActiveBoundsPointers(5, out var min, out var max);
        *min = far.Min;
        *max = far.Max;
        world.BroadPhase.Update();
        world.BroadPhase.UpdateStaticBounds(7, far.Min, far.Max);
        var found = new CollidableList { Found = [] };
        world.BroadPhase.GetOverlaps(far, world.Pool, ref found);
        Assert.Equal([5, 7], found.Found.Select(collidable => collidable.RawHandleValue));
        Assert.Equal([CollidableMobility.Dynamic, CollidableMobility.Static], found.Found.Select(collidable => collidable.Mobility));
        Assert.ThrowsAny<ArgumentException>(() => world.BroadPhase.UpdateStaticBounds(0, far.Max, far.Min));
    }

    [Fact]
    public void QueriesSeeBothTreesAndStopWhenToldTo()
    {
        using var world = new World(200, 200);
        var found = new CollidableList { Found = [], Limit = 150 };
        world.BroadPhase.GetOverlaps(new Vector3(-1e6f), new Vector3(1e6f), world.Pool, ref found);
        Assert.Equal(150, found.Found.Count);
        found = new CollidableList { Found = [], Limit = 250 };
        world.BroadPhase.GetOverlaps(new Vector3(-1e6f), new Vector3(1e6f), world.Pool, ref found);
        Assert.Equal(250, found.Found.Count);
        Assert.Equal(200, found.Found.Count(collidable => collidable.Mobility == CollidableMobility.Dynamic));

        var rays = new CollidableList { Found = [] };
        var sweeps = new CollidableList { Found = [] };
        world.BroadPhase.RayCast(new Vector3(-5, 3, 3), Vector3.UnitX, 1000, world.Pool, ref rays, 3);
        world.BroadPhase.Sweep(new Vector3(-5, 3, 3), new Vector3(-5, 3, 3), Vector3.UnitX, 1000, world.Pool, ref sweeps);
        var line = new BoundingBox(new(-5, 3, 3), new(995, 3, 3));
        Assert.Equal(world.Active.Concat(world.Still).Count(box => BoundingBox.Intersects(box, line)), rays.Found.Count);
        Assert.Equal(rays.Found.Order(Comparer<CollidableReference>.Create((a, b) => a.Packed.CompareTo(b.Packed))),
            sweeps.Found.Order(Comparer<CollidableReference>.Create((a, b) => a.Packed.CompareTo(b.Packed))));
    }

    [Fact]
    public void AStepTakesNoManagedMemoryAndNoMoreFromTheSystem()
    {
        using var dispatcher = new ThreadDispatcher(2);
        using var world = new World(1000, 100);
        var counter = new PairCounter();
        for (var step = 0; step < 40; ++step)
        {
            world.Step(step, dispatcher);
            world.BroadPhase.FindOverlaps(ref counter, dispatcher);
        }
        var fromSystem = world.Pool.GetTotalAllocatedByteCount();
        var before = GC.GetAllocatedBytesForCurrentThread();
        for (var step = 0; step < 40; ++step)
        {
            world.Step(step, dispatcher);
            world.BroadPhase.FindOverlaps(ref counter, dispatcher);
            world.BroadPhase.FindOverlaps(ref counter);
        }
        Assert.Equal(0, GC.GetAllocatedBytesForCurrentThread() - before);
        Assert.Equal(fromSystem, world.Pool.GetTotalAllocatedByteCount());
    }

    [Fact]
    public void AHandlerThatThrowsLeavesNothingBehind()
    {
        using var dispatcher = new ThreadDispatcher(2);
        using var world = new World(1000, 0);
        var thrower = new Thrower();
        Assert.Throws<InvalidOperationException>(() => world.BroadPhase.FindOverlaps(ref thrower, dispatcher));
        Assert.Throws<InvalidOperationException>(() => world.BroadPhase.FindOverlaps(ref thrower));
    }

    unsafe sealed class World : IDisposable
    {
        public readonly BufferPool Pool = new();
        public readonly BroadPhase BroadPhase;
        public readonly BoundingBox[] Active, Still;

        public World(int activeCount, int staticCount)
        {
            BroadPhase = new BroadPhase(Pool, 1, 1);
            Active = TreeGenerators.World(activeCount, seed: 20, largest: 5);
            Still = TreeGenerators.World(staticCount, seed: 21, largest: 10);
            for (var i = 0; i < activeCount; ++i)
            {
                var body = new CollidableReference(CollidableMobility.Dynamic, new BodyHandle(i));
                Assert.Equal(i, BroadPhase.AddActive(body, ref Active[i]));
            }
            for (var i = 0; i < staticCount; ++i)
                Assert.Equal(i, BroadPhase.AddStatic(new CollidableReference(new StaticHandle(i)), ref Still[i]));
        }

        public void Step(int step, IThreadDispatcher? dispatcher)
        {
            for (var i = 0; i < Active.Length; ++i)
            {
                var offset = new Vector3((i + step) % 5 - 2, (i * 7 + step) % 3 - 1, (i * 3 + step) % 7 - 3) * 0.1f;
                Active[i].Min += offset;
                Active[i].Max += offset;
                BroadPhase.GetActiveBoundsPointers(i, out var min, out var max);
                *min = Active[i].Min;
                *max = Active[i].Max;
            }
            BroadPhase.Update(dispatcher);
        }

        public ((int, int)[] Self, (int, int)[] Static) FindOverlaps(IThreadDispatcher? dispatcher)
        {
            var lists = new PairLists { Self = [], Static = [] };
            for (var worker = 0; worker < 8; ++worker)
            {
                lists.Self.Add([]);
                lists.Static.Add([]);
            }
            BroadPhase.FindOverlaps(ref lists, dispatcher);
            return (lists.Self.SelectMany(list => list).Order().ToArray(), lists.Static.SelectMany(list => list).Order().ToArray());
        }

        public (int, int)[] BruteForceSelf() =>
            (from a in Enumerable.Range(0, Active.Length)
             from b in Enumerable.Range(a + 1, Active.Length - a - 1)
             where BoundingBox.Intersects(Active[a], Active[b])
             select (a, b)).ToArray();

        public (int, int)[] BruteForceStatic() =>
            (from a in Enumerable.Range(0, Active.Length)
             from b in Enumerable.Range(0, Still.Length)
             where BoundingBox.Intersects(Active[a], Still[b])
             select (a, b)).ToArray();

        public void Dispose()
        {
            BroadPhase.Dispose();
            BroadPhase.Dispose();
            Pool.AssertEmpty();
            Pool.Clear();
        }
    }

    struct PairLists : IBroadPhaseOverlapHandler
    {
        public List<List<(int, int)>> Self, Static;

        public readonly void Handle(int workerIndex, int leafA, int leafB, bool bIsStatic) =>
            (bIsStatic ? Static : Self)[workerIndex].Add((leafA, leafB));
    }

    struct PairCounter : IBroadPhaseOverlapHandler
    {
        public int Count;

        public void Handle(int workerIndex, int leafA, int leafB, bool bIsStatic) => System.Threading.Interlocked.Increment(ref Count);
    }

    struct Thrower : IBroadPhaseOverlapHandler
    {
        public readonly void Handle(int workerIndex, int leafA, int leafB, bool bIsStatic) => throw new InvalidOperationException("No.");
    }

    struct CollidableList : IBreakableForEach<CollidableReference>, IBroadPhaseRayTester, IBroadPhaseSweepTester
    {
        public List<CollidableReference> Found;
        public int Limit;

        public readonly bool LoopBody(CollidableReference collidable)
        {
            Found.Add(collidable);
            return Found.Count != Limit;
        }

        public readonly unsafe void RayTest(CollidableReference collidable, RayData* rayData, float* maximumT, BufferPool pool) =>
            Found.Add(collidable);

        public readonly void Test(CollidableReference collidable, ref float maximumT) => Found.Add(collidable);
    }
}
