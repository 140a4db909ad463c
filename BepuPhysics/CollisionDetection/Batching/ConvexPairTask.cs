using System;
using System.Numerics;
using System.Runtime.CompilerServices;
using BepuPhysics.Collidables;
using BepuUtilities;
using BepuUtilities.Diagnostics;

namespace BepuPhysics.CollisionDetection;

/// <summary>Tests batches of pairs of two convex shape types: what is common to tasks with and without histories.</summary>
/// <remarks>
/// A pair is written straight into its lane, so that a test starts from wide data and nothing is transposed in between. Types are
/// ordered by their ids; a pair that was added in the other order is turned on its way in and its contacts on their way out.
/// </remarks>
/// <typeparam name="TShapeA">First shape; its type id is no greater than that of the second.</typeparam>
/// <typeparam name="TShapeWideA">Wide form of the first shape.</typeparam>
/// <typeparam name="TShapeB">Second shape.</typeparam>
/// <typeparam name="TShapeWideB">Wide form of the second shape.</typeparam>
/// <typeparam name="TContacts">As many contacts as a pair can have.</typeparam>
public abstract unsafe class ConvexPairTask<TShapeA, TShapeWideA, TShapeB, TShapeWideB, TContacts> : CollisionTask
    where TShapeA : unmanaged, IConvexShape where TShapeWideA : unmanaged, IShapeWide<TShapeA>
    where TShapeB : unmanaged, IConvexShape where TShapeWideB : unmanaged, IShapeWide<TShapeB>
    where TContacts : unmanaged, IFew<ContactWide>
{
    private protected ConvexPairTask(bool keepsHistories, bool isOrdered = true)
        : base(TShapeA.TypeId, TShapeB.TypeId, Describe(typeof(TShapeA), typeof(TShapeB)), keepsHistories)
    {
        if (isOrdered)
            CheckOrder(typeof(TShapeA), typeof(TShapeB));
    }

    // Behind the bundles is the room for their contacts: memory of the pool starts at a cache line, which vectors on the stack do not, and
    // half of those would lie across two.
    internal override int BatchByteCount =>
        PairBatch.BundleCapacity * sizeof(PairBundle<TShapeWideA, TShapeWideB>) + sizeof(ConvexManifoldWide<TContacts>);

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    private protected static PairBundle<TShapeWideA, TShapeWideB>* Bundles(in PairBatch batch) =>
        (PairBundle<TShapeWideA, TShapeWideB>*)batch.Bundles.Memory;

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    private protected static ref ConvexManifoldWide<TContacts> Manifold(in PairBatch batch) =>
        ref *(ConvexManifoldWide<TContacts>*)(Bundles(batch) + PairBatch.BundleCapacity);

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    private protected static void Find(Shapes shapes, int shapeIndexA, int shapeIndexB, out TShapeA* shapeA, out TShapeB* shapeB)
    {
        Check.That(shapes.GetBatch(TShapeA.TypeId) is ShapeBatch<TShapeA> && shapes.GetBatch(TShapeB.TypeId) is ShapeBatch<TShapeB>);
        // A checked cast to a generic class is a call. Shapes do not move while pairs are tested.
        shapeA = (TShapeA*)Unsafe.AsPointer(ref Unsafe.As<ShapeBatch<TShapeA>>(shapes.GetBatch(TShapeA.TypeId)).Get(shapeIndexA));
        shapeB = (TShapeB*)Unsafe.AsPointer(ref Unsafe.As<ShapeBatch<TShapeB>>(shapes.GetBatch(TShapeB.TypeId)).Get(shapeIndexB));
    }

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    private protected static void Write(ref PairBatch batch, TShapeA* shapeA, TShapeB* shapeB, in Vector3 offsetB, in Quaternion orientationA,
        in Quaternion orientationB, in PairInput pair, bool needsOrientationA, bool needsOrientationB)
    {
        Check.That(batch.Bundles.Allocated && batch.Count < PairBatch.Capacity);
        BundleIndexing.GetBundleIndices(batch.Count++, out var bundleIndex, out var lane);
        ref var bundle = ref Bundles(batch)[bundleIndex];
        Lanes.Write(*shapeA, ref bundle.A, lane);
        Lanes.Write(*shapeB, ref bundle.B, lane);
        WriteOffset(offsetB, pair.FlipMask & int.MinValue, ref bundle.Pose.OffsetB, lane);
        if (needsOrientationA)
            Lanes.Write(orientationA, ref bundle.Pose.OrientationA, lane);
        if (needsOrientationB)
            Lanes.Write(orientationB, ref bundle.Pose.OrientationB, lane);
        Lane(ref bundle.SpeculativeMargin, lane) = pair.SpeculativeMargin;
        Lane(ref bundle.PairIds, lane) = pair.PairId;
        Lane(ref bundle.FlipMask, lane) = pair.FlipMask;
    }

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static void WriteOffset(in Vector3 offset, int sign, ref Vector3Wide wide, int lane)
    {
        Lane(ref Unsafe.As<Vector<float>, Vector<int>>(ref wide.X), lane) = BitConverter.SingleToInt32Bits(offset.X) ^ sign;
        Lane(ref Unsafe.As<Vector<float>, Vector<int>>(ref wide.Y), lane) = BitConverter.SingleToInt32Bits(offset.Y) ^ sign;
        Lane(ref Unsafe.As<Vector<float>, Vector<int>>(ref wide.Z), lane) = BitConverter.SingleToInt32Bits(offset.Z) ^ sign;
    }

    // A vector that is written to memory by components and read as a whole waits until the components are in the cache.
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static Vector3 ReadVector(ref Vector3Wide wide, int lane) => new(Lane(ref wide.X, lane), Lane(ref wide.Y, lane), Lane(ref wide.Z, lane));

    /// <summary>Takes the contacts that exist out of a lane, in the frame of the caller's A.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    private protected static void Read(ref ConvexManifoldWide<TContacts> wide, ref PairBundle<TShapeWideA, TShapeWideB> bundle, int lane,
        ref ConvexContactManifold manifold)
    {
        int count = 0;
        var offsetB = ReadVector(ref bundle.Pose.OffsetB, lane);
        var normal = ReadVector(ref wide.Normal, lane);
        Vector3 correction = default;
        if (Lane(ref bundle.FlipMask, lane) != 0)
        {
            offsetB = -offsetB;
            normal = -normal;
            correction = offsetB;
        }
        manifold.OffsetB = offsetB;
        for (int i = 0; i < TContacts.Count; ++i)
        {
            ref var source = ref wide.Contacts[i];
            if (Lane(ref source.Exists, lane) == 0)
                continue;
            ref var contact = ref Unsafe.Add(ref manifold.Contact0, count++);
            contact.Offset = ReadVector(ref source.OffsetA, lane) + correction;
            contact.Depth = Lane(ref source.Depth, lane);
            contact.FeatureId = Lane(ref source.FeatureId, lane);
        }
        manifold.Count = count;
        // A bundle that is apart as a whole leaves its normals unwritten: nobody may see what was there before.
        manifold.Normal = count > 0 ? normal : default;
    }

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    private protected static ref T Lane<T>(ref Vector<T> wide, int lane) => ref Unsafe.Add(ref Unsafe.As<Vector<T>, T>(ref wide), lane);
}
