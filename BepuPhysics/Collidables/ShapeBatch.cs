using System;
using System.Numerics;
using System.Runtime.CompilerServices;
using BepuPhysics.Trees;
using BepuUtilities;
using BepuUtilities.Diagnostics;
using BepuUtilities.Memory;

namespace BepuPhysics.Collidables;

/// <summary>The shapes of one type, by index; the type itself is known only to the derived classes.</summary>
/// <remarks>
/// Shapes do not move: collidables hold their indices. A removed shape leaves a free slot, which the next one added takes. Whether a
/// slot is taken is recorded, so that an index that outlived its shape is refused and not read.
/// Any number of threads may read at once; adding, removing and resizing needs the batch alone.
/// </remarks>
public abstract unsafe partial class ShapeBatch
{
    private protected readonly BufferPool pool;
    IdPool ids;
    // One byte per slot: None, There or Removed.
    Buffer<byte> taken;
    // What number each slot's shape has among all that were ever added.
    Buffer<int> generations;
    int lastGeneration;
    // The collection that the batch belongs to; null for one that stands alone.
    Shapes? owner;

    private protected ShapeBatch(BufferPool pool, int typeId, int shapeDataSize, int initialCapacity)
    {
        this.pool = pool;
        TypeId = typeId;
        ShapeDataSize = shapeDataSize;
        ids = new IdPool(initialCapacity, pool);
    }

    /// <summary>Type id of the shapes.</summary>
    public int TypeId { get; }

    /// <summary>Size of one shape in memory, bytes.</summary>
    public int ShapeDataSize { get; }

    /// <summary>Whether the shapes are made of children.</summary>
    public virtual bool Compound => false;

    /// <summary>Whether a shape is for statics, and no body has it.</summary>
    internal virtual bool IsForStaticsOnly(int shapeIndex) => false;

    /// <summary>Whether a shape has a child that is made of children itself.</summary>
    internal virtual bool HasContainer(int shapeIndex) => false;

    /// <summary>Number of shapes that fit without taking more memory.</summary>
    public abstract int Capacity { get; }

    /// <summary>Number of shapes in the batch.</summary>
    public int Count { get; private set; }

    /// <summary>Whether a shape was added at an index and not removed since. Any index may be asked.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public bool Exists(int shapeIndex) => (uint)shapeIndex < (uint)taken.Length && taken[shapeIndex] == There;

    /// <summary>Whether there is a shape at an index, be it one that was removed and that bodies or statics still have.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    internal bool Holds(int shapeIndex) => (uint)shapeIndex < (uint)taken.Length && taken[shapeIndex] != None;

    /// <summary>Memory of a shape; valid until a shape is added or the batch is resized.</summary>
    /// <param name="shapeIndex">Index of the shape.</param>
    /// <param name="shapePointer">First byte of the shape.</param>
    /// <param name="shapeSize">Size of the shape, bytes.</param>
    /// <exception cref="ArgumentOutOfRangeException">There is no such shape.</exception>
    public void GetShapeData(int shapeIndex, out void* shapePointer, out int shapeSize)
    {
        CheckExists(shapeIndex);
        shapePointer = GetPointer(shapeIndex);
        shapeSize = ShapeDataSize;
    }

    /// <summary>Box around a shape, relative to its centre, m.</summary>
    /// <param name="shapeIndex">Index of the shape.</param>
    /// <param name="orientation">Rotation from the shape's frame to the world; unit length.</param>
    /// <param name="min">Corner with the least coordinates.</param>
    /// <param name="max">Corner with the greatest coordinates.</param>
    /// <exception cref="ArgumentOutOfRangeException">There is no such shape.</exception>
    public abstract void ComputeBounds(int shapeIndex, Quaternion orientation, out Vector3 min, out Vector3 max);

    /// <summary>Box around a shape in the world, m.</summary>
    /// <param name="shapeIndex">Index of the shape.</param>
    /// <param name="pose">Pose of the shape.</param>
    /// <param name="min">Corner with the least coordinates.</param>
    /// <param name="max">Corner with the greatest coordinates.</param>
    /// <exception cref="ArgumentOutOfRangeException">There is no such shape.</exception>
    public void ComputeBounds(int shapeIndex, in RigidPose pose, out Vector3 min, out Vector3 max)
    {
        ComputeBounds(shapeIndex, pose.Orientation, out min, out max);
        min += pose.Position;
        max += pose.Position;
    }

