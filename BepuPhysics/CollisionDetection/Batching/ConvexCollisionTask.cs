using System;
using System.Numerics;
using System.Runtime.CompilerServices;
using BepuPhysics.Collidables;
using BepuUtilities;

namespace BepuPhysics.CollisionDetection;

/// <summary>Tests batches of pairs of two convex shape types with a pair tester.</summary>
/// <typeparam name="TShapeA">First shape; its type id is no greater than that of the second.</typeparam>
/// <typeparam name="TShapeWideA">Wide form of the first shape.</typeparam>
/// <typeparam name="TShapeB">Second shape.</typeparam>
/// <typeparam name="TShapeWideB">Wide form of the second shape.</typeparam>
/// <typeparam name="TContacts">As many contacts as a pair can have.</typeparam>
/// <typeparam name="TTester">Finds the contacts.</typeparam>
public sealed unsafe class ConvexCollisionTask<TShapeA, TShapeWideA, TShapeB, TShapeWideB, TContacts, TTester>
    : ConvexPairTask<TShapeA, TShapeWideA, TShapeB, TShapeWideB, TContacts>
    where TShapeA : unmanaged, IConvexShape where TShapeWideA : unmanaged, IShapeWide<TShapeA>
    where TShapeB : unmanaged, IConvexShape where TShapeWideB : unmanaged, IShapeWide<TShapeB>
    where TContacts : unmanaged, IFew<ContactWide>
    where TTester : unmanaged, IPairTester<TShapeWideA, TShapeWideB, TContacts>
{
    /// <summary>Creates the task.</summary>
    /// <exception cref="InvalidOperationException">The type id of the first shape is greater than that of the second.</exception>
    public ConvexCollisionTask() : base(keepsHistories: false) { }

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
    static void WriteLane(ref PairBatch batch, TShapeA* shapeA, TShapeB* shapeB, in Vector3 offsetB, in Quaternion orientationA,
        in Quaternion orientationB, in PairInput pair) =>
        Write(ref batch, shapeA, shapeB, offsetB, orientationA, orientationB, pair, TTester.NeedsOrientationA, TTester.NeedsOrientationB);

    internal override void Execute<TCallbacks>(ref PairBatch batch, PairHistory* histories, ref TCallbacks callbacks)
    {
        ref var wide = ref Manifold(batch);
        Unsafe.SkipInit(out ConvexContactManifold manifold);
        for (int start = 0; start < batch.Count; start += Vector<float>.Count)
        {
            ref var bundle = ref Bundles(batch)[start >> BundleIndexing.VectorShift];
            TTester.Test(bundle.A, bundle.B, bundle.Pose, bundle.SpeculativeMargin, out wide);
            var laneCount = Math.Min(Vector<float>.Count, batch.Count - start);
            for (int lane = 0; lane < laneCount; ++lane)
            {
                Read(ref wide, ref bundle, lane, ref manifold);
                callbacks.OnPairCompleted(Lane(ref bundle.PairIds, lane), ref manifold);
            }
        }
        batch.Count = 0;
    }
}
