using System;
using BepuPhysics.Collidables;
using BepuUtilities.Collections;
using BepuUtilities.Memory;

namespace BepuPhysics.CollisionDetection;

/// <summary>What touched what in the last step, for the collidables that somebody listens to.</summary>
/// <remarks>
/// A pair is told of where either of the two is listened to. Two collidables touch in a step where a contact of theirs was deeper than zero when
/// collisions were detected, or pushed; contacts that were foreseen and never pushed make no event. The lists are those of the last step that was
/// completed, and valid until the next is solved; each is in the order of pairs (A, then B), whatever the threads. Removing a body or static ends what it
/// touched in the list of the next step. A body that becomes kinematic, or dynamic, ends its pairs and begins them as another collidable.
/// What nobody listens to costs a test where contacts are added; as long as nobody listened at all, nothing.
/// </remarks>
// Listened pairs are kept in order. Those with new contacts are noted in the flush, whose order is that of pairs; before the solver
// runs the two lists are merged. A pair that the cache does not know any more has ended, whoever removed it, so that removals note nothing.
public sealed unsafe partial class CollisionEvents
{
    const byte SensorBit = 128;

    readonly WorldLock world;
    readonly BufferPool pool;
    readonly Bodies bodies;
    readonly CollidableTraits traits;
    readonly Solver solver;
    readonly ListeningStage stage;
    // Whether somebody listens to a collidable that may have contacts already.
    bool hasNewListener;
    float hitSpeed = 1;

    internal CollisionEvents(Bodies bodies, CollidableTraits traits, Solver solver, BufferPool pool, WorldLock world)
    {
        this.world = world;
        this.pool = pool;
        this.bodies = bodies;
        this.traits = traits;
        this.solver = solver;
        stage = new ListeningStage(solver, bodies, pool);
    }

    /// <summary>Speed of approach from which on a touch is a hit, m/s. From 0; 1 unless it was set.</summary>
    /// <exception cref="ArgumentOutOfRangeException">The speed is negative or not a number; nothing was changed.</exception>
    /// <exception cref="InvalidOperationException">A step is in progress; nothing was changed.</exception>
    public float HitSpeed
    {
        get => hitSpeed;
        set
        {
            if (!(value >= 0))
                throw new ArgumentOutOfRangeException(nameof(HitSpeed), value, "The speed of a hit must be zero or more.");
            world.CheckWritable(nameof(HitSpeed));
            hitSpeed = value;
        }
    }

    /// <summary>Pairs that touch and did not in the step before.</summary>
    public ReadOnlySpan<ContactEvent> Began => AsSpan(began);
    /// <summary>Pairs that touched in the step before and do not any more.</summary>
    public ReadOnlySpan<ContactEvent> Ended => AsSpan(ended);
    /// <summary>Pairs that met faster than <see cref="HitSpeed"/> and pushed; sensors never do.</summary>
    /// <remarks>
    /// A hit is told of once. Where a step ends in the midst of it, with more than a twentieth of the speed of approach left, that is in the next one, with
    /// what both have pushed, and the place and speed at which the two met. With a <see cref="HitSpeed"/> of zero whatever pushes while it approaches is a
    /// hit, in each step.
    /// </remarks>
    public ReadOnlySpan<ContactEvent> Hits => AsSpan(hits);
    /// <summary>Pairs that touch and did in the step before.</summary>
    /// <remarks>
    /// Written when it is asked for, or something changes: so a step does not pay for what nobody reads. Ask before the next step begins, whose stages
    /// find it empty otherwise.
    /// </remarks>
    public ReadOnlySpan<ContactEvent> Persisting
    {
        get
        {
            world.ReadUnread();
            return AsSpan(persisting);
        }
    }

    /// <summary>Whether anybody has listened to anything, or sensors have been made, since the simulation began or was cleared.</summary>
    internal bool IsUsed => traits.Listeners.IsUsed;

    /// <summary>Whether there may be sensors.</summary>
    internal bool UsesSensors { get; private set; }

    /// <summary>The contacts of an event, also those that did not push; empty for sensors. Valid as long as the event's list.</summary>
    /// <param name="contactEvent">An event of one of the lists as they are now.</param>
    public ReadOnlySpan<EventContact> Contacts(in ContactEvent contactEvent) =>
        AsSpan(contacts).Slice(contactEvent.FirstContact, contactEvent.ContactCount);

    /// <summary>Says what is to be told of a collidable from the next step on, in the place of what was said before.</summary>
    /// <remarks>Pairs that touch already begin then; those that sleep, when they wake. It is forgotten when the collidable is removed.</remarks>
    /// <param name="collidable">A body or static.</param>
    /// <param name="mask">What is to be told; <see cref="EventMask.None"/> to listen no more, which ends nothing.</param>
    /// <exception cref="ArgumentException">There is no such collidable, or the mask has unknown bits; nothing was changed.</exception>
    /// <exception cref="InvalidOperationException">A step, a change or a query is in progress; nothing was changed.</exception>
    public void Listen(CollidableReference collidable, EventMask mask)
    {
        if ((mask & ~EventMask.All) != 0)
            throw new ArgumentException($"There are no such events: {mask}.", nameof(mask));
        using var change = world.Change("CollisionEvents.Listen");
        traits.Existing(collidable);
        Set(collidable, (byte)(traits.Listeners[collidable] & SensorBit | (byte)mask));
        hasNewListener |= (mask & EventMask.Contacts) != 0 && MayHaveContacts(collidable);
    }

