using System;
using System.Threading;
using BepuUtilities.Diagnostics;
using BepuUtilities.Memory;

namespace BepuPhysics.Collidables;

// Who uses a shape: bodies and statics, and compounds that have it as a child.
public abstract unsafe partial class ShapeBatch
{
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
        CheckExists(shapeIndex);
        CheckNoUser(shapeIndex);
        CheckNoPart(shapeIndex);
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
            if (!Exists(i))
                continue;
            CheckNoUser(i);
            if (andNoParts)
                CheckNoPart(i);
        }
    }
}
