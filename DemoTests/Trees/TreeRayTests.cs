using System;
using System.Collections.Generic;
using System.Linq;
using System.Numerics;
using BepuPhysics.Trees;
using BepuUtilities;
using BepuUtilities.Memory;
using FsCheck;
using FsCheck.Fluent;
using Xunit;

namespace DemoTests.Trees;

/// <summary>Rays and sweeps against exact arithmetic: which boxes they meet, and, with a callback that shortens them, which first and
/// when.</summary>
public class TreeRayTests
{
    [Fact]
    public void RaysMeetWhatALineMeets() =>
        Prop.ForAll(Queries, query => Compare(query with { Half = Vector3.Zero }, isRay: true)).Check(TreeGenerators.Reproducible(400));

    [Fact]
    public void SweepsMeetWhatAMovingBoxMeets() =>
        Prop.ForAll(Queries, query => Compare(query, isRay: false)).Check(TreeGenerators.Reproducible(400));

    [Theory]
    [InlineData(0, 0, 0), InlineData(1, 0, 0), InlineData(0, -1, 0), InlineData(0, 0, 1),
     InlineData(1e-41f, 0, -1), InlineData(1e30f, 1e-30f, 0)]
    public void DirectionsWithoutALengthOnSomeAxisAreNoSpecialCase(float x, float y, float z)
    {
        using var model = new TreeModel([
            new(new(0), new(2)), new(new(10, 0, 0), new(12, 2, 2)), new(new(0, -12, 0), new(2, -10, 2)), new(new(0, 0, 10), new(2, 2, 12))]);
        var hits = new HitList { Hits = [] };
        model.Tree.RayCast(new Vector3(1), new Vector3(x, y, z), float.MaxValue, model.Pool, ref hits);
        // Along the edge of the first box too.
        var edgeHits = new HitList { Hits = [] };
        model.Tree.RayCast(new Vector3(0, 2, 0), new Vector3(x, y, z), float.MaxValue, model.Pool, ref edgeHits);
        Assert.Contains(0, hits.Hits);
        Assert.Contains(0, edgeHits.Hits);
        Assert.Equal(x == 1 || x > 1e29f, hits.Hits.Contains(1));
        Assert.Equal(y < 0, hits.Hits.Contains(2));
        Assert.Equal(z > 0, hits.Hits.Contains(3));
    }

    [Fact]
    public void BadRaysAreRefused()
    {
        using var model = new TreeModel(TreeGenerators.World(5, seed: 8));
        var hits = new HitList { Hits = [] };
        Assert.ThrowsAny<ArgumentException>(() => model.Tree.RayCast(new(float.NaN), Vector3.UnitX, 1, model.Pool, ref hits));
        Assert.ThrowsAny<ArgumentException>(() => model.Tree.RayCast(default, new(float.PositiveInfinity, 0, 0), 1, model.Pool, ref hits));
        Assert.ThrowsAny<ArgumentException>(() => model.Tree.RayCast(default, Vector3.UnitX, -1, model.Pool, ref hits));
        Assert.ThrowsAny<ArgumentException>(() => model.Tree.RayCast(default, Vector3.UnitX, float.NaN, model.Pool, ref hits));
        Assert.ThrowsAny<ArgumentException>(() => model.Tree.Sweep(Vector3.One, Vector3.Zero, Vector3.UnitX, 1, model.Pool, ref hits));
        Assert.Empty(hits.Hits);
    }

    [Fact]
    public unsafe void TheCallbackSeesTheRay()
    {
        using var model = new TreeModel(TreeGenerators.World(5, seed: 9));
        var seen = new RaySeen();
        model.Tree.RayCast(new Vector3(1, 2, 3), Vector3.Zero, 7, model.Pool, ref seen, id: 42);
        model.Tree.RayCast(model.Boxes[0].Min, Vector3.UnitX, 7, model.Pool, ref seen, id: 42);
        Assert.Equal(42, seen.Ray.Id);
        Assert.Equal(model.Boxes[0].Min, seen.Ray.Origin);
        Assert.Equal(Vector3.UnitX, seen.Ray.Direction);
        Assert.Same(model.Pool, seen.Pool);
    }

