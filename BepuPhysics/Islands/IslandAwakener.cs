using System;
using BepuPhysics.Collidables;
using BepuPhysics.CollisionDetection;
using BepuUtilities;
using BepuUtilities.Collections;
using BepuUtilities.Memory;

namespace BepuPhysics;

/// <summary>Wakes islands: those that something happens to, and those that a game asks for.</summary>
/// <remarks>
/// A body wakes with all that constraints connect it with, in the order of the lowest slots of islands. Impulses that its contacts and joints had are kept,
/// so that nothing sags. It begins anew to count its rest.
/// </remarks>
public sealed unsafe class IslandAwakener
{
    readonly WorldLock world;
    readonly Bodies bodies;
    readonly Solver solver;
    readonly BroadPhase broadPhase;
    readonly SleepingIslands islands;
    readonly BufferPool pool;
    // Lowest slot and id of each island that is to wake.
    QuickList<ulong> requests;

    internal IslandAwakener(WorldLock world, Bodies bodies, Solver solver, BroadPhase broadPhase, SleepingIslands islands, BufferPool pool)
    {
        this.world = world;
        this.bodies = bodies;
        this.solver = solver;
        this.broadPhase = broadPhase;
        this.islands = islands;
        this.pool = pool;
        requests = new(16, pool);
    }

    /// <summary>Number of islands that sleep. A kinematic body is one by itself.</summary>
    public int SleepingIslandCount => islands.Count;

    /// <summary>Wakes a body with its island. One that is awake begins anew to count its rest.</summary>
    /// <exception cref="ArgumentException">There is no such body.</exception>
    public void AwakenBody(BodyHandle bodyHandle)
    {
        using var change = world.Change("IslandAwakener.AwakenBody");
        bodies.CheckHandle(bodyHandle);
        Wake(bodyHandle);
    }

    /// <summary>Wakes a set of bodies: all that sleep are in one. To wake one island, use <see cref="AwakenBody"/>.</summary>
    /// <param name="setIndex">Index of the set; the active one is awake already.</param>
    /// <exception cref="ArgumentOutOfRangeException">There is no such set.</exception>
    public void AwakenSet(int setIndex)
    {
        using var change = world.Change("IslandAwakener.AwakenSet");
        CheckSet(setIndex, nameof(setIndex));
        if (setIndex == Bodies.AsleepSet)
            WakeAll();
    }

    /// <summary>Wakes sets of bodies, as <see cref="AwakenSet"/>.</summary>
    /// <param name="setIndices">Indices of sets.</param>
    /// <param name="threadDispatcher">Has no effect; there for callers.</param>
    /// <exception cref="ArgumentOutOfRangeException">There is no such set; nothing was changed.</exception>
    public void AwakenSets(ref QuickList<int> setIndices, IThreadDispatcher? threadDispatcher = null)
    {
        using var change = world.Change("IslandAwakener.AwakenSets");
        var hasAsleep = false;
        for (int i = 0; i < setIndices.Count; ++i)
        {
            CheckSet(setIndices[i], nameof(setIndices));
            hasAsleep |= setIndices[i] == Bodies.AsleepSet;
        }
        if (hasAsleep)
            WakeAll();
    }

    void CheckSet(int setIndex, string name)
    {
        if ((uint)setIndex >= (uint)bodies.Sets.Length)
            throw new ArgumentOutOfRangeException(name, setIndex, $"There are {bodies.Sets.Length} sets of bodies.");
    }

    /// <summary>Wakes all bodies, as when gravity has changed.</summary>
    public void AwakenAll()
    {
        using var change = world.Change("IslandAwakener.AwakenAll");
        for (int i = 0; i < bodies.Awake.Count; ++i)
            bodies.Awake.Activity[i].Forget();
        WakeAll();
    }

    void WakeAll()
    {
        BeginRequests();
        for (int i = 0; i < bodies.Asleep.Count; ++i)
            Request(bodies.Asleep.IndexToHandle[i].Slot);
        WakeRequested();
    }

    /// <summary>Wakes a body that exists, with its island.</summary>
    internal void Wake(BodyHandle body)
    {
        ref var location = ref bodies.Locations[body.Slot];
        if (location.SetIndex == Bodies.AsleepSet)
            islands.Wake(islands.IslandOf(body.Slot));
        else
            bodies.Awake.Activity[location.Index].Forget();
    }

