using System;
using System.Runtime.InteropServices;

namespace Demos.Running;

/// <summary>
/// What the narrow phase callbacks know beside their settings: the groups of the bodies and, in the one step in which it is asked for,
/// what was found. Each worker writes to a slot of its own, far enough from the next that they share no cache line.
/// </summary>
sealed class ContactRecorder(int workerCount)
{
    /// <summary>What one worker found.</summary>
    [StructLayout(LayoutKind.Sequential, Size = 128)]
    public struct Slot
    {
        public long Pairs;
        public long Manifolds;
        public long Contacts;
        public float GreatestDepth;
    }

    readonly Slot[] slots = new Slot[workerCount];

    /// <summary>Whether this step is recorded. Off in steps that are timed.</summary>
    public bool Recording { get; private set; }

    /// <summary>Whether any body has a group, so that a pair has to be looked up.</summary>
    public bool HasGroups { get; private set; }

    /// <summary>Group of each body by its handle.</summary>
    public int[] BodyGroups { get; private set; } = [];

    /// <summary>Group of each static by its handle.</summary>
    public int[] StaticGroups { get; private set; } = [];

    /// <summary>Sets the groups by handle.</summary>
    public void SetGroups(int[] bodyGroups, int[] staticGroups)
    {
        BodyGroups = bodyGroups;
        StaticGroups = staticGroups;
        HasGroups = Array.Exists(bodyGroups, group => group != 0) || Array.Exists(staticGroups, group => group != 0);
    }

    /// <summary>Slot of one worker.</summary>
    public ref Slot this[int workerIndex] => ref slots[workerIndex];

    /// <summary>Records from here on.</summary>
    public void Begin()
    {
        Array.Clear(slots);
        Recording = true;
    }

    /// <summary>Ends the recording and returns the sum of all workers.</summary>
    public Slot End()
    {
        Recording = false;
        var sum = new Slot();
        foreach (ref readonly Slot slot in slots.AsSpan())
        {
            sum.Pairs += slot.Pairs;
            sum.Manifolds += slot.Manifolds;
            sum.Contacts += slot.Contacts;
            sum.GreatestDepth = Math.Max(sum.GreatestDepth, slot.GreatestDepth);
        }
        return sum;
    }
}
