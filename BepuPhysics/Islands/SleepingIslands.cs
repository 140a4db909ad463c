using System;
using BepuPhysics.CollisionDetection;
using BepuPhysics.Constraints;
using BepuUtilities;
using BepuUtilities.Collections;
using BepuUtilities.Memory;
using BepuUtilities.TaskScheduling;

namespace BepuPhysics;

/// <summary>All islands that sleep: moves whole islands out of the active sets and back.</summary>
/// <remarks>
/// An island goes with all that is known of it: bodies, constraints with their impulses, pairs with their histories, leaves of the broad phase. Bodies,
/// constraints and pairs lie in one table each beside that of the active ones, and the bodies of an island are linked in the order of their slots; nothing
/// is allocated per island. A kinematic body is an island by itself.
/// </remarks>
// Constraints come in the order of their first bodies, and of those of one body in the order in which they were added. So it depends on no place in
// memory in which order they get their batches when they wake.
sealed unsafe class SleepingIslands(Bodies bodies, Solver solver, CollisionEvents events, BufferPool pool)
{
    struct Island
    {
        public int LowestSlot;
        // Zero for an island that is not there any more.
        public int Count;
    }

    // Fewer bodies fall asleep in less time than a dispatch takes.
    const int LeastForThreads = 128;

    readonly Bodies bodies = bodies;
    readonly BufferPool pool = pool;
    IdPool ids;
    Buffer<Island> islands;
    QuickList<int> slots = new(64, pool);

    internal NarrowPhase NarrowPhase { get; set; } = null!;

    /// <summary>Number of islands.</summary>
    internal int Count { get; private set; }

    /// <summary>Island of a body that sleeps.</summary>
    internal int IslandOf(int slot) => bodies.Asleep.Islands[bodies.Locations[slot].Index];

    /// <summary>Lowest slot of an island's bodies; negative if the island has woken.</summary>
    internal int LowestSlotOf(int island) => islands[island].Count > 0 ? islands[island].LowestSlot : -1;

    /// <summary>Puts islands of the active set to sleep: constraints and pairs beside leaves, then bodies.</summary>
    /// <param name="all">
    /// Slots of one island after the other, in ascending order in each: an island of dynamic bodies, or a kinematic body none of whose constraints is awake.
    /// </param>
    /// <param name="ends">Where each island ends.</param>
    /// <param name="dispatcher">The threads; null for the caller alone.</param>
    internal void PutToSleep(ReadOnlySpan<int> all, ReadOnlySpan<int> ends, IThreadDispatcher? dispatcher = null)
    {
        bodies.Asleep.ReserveAsleep(bodies.Asleep.Count + all.Length, bodies.Pool);
        bodies.ReserveStaticLeaves(all.Length);
        fixed (int* slots = all)
        {
            var work = new SleepWork { Islands = this, Slots = slots, Count = all.Length, Dispatcher = dispatcher };
            StagedWork.Run(ref work, all.Length < LeastForThreads ? null : dispatcher);
        }
        for (int i = 0, start = 0; i < ends.Length; start = ends[i++])
            PutBodiesToSleep(all[start..ends[i]]);
    }

    // Constraints and pairs know nothing of leaves, and each of the two goes in one order.
    struct SleepWork : IStagedWork
    {
        public SleepingIslands Islands;
        public int* Slots;
        public int Count;
        public IThreadDispatcher? Dispatcher;

        public readonly int StageCount => 1;
        public readonly int GetBlockCount(int stage) => 2;

        public readonly void Execute(int stage, int block, int workerIndex)
        {
            if (block == 0)
            {
                for (int i = 0; i < Count; ++i)
                    Islands.PutConstraintsToSleep(Slots[i]);
                return;
            }
            // Not the pool that constraints take their memory from at the same time.
            var scratch = Dispatcher is null ? Islands.pool : Dispatcher.WorkerPools[workerIndex];
            for (int i = 0; i < Count; ++i)
                Islands.bodies.MoveLeafToStaticTree(Slots[i], scratch);
        }
    }

    void PutBodiesToSleep(ReadOnlySpan<int> island)
    {
        var id = Add(island[0], island.Length);
        var last = bodies.Asleep.Count + island.Length - 1;
        for (int i = 0; i < island.Length; ++i)
        {
            var index = bodies.PutToSleep(island[i]);
            bodies.Asleep.Islands[index] = id;
            bodies.Asleep.NextOfIsland[index] = island[index == last ? 0 : i + 1];
            events.NoteTurned(island[i]);
        }
    }

