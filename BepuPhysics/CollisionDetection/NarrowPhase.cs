using System;
using System.Runtime.CompilerServices;
using BepuPhysics.Collidables;
using BepuPhysics.Constraints.Contact;
using BepuUtilities;
using BepuUtilities.Memory;

namespace BepuPhysics.CollisionDetection;

/// <summary>Turns pairs of overlapping bounds into contacts, and contacts into constraints.</summary>
// Pairs come from the broad phase on many threads, in any order. A pair whose constraint keeps its type is written in place by whichever
// worker finds it: that is most pairs of a scene at rest, and the order does not matter. All other changes (new pairs, pairs whose number
// of contacts changed, pairs that parted) are noted, sorted by the handles of the pair, and made on one thread after the workers have
// ended, so that handles, batches and with them every bit of the result do not depend on threads. Pairs whose shapes are made of children
// have a manifold, and a constraint, for each two children that touch: what is said of a pair is then true of each of these.
public abstract partial class NarrowPhase : IBufferPoolUser
{
    private protected readonly Simulation Simulation;
    private protected readonly BufferPool Pool;
    private protected readonly WorldLock World;
    internal PairCache Pairs;
    internal readonly Restitution Restitution;
    internal readonly FastPairs FastPairs;
    internal readonly SmoothBends SmoothBends;
    readonly LoadPathStage loadPath;
    private protected Buffer<CollidablePair> pairOfConstraint;
    internal AgreedPairs AgreedPairs;

    /// <summary>Tests of shape pairs.</summary>
    public CollisionTaskRegistry CollisionTaskRegistry { get; }

    /// <summary>Sweeps of pairs of shapes; <see cref="BepuPhysics.Simulation"/> sweeps through a whole world.</summary>
    public SweepTaskRegistry SweepTaskRegistry { get; } = new();

    private protected NarrowPhase(Simulation simulation, CollisionTaskRegistry collisionTaskRegistry, int initialPairCapacity)
    {
        Simulation = simulation;
        Pool = simulation.BufferPool;
        World = simulation.World;
        tellPersisting = () => simulation.Events.TellPersisting(ref Pairs);
        CollisionTaskRegistry = collisionTaskRegistry;
        collisionTaskRegistry.World = World;
        Pairs = new PairCache(Math.Max(64, initialPairCapacity), Pool);
        // Before all others: these are to see where bodies have come to.
        FastPairs = new FastPairs(this, simulation, Pool);
        simulation.Solver.OptionalStages.InsertRange(
            0,
            [
                new FastPairsShare(FastPairs, FastPairsShare.Part.Ways), new FastPairsShare(FastPairs, FastPairsShare.Part.Growth),
                new FastPairsShare(FastPairs, FastPairsShare.Part.Sweeps), FastPairs,
            ]);
        Restitution = new Restitution(simulation.Solver, simulation.Bodies, Pool);
        simulation.Solver.OptionalStages.Add(Restitution);
        SmoothBends = new SmoothBends(simulation.Solver, simulation.Bodies, Pool);
        simulation.Solver.OptionalStages.Add(SmoothBends);
        loadPath = new LoadPathStage(simulation.Solver, simulation.Bodies, Pool);
        simulation.Solver.OptionalStages.Add(loadPath);
    }

    /// <summary>See <see cref="LoadPathStage.RelaxedCount"/>.</summary>
    internal int RelaxedCount => loadPath.RelaxedCount;

    /// <summary>See <see cref="LoadPathStage.NodeCount"/>.</summary>
    internal int LoadNodeCount => loadPath.NodeCount;

    /// <summary>See <see cref="LoadPathStage.MostWalked"/>.</summary>
    internal int MostWalkedFromFloors
    {
        set => loadPath.MostWalked = value;
    }

    /// <summary>Number of pairs that have contacts.</summary>
    public int PairCount { get; private set; }

    /// <summary>The order in which the two collidables of a pair are named in manifolds and constraints, which does not change from step to step.</summary>
    /// <remarks>Statics come second, then kinematics, then the larger slot.</remarks>
    /// <param name="a">One collidable.</param>
    /// <param name="b">The other.</param>
    /// <param name="aMobility">How the first collidable of the pair moves.</param>
    /// <param name="bMobility">How the second collidable of the pair moves.</param>
    /// <param name="sortedA">First collidable of the pair.</param>
    /// <param name="sortedB">Second collidable of the pair.</param>
    public static void SortCollidableReferencesForPair(CollidableReference a, CollidableReference b,
        out CollidableMobility aMobility, out CollidableMobility bMobility, out CollidableReference sortedA, out CollidableReference sortedB)
    {
        (sortedA, sortedB) = ComesSecond(a, b) ? (b, a) : (a, b);
        aMobility = sortedA.Mobility;
        bMobility = sortedB.Mobility;
    }

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    private protected static bool ComesSecond(CollidableReference a, CollidableReference b) =>
        a.Mobility > b.Mobility || (a.Mobility == b.Mobility && a.Slot > b.Slot);