    /// <summary>As <see cref="Listen(CollidableReference, EventMask)"/>, for a body.</summary>
    /// <exception cref="ArgumentException">There is no such body, or the mask has unknown bits; nothing was changed.</exception>
    /// <exception cref="InvalidOperationException">A step, a change or a query is in progress; nothing was changed.</exception>
    public void Listen(BodyHandle body, EventMask mask) => Listen(traits.Existing(body), mask);

    /// <summary>As <see cref="Listen(CollidableReference, EventMask)"/>, for a static.</summary>
    /// <exception cref="ArgumentException">There is no such static, or the mask has unknown bits; nothing was changed.</exception>
    /// <exception cref="InvalidOperationException">A step, a change or a query is in progress; nothing was changed.</exception>
    public void Listen(StaticHandle still, EventMask mask) => Listen(traits.Existing(still), mask);

    /// <summary>What a collidable is listened to for.</summary>
    /// <exception cref="ArgumentException">There is no such collidable.</exception>
    public EventMask GetMask(CollidableReference collidable)
    {
        traits.Existing(collidable);
        return (EventMask)traits.Listeners[collidable] & EventMask.All;
    }

    /// <summary>Makes a collidable a sensor, from the next step on: it sees what overlaps it, and neither pushes nor is pushed.</summary>
    /// <remarks>
    /// What comes and goes is told as <see cref="Began"/> and <see cref="Ended"/> with <see cref="ContactEvent.IsSensor"/>, where the sensor or the
    /// other is listened to. A sensor sees bodies and statics, kinematic or not, but no other sensors, and nothing that passes it between two
    /// steps. The callbacks are asked whether a pair may touch, and not how.
    /// </remarks>
    /// <param name="collidable">A body or static.</param>
    /// <param name="isSensor">Whether it is one.</param>
    /// <exception cref="ArgumentException">There is no such collidable; nothing was changed.</exception>
    /// <exception cref="InvalidOperationException">A step, a change or a query is in progress; nothing was changed.</exception>
    public void SetSensor(CollidableReference collidable, bool isSensor)
    {
        using var change = world.Change("CollisionEvents.SetSensor");
        traits.Existing(collidable);
        traits.WakeAround(collidable);
        Set(collidable, (byte)(traits.Listeners[collidable] & ~SensorBit | (isSensor ? SensorBit : 0)));
        UsesSensors |= isSensor;
    }

    /// <summary>As <see cref="SetSensor(CollidableReference, bool)"/>, for a body.</summary>
    /// <exception cref="ArgumentException">There is no such body; nothing was changed.</exception>
    /// <exception cref="InvalidOperationException">A step, a change or a query is in progress; nothing was changed.</exception>
    public void SetSensor(BodyHandle body, bool isSensor) => SetSensor(traits.Existing(body), isSensor);

    /// <summary>As <see cref="SetSensor(CollidableReference, bool)"/>, for a static.</summary>
    /// <exception cref="ArgumentException">There is no such static; nothing was changed.</exception>
    /// <exception cref="InvalidOperationException">A step, a change or a query is in progress; nothing was changed.</exception>
    public void SetSensor(StaticHandle still, bool isSensor) => SetSensor(traits.Existing(still), isSensor);

    /// <summary>Whether a collidable is a sensor.</summary>
    /// <exception cref="ArgumentException">There is no such collidable.</exception>
    public bool IsSensor(CollidableReference collidable)
    {
        traits.Existing(collidable);
        return (traits.Listeners[collidable] & SensorBit) != 0;
    }

    /// <summary>Number of sensors among two collidables.</summary>
    internal int CountSensors(CollidableReference a, CollidableReference b) => (traits.Listeners[a] >> 7) + (traits.Listeners[b] >> 7);

    /// <summary>What a pair is listened to for.</summary>
    internal EventMask MaskOf(in CollidablePair pair) => (EventMask)(traits.Listeners[pair.A] | traits.Listeners[pair.B]) & EventMask.Contacts;

    /// <summary>Forgets all listeners, sensors and events.</summary>
    internal void Clear()
    {
        ReleaseLists();
        hasNewListener = false;
        isSettled = false;
        UsesSensors = false;
        solver.OptionalStages.Remove(stage);
    }

    /// <summary>Forgets memory that is gone already.</summary>
    internal void Abandon() => AbandonLists();

    void Set(CollidableReference collidable, byte value)
    {
        isSettled = false;
        isStale = true;
        var wasUsed = traits.Listeners.IsUsed;
        traits.Listeners.Set(collidable, value, pool);
        // Behind all others, so that it reads what they have done.
        if (!wasUsed && traits.Listeners.IsUsed)
            solver.OptionalStages.Add(stage);
    }

    bool MayHaveContacts(CollidableReference collidable) =>
        collidable.Mobility == CollidableMobility.Static || bodies.GetConstraints(collidable.BodyHandle).Count > 0;

    static ReadOnlySpan<T> AsSpan<T>(in QuickList<T> list) where T : unmanaged => list.Span.Allocated ? list.Span.AsSpan()[..list.Count] : [];
}