    /// <summary>Tests a ray against a shape and reports hits to a handler.</summary>
    /// <param name="shapeIndex">Index of the shape.</param>
    /// <param name="pose">Pose of the shape.</param>
    /// <param name="ray">Ray in the world.</param>
    /// <param name="maximumT">Farthest t of interest; the handler may lower it.</param>
    /// <param name="pool">Source of temporary memory; used by the calling thread only.</param>
    /// <param name="hitHandler">Receives the hits.</param>
    /// <exception cref="ArgumentOutOfRangeException">There is no such shape.</exception>
    public abstract void RayTest<TRayHitHandler>(int shapeIndex, in RigidPose pose, in RayData ray, ref float maximumT, BufferPool pool,
        ref TRayHitHandler hitHandler) where TRayHitHandler : struct, IShapeRayHitHandler;

    /// <summary>Tests a ray against a shape that is not made of children, which takes no temporary memory, and reports hits to a handler.</summary>
    /// <param name="shapeIndex">Index of the shape.</param>
    /// <param name="pose">Pose of the shape.</param>
    /// <param name="ray">Ray in the world.</param>
    /// <param name="maximumT">Farthest t of interest; the handler may lower it.</param>
    /// <param name="hitHandler">Receives the hits.</param>
    /// <exception cref="ArgumentOutOfRangeException">There is no such shape.</exception>
    /// <exception cref="InvalidOperationException">Shapes of this type are made of children.</exception>
    public void RayTest<TRayHitHandler>(int shapeIndex, in RigidPose pose, in RayData ray, ref float maximumT, ref TRayHitHandler hitHandler)
        where TRayHitHandler : struct, IShapeRayHitHandler
    {
        if (Compound)
            throw new InvalidOperationException($"Shapes of type id {TypeId} are made of children: their ray test needs a pool.");
        RayTest(shapeIndex, pose, ray, ref maximumT, null!, ref hitHandler);
    }

    /// <summary>Removes a shape. What it owns itself stays its owner's. Bodies and statics that have it keep it.</summary>
    /// <param name="index">Index of the shape.</param>
    /// <exception cref="ArgumentOutOfRangeException">There is no such shape.</exception>
    /// <exception cref="InvalidOperationException">
    /// A compound uses it, or it has memory of its own and a body or static uses it; nothing was changed.
    /// </exception>
    public void Remove(int index)
    {
        using var change = BeginChange("ShapeBatch.Remove");
        RemoveUnlocked(index);
    }

    internal void RemoveUnlocked(int shapeIndex)
    {
        CheckRemovable(shapeIndex);
        // Its owner may dispose of it now, and would take it from under those who have it.
        if (HasMemory)
            CheckNoUser(shapeIndex);
        RemoveOrKeep(shapeIndex, null);
    }

    /// <summary>Removes a shape and returns the memory that it owns, once no body and no static has it any more.</summary>
    /// <param name="index">Index of the shape.</param>
    /// <param name="pool">Pool that the shape's own memory was taken from.</param>
    /// <exception cref="ArgumentOutOfRangeException">There is no such shape.</exception>
    /// <exception cref="InvalidOperationException">A compound uses it; nothing was changed.</exception>
    public void RemoveAndDispose(int index, BufferPool pool)
    {
        using var change = BeginChange("ShapeBatch.RemoveAndDispose");
        RemoveAndDisposeUnlocked(index, pool);
    }

    internal void RemoveAndDisposeUnlocked(int shapeIndex, BufferPool pool)
    {
        CheckRemovable(shapeIndex);
        ArgumentNullException.ThrowIfNull(pool);
        RemoveOrKeep(shapeIndex, pool);
    }

    /// <summary>Removes a shape and its children, and returns the memory that they own.</summary>
    /// <param name="index">Index of the shape.</param>
    /// <param name="shapes">Collection that holds the children.</param>
    /// <param name="pool">Pool that the shapes' own memory was taken from.</param>
    /// <exception cref="ArgumentOutOfRangeException">There is no such shape.</exception>
    /// <exception cref="InvalidOperationException">A body, a static or a compound uses it; nothing was changed.</exception>
    public void RecursivelyRemoveAndDispose(int index, Shapes shapes, BufferPool pool)
    {
        using var change = BeginChange("ShapeBatch.RecursivelyRemoveAndDispose");
        RecursivelyRemoveAndDisposeUnlocked(index, shapes, pool);
    }

