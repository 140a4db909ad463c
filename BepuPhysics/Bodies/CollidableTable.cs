using System;
using BepuPhysics.Collidables;
using BepuUtilities.Memory;

namespace BepuPhysics;

/// <summary>A value for each body and static, most of which have the usual one. Takes no memory before the first that has another.</summary>
/// <param name="usual">Value of a collidable that was given none.</param>
// By slot: the value stays where it is while bodies and leaves move in memory, and while a body has no shape.
struct CollidableTable<T>(T usual) where T : unmanaged, IEquatable<T>
{
    Buffer<T> bodies;
    Buffer<T> statics;

    /// <summary>Whether any collidable was given a value since the table was last empty.</summary>
    internal readonly bool IsUsed => bodies.Allocated || statics.Allocated;

    /// <summary>Value of a collidable.</summary>
    internal readonly T this[CollidableReference collidable]
    {
        get
        {
            var slot = collidable.Slot;
            if (collidable.Mobility == CollidableMobility.Static)
                return (uint)slot < (uint)statics.Length ? statics[slot] : usual;
            return (uint)slot < (uint)bodies.Length ? bodies[slot] : usual;
        }
    }

    /// <summary>Gives a collidable a value.</summary>
    internal void Set(CollidableReference collidable, T value, BufferPool pool)
    {
        ref var rows = ref collidable.Mobility == CollidableMobility.Static ? ref statics : ref bodies;
        if (collidable.Slot >= rows.Length)
        {
            if (value.Equals(usual))
                return;
            MakeRoom(ref rows, Math.Max(64, collidable.Slot + 1), pool);
        }
        rows[collidable.Slot] = value;
    }

    /// <summary>Gives a collidable that is removed the usual value, for the next that gets its slot.</summary>
    internal readonly void Forget(CollidableReference collidable)
    {
        var rows = collidable.Mobility == CollidableMobility.Static ? statics : bodies;
        if (collidable.Slot < rows.Length)
            rows[collidable.Slot] = usual;
    }

    readonly void MakeRoom(ref Buffer<T> rows, int count, BufferPool pool)
    {
        var previous = rows.Length;
        pool.ResizeToAtLeast(ref rows, Math.Max(count, previous * 2), previous);
        rows.AsSpan()[previous..].Fill(usual);
    }

    internal void CopyState(StateCopy copy)
    {
        CopyState(copy, ref bodies);
        CopyState(copy, ref statics);
    }

    readonly void CopyState(StateCopy copy, ref Buffer<T> rows)
    {
        if (copy.Value(rows.Allocated))
            copy.Rows(ref rows, rows.Length, usual);
        else if (rows.Allocated)
            copy.Pool.Return(ref rows);
    }

    /// <summary>Forgets all values and gives the memory back.</summary>
    internal void Dispose(BufferPool pool)
    {
        pool.ReturnIfTaken(ref bodies);
        pool.ReturnIfTaken(ref statics);
    }

    /// <summary>Forgets memory that is gone already.</summary>
    internal void Abandon()
    {
        bodies = default;
        statics = default;
    }
}
