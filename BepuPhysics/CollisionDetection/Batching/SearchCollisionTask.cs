using System.Numerics;
using System.Runtime.CompilerServices;
using BepuPhysics.Collidables;
using BepuUtilities;

namespace BepuPhysics.CollisionDetection;

/// <summary>Tests batches of pairs of two convex shape types with a pair tester that starts from what it found in the last step.</summary>
/// <remarks>
/// A bundle takes as long as its slowest search, and which searches are slow changes little from step to step: a rim that rolls along an
/// edge takes ten support points, a face that rests on a face one. So batches are filled from both ends, from the last place on by
/// pairs whose last search was slow.
/// </remarks>
/// <typeparam name="TShapeA">First shape.</typeparam>
/// <typeparam name="TShapeWideA">Wide form of the first shape.</typeparam>
/// <typeparam name="TShapeB">Second shape.</typeparam>
/// <typeparam name="TShapeWideB">Wide form of the second shape.</typeparam>
/// <typeparam name="TContacts">As many contacts as a pair can have.</typeparam>
/// <typeparam name="TTester">Finds the contacts.</typeparam>
sealed unsafe class SearchCollisionTask<TShapeA, TShapeWideA, TShapeB, TShapeWideB, TContacts, TTester>
    : ConvexPairTask<TShapeA, TShapeWideA, TShapeB, TShapeWideB, TContacts>
    where TShapeA : unmanaged, IConvexShape where TShapeWideA : unmanaged, IShapeWide<TShapeA>
    where TShapeB : unmanaged, IConvexShape where TShapeWideB : unmanaged, IShapeWide<TShapeB>
    where TContacts : unmanaged, IFew<ContactWide>
    where TTester : unmanaged, ISearchingPairTester<TShapeWideA, TShapeWideB, TContacts>
{
    // A half-space is the second even where the first is a game's own.
    public SearchCollisionTask() : base(keepsHistories: true, isOrdered: false) { }

    // After the bundles and their contacts: the index of each pair's history, and the number of slow pairs.
    internal override int BatchByteCount => base.BatchByteCount + (PairBatch.Capacity + 1) * sizeof(int);

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    int* HistoryIndices(in PairBatch batch) => (int*)(batch.Bundles.Memory + base.BatchByteCount);

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    ref int SlowCount(in PairBatch batch) => ref HistoryIndices(batch)[PairBatch.Capacity];

    internal override void Write(ref PairBatch batch, Shapes shapes, int shapeIndexA, int shapeIndexB, in Vector3 offsetB,
        in Quaternion orientationA, in Quaternion orientationB, in PairInput pair)
    {
        Find(shapes, shapeIndexA, shapeIndexB, out var shapeA, out var shapeB);
        WriteLane(ref batch, shapeA, shapeB, offsetB, orientationA, orientationB, pair);
    }

    internal override void WriteDirectly(ref PairBatch batch, void* shapeA, void* shapeB, in Vector3 offsetB, in Quaternion orientationA,
        in Quaternion orientationB, in PairInput pair) =>
        WriteLane(ref batch, (TShapeA*)shapeA, (TShapeB*)shapeB, offsetB, orientationA, orientationB, pair);

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    void WriteLane(ref PairBatch batch, TShapeA* shapeA, TShapeB* shapeB, in Vector3 offsetB, in Quaternion orientationA,
        in Quaternion orientationB, in PairInput pair)
    {
        ref var slowCount = ref SlowCount(batch);
        if (batch.Count == 0)
            slowCount = 0;
        var place = PairHistory.IsSlow(pair.History) ? PairBatch.Capacity - ++slowCount : batch.Count - slowCount;
        ++batch.Count;
        HistoryIndices(batch)[place] = PairHistory.GetIndex(pair.History);
        var target = batch with { Count = place };
        Write(ref target, shapeA, shapeB, offsetB, orientationA, orientationB, pair, needsOrientationA: true, needsOrientationB: true);
    }

    internal override void Execute<TCallbacks>(ref PairBatch batch, PairHistory* histories, ref TCallbacks callbacks)
    {
        ref var wide = ref Manifold(batch);
        Unsafe.SkipInit(out ConvexContactManifold manifold);
        Unsafe.SkipInit(out PairMeasuresWide measures);
        var firstEmpty = batch.Count - SlowCount(batch);
        var firstSlow = PairBatch.Capacity - SlowCount(batch);
        EmptyLanes(batch, firstEmpty, firstSlow);
        for (int start = 0; start < PairBatch.Capacity; start += Vector<float>.Count)
        {
            if (IsEmpty(start, firstEmpty, firstSlow))
                continue;
            ref var bundle = ref Bundles(batch)[start >> BundleIndexing.VectorShift];
            var historyIndices = *(Vector<int>*)(HistoryIndices(batch) + start);
            PairHistory.GatherSearch(histories, historyIndices, out var state);
            TTester.Test(bundle.A, bundle.B, bundle.Pose, bundle.SpeculativeMargin, ref state, ref measures, out wide);
            if (!Vector.LessThanAll(historyIndices, Vector<int>.Zero))
            {
                PairHistory.ScatterSearch(histories, historyIndices, state);
                TTester.MeasureReaches(bundle.A, bundle.B, ref measures);
                PairHistory.Record(histories, historyIndices, bundle.Pose, bundle.FlipMask, bundle.SpeculativeMargin, measures, ref wide,
                    TTester.LeastCarriedContactCount);
            }
            for (int lane = 0; lane < Vector<float>.Count; ++lane)
            {
                if (start + lane >= firstEmpty && start + lane < firstSlow)
                    continue;
                Read(ref wide, ref bundle, lane, ref manifold);
                callbacks.OnPairCompleted(Lane(ref bundle.PairIds, lane), ref manifold);
            }
        }
        batch.Count = 0;
    }

    /// <summary>Whether a bundle has no pair.</summary>
    static bool IsEmpty(int start, int firstEmpty, int firstSlow) => start >= firstEmpty && start + Vector<float>.Count <= firstSlow;

    // The lanes between quick and slow pairs have no history, and no shape: one that was there before may have left its memory. No distance is
    // small enough for them, so that nothing waits for them.
    void EmptyLanes(in PairBatch batch, int firstEmpty, int firstSlow)
    {
        for (int i = firstEmpty; i < firstSlow; ++i)
        {
            BundleIndexing.GetBundleIndices(i, out var bundleIndex, out var lane);
            if (IsEmpty(i - lane, firstEmpty, firstSlow))
                continue;
            HistoryIndices(batch)[i] = PairInput.NoHistory;
            ref var bundle = ref Bundles(batch)[bundleIndex];
            Lanes.Write(default(TShapeA), ref bundle.A, lane);
            Lanes.Write(default(TShapeB), ref bundle.B, lane);
            Lane(ref bundle.SpeculativeMargin, lane) = float.NegativeInfinity;
        }
    }
}