    internal void RecursivelyRemoveAndDisposeUnlocked(int shapeIndex, Shapes shapes, BufferPool pool)
    {
        CheckUnused(shapeIndex);
        ArgumentNullException.ThrowIfNull(shapes);
        ArgumentNullException.ThrowIfNull(pool);
        RemoveAndDisposeChildren(shapeIndex, shapes, pool);
        RemoveAndDisposeUnlocked(shapeIndex, pool);
    }

    /// <summary>Removes all shapes; what they own themselves stays their owners'.</summary>
    /// <exception cref="InvalidOperationException">A body, a static or a compound uses one of them; nothing was changed.</exception>
    public void Clear()
    {
        using var change = BeginChange("ShapeBatch.Clear");
        CheckAllUnused(andNoParts: true);
        ClearUnlocked();
    }

    internal void ClearUnlocked()
    {
        LetGo();
        for (int i = 0; i < UsedSlotCount; ++i)
        {
            if (Holds(i))
                OnRemoved(i);
        }
        ids.Clear();
        taken.Clear(0, taken.Length);
        Count = 0;
    }

    /// <summary>Makes room for a number of shapes.</summary>
    /// <param name="shapeCapacity">Number of shapes that must fit.</param>
    /// <exception cref="ArgumentOutOfRangeException">The capacity is negative or more than can be indexed.</exception>
    public void EnsureCapacity(int shapeCapacity)
    {
        CheckCapacity(shapeCapacity);
        using var change = BeginChange("ShapeBatch.EnsureCapacity");
        EnsureCapacityUnlocked(shapeCapacity);
    }

    internal void EnsureCapacityUnlocked(int shapeCapacity)
    {
        if (shapeCapacity > Capacity)
            ResizeShapes(shapeCapacity);
    }

    /// <summary>Makes room for a number of shapes, or gives room back; no shape is lost.</summary>
    /// <param name="shapeCapacity">Number of shapes that should fit.</param>
    /// <exception cref="ArgumentOutOfRangeException">The capacity is negative or more than can be indexed.</exception>
    public void Resize(int shapeCapacity)
    {
        CheckCapacity(shapeCapacity);
        using var change = BeginChange("ShapeBatch.Resize");
        ResizeUnlocked(shapeCapacity);
    }

    internal void ResizeUnlocked(int shapeCapacity) => ResizeShapes(Math.Max(shapeCapacity, UsedSlotCount));

    /// <summary>Changes how many free indices can be remembered without taking memory; none is lost.</summary>
    /// <param name="targetIdCapacity">Number of indices.</param>
    public void ResizeIdPool(int targetIdCapacity)
    {
        using var change = BeginChange("ShapeBatch.ResizeIdPool");
        ids.Resize(targetIdCapacity, pool);
    }

    /// <summary>Returns all memory of the batch, which must not be used any more. Not of a batch of a collection, which disposes it.</summary>
    /// <exception cref="InvalidOperationException">The batch is part of a <see cref="Shapes"/>; nothing was changed.</exception>
    public void Dispose()
    {
        if (owner is not null)
            throw new InvalidOperationException("A batch of a collection is disposed with the collection, by Shapes.Dispose.");
        LetGo();
        ReturnMemory();
    }

    internal void ReturnMemory()
    {
        if (!taken.Allocated)
            return;
        OnMemoryReturned();
        ReturnShapes();
        pool.Return(ref taken);
        pool.Return(ref generations);
        pool.Return(ref uses);
        pool.Return(ref parts);
        ids.Dispose(pool);
        Count = 0;
    }

    private protected abstract void ReturnShapes();

    /// <summary>Makes the batch part of a collection.</summary>
    internal void BelongTo(Shapes shapes)
    {
        owner = shapes;
        OnOwned(shapes);
    }

    /// <summary>Called when the batch became part of a collection.</summary>
    private protected virtual void OnOwned(Shapes shapes) { }

    /// <summary>Type of the shapes.</summary>
    internal abstract Type ShapeType { get; }

    /// <summary>Begins a change of the batch, and of the collection that it belongs to.</summary>
    private protected Shapes.ChangeScope BeginChange(string operation) => owner is null ? default : owner.Change(operation);

    /// <summary>Called when a shape was added.</summary>
    private protected virtual void OnAdded(int shapeIndex) { }

    /// <summary>Called before a shape is removed.</summary>
    private protected virtual void OnRemoved(int shapeIndex) { }

    /// <summary>Called before the memory of the batch is returned.</summary>
    private protected virtual void OnMemoryReturned() { }

    /// <summary>Returns the memory that a shape owns.</summary>
    private protected virtual void DisposeShape(int shapeIndex, BufferPool pool) { }

