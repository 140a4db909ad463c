using System.Numerics;
using BepuUtilities;
using BepuUtilities.Collections;
using BepuUtilities.Memory;

namespace BepuPhysics;

// Statics that a game has moved since the last step. They have no velocity, so to what stands on them they are ground that rests; who moves them in each
// step, as a lift, pushes what stands there.
public sealed unsafe partial class Statics
{
    // Of a way: what goes along a surface by no more than this part of it does not go into that.
    const float LeastSlope = 0.01f;
    // Of the extent of bounds: what a turn that is none leaves of a difference.
    const float SameExtent = 1e-5f;
    const int LeastMoved = 16;
    const int NotMoved = -1;

    QuickList<MovedStatic> moved;
    // Per slot, the place in the list.
    Buffer<int> movedPlaces;

    struct MovedStatic
    {
        public int Slot;
        /// <summary>Where to the middle of the bounds has moved, m.</summary>
        public Vector3 Way;
        /// <summary>Whether it has another extent, and its surfaces have moved in many ways.</summary>
        public bool IsTurned;
    }

    /// <summary>Whether any was moved since the last step.</summary>
    internal bool AnyMoved => moved.Count > 0;

    /// <summary>Whether one was moved since the last step into what it touches.</summary>
    /// <param name="handle">The static.</param>
    /// <param name="normal">Normal of the contact, from the static to the other.</param>
    internal bool WasMovedInto(StaticHandle handle, in Vector3 normal)
    {
        if (handle.Slot >= movedPlaces.Length || movedPlaces[handle.Slot] == NotMoved)
            return false;
        ref var note = ref moved[movedPlaces[handle.Slot]];
        return note.IsTurned || Exact.Dot(note.Way, normal) > LeastSlope * Exact.Length(note.Way);
    }

    // Not the pose: who writes that in place asks for its bounds alone.
    void NoteMoved(int slot, in BoundingBox before, in BoundingBox after)
    {
        ref var note = ref NoteOf(slot);
        note.Way += (after.Min + after.Max - before.Min - before.Max) * 0.5f;
        var extent = after.Max - after.Min;
        note.IsTurned |= Exact.Distance(extent, before.Max - before.Min) > SameExtent * Exact.Length(extent);
    }

    ref MovedStatic NoteOf(int slot)
    {
        if (slot >= movedPlaces.Length)
        {
            var before = movedPlaces.Length;
            pool.ResizeToAtLeast(ref movedPlaces, Indices.Length, before);
            movedPlaces.AsSpan()[before..].Fill(NotMoved);
        }
        ref var place = ref movedPlaces[slot];
        if (place == NotMoved)
        {
            if (!moved.Span.Allocated)
                moved = new(LeastMoved, pool);
            place = moved.Count;
            moved.Add(new() { Slot = slot }, pool);
        }
        return ref moved[place];
    }

    /// <summary>Forgets which were moved, once the contacts of the step are found.</summary>
    internal void ForgetMoved()
    {
        foreach (ref var note in moved.AsSpan())
            movedPlaces[note.Slot] = NotMoved;
        moved.Count = 0;
    }

    void CopyMoved(StateCopy copy)
    {
        if (copy.Restores)
            ForgetMoved();
        copy.List(ref moved);
        if (!copy.Restores)
            return;
        var count = moved.Count;
        moved.Count = 0;
        for (int i = 0; i < count; ++i)
        {
            var note = moved.Span[i];
            NoteOf(note.Slot) = note;
        }
    }

    void DisposeMoved()
    {
        moved.DisposeIfTaken(pool);
        pool.ReturnIfTaken(ref movedPlaces);
    }
}
