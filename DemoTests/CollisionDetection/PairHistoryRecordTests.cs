using System;
using System.Numerics;
using BepuPhysics.CollisionDetection;
using BepuUtilities;
using BepuUtilities.Memory;
using Xunit;

namespace DemoTests.CollisionDetection;

/// <summary>Each lane of a bundle is recorded in the history that its index names, and only there.</summary>
public class PairHistoryRecordTests
{
    const int LeastCarriedCount = 2;

    // One of everything that a lane brings; no two pairs agree in any of it.
    sealed class Pair
    {
        public readonly ConvexContactManifold Found;
        public readonly PairMeasures Measures;
        public readonly Quaternion A, B;
        public readonly float Margin;
        public readonly bool Flipped;

        public Pair(Random random, int contactCount, bool isSlow, bool flipped)
        {
            Found.OffsetB = Point(random, 3);
            Found.Normal = Exact.Normalize(Point(random, 1));
            Found.Count = contactCount;
            for (int i = 0; i < contactCount; ++i)
            {
                ref var contact = ref ConvexContactManifold.GetConvexContactReference(ref Found, i);
                contact = new() { Offset = Point(random, 1), Depth = random.NextSingle() * 0.01f, FeatureId = random.Next() };
            }
            var depth = contactCount == 0 ? -1 - random.NextSingle() : random.NextSingle() * 0.01f;
            Measures = new() { Depth = depth, ReachA = 1 + random.NextSingle(), ReachB = 1 + random.NextSingle(), Evaluations = isSlow ? 5 : 1 };
            A = Turn(random);
            B = Turn(random);
            Margin = 0.1f + random.NextSingle();
            Flipped = flipped;
        }

        /// <summary>What a history says of the pair where it was, a little away from there, and with margins about its own.</summary>
        public string Recall(PairHistory history)
        {
            Span<ConvexContactManifold> recalled = stackalloc ConvexContactManifold[3];
            recalled.Clear();
            var little = Exact.Normalize(new Quaternion(1e-5f, -2e-5f, 1e-5f, 1));
            var said = $"{history.GetReference(1)}";
            said += history.TryReuse(Found.OffsetB, A, B, Margin, ref recalled[0]);
            said += history.TryReuse(Found.OffsetB + new Vector3(1e-4f, -1e-4f, 2e-4f), A, Exact.Concatenate(B, little), Margin, ref recalled[1]);
            said += history.TryReuse(Found.OffsetB, A, B, Margin * 1.0001f, ref recalled[2]);
            foreach (ref var manifold in recalled)
            {
                said += $" {manifold.OffsetB} {manifold.Normal}";
                for (int i = 0; i < manifold.Count; ++i)
                {
                    var contact = ConvexContactManifold.GetConvexContactReference(ref manifold, i);
                    said += $" {contact.Offset} {contact.Depth} {contact.FeatureId}";
                }
            }
            // How far it may move, which is by how far the smaller of the two reaches: to one part in sixteen of what reaches differ by.
            for (int i = 0; i < 16; ++i)
            {
                var copy = history;
                var way = new Vector3(0, RetestBound.Tolerance * (1 + i / 16f), 0);
                said += copy.TryReuse(Found.OffsetB + way, A, B, Margin, ref recalled[0]) ? " near" : " far";
            }
            return said;
        }
    }

    /// <summary>Whatever the other lanes are, and whichever of them have no history.</summary>
    [Theory]
    [InlineData(1)]
    [InlineData(2)]
    [InlineData(3)]
    [InlineData(4)]
    public void A_lane_records_the_pair_that_is_in_it(int seed)
    {
        using var pool = new BufferPool();
        var random = new Random(seed);
        var count = Vector<float>.Count;
        // Two more than lanes, and the first, which is nobody's.
        pool.Take<PairHistory>(count + 3, out var histories);
        histories.Clear(0, count + 3);
        var indices = new int[count + 2];
        for (int i = 0; i < indices.Length; ++i)
            indices[i] = i + 1;
        random.Shuffle(indices);
        var pairs = new Pair[count];
        var bundle = new HistoryBundle();
        for (int lane = 0; lane < count; ++lane)
        {
            pairs[lane] = new Pair(random, (lane + seed) % 5, random.Next(2) == 0, random.Next(2) == 0);
            if (!HasHistory(lane, seed))
                indices[lane] = PairInput.NoHistory;
            bundle.Write(new HistoryLane(lane, pairs[lane].Flipped), indices[lane], pairs[lane].Found, pairs[lane].Measures, pairs[lane].A, pairs[lane].B,
                pairs[lane].Margin);
        }

        bundle.Record(histories, LeastCarriedCount);

        var isRecorded = new bool[count + 3];
        for (int lane = 0; lane < count; ++lane)
        {
            if (!HasHistory(lane, seed))
                continue;
            var pair = pairs[lane];
            var alone = default(PairHistory);
            new HistoryLane(0, pair.Flipped).Record(ref alone, pair.Found, pair.Measures, pair.A, pair.B, pair.Margin, LeastCarriedCount);
            Assert.Equal(pair.Recall(alone), pair.Recall(histories[indices[lane]]));
            // The comparison means something: what there is to recall is recalled.
            ConvexContactManifold manifold = default;
            var isReused = alone.TryReuse(pair.Found.OffsetB, pair.A, pair.B, pair.Margin, ref manifold);
            Assert.Equal(pair.Found.Count is 0 or >= LeastCarriedCount, isReused);
            isRecorded[indices[lane]] = true;
        }
        for (int i = 0; i < isRecorded.Length; ++i)
        {
            if (isRecorded[i])
                continue;
            foreach (var part in histories.Slice(i, 1).As<int>().AsSpan())
                Assert.Equal(0, part);
        }
    }

    static bool HasHistory(int lane, int seed) => seed == 1 || lane % 4 != seed - 2;

    static Vector3 Point(Random random, float size) =>
        new Vector3(random.NextSingle() - 0.5f, random.NextSingle() - 0.5f, random.NextSingle() - 0.5f) * (2 * size);

    static Quaternion Turn(Random random) => Exact.Normalize(new Quaternion(
        random.NextSingle() - 0.5f, random.NextSingle() - 0.5f, random.NextSingle() - 0.5f, random.NextSingle() + 0.1f));
}
