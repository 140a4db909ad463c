using System;
using System.Diagnostics.CodeAnalysis;
using System.Numerics;
using System.Runtime.CompilerServices;
using BepuUtilities;
using BepuUtilities.Memory;

namespace BepuPhysics.Collidables;

/// <summary>All shapes that collidables refer to, in one batch per type; may be shared by several simulations.</summary>
/// <remarks>
/// Any number of threads may read at once; adding, removing and resizing needs the collection alone, outside of a step: during a stage or a
/// query of a simulation that uses the shapes it is refused. A shape that a body or static uses is not removed.
/// </remarks>
public sealed partial class Shapes
{
    readonly BufferPool pool;
    // Managed, because batches are objects; it grows only when a new type of shape is added.
    ShapeBatch?[] batches = [];
    // Changes of this collection by different threads.
    readonly WorldLock world = new();
    // The simulations that use it.
    WorldLock[] users = [];

    /// <summary>Creates an empty collection.</summary>
    /// <param name="pool">Source of the memory of all batches.</param>
    /// <param name="initialCapacityPerTypeBatch">Number of shapes that a new batch makes room for.</param>
    public Shapes(BufferPool pool, int initialCapacityPerTypeBatch)
    {
        ArgumentNullException.ThrowIfNull(pool);
        ArgumentOutOfRangeException.ThrowIfNegative(initialCapacityPerTypeBatch);
        ArgumentOutOfRangeException.ThrowIfGreaterThan(initialCapacityPerTypeBatch, TypedIndex.MaximumIndexCount);
        this.pool = pool;
        InitialCapacityPerTypeBatch = initialCapacityPerTypeBatch;
    }

    /// <summary>Number of shapes that a new batch makes room for.</summary>
    public int InitialCapacityPerTypeBatch { get; }

    /// <summary>One more than the greatest type id that has a batch.</summary>
    public int RegisteredTypeSpan => batches.Length;

    /// <summary>The shapes of a type; null when none was ever added.</summary>
    /// <param name="typeIndex">Type id, less than <see cref="RegisteredTypeSpan"/>.</param>
    public ShapeBatch? this[int typeIndex]
    {
        get
        {
            world.CheckAlive();
            if ((uint)typeIndex >= (uint)batches.Length)
                throw new ArgumentOutOfRangeException(nameof(typeIndex), typeIndex, $"No type id from {batches.Length} on has a batch.");
            return batches[typeIndex];
        }
    }

    /// <summary>Adds a shape.</summary>
    /// <returns>Name of the shape, by which collidables refer to it.</returns>
    /// <exception cref="ArgumentException">The shape is not valid.</exception>
    /// <exception cref="InvalidOperationException">Another type of shape has the same id, or there is no index left.</exception>
    public TypedIndex Add<TShape>(in TShape shape) where TShape : unmanaged, IShape
    {
        // Before a batch is made for the type, so that a refused shape leaves no trace.
        shape.Validate();
        if (shape is ICompoundShape compound)
        {
            world.CheckAlive();
            CompoundChildren.CheckShapes(compound, this);
        }
        using var change = Change("Shapes.Add");
        return new(TShape.TypeId, GetOrCreateBatch<TShape>().AddUnlocked(shape));
    }

    /// <summary>A shape by its index among those of its type; valid until a shape of the type is added or batches are resized.</summary>
    /// <remarks><inheritdoc cref="ShapeBatch{TShape}.this" path="/remarks"/></remarks>
    /// <param name="shapeIndex">Index of the shape in its type's batch.</param>
    /// <exception cref="ArgumentException">There is no such shape.</exception>
    public ref TShape GetShape<TShape>(int shapeIndex) where TShape : unmanaged, IShape
    {
        if ((uint)TShape.TypeId >= (uint)batches.Length || batches[TShape.TypeId] is not ShapeBatch<TShape> batch)
        {
            world.CheckAlive();
            throw new ArgumentOutOfRangeException(nameof(shapeIndex), shapeIndex, $"There are no shapes of type {typeof(TShape).Name}.");
        }
        return ref batch[shapeIndex];
    }

    /// <summary>Whether a shape was added under this name and not removed since.</summary>
    public bool Exists(TypedIndex shape) => shape.Exists && Exists(shape.Type, shape.Index);

    /// <summary>Removes a shape. What it owns itself stays its owner's.</summary>
    /// <remarks>
    /// Bodies and statics that have it keep it until they are gone or get another one, so it may be removed before them. For all else it is gone at
    /// once: nothing can get it any more. Shapes with memory of their own are removed after them, as whoever disposes of it would take it from under
    /// them, or by <see cref="RemoveAndDispose"/>.
    /// </remarks>
    /// <param name="shapeIndex">Name of the shape; nothing is removed for the default, which bodies without a shape have.</param>
    /// <exception cref="ArgumentException">There is no such shape.</exception>
    /// <exception cref="InvalidOperationException">
    /// A compound uses it, or it has memory of its own and a body or static uses it; nothing was changed.
    /// </exception>
    public void Remove(TypedIndex shapeIndex)
    {
        using var change = Change("Shapes.Remove");
        if (shapeIndex.Exists)
            GetCheckedBatch(shapeIndex).RemoveUnlocked(shapeIndex.Index);
    }

