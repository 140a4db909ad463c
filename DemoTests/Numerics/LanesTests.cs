using System.Numerics;
using System.Runtime.CompilerServices;
using BepuUtilities;
using Xunit;

namespace DemoTests.Numerics;

public class LanesTests
{
    [Fact]
    public void WhatWasWrittenIsReadAndNeighboursStay()
    {
        var samples = new WideSamples(5);
        var wide = samples.Rotations();
        for (int lane = 0; lane < Vector<float>.Count; ++lane)
        {
            var before = wide;
            var q = samples.Rotation();
            Lanes.Write(q, ref wide, lane);
            Assert.Equal(q, Lanes.Read<Quaternion, QuaternionWide>(ref wide, lane));
            for (int other = 0; other < Vector<float>.Count; ++other)
                if (other != lane)
                    Assert.Equal(Lanes.Read<Quaternion, QuaternionWide>(ref before, other), Lanes.Read<Quaternion, QuaternionWide>(ref wide, other));
        }
    }

    [Fact]
    public void BroadcastFillsEveryLane()
    {
        var matrix = new WideSamples(6).Matrix();
        var wide = Lanes.Broadcast<Matrix3x3, Matrix3x3Wide>(matrix);
        for (int lane = 0; lane < Vector<float>.Count; ++lane)
            Assert.Equal(matrix, Lanes.Read<Matrix3x3, Matrix3x3Wide>(ref wide, lane));
    }

    [Fact]
    public void CopyMovesOneLane()
    {
        var samples = new WideSamples(7);
        var (source, target) = (samples.Vectors(), samples.Vectors());
        var expected = Lanes.Read<Vector3, Vector3Wide>(ref source, 1);
        var untouched = Lanes.Read<Vector3, Vector3Wide>(ref target, 0);
        Vector3Wide.CopySlot(ref source, 1, ref target, 2);
        Assert.Equal(expected, Lanes.Read<Vector3, Vector3Wide>(ref target, 2));
        Assert.Equal(untouched, Lanes.Read<Vector3, Vector3Wide>(ref target, 0));
    }

    [Fact]
    public void ReferencesToLanes()
    {
        var wide = new WideSamples(8).Vectors();
        var last = Vector<float>.Count - 1;
        Assert.Equal(wide.Y[last], GatherScatter.Get(ref wide.Y, last));
        Assert.Equal(wide.Z[0], GatherScatter.GetFirst(ref wide.Z));
        ref var offset = ref GatherScatter.GetOffsetInstance(ref wide, last);
        Assert.Equal(new Vector3(wide.X[last], wide.Y[last], wide.Z[last]), new(Lane(ref offset.X), Lane(ref offset.Y), Lane(ref offset.Z)));

        static float Lane(ref Vector<float> vector) => Unsafe.As<Vector<float>, float>(ref vector);
    }

    [Fact]
    public void BundleArithmetic()
    {
        for (int count = 0; count < 100; ++count)
        {
            Assert.Equal((count + Vector<float>.Count - 1) / Vector<float>.Count, BundleIndexing.GetBundleCount(count));
            BundleIndexing.GetBundleIndices(count, out var bundle, out var inner);
            Assert.Equal((count / Vector<float>.Count, count % Vector<float>.Count), (bundle, inner));
        }
        for (int count = 0; count <= Vector<float>.Count; ++count)
            for (int lane = 0; lane < Vector<float>.Count; ++lane)
            {
                Assert.Equal(lane < count ? -1 : 0, BundleIndexing.CreateMaskForCountInBundle(count)[lane]);
                Assert.Equal(lane < count ? 0 : -1, BundleIndexing.CreateTrailingMaskForCountInBundle(count)[lane]);
            }
    }

    [Fact]
    public void FewAreDense()
    {
        AssertDense<Few1<int>>(1);
        AssertDense<Few2<int>>(2);
        AssertDense<Few3<int>>(3);
        AssertDense<Few4<int>>(4);

        static void AssertDense<TFew>(int count) where TFew : unmanaged, IFew<int>
        {
            Assert.Equal(count, TFew.Count);
            Assert.Equal(count * sizeof(int), Unsafe.SizeOf<TFew>());
            TFew few = default;
            for (int i = 0; i < count; ++i)
                few[i] = i + 10;
            for (int i = 0; i < count; ++i)
                Assert.Equal(i + 10, Unsafe.Add(ref Unsafe.As<TFew, int>(ref few), i));
        }
    }
}
