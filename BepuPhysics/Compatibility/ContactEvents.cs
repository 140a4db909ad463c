using System;
using System.Collections.Generic;
using System.Diagnostics.CodeAnalysis;
using BepuPhysics.Collidables;
using BepuPhysics.CollisionDetection;
using BepuUtilities;
using BepuUtilities.Memory;

namespace BepuPhysics.Compatibility;

/// <summary>Contact events by the names of the demo of bepuphysics2 that most games copied, made of <see cref="Simulation.Events"/>.</summary>
/// <remarks>
/// Register handlers, and call <see cref="Flush"/> after each step: it calls them in the order of pairs, on its thread. So they may add and remove things,
/// and what they do does not depend on threads. Touching means what it means for <see cref="CollisionEvents"/>. Of a pair with more than four contacts
/// the deepest four are shown. New code does better with <see cref="CollisionEvents"/>, which knows impulses, too.
/// </remarks>
public sealed class ContactEvents : IDisposable
{
    readonly Dictionary<uint, IContactEventHandler> handlers = [];
    // The pairs of this flush and of the last, in their order.
    List<ContactSnapshot> current = [];
    List<ContactSnapshot> previous = [];
    // Pairs that sleep, as they were when they fell asleep.
    readonly Dictionary<(uint, uint), ContactSnapshot> asleep = [];
    long wokenPairCount;
    Simulation? simulation;

    /// <summary>Creates events without handlers; call <see cref="Initialize"/> before any is registered. The parameters are there for callers alone.</summary>
    /// <param name="threadDispatcher">Has no effect.</param>
    /// <param name="pool">Has no effect.</param>
    /// <param name="initialListenerCapacity">Has no effect.</param>
    public ContactEvents(IThreadDispatcher? threadDispatcher = null, BufferPool? pool = null, int initialListenerCapacity = 64)
    {
    }

    /// <summary>Says whose contacts are meant; the narrow phase callbacks' Initialize is a good place.</summary>
    public void Initialize(Simulation simulation)
    {
        ArgumentNullException.ThrowIfNull(simulation);
        this.simulation = simulation;
    }

    /// <summary>Calls a handler for a collidable from the next step on.</summary>
    /// <remarks>Replaces what <see cref="CollisionEvents.Listen(CollidableReference, EventMask)"/> was told of it.</remarks>
    /// <exception cref="ArgumentException">There is no such collidable, or it has a handler already; nothing was changed.</exception>
    /// <exception cref="InvalidOperationException">There is no simulation yet, or a step is in progress; nothing was changed.</exception>
    public void Register(CollidableReference collidable, IContactEventHandler handler)
    {
        ArgumentNullException.ThrowIfNull(handler);
        if (handlers.ContainsKey(KeyOf(collidable)))
            throw new ArgumentException($"{collidable} has a handler already.", nameof(collidable));
        Events.Listen(collidable, EventMask.Contacts);
        handlers.Add(KeyOf(collidable), handler);
    }

    /// <summary>As <see cref="Register(CollidableReference, IContactEventHandler)"/>, for a body.</summary>
    public void Register(BodyHandle body, IContactEventHandler handler) => Register(NameOf(body), handler);

    /// <summary>As <see cref="Register(CollidableReference, IContactEventHandler)"/>, for a static.</summary>
    public void Register(StaticHandle staticHandle, IContactEventHandler handler) => Register(new CollidableReference(staticHandle), handler);

    /// <summary>Calls the handler of a collidable no more, whether the collidable was removed or not.</summary>
    /// <exception cref="ArgumentException">It has no handler.</exception>
    /// <exception cref="InvalidOperationException">A step is in progress; nothing was changed.</exception>
    public void Unregister(CollidableReference collidable)
    {
        if (!handlers.ContainsKey(KeyOf(collidable)))
            throw new ArgumentException($"{collidable} has no handler.", nameof(collidable));
        var exists = collidable.Mobility == CollidableMobility.Static
            ? simulation!.Statics.StaticExists(collidable.StaticHandle)
            : simulation!.Bodies.BodyExists(collidable.BodyHandle);
        if (exists)
            Events.Listen(collidable, EventMask.None);
        handlers.Remove(KeyOf(collidable));
    }

    /// <summary>As <see cref="Unregister(CollidableReference)"/>, for a body.</summary>
    public void Unregister(BodyHandle body) => Unregister(NameOf(body));

    /// <summary>As <see cref="Unregister(CollidableReference)"/>, for a static.</summary>
    public void Unregister(StaticHandle staticHandle) => Unregister(new CollidableReference(staticHandle));

    /// <summary>Whether a collidable has a handler.</summary>
    public bool IsListener(CollidableReference collidable) => handlers.ContainsKey(KeyOf(collidable));

    /// <summary>Does nothing: contacts are found without the help of callbacks. There for callers.</summary>
    [SuppressMessage("Performance", "CA1822", Justification = "Callers have an instance.")]
    public void HandleManifold<TManifold>(int workerIndex, CollidablePair pair, ref TManifold manifold)
        where TManifold : unmanaged, IContactManifold<TManifold>
    {
    }

