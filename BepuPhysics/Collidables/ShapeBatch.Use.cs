using System;
using System.Collections.Generic;
using System.Threading;
using BepuUtilities.Diagnostics;
using BepuUtilities.Memory;

namespace BepuPhysics.Collidables;

// Who uses a shape: bodies and statics, and compounds that have it as a child.
public abstract unsafe partial class ShapeBatch
{
    // What is in a slot: nothing, a shape, or a shape that was removed while bodies or statics had it.
    const byte None = 0, There = 1, Removed = 2;

    // Shapes that were removed while bodies or statics had them, with the pool that their own memory goes back to, if it does.
    List<(int Index, BufferPool? Pool)>? kept;

    // Number of bodies and statics of each slot's shape.
    Buffer<int> uses;
    // Number of children of compounds that are each slot's shape.
    Buffer<int> parts;

    // Bodies of several simulations, on a thread each, may share the shapes.
    internal void BeginUse(int shapeIndex) => Interlocked.Increment(ref uses[shapeIndex]);

    internal void EndUse(int shapeIndex)
    {
        var left = Interlocked.Decrement(ref uses[shapeIndex]);
        Check.That(left >= 0);
    }

    /// <summary>Counts a child of a compound that is this shape. Only while the collection changes.</summary>
    /// <returns>How many there are then.</returns>
    internal int BeginPart(int shapeIndex) => ++parts[shapeIndex];

    /// <summary>Counts a child of a compound less.</summary>
    /// <returns>How many are left.</returns>
    internal int EndPart(int shapeIndex)
    {
        --parts[shapeIndex];
        Check.That(parts[shapeIndex] >= 0);
        return parts[shapeIndex];
    }

    /// <summary>Ends the uses of a shape's children, and of the children of those that nothing else uses.</summary>
    internal virtual void ReleaseChildren(int shapeIndex) { }

    /// <summary>Takes <see cref="ReleaseChildren"/> back.</summary>
    internal virtual void ReclaimChildren(int shapeIndex) { }

    /// <summary>Refuses if anything else uses a child of a shape, or a child of one, whose uses have ended.</summary>
    internal virtual void CheckReleased(int shapeIndex) { }

    /// <summary>Removes the children of a shape, and theirs, and returns the memory that they own. Their uses have ended.</summary>
    internal virtual void DisposeReleased(int shapeIndex, BufferPool pool) { }

    /// <summary>Refuses a shape that does not exist, or that something uses.</summary>
    internal void CheckUnused(int shapeIndex)
    {
        CheckRemovable(shapeIndex);
        CheckNoUser(shapeIndex);
    }

    // Bodies and statics do not hold a removal up: they keep the shape.
    void CheckRemovable(int shapeIndex)
    {
        CheckIsThere(Exists(shapeIndex), shapeIndex);
        CheckNoPart(shapeIndex);
    }

    void RemoveOrKeep(int shapeIndex, BufferPool? memoryPool)
    {
        LetGo();
        --Count;
        if (uses[shapeIndex] == 0)
        {
            FreeSlot(shapeIndex, memoryPool);
            return;
        }
        taken[shapeIndex] = Removed;
        (kept ??= []).Add((shapeIndex, memoryPool));
    }

    void FreeSlot(int shapeIndex, BufferPool? memoryPool)
    {
        if (memoryPool is not null)
            DisposeShape(shapeIndex, memoryPool);
        OnRemoved(shapeIndex);
        ids.Return(shapeIndex, pool);
        taken[shapeIndex] = None;
    }

    /// <summary>Number of shapes in the batch and of those that were removed and are kept.</summary>
    internal int HeldCount => Count + (kept?.Count ?? 0);

    /// <summary>Frees the slots of removed shapes that no body and no static has any more.</summary>
    /// <remarks>
    /// With each change of the batch, not when the last of them loses the shape: simulations that share shapes may lose some at once, each on a thread
    /// of its own, while those who change the batch have it alone.
    /// </remarks>
    internal void LetGo()
    {
        if (kept is null)
            return;
        int left = 0;
        for (int i = 0; i < kept.Count; ++i)
        {
            var shape = kept[i];
            if (uses[shape.Index] == 0)
                FreeSlot(shape.Index, shape.Pool);
            else
                kept[left++] = shape;
        }
        kept.RemoveRange(left, kept.Count - left);
    }

    void CheckNoUser(int shapeIndex)
    {
        if (uses[shapeIndex] != 0)
            throw new InvalidOperationException(
                $"Shape {shapeIndex} of type {TypeId} is in use by {uses[shapeIndex]} bodies and statics: remove these first, or give them another shape.");
    }

    void CheckNoPart(int shapeIndex)
    {
        if (parts[shapeIndex] != 0)
            throw new InvalidOperationException(
                $"Shape {shapeIndex} of type {TypeId} is a child of a compound, {parts[shapeIndex]} times: remove the compound first.");
    }

    /// <summary>Refuses if anything uses one of the shapes.</summary>
    /// <param name="andNoParts">Whether compounds count too, because they stay.</param>
    internal void CheckAllUnused(bool andNoParts)
    {
        for (int i = 0; i < UsedSlotCount; ++i)
        {
            if (!Holds(i))
                continue;
            CheckNoUser(i);
            if (andNoParts)
                CheckNoPart(i);
        }
    }
}