    /// <summary>
    /// Number of pairs of bodies with overlapping bounds that the last step left out, because very many bodies were in one place; 0 in any
    /// scene that makes sense. Bodies in such a crowd meet only some of the others there.
    /// </summary>
    public long SkippedPairCount { get; private protected set; }

    /// <summary>Whether the contacts of a body with several statics agree; each pair is for itself otherwise. To be changed before the first step.</summary>
    internal bool JoinsStatics { get; set; } = true;

    /// <summary>Whether bodies that hardly move remember what their pairs have agreed on. To be changed before the first step.</summary>
    internal bool RemembersAgreements { get; set; } = true;

    internal abstract void Initialize();
    internal abstract void FindContacts(float dt, IThreadDispatcher? dispatcher);
    internal abstract void Flush(IThreadDispatcher? dispatcher);
    internal abstract void DisposeCallbacks();
    /// <summary>Asks the callbacks of a game what an impact is like that no contact has foreseen.</summary>
    /// <returns>Whether there is to be one.</returns>
    internal abstract bool ConfigureImpact(in CollidablePair pair, ref ConvexContactManifold manifold, out float friction, out float restitution);
    /// <summary>Inner radius of a shape, or what counts as one where there is none, and the radius around its centre that it does not leave, m.</summary>
    internal abstract (float Inner, float Radius) RadiiOf(TypedIndex shape);
    /// <summary>Whether a pair that was not foreseen is to be watched: one of the two is marked, it is fast, and the game allows it.</summary>
    internal abstract bool WatchesLate(
        in CollidablePair pair, TypedIndex shapeA, TypedIndex shapeB, in BodyVelocity velocityA, in BodyVelocity velocityB, float dt, out float inner);
    /// <summary>Compiles what is generic over the callbacks of a game, without calling them.</summary>
    /// <param name="shapeTypes">Ids of the shape types whose tests are compiled.</param>
    internal abstract void Compile(ReadOnlySpan<int> shapeTypes);

    internal void Clear()
    {
        Pairs.Clear();
        AgreedPairs.Clear();
        PairCount = 0;
        Restitution.BeginStep();
        SmoothBends.Clear();
        FastPairs.BeginStep();
    }

    /// <param name="copy">Where to.</param>
    /// <param name="constraintSlots">Slots of constraints that were ever in use.</param>
    internal void CopyState(StateCopy copy, int constraintSlots)
    {
        Pairs.CopyState(copy);
        AgreedPairs.CopyState(copy);
        copy.Rows(ref pairOfConstraint, Math.Min(pairOfConstraint.Length, constraintSlots));
        PairCount = copy.Value(PairCount);
        SkippedPairCount = copy.Value(SkippedPairCount);
        // What bounces is found in each step.
        if (!copy.Restores)
            return;
        Restitution.BeginStep();
        SmoothBends.Clear();
        FastPairs.BeginStep();
    }

    /// <summary>Forgets all memory, which the pool has given back to the system.</summary>
    internal void Abandon()
    {
        Pairs = default;
        AgreedPairs = default;
        pairOfConstraint = default;
        PairCount = 0;
        Restitution.Abandon();
        SmoothBends.Abandon();
        FastPairs.Abandon();
        loadPath.Abandon();
    }

    internal void Dispose()
    {
        Pairs.Dispose(Pool);
        AgreedPairs.Dispose(Pool);
        Restitution.Dispose();
        SmoothBends.Clear();
        FastPairs.Dispose();
        loadPath.Dispose();
        Pool.ReturnIfTaken(ref pairOfConstraint);
    }

    // Of the pools of workers, which hold memory for no longer than a step.
    void IBufferPoolUser.CheckNotBusy() =>
        throw new InvalidOperationException("BufferPool.Clear was called while a step is in progress that has memory in the pool; nothing was changed.");

    void IBufferPoolUser.ForgetMemory() { }

    /// <summary>Removes every pair that was not seen in this step.</summary>
    private protected void RemoveUnseenPairs()
    {
        var next = FindUnseen(FindUnseen(Pairs.Pairs.Count, out var first), out var second);
        for (var current = first; current >= 0;)
        {
            // A removal changes indices from its own on; those that are still to come are below.
            next = FindUnseen(next, out var third);
            RemoveConstraints(current);
            Pairs.Remove(current, Pool);
            current = second;
            second = third;
        }
    }