    /// <summary>Calls the handlers. After each step.</summary>
    /// <exception cref="InvalidOperationException">There is no simulation yet.</exception>
    public void Flush()
    {
        (current, previous) = (previous, current);
        current.Clear();
        Events.AddSnapshots(current, simulation!.Statics);
        RecallWoken();
        int before = 0;
        int now = 0;
        while (before < previous.Count || now < current.Count)
        {
            var order = before == previous.Count ? 1 : now == current.Count ? -1 : ContactSnapshot.Compare(previous[before], current[now]);
            if (order < 0 && simulation!.NarrowPhase.Sleeps(previous[before].Pair))
                asleep[KeyOf(previous[before].Pair)] = previous[before++];
            else if (order < 0)
                Tell(previous[before++], null);
            else if (order > 0)
                Tell(null, current[now++]);
            else
                Tell(previous[before++], current[now++]);
        }
    }

    /// <summary>Forgets all handlers.</summary>
    public void Dispose()
    {
        handlers.Clear();
        current.Clear();
        previous.Clear();
        asleep.Clear();
    }

    // What woke goes on from where it fell asleep, or has ended meanwhile.
    void RecallWoken()
    {
        if (asleep.Count == 0 || wokenPairCount == Events.WokenPairCount)
            return;
        wokenPairCount = Events.WokenPairCount;
        foreach (var (key, snapshot) in asleep)
        {
            if (simulation!.NarrowPhase.Sleeps(snapshot.Pair))
                continue;
            previous.Add(snapshot);
            asleep.Remove(key);
        }
        previous.Sort(static (a, b) => ContactSnapshot.Compare(a, b));
    }

    static (uint, uint) KeyOf(in CollidablePair pair) => (pair.A.Packed, pair.B.Packed);

    CollisionEvents Events => (simulation ?? throw new InvalidOperationException("Call Initialize first: there is no simulation yet.")).Events;

    static CollidableReference NameOf(BodyHandle body) => new(CollidableMobility.Dynamic, body);

    // A body that becomes kinematic keeps its handler.
    static uint KeyOf(CollidableReference collidable) =>
        collidable.Mobility == CollidableMobility.Static ? collidable.Packed : NameOf(collidable.BodyHandle).Packed;

    void Tell(in ContactSnapshot? before, in ContactSnapshot? now)
    {
        var pair = (now ?? before)!.Value.Pair;
        Tell(pair.A, pair, before, now);
        Tell(pair.B, pair, before, now);
    }

    void Tell(CollidableReference source, in CollidablePair pair, in ContactSnapshot? before, in ContactSnapshot? now)
    {
        if (!handlers.TryGetValue(KeyOf(source), out var handler))
            return;
        var old = before ?? default;
        if (now is not { } snapshot)
        {
            var nothing = new ConvexContactManifold();
            Tell(handler, source, pair, old, isNew: false, touches: false, ref nothing);
            handler.OnPairEnded(source, pair);
            return;
        }
        if (snapshot.IsConvex)
        {
            var convex = snapshot.ToConvex();
            Tell(handler, source, pair, old, before is null, snapshot.Touches, ref convex);
            handler.OnPairUpdated(source, pair, ref convex, 0);
        }
        else
        {
            var contacts = snapshot.Contacts;
            Tell(handler, source, pair, old, before is null, snapshot.Touches, ref contacts);
            handler.OnPairUpdated(source, pair, ref contacts, 0);
        }
    }

    static void Tell<TManifold>(IContactEventHandler handler, CollidableReference source, in CollidablePair pair, in ContactSnapshot old, bool isNew,
        bool touches, ref TManifold manifold) where TManifold : unmanaged, IContactManifold<TManifold>
    {
        if (isNew)
            handler.OnPairCreated(source, pair, ref manifold, 0);
        for (int i = 0; i < manifold.Count; ++i)
        {
            manifold.GetContact(i, out var offset, out var normal, out var depth, out var featureId);
            if (!Has(old.Contacts, featureId))
                handler.OnContactAdded(source, pair, ref manifold, offset, normal, depth, featureId, i, 0);
        }
        for (int i = 0; i < old.Contacts.Count; ++i)
        {
            var featureId = old.Contacts.GetFeatureId(i);
            if (!Has(manifold, featureId))
                handler.OnContactRemoved(source, pair, ref manifold, featureId, 0);
        }
        if (touches && !old.Touches)
            handler.OnStartedTouching(source, pair, ref manifold, 0);
        else if (!touches && old.Touches)
            handler.OnStoppedTouching(source, pair, ref manifold, 0);
        if (touches)
            handler.OnTouching(source, pair, ref manifold, 0);
    }

    static bool Has<TManifold>(in TManifold manifold, int featureId) where TManifold : unmanaged, IContactManifold<TManifold>
    {
        for (int i = 0; i < manifold.Count; ++i)
        {
            if (manifold.GetFeatureId(i) == featureId)
                return true;
        }
        return false;
    }
}