    void PutConstraintsToSleep(int slot)
    {
        var list = ConstraintsOf(slot);
        var edge = list.First;
        for (int i = 0; i < list.Count; ++i, edge = solver.Edges.Next(edge))
        {
            var constraint = solver.Edges.ConstraintSlot(edge);
            if (solver.IsAsleep(constraint))
                continue;
            if (IsContact(constraint))
                NarrowPhase.PutToSleep(constraint);
            solver.PutToSleep(constraint);
        }
    }

    /// <summary>Wakes an island, and the kinematic bodies that it has constraints with.</summary>
    internal void Wake(int island)
    {
        slots.Count = 0;
        var next = islands[island].LowestSlot;
        for (int i = islands[island].Count; i > 0; --i)
        {
            var slot = next;
            next = bodies.Asleep.NextOfIsland[bodies.Locations[slot].Index];
            slots.Add(slot, pool);
            Awaken(slot);
        }
        Remove(island);
        // A kinematic body that wakes with the island takes none of its other constraints along.
        var isKinematic = Bodies.IsKinematic(bodies.Awake.LocalInertias[bodies.Locations[slots[0]].Index]);
        for (int i = 0; i < slots.Count && !isKinematic; ++i)
            WakeConstraints(slots[i]);
    }

    void WakeConstraints(int slot)
    {
        var list = ConstraintsOf(slot);
        var edge = list.First;
        for (int i = 0; i < list.Count; ++i, edge = solver.Edges.Next(edge))
        {
            var constraint = solver.Edges.ConstraintSlot(edge);
            if (!solver.IsAsleep(constraint))
                continue;
            WakeKinematicsOf(constraint);
            solver.Awaken(constraint);
            if (IsContact(constraint))
                NarrowPhase.Awaken(constraint);
        }
    }

    void WakeKinematicsOf(int constraint)
    {
        ref var location = ref solver.Locations[constraint];
        for (int i = 0; i < solver.Processor(location.TypeId).BodiesPerConstraint; ++i)
        {
            var slot = solver.BodySlotOf(location, i);
            if (!bodies.IsAsleep(slot))
                continue;
            var island = IslandOf(slot);
            Awaken(slot);
            Remove(island);
        }
    }

    void Awaken(int slot)
    {
        bodies.Awaken(slot);
        events.NoteTurned(slot);
    }

    ConstraintList ConstraintsOf(int slot)
    {
        ref var location = ref bodies.Locations[slot];
        return bodies.SetOf(location).Constraints[location.Index];
    }

    bool IsContact(int constraint) => solver.Locations[constraint].TypeId < ConstraintTypeIds.ContactTypeCount;

    int Add(int lowestSlot, int count)
    {
        if (!ids.Allocated)
            ids = new IdPool(64, pool);
        var id = ids.Take();
        if (id >= islands.Length)
            pool.ResizeToAtLeast(ref islands, Math.Max(64, id * 2), islands.Length);
        islands[id] = new() { LowestSlot = lowestSlot, Count = count };
        ++Count;
        return id;
    }

    void Remove(int id)
    {
        islands[id] = default;
        ids.Return(id, pool);
        --Count;
    }

    /// <summary>Forgets all islands, of which nothing is left.</summary>
    internal void Clear()
    {
        if (ids.Allocated)
            ids.Clear();
        Count = 0;
    }

    /// <summary>Rings of bodies, and their islands.</summary>
    internal void Validate()
    {
        int bodyCount = 0;
        for (int id = 0; Count > 0 && id <= ids.HighestPossiblyClaimedId; ++id)
        {
            var count = islands[id].Count;
            bodyCount += count;
            var slot = islands[id].LowestSlot;
            for (int i = 0; i < count; ++i)
            {
                Invariant.Require(bodies.IsAsleep(slot) && IslandOf(slot) == id, "island of sleeping body", slot, id);
                var next = bodies.Asleep.NextOfIsland[bodies.Locations[slot].Index];
                Invariant.Require(i == count - 1 ? next == islands[id].LowestSlot : next > slot, "order of the bodies of a sleeping island", id, slot);
                slot = next;
            }
        }
        Invariant.Require(bodyCount == bodies.Asleep.Count, "number of sleeping bodies, islands have", bodyCount, bodies.Asleep.Count);
    }

    internal void CopyState(StateCopy copy)
    {
        copy.Ids(ref ids);
        copy.Rows(ref islands, ids.HighestPossiblyClaimedId + 1);
        Count = copy.Value(Count);
    }

    internal void Dispose()
    {
        slots.Dispose(pool);
        if (ids.Allocated)
            ids.Dispose(pool);
        pool.ReturnIfTaken(ref islands);
    }

    /// <summary>Forgets all memory, which the pool has given back to the system.</summary>
    internal void Abandon()
    {
        slots = default;
        ids = default;
        islands = default;
        Count = 0;
    }
}