    // The next pair that was not seen, whose constraint is loaded until its turn comes.
    int FindUnseen(int limit, out int found)
    {
        found = limit < 0 ? -1 : Pairs.FindUnseen(limit);
        if (found >= 0 && Pairs.Pairs.Values[found].Single.HasConstraint)
            Simulation.Solver.Prefetch(Pairs.Pairs.Values[found].Single.Constraint);
        return found;
    }

    /// <summary>Removes all contacts, and what is remembered of all pairs, but for those that sleep.</summary>
    private protected void ForgetContacts()
    {
        for (int i = Pairs.Pairs.Count - 1; i >= 0; --i)
        {
            RemoveConstraints(i);
            Pairs.Remove(i, Pool);
        }
        Restitution.BeginStep();
        SmoothBends.Clear();
    }

    /// <summary>Removes all constraints of a pair.</summary>
    private protected void RemoveConstraints(int index)
    {
        foreach (ref var manifold in Pairs.ManifoldsOf(index))
        {
            if (manifold.HasConstraint)
                RemoveConstraint(Pairs.Pairs.Keys[index], ref Pairs.Pairs.Values[index], ref manifold);
        }
    }

    /// <summary>Removes the constraint of a manifold, which has one.</summary>
    private protected void RemoveConstraint(in CollidablePair pair, ref CachedPair cached, ref CachedManifold manifold)
    {
        if (Simulation.Solver.Defers)
            Simulation.Solver.RemoveLater(manifold.Constraint, EndsOf(pair));
        else
            Simulation.Solver.RemoveWithoutNotice(manifold.Constraint);
        manifold.ConstraintTypeId = CachedManifold.NoConstraint;
        CountConstraint(ref cached, -1);
    }

    // Of one that is removed it does not matter who is kinematic.
    ContactEnds EndsOf(in CollidablePair pair)
    {
        var locations = Simulation.Bodies.Locations;
        var reference = pair.B.Mobility == CollidableMobility.Static ? -1 : locations[pair.B.Slot].Index;
        return new(pair.A.Slot, locations[pair.A.Slot].Index, pair.B.Slot, reference);
    }

    /// <summary>Adds the constraint of a manifold, which has none.</summary>
    /// <returns>Its number, if it is added later, otherwise its handle.</returns>
    private protected int AddConstraint(in CollidablePair pair, in ContactEnds ends, int typeId, ref CachedPair cached, ref CachedManifold manifold)
    {
        ConstraintHandle handle;
        int number;
        if (Simulation.Solver.Defers)
        {
            handle = Simulation.Solver.AddLater(ends, typeId, out number);
        }
        else
        {
            Span<BodyHandle> bodies = [pair.A.BodyHandle, pair.B.BodyHandle];
            handle = Simulation.Solver.AddUnwritten(pair.B.Mobility == CollidableMobility.Static ? bodies[..1] : bodies, typeId);
            number = handle.Value;
        }
        if (handle.Slot >= pairOfConstraint.Length)
            Pool.ResizeToAtLeast(ref pairOfConstraint, Math.Max(256, handle.Slot * 2), pairOfConstraint.Length);
        pairOfConstraint[handle.Slot] = pair;
        manifold.Constraint = handle;
        manifold.ConstraintTypeId = typeId;
        CountConstraint(ref cached, 1);
        if (Simulation.Events.IsUsed)
            Simulation.Events.NoteContacts(pair);
        return number;
    }

    // A pair has contacts from its first constraint to its last.
    void CountConstraint(ref CachedPair cached, int change)
    {
        if (cached.IsOfChildren)
        {
            cached.ChildConstraintCount += change;
            if (cached.ChildConstraintCount != (change > 0 ? 1 : 0))
                return;
        }
        PairCount += change;
    }

    /// <summary>Forgets the manifold of a contact constraint that is removed from outside, as with one of its bodies.</summary>
    internal void Forget(ConstraintHandle handle)
    {
        if (TryFind(handle, out var index, out var children))
        {
            CountConstraint(ref Pairs.Pairs.Values[index], -1);
            Pairs.Remove(index, children, Pool);
        }
        Restitution.Forget(handle);
    }

    /// <summary>Finds the manifold of a contact constraint.</summary>
    private protected bool TryFind(ConstraintHandle handle, out int pairIndex, out ChildIds children)
    {
        children = ChildIds.None;
        pairIndex = Pairs.Pairs.IndexOf(pairOfConstraint[handle.Slot]);
        if (pairIndex < 0)
            return false;
        for (var manifolds = Pairs.ManifoldsOf(pairIndex); manifolds.MoveNext();)
        {
            children = manifolds.Children;
            if (manifolds.Current.HasConstraint && manifolds.Current.Constraint == handle)
                return true;
        }
        return false;
    }
}