    /// <summary>Whether shapes have memory of their own, which somebody disposes.</summary>
    private protected virtual bool HasMemory => false;

    /// <summary>Removes the children of a shape and returns the memory that they own.</summary>
    private protected virtual void RemoveAndDisposeChildren(int shapeIndex, Shapes shapes, BufferPool pool) { }

    /// <summary>Changes the number of slots; at least those in use remain.</summary>
    private protected abstract void ResizeShapes(int shapeCapacity);

    /// <summary>Memory of a shape that is known to exist, for inner loops.</summary>
    internal abstract void* GetPointer(int shapeIndex);

    /// <summary>Bounds of a bundle of shapes, as <see cref="IShapeWide{TShape}.GetBounds"/>.</summary>
    /// <param name="shapeIndices">
    /// Index per lane, at most as many as there are lanes; negative for a lane without shape. Results of such lanes, and of those beyond, mean
    /// nothing.
    /// </param>
    /// <param name="orientations">Rotation per lane.</param>
    /// <param name="maximumRadius">Distance from the centre to the farthest point.</param>
    /// <param name="maximumAngularExpansion">How far rotation carries the surface beyond the box.</param>
    /// <param name="min">Corners relative to the centre.</param>
    /// <param name="max">Corners relative to the centre.</param>
    internal abstract void GetBounds(ReadOnlySpan<int> shapeIndices, in QuaternionWide orientations,
        out Vector<float> maximumRadius, out Vector<float> maximumAngularExpansion, out Vector3Wide min, out Vector3Wide max);

    /// <summary>Distance from the centre of a shape to its farthest point.</summary>
    internal abstract float MaximumRadius(int shapeIndex);

    /// <summary>Radius of a ball about the centre of a shape that is inside of it, m; zero where none is known to be.</summary>
    internal virtual float InnerRadius(int shapeIndex) => 0;

    /// <summary>Tells a shape that exists from those that were in its slot before.</summary>
    internal int Generation(int shapeIndex)
    {
        Check.That(Holds(shapeIndex));
        return generations[shapeIndex];
    }

    /// <summary>Number of slots whose state is recorded.</summary>
    private protected int SlotCapacity => taken.Length;

    /// <summary>Changes the number of slots whose state is recorded; those in use remain.</summary>
    private protected void ResizeSlots(int slotCapacity)
    {
        pool.ResizeToAtLeast(ref generations, slotCapacity, UsedSlotCount);
        pool.ResizeToAtLeast(ref uses, slotCapacity, UsedSlotCount);
        pool.ResizeToAtLeast(ref parts, slotCapacity, UsedSlotCount);
        // It tells the capacity, so it comes last, should the system refuse memory in between.
        pool.ResizeToAtLeast(ref taken, slotCapacity, UsedSlotCount);
        taken.Clear(UsedSlotCount, taken.Length - UsedSlotCount);
    }

    /// <summary>Number of slots from the first to the last that may hold a shape.</summary>
    private protected int UsedSlotCount => ids.HighestPossiblyClaimedId + 1;

    private protected int TakeSlot()
    {
        LetGo();
        if (ids.AvailableIdCount == 0)
        {
            if (UsedSlotCount == TypedIndex.MaximumIndexCount)
                throw new InvalidOperationException($"There is no index left for another shape of type {TypeId}.");
            // Before the index is taken, so that nothing has changed if there is no memory.
            if (UsedSlotCount == Capacity)
                ResizeShapes((int)Math.Min(Math.Max(1, Capacity * 2L), TypedIndex.MaximumIndexCount));
        }
        var index = ids.Take();
        Check.That(!Holds(index));
        taken[index] = There;
        generations[index] = ++lastGeneration;
        uses[index] = 0;
        parts[index] = 0;
        ++Count;
        return index;
    }

    // A shape that was removed can be read by those who still have it.
    private protected void CheckExists(int shapeIndex) => CheckIsThere(Holds(shapeIndex), shapeIndex);

    void CheckIsThere(bool isThere, int shapeIndex)
    {
        if (!isThere)
            throw new ArgumentOutOfRangeException(nameof(shapeIndex), shapeIndex, $"There is no shape {shapeIndex} of type {TypeId}.");
    }

    internal static void CheckCapacity(int shapeCapacity)
    {
        if ((uint)shapeCapacity > TypedIndex.MaximumIndexCount)
            throw new ArgumentOutOfRangeException(nameof(shapeCapacity), shapeCapacity, "A capacity is from 0 to 2^24 shapes.");
    }
}