    static void Compare(Query query, bool isRay)
    {
        using var model = new TreeModel(query.Boxes);
        if (query.Boxes.Length % 2 == 0)
            model.Tree.BinnedBuild(model.Pool);
        var min = query.Origin - query.Half;
        var max = query.Origin + query.Half;
        var entries = query.Boxes.Select(box => Entry(box, min, max, query.Direction)).ToArray();

        var all = new HitList { Hits = [] };
        var first = new HitList { Hits = [], Entries = entries };
        var length = query.Length;
        if (isRay)
        {
            model.Tree.RayCast(query.Origin, query.Direction, query.Length, model.Pool, ref all);
            model.Tree.RayCast(query.Origin, query.Direction, ref length, model.Pool, ref first);
        }
        else
        {
            model.Tree.Sweep(min, max, query.Direction, query.Length, model.Pool, ref all);
            model.Tree.Sweep(min, max, query.Direction, ref length, model.Pool, ref first);
        }

        // All numbers are small multiples of a quarter, so doubles are exact up to the divisions; only what is closer than these to a
        // touch may go either way.
        const double Tolerance = 1e-6;
        var hits = all.Hits.ToHashSet();
        Assert.Equal(hits.Count, all.Hits.Count);
        for (var leaf = 0; leaf < entries.Length; ++leaf)
        {
            var (begin, end) = entries[leaf];
            if (begin <= end && end >= 0 && begin <= query.Length)
                Assert.True(hits.Contains(leaf), $"Leaf {leaf} is met from {begin} to {end} and was missed.");
            else if (begin > end + Tolerance * Math.Abs(end) || end < -Tolerance || begin > query.Length * (1 + Tolerance))
                Assert.False(hits.Contains(leaf), $"Leaf {leaf} was met, but {begin} > {end}.");
        }
        var reachable = entries.Where(entry => entry.Begin <= entry.End && entry.End >= 0 && entry.Begin <= query.Length).ToArray();
        var expected = reachable.Length == 0 ? query.Length : Math.Max(0, reachable.Min(entry => entry.Begin));
        Assert.Equal(expected, length, Math.Max(1e-5, expected * 1e-5));
    }

    /// <summary>When a moving box begins and ends to touch a box at rest, in doubles.</summary>
    static (double Begin, double End) Entry(BoundingBox box, Vector3 min, Vector3 max, Vector3 direction)
    {
        var begin = double.NegativeInfinity;
        var end = double.PositiveInfinity;
        for (var axis = 0; axis < 3; ++axis)
        {
            double low = (double)box.Min[axis] - max[axis], high = (double)box.Max[axis] - min[axis], speed = direction[axis];
            if (speed == 0)
            {
                if (low > 0 || high < 0)
                    return (double.PositiveInfinity, double.NegativeInfinity);
                continue;
            }
            begin = Math.Max(begin, Math.Min(low / speed, high / speed));
            end = Math.Min(end, Math.Max(low / speed, high / speed));
        }
        return (begin, end);
    }

    public sealed record Query(BoundingBox[] Boxes, Vector3 Origin, Vector3 Half, Vector3 Direction, float Length);

    static Gen<Vector3> Quarters(int low, int high) =>
        from x in Gen.Choose(low, high)
        from y in Gen.Choose(low, high)
        from z in Gen.Choose(low, high)
        select new Vector3(x, y, z) * 0.25f;

    static Arbitrary<Query> Queries =>
        (from count in Gen.Choose(0, 60)
         from corners in Gen.ArrayOf(Quarters(-40, 40), count)
         from sizes in Gen.ArrayOf(Quarters(0, 12), count)
         from origin in Quarters(-50, 50)
         from half in Quarters(0, 8)
         from direction in Quarters(-8, 8)
         from length in Gen.Elements(0f, 1f, 7.5f, 1000f, float.MaxValue)
         let boxes = corners.Zip(sizes, (corner, size) => new BoundingBox(corner, corner + size)).ToArray()
         select new Query(boxes, origin, half, direction, length)).ToArbitrary();

    struct HitList : IRayLeafTester, ISweepLeafTester
    {
        public List<int> Hits;
        public (double Begin, double End)[]? Entries;

        public readonly unsafe void TestLeaf(int leafIndex, RayData* rayData, float* maximumT, BufferPool pool) =>
            TestLeaf(leafIndex, ref *maximumT);

        public readonly void TestLeaf(int leafIndex, ref float maximumT)
        {
            Hits.Add(leafIndex);
            // Shortens the query to the true time of entry, as a test against the shape in the box would.
            if (Entries is not null && Entries[leafIndex].Begin <= Entries[leafIndex].End && Entries[leafIndex].End >= 0)
                maximumT = MathF.Min(maximumT, MathF.Max(0, (float)Entries[leafIndex].Begin));
        }
    }

    struct RaySeen : IRayLeafTester
    {
        public RayData Ray;
        public BufferPool? Pool;

        public unsafe void TestLeaf(int leafIndex, RayData* rayData, float* maximumT, BufferPool pool)
        {
            Ray = *rayData;
            Pool = pool;
            Assert.Equal(7, *maximumT);
        }
    }
}