    /// <summary>Wakes a body that exists, and all that it has constraints with.</summary>
    internal void WakeAround(BodyHandle body)
    {
        Wake(body);
        // Nothing comes or goes meanwhile: the ring stays as it is.
        var list = bodies.Awake.Constraints[bodies.Locations[body.Slot].Index];
        var edge = list.First;
        for (int i = 0; i < list.Count; ++i, edge = solver.Edges.Next(edge))
        {
            var constraint = solver.Edges.ConstraintSlot(edge);
            for (int j = 0; j < solver.Processor(solver.Locations[constraint].TypeId).BodiesPerConstraint; ++j)
                Wake(bodies.HandleAt(solver.BodySlotOf(solver.Locations[constraint], j)));
        }
    }

    /// <summary>Whether islands are listed that are to wake.</summary>
    internal bool HasRequests => requests.Count > 0;

    /// <summary>Begins to list islands that are to wake.</summary>
    internal void BeginRequests() => requests.Count = 0;

    /// <summary>Lists the island of a body, if that sleeps.</summary>
    internal void Request(int slot)
    {
        if (!bodies.IsAsleep(slot))
            return;
        var island = islands.IslandOf(slot);
        requests.Add((ulong)islands.LowestSlotOf(island) << 32 | (uint)island, pool);
    }

    /// <summary>Lists the islands of bodies whose bounds meet a box. Those that are awake begin anew to count their rest.</summary>
    internal void Request<TFilter>(in BoundingBox bounds, ref TFilter filter) where TFilter : struct, IStaticChangeAwakeningFilter
    {
        if (!filter.AllowAwakening)
            return;
        // The broad phase belongs to whoever changes the static: nobody else looks at it now.
        var finder = new BodyFinder<TFilter> { Awakener = this, Filter = filter };
        broadPhase.FindOverlapping(bounds, ref finder);
        filter = finder.Filter;
    }

    /// <summary>Lists the islands that have constraints with kinematic bodies that move.</summary>
    internal void RequestHeldByMovingKinematics()
    {
        if (solver.AsleepOfKinematics == 0)
            return;
        ref var set = ref bodies.Awake;
        for (int i = 0; i < set.Count; ++i)
        {
            if (set.Constraints[i].AsleepCount > 0 && NarrowPhase.Moves(set, i))
                RequestHeldBy(set.Constraints[i]);
        }
    }

    void RequestHeldBy(in ConstraintList list)
    {
        var edge = list.First;
        for (int i = 0; i < list.Count; ++i, edge = solver.Edges.Next(edge))
        {
            ref var location = ref solver.Locations[solver.Edges.ConstraintSlot(edge)];
            if (location.SetIndex != Solver.AsleepSet)
                continue;
            for (int j = 0; j < solver.Processor(location.TypeId).BodiesPerConstraint; ++j)
                Request(solver.BodySlotOf(location, j));
        }
    }

    /// <summary>Wakes the islands that were listed, in the order of their lowest slots.</summary>
    /// <returns>Whether there were any.</returns>
    internal bool WakeRequested()
    {
        if (requests.Count == 0)
            return false;
        requests.Span.AsSpan()[..requests.Count].Sort();
        for (int i = 0; i < requests.Count; ++i)
        {
            var island = (int)(uint)requests[i];
            // It may have been listed several times, or a kinematic body that has woken with another one.
            if (islands.LowestSlotOf(island) == (int)(requests[i] >> 32))
                islands.Wake(island);
        }
        requests.Count = 0;
        return true;
    }

    struct BodyFinder<TFilter> : IBreakableForEach<CollidableReference> where TFilter : struct, IStaticChangeAwakeningFilter
    {
        public IslandAwakener Awakener;
        public TFilter Filter;

        public bool LoopBody(CollidableReference collidable)
        {
            if (collidable.Mobility == CollidableMobility.Static)
                return true;
            var bodies = Awakener.bodies;
            if (!Filter.ShouldAwaken(new(collidable.BodyHandle, bodies)))
                return true;
            ref var location = ref bodies.Locations[collidable.Slot];
            if (location.SetIndex == 0)
                bodies.Awake.Activity[location.Index].Forget();
            else
                Awakener.Request(collidable.Slot);
            return true;
        }
    }

    internal void Dispose() => requests.Dispose(pool);

    /// <summary>Forgets all memory, which the pool has given back to the system.</summary>
    internal void Abandon() => requests = default;
}
