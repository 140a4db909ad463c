using System.Numerics;
using System.Runtime.CompilerServices;
using BepuPhysics.CollisionDetection;
using BepuUtilities;
using BepuUtilities.Memory;
using Xunit;

namespace DemoTests.CollisionDetection;

/// <summary>Records one pair as a lane of a bundle whose other lanes have no history.</summary>
/// <param name="Index">Which lane.</param>
/// <param name="Flipped">Whether the bundle has the pair in the other order.</param>
/// <param name="FirstSlot">Which of the four contacts of a bundle is the pair's first.</param>
readonly record struct HistoryLane(int Index = 0, bool Flipped = false, int FirstSlot = 0)
{
    public unsafe void Record(ref PairHistory history, in ConvexContactManifold found, PairMeasures measures, Quaternion turnA, Quaternion turnB,
        float margin, int leastCarriedCount)
    {
        using var pool = new BufferPool();
        pool.Take<PairHistory>(2, out var histories);
        histories[0] = default;
        histories[1] = history;
        var bundle = new HistoryBundle();
        bundle.Write(this, 1, found, measures, turnA, turnB, margin);
        bundle.Record(histories, leastCarriedCount);
        Assert.Equal(default, histories[0].Search);
        history = histories[1];
    }
}

/// <summary>A bundle of outcomes to record; lanes that are not written have no history.</summary>
unsafe struct HistoryBundle
{
    Vector<int> indices;
    Vector<int> flipMask;
    Vector<float> margins;
    PairPoseWide pose;
    PairMeasuresWide measuresOfPairs;
    ConvexManifoldWide<Few4<ContactWide>> manifold;

    public HistoryBundle() => indices = new Vector<int>(PairInput.NoHistory);

    /// <summary>Writes a pair, told in the caller's order.</summary>
    public void Write(HistoryLane lane, int history, in ConvexContactManifold found, PairMeasures measures, Quaternion turnA, Quaternion turnB, float margin)
    {
        var offsetB = found.OffsetB;
        var normal = found.Normal;
        if (lane.Flipped)
        {
            (turnA, turnB) = (turnB, turnA);
            (measures.ReachA, measures.ReachB) = (measures.ReachB, measures.ReachA);
            offsetB = -offsetB;
            normal = -normal;
        }
        var index = lane.Index;
        GatherScatter.Get(ref indices, index) = history;
        GatherScatter.Get(ref flipMask, index) = lane.Flipped ? -1 : 0;
        GatherScatter.Get(ref margins, index) = margin;
        Lanes.Write(offsetB, ref pose.OffsetB, index);
        Lanes.Write(turnA, ref pose.OrientationA, index);
        Lanes.Write(turnB, ref pose.OrientationB, index);
        Lanes.Write(measures, ref measuresOfPairs, index);
        Lanes.Write(normal, ref manifold.Normal, index);
        for (int i = 0; i < found.Count; ++i)
        {
            ref var contact = ref ConvexContactManifold.GetConvexContactReference(ref Unsafe.AsRef(in found), i);
            ref var wide = ref manifold.Contacts[lane.FirstSlot + i];
            // The bundle tells contacts from the centre of its own A.
            Lanes.Write(contact.Offset + (lane.Flipped ? offsetB : default), ref wide.OffsetA, index);
            GatherScatter.Get(ref wide.Depth, index) = contact.Depth;
            GatherScatter.Get(ref wide.FeatureId, index) = contact.FeatureId;
            GatherScatter.Get(ref wide.Exists, index) = -1;
        }
    }

    public void Record(Buffer<PairHistory> histories, int leastCarriedCount) =>
        PairHistory.Record(histories.Memory, indices, pose, flipMask, margins, measuresOfPairs, ref manifold, leastCarriedCount);
}
