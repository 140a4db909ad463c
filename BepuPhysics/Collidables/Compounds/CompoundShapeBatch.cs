using System;
using System.Numerics;
using BepuPhysics.Trees;
using BepuUtilities.Memory;

namespace BepuPhysics.Collidables;

/// <summary>Compounds of one kind. It notes which shapes the children of each had when it was added: these cannot be removed meanwhile.</summary>
/// <remarks>What is noted does not change with a compound that is changed in place, so that what was counted is what is counted back.</remarks>
sealed unsafe class CompoundShapeBatch<TCompound>(BufferPool source, int initialCapacity, Shapes collection)
    : ContainerShapeBatch<TCompound>(source, initialCapacity, collection) where TCompound : unmanaged, ICompoundShape, IContainer
{
    // By slot; none for a slot without a shape.
    Buffer<Buffer<TypedIndex>> childNames;

    public override void ComputeBounds(int shapeIndex, Quaternion orientation, out Vector3 min, out Vector3 max) =>
        this[shapeIndex].ComputeBounds(orientation, all, out min, out max);

    public override void RayTest<TRayHitHandler>(
        int shapeIndex, in RigidPose pose, in RayData ray, ref float maximumT, BufferPool pool, ref TRayHitHandler hitHandler) =>
        this[shapeIndex].RayTest(pose, ray, ref maximumT, all, pool, ref hitHandler);

    private protected override ContainerExtent Measure(int shapeIndex, in Quaternion orientation)
    {
        var extent = CompoundChildren.Measure(CompoundChildren.Of(ref Get(shapeIndex)), orientation, all);
        return new(extent.Min, extent.Max, extent.MaximumRadius, extent.MaximumAngularExpansion);
    }

    internal override bool IsForStaticsOnly(int shapeIndex) => CompoundChildren.IsForStaticsOnly(CompoundChildren.Of(ref Get(shapeIndex)), all);

    internal override bool HasContainer(int shapeIndex) => CompoundChildren.HasContainer(CompoundChildren.Of(ref Get(shapeIndex)));

    private protected override void CheckParts(in TCompound shape)
    {
        var copy = shape;
        CompoundChildren.CheckShapes(CompoundChildren.Of(ref copy), all);
    }

    private protected override void OnAdded(int shapeIndex)
    {
        if (shapeIndex >= childNames.Length)
        {
            var known = childNames.Length;
            pool.ResizeToAtLeast(ref childNames, Capacity, known);
            childNames.Clear(known, childNames.Length - known);
        }
        var children = CompoundChildren.Of(ref Get(shapeIndex));
        pool.Take(children.Length, out Buffer<TypedIndex> names);
        for (int i = 0; i < children.Length; ++i)
            names[i] = children[i].ShapeIndex;
        childNames[shapeIndex] = names;
        BeginUses(names);
    }

    private protected override void OnRemoved(int shapeIndex)
    {
        ref var names = ref childNames[shapeIndex];
        if (!names.Allocated)
            return;
        EndUses(names);
        pool.Return(ref names);
        names = default;
    }

    private protected override void OnMemoryReturned()
    {
        for (int i = 0; i < childNames.Length; ++i)
            pool.ReturnIfTaken(ref childNames[i]);
        pool.ReturnIfTaken(ref childNames);
        childNames = default;
    }

    private protected override void DisposeShape(int shapeIndex, BufferPool pool) => Get(shapeIndex).Dispose(pool);

    private protected override bool HasMemory => true;

    private protected override void RemoveAndDisposeChildren(int shapeIndex, Shapes shapes, BufferPool pool)
    {
        ReleaseChildren(shapeIndex);
        try
        {
            CheckReleased(shapeIndex);
        }
        catch
        {
            ReclaimChildren(shapeIndex);
            throw;
        }
        DisposeReleased(shapeIndex, pool);
    }

    internal override void ReleaseChildren(int shapeIndex)
    {
        foreach (var name in Names(shapeIndex))
        {
            if (all.GetBatch(name.Type).EndPart(name.Index) == 0)
                all.GetBatch(name.Type).ReleaseChildren(name.Index);
        }
    }

    internal override void ReclaimChildren(int shapeIndex)
    {
        foreach (var name in Names(shapeIndex))
        {
            if (all.GetBatch(name.Type).BeginPart(name.Index) == 1)
                all.GetBatch(name.Type).ReclaimChildren(name.Index);
        }
    }

    internal override void CheckReleased(int shapeIndex)
    {
        foreach (var name in Names(shapeIndex))
        {
            all.GetBatch(name.Type).CheckUnused(name.Index);
            all.GetBatch(name.Type).CheckReleased(name.Index);
        }
    }

    internal override void DisposeReleased(int shapeIndex, BufferPool pool)
    {
        // A shape may be that of several children.
        foreach (var name in Names(shapeIndex))
        {
            if (!all.Exists(name))
                continue;
            all.GetBatch(name.Type).DisposeReleased(name.Index, pool);
            all.GetBatch(name.Type).RemoveAndDisposeUnlocked(name.Index, pool);
        }
        base.pool.Return(ref childNames[shapeIndex]);
        childNames[shapeIndex] = default;
    }

    ReadOnlySpan<TypedIndex> Names(int shapeIndex) => new(childNames[shapeIndex].Memory, childNames[shapeIndex].Length);

    void BeginUses(Buffer<TypedIndex> names)
    {
        for (int i = 0; i < names.Length; ++i)
            all.GetBatch(names[i].Type).BeginPart(names[i].Index);
    }

    void EndUses(Buffer<TypedIndex> names)
    {
        for (int i = 0; i < names.Length; ++i)
            all.GetBatch(names[i].Type).EndPart(names[i].Index);
    }
}