    /// <summary>Removes a shape and returns the memory that it owns: once no body and no static has it any more, at the next change of its type's
    /// shapes.</summary>
    /// <remarks>
    /// Bodies and statics that have it keep it until they are gone or get another one, so it may be removed before them. For all else it is gone at
    /// once: nothing can get it any more.
    /// </remarks>
    /// <param name="shapeIndex">Name of the shape; nothing is removed for the default, which bodies without a shape have.</param>
    /// <param name="pool">Pool that the shape's own memory was taken from; to be kept as long as those who have the shape.</param>
    /// <exception cref="ArgumentException">There is no such shape.</exception>
    /// <exception cref="InvalidOperationException">A compound uses it; nothing was changed.</exception>
    public void RemoveAndDispose(TypedIndex shapeIndex, BufferPool pool)
    {
        using var change = Change("Shapes.RemoveAndDispose");
        if (shapeIndex.Exists)
            GetCheckedBatch(shapeIndex).RemoveAndDisposeUnlocked(shapeIndex.Index, pool);
    }

    /// <summary>Removes a shape and all its children, and returns the memory that they own.</summary>
    /// <param name="shapeIndex">Name of the shape; nothing is removed for the default, which bodies without a shape have.</param>
    /// <param name="pool">Pool that the shapes' own memory was taken from.</param>
    /// <exception cref="ArgumentException">There is no such shape.</exception>
    /// <exception cref="InvalidOperationException">A body, a static or a compound uses it; nothing was changed.</exception>
    public void RecursivelyRemoveAndDispose(TypedIndex shapeIndex, BufferPool pool)
    {
        using var change = Change("Shapes.RecursivelyRemoveAndDispose");
        if (shapeIndex.Exists)
            GetCheckedBatch(shapeIndex).RecursivelyRemoveAndDisposeUnlocked(shapeIndex.Index, this, pool);
    }

    /// <summary>Box around a shape in the world, m.</summary>
    /// <param name="pose">Pose of the shape.</param>
    /// <param name="shapeIndex">Name of the shape.</param>
    /// <param name="bounds">Box around the shape.</param>
    /// <exception cref="ArgumentException">There is no such shape.</exception>
    public void UpdateBounds(in RigidPose pose, TypedIndex shapeIndex, out BoundingBox bounds) =>
        GetCheckedBatch(shapeIndex).ComputeBounds(shapeIndex.Index, pose, out bounds.Min, out bounds.Max);

    /// <summary>Box around a shape in the world, m.</summary>
    /// <param name="position">Position of the shape, m.</param>
    /// <param name="orientation">Rotation from the shape's frame to the world; unit length.</param>
    /// <param name="shapeIndex">Name of the shape.</param>
    /// <param name="bounds">Box around the shape.</param>
    /// <exception cref="ArgumentException">There is no such shape.</exception>
    public void UpdateBounds(Vector3 position, Quaternion orientation, TypedIndex shapeIndex, out BoundingBox bounds) =>
        UpdateBounds(new RigidPose(position, orientation), shapeIndex, out bounds);

    /// <summary>Removes all shapes; what they own themselves stays their owners'. Batches keep their room.</summary>
    /// <exception cref="InvalidOperationException">A body or static uses one of them; nothing was changed.</exception>
    public void Clear()
    {
        using var change = Change("Shapes.Clear");
        ClearUnlocked();
    }

    internal void ClearUnlocked()
    {
        CheckAllUnused();
        LetGo();
        foreach (var batch in batches)
            batch?.ClearUnlocked();
    }

    /// <summary>Makes room for a number of shapes in every batch that there is.</summary>
    /// <param name="shapeCapacity">Number of shapes of each type that must fit.</param>
    public void EnsureBatchCapacities(int shapeCapacity)
    {
        ShapeBatch.CheckCapacity(shapeCapacity);
        using var change = Change("Shapes.EnsureBatchCapacities");
        MakeRoomFor(shapeCapacity);
    }

    internal void MakeRoomFor(int shapeCapacity)
    {
        foreach (var batch in batches)
            batch?.EnsureCapacityUnlocked(shapeCapacity);
    }

    /// <summary>Makes room for a number of shapes in every batch that there is, or gives room back; no shape is lost.</summary>
    /// <param name="shapeCapacity">Number of shapes of each type that should fit.</param>
    public void ResizeBatches(int shapeCapacity)
    {
        ShapeBatch.CheckCapacity(shapeCapacity);
        using var change = Change("Shapes.ResizeBatches");
        foreach (var batch in batches)
            batch?.ResizeUnlocked(shapeCapacity);
    }

