using System;
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
        var indices = new int[Vector<int>.Count];
        Array.Fill(indices, PairInput.NoHistory);
        indices[Index] = 1;
        var offsetB = found.OffsetB;
        var normal = found.Normal;
        if (Flipped)
        {
            (turnA, turnB) = (turnB, turnA);
            (measures.ReachA, measures.ReachB) = (measures.ReachB, measures.ReachA);
            offsetB = -offsetB;
            normal = -normal;
        }
        var pose = default(PairPoseWide);
        Lanes.Write(offsetB, ref pose.OffsetB, Index);
        Lanes.Write(turnA, ref pose.OrientationA, Index);
        Lanes.Write(turnB, ref pose.OrientationB, Index);
        var measuresWide = default(PairMeasuresWide);
        Lanes.Write(measures, ref measuresWide, Index);
        var manifold = default(ConvexManifoldWide<Few4<ContactWide>>);
        Lanes.Write(normal, ref manifold.Normal, Index);
        for (int i = 0; i < found.Count; ++i)
        {
            ref var contact = ref ConvexContactManifold.GetConvexContactReference(ref Unsafe.AsRef(in found), i);
            ref var wide = ref manifold.Contacts[FirstSlot + i];
            // The bundle tells contacts from the centre of its own A.
            Lanes.Write(contact.Offset + (Flipped ? offsetB : default), ref wide.OffsetA, Index);
            GatherScatter.Get(ref wide.Depth, Index) = contact.Depth;
            GatherScatter.Get(ref wide.FeatureId, Index) = contact.FeatureId;
            GatherScatter.Get(ref wide.Exists, Index) = -1;
        }
        PairHistory.Record(histories.Memory, new Vector<int>(indices), pose, new Vector<int>(Flipped ? -1 : 0), new Vector<float>(margin),
            measuresWide, ref manifold, leastCarriedCount);
        Assert.Equal(default, histories[0].Search);
        history = histories[1];
    }
}
