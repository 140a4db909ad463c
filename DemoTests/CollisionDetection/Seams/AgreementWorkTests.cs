using System;
using System.Linq;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuPhysics.CollisionDetection;
using BepuUtilities.Memory;
using Xunit;

namespace DemoTests.CollisionDetection.Seams;

/// <summary>How much is looked at until many children agree: each of those that lean is once along the normal of the one that all yield to.</summary>
public sealed unsafe class AgreementWorkTests : IDisposable
{
    const float Cell = .1f, Depth = 5e-3f, Margin = 1e-2f;

    static readonly CollisionTaskRegistry Registry = DefaultTypes.CreateDefaultCollisionTaskRegistry();
    readonly BufferPool pool = new();

    public void Dispose()
    {
        pool.AssertEmpty();
        pool.Clear();
    }

    /// <summary>A plate on boxes side by side; of a part of them the test has found a normal that leans by two degrees, a little less deep.</summary>
    [Theory]
    [InlineData(10, 0), InlineData(10, 10), InlineData(10, 100), InlineData(100, 0), InlineData(100, 10), InlineData(100, 100)]
    [InlineData(1000, 0), InlineData(1000, 10), InlineData(1000, 100)]
    public void Each_suspect_is_looked_at_once(int count, int percent)
    {
        var memory = new SeamMemory();
        var (results, placed) = (new ChildResult[PatchSet.Capacity + count], new PlacedChildren[count]);
        var children = results.AsSpan(PatchSet.Capacity);
        var suspectCount = Fill(children, placed, percent);
        fixed (ChildResult* first = children)
        fixed (PlacedChildren* places = placed)
        {
            memory.Add(first, places, count, owner: 0, leavesToNeighbours: false, pool);
            SeamRounds.Run(ref memory, Registry, pool);
        }
        ref var set = ref memory.Sets[0];
        Assert.Equal(1, set.LeaderCount);
        // What was looked at last is what the leader was offered to.
        Assert.Equal(suspectCount, memory.TouchingOf(set).ToArray().Count(child => child.HasYielded));
        if (suspectCount > 0)
            Assert.Equal(suspectCount, memory.Tests.FoundCount);
        foreach (ref var child in children)
            Assert.Equal(Vector3.UnitY, child.Manifold.Normal);
        memory.Rank(memory.TouchingOf(set), pool);
        Assert.Equal(1, PatchSet.Build(ref memory, children, placed, default, results.AsSpan(0, PatchSet.Capacity), pool));
        memory.Dispose(pool);
    }

    static int Fill(Span<ChildResult> results, Span<PlacedChildren> placed, int percent)
    {
        var side = (int)MathF.Ceiling(MathF.Sqrt(results.Length));
        var plate = new Box((side + 2) * Cell, 1, (side + 2) * Cell);
        var box = new Box(Cell, 1, Cell);
        var suspectCount = 0;
        for (int i = 0; i < results.Length; ++i)
        {
            var offset = new Vector3((i % side - .5f * side) * Cell, Depth - 1, (i / side - .5f * side) * Cell);
            placed[i].Write(new ChildShapes
            {
                TypeA = Box.Id,
                ShapeA = &plate,
                TypeB = Box.Id,
                ShapeB = &box,
                OffsetB = offset,
                OrientationA = Quaternion.Identity,
                OrientationB = Quaternion.Identity,
            }, moverIsB: false, Margin);
            // The first is none, and the deepest.
            var isSuspect = i > 0 && i * 7 % 10 * 10 < percent;
            suspectCount += isSuspect ? 1 : 0;
            var (sine, cosine) = MathF.SinCos(i);
            results[i].Children = new(0, i);
            results[i].Manifold.Normal = isSuspect ? Vector3.Normalize(new(.035f * cosine, 1, .035f * sine)) : Vector3.UnitY;
            results[i].Manifold.Count = 1;
            results[i].Manifold.Contact0 = new() { Offset = offset with { Y = -.5f }, Depth = Depth - (isSuspect ? .2f : i > 0 ? .01f : 0) * Depth };
        }
        return suspectCount;
    }
}