    /// <summary>Returns all memory to the pool. The collection is then empty and may be used again, unless it was part of a simulation that was
    /// disposed.</summary>
    /// <exception cref="InvalidOperationException">A body or static uses one of the shapes; nothing was changed.</exception>
    public void Dispose()
    {
        if (world.HasEnded)
            return;
        using var change = Change("Shapes.Dispose");
        CheckAllUnused();
        ReturnMemory();
    }

    /// <summary>Returns all memory to the pool.</summary>
    internal void ReturnMemory()
    {
        LetGo();
        foreach (var batch in batches)
            batch?.ReturnMemory();
        batches = [];
        pool.RemoveUser(this);
    }

    // All of them before the memory of any: compounds count their children, which are in other batches.
    void LetGo()
    {
        foreach (var batch in batches)
            batch?.LetGo();
    }

    /// <summary>Whether there is any shape of a type, be it one that was removed and that bodies or statics still have.</summary>
    internal bool HasAny(int typeIndex) => typeIndex < batches.Length && batches[typeIndex] is { HeldCount: > 0 };

    /// <summary>The shapes of a type; null when none was ever added.</summary>
    internal ShapeBatch? FindBatch(int typeIndex) => (uint)typeIndex < (uint)batches.Length ? batches[typeIndex] : null;

    /// <summary>The batch of a shape that is known to exist, for inner loops.</summary>
    internal ShapeBatch GetBatch(int typeIndex) => batches[typeIndex]!;

    /// <summary>Whether there is a shape of an index among those of a type.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    internal bool Exists(int typeIndex, int shapeIndex) =>
        (uint)typeIndex < (uint)batches.Length && batches[typeIndex] is { } batch && batch.Exists(shapeIndex);

    /// <summary>Whether there is a shape, be it one that was removed and that bodies or statics still have.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    internal bool Holds(int typeIndex, int shapeIndex) =>
        (uint)typeIndex < (uint)batches.Length && batches[typeIndex] is { } batch && batch.Holds(shapeIndex);

    /// <inheritdoc cref="Holds(int, int)"/>
    internal bool Holds(TypedIndex shape) => shape.Exists && Holds(shape.Type, shape.Index);

    /// <summary>Tells a shape from all others that had its name, or will have it. It must exist.</summary>
    internal ShapeIdentity Identify(TypedIndex shape) => new(shape, GetBatch(shape.Type).Generation(shape.Index));

    /// <summary>Refuses a name that no shape has.</summary>
    /// <param name="shape">Name of a shape.</param>
    /// <param name="name">Name of the argument that it was given as.</param>
    /// <exception cref="ArgumentException">There is no such shape.</exception>
    internal void CheckExists(TypedIndex shape, string name)
    {
        if (Exists(shape))
            return;
        world.CheckAlive();
        ThrowMissing(shape, name);
    }

    /// <summary>Refuses a name that no shape has.</summary>
    /// <param name="shape">The name.</param>
    /// <param name="name">Name of the argument that it was given as.</param>
    [DoesNotReturn]
    [MethodImpl(MethodImplOptions.NoInlining)]
    internal static void ThrowMissing(TypedIndex shape, string name)
    {
        var reason = shape.Exists ? $"There is no {shape}: it was removed or never added." : "There is no shape of the default index.";
        throw new ArgumentException(reason, name);
    }

    ShapeBatch GetCheckedBatch(TypedIndex shapeIndex)
    {
        CheckExists(shapeIndex, nameof(shapeIndex));
        return GetBatch(shapeIndex.Type);
    }

    /// <summary>Makes a batch for a type, if there is none.</summary>
    internal void MakeRoomForType<TShape>() where TShape : unmanaged, IShape => GetOrCreateBatch<TShape>();

    ShapeBatch<TShape> GetOrCreateBatch<TShape>() where TShape : unmanaged, IShape
    {
        var typeId = TShape.TypeId;
        if ((uint)typeId >= TypedIndex.MaximumTypeCount)
            throw new InvalidOperationException($"{typeof(TShape).Name} has type id {typeId}; ids are from 0 to 127.");
        if (typeId >= batches.Length)
            Array.Resize(ref batches, typeId + 1);
        if (batches[typeId] is not { } batch)
        {
            batch = TShape.CreateShapeBatch(pool, InitialCapacityPerTypeBatch, this);
            if (Array.TrueForAll(batches, other => other is null))
                pool.AddUser(this);
            batches[typeId] = batch;
            batch.BelongTo(this);
        }
        return batch as ShapeBatch<TShape> ??
            throw new InvalidOperationException($"{typeof(TShape).Name} has type id {typeId}, which another type of shape already has.");
    }
}
