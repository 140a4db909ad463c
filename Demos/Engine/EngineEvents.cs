using System;
using BepuPhysics;
using BepuPhysics.CollisionDetection;
using Demos.Running;

namespace Demos.Engine;

/// <summary>What touched what, as this engine tells it.</summary>
static class EngineEvents
{
    /// <summary>Listens to all events of all bodies that there are.</summary>
    public static void ListenToAll(Simulation simulation)
    {
        for (int slot = 0; slot < simulation.Bodies.HandleToLocation.Length; ++slot)
        {
            if (simulation.Bodies.TryGetHandle(slot, out var handle))
                simulation.Events.Listen(handle, EventMask.All);
        }
    }

    /// <summary>A hash over a state and all that the last step told.</summary>
    /// <param name="simulation">Who told it.</param>
    /// <param name="state">Hash of the state.</param>
    public static ulong Hash(Simulation simulation, ulong state)
    {
        var hash = new SceneHash();
        hash.Add((uint)state);
        hash.Add((uint)(state >> 32));
        var events = simulation.Events;
        Add(ref hash, events, events.Began);
        Add(ref hash, events, events.Ended);
        Add(ref hash, events, events.Hits);
        Add(ref hash, events, events.Persisting);
        return hash.Value;
    }

    static void Add(ref SceneHash hash, CollisionEvents events, ReadOnlySpan<ContactEvent> list)
    {
        hash.Add((uint)list.Length);
        foreach (ref readonly var one in list)
        {
            hash.Add(one.Pair.A.Packed);
            hash.Add(one.Pair.B.Packed);
            hash.Add(one.Position);
            hash.Add(one.Normal);
            hash.Add(one.Depth);
            hash.Add(one.Impulse);
            hash.Add(one.FrictionImpulse);
            hash.Add(one.ApproachSpeed);
            foreach (ref readonly var contact in events.Contacts(one))
            {
                hash.Add((uint)contact.FeatureId);
                hash.Add(contact.Position);
                hash.Add(contact.Depth);
                hash.Add(contact.Impulse);
            }
        }
    }
}
