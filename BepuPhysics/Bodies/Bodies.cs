using System;
using System.Runtime.CompilerServices;
using BepuPhysics.Collidables;
using BepuPhysics.CollisionDetection;
using BepuUtilities;
using BepuUtilities.Memory;

namespace BepuPhysics;

/// <summary>All bodies of a simulation.</summary>
public sealed unsafe partial class Bodies
{
    // Every body takes as much: what is beyond is a mistake.
    internal const int MaximumConstraintCapacity = 1_000_000;

    int minimumConstraintCapacity = 4;

    readonly WorldLock world;
    Solver solver = null!;
    BroadPhase broadPhase = null!;
    Shapes shapes = null!;
    Statics statics = null!;
    IslandAwakener awakener = null!;
    IslandSleeper sleeper = null!;
    CollidableTraits traits = null!;

    /// <summary>Sets of bodies: 0 is the active one, 1 has all that sleep.</summary>
    public Buffer<BodySet> Sets;
    /// <summary>Memory of the bodies.</summary>
    public BufferPool Pool { get; }
    /// <summary>Has no effect, and is what it was set to: constraints take no memory of bodies. From 0 to a million.</summary>
    /// <exception cref="ArgumentOutOfRangeException">The number is negative or more than a million; nothing was changed.</exception>
    public int MinimumConstraintCapacityPerBody
    {
        get => minimumConstraintCapacity;
        set
        {
            ArgumentOutOfRangeException.ThrowIfNegative(value, nameof(MinimumConstraintCapacityPerBody));
            ArgumentOutOfRangeException.ThrowIfGreaterThan(value, MaximumConstraintCapacity, nameof(MinimumConstraintCapacityPerBody));
            world.CheckWritable(nameof(MinimumConstraintCapacityPerBody));
            minimumConstraintCapacity = value;
        }
    }

    /// <summary>Bodies that are awake.</summary>
    /// <exception cref="ObjectDisposedException">The simulation was disposed, or its pool cleared.</exception>
    public ref BodySet ActiveSet
    {
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        get
        {
            if (!Sets.Allocated)
                world.ThrowEnded();
            return ref Sets[0];
        }
    }

    /// <summary>The same without the question whether the simulation lives, for the inside of a step.</summary>
    internal ref BodySet Awake => ref Sets[0];

    /// <summary>The set in which a body is.</summary>
    internal ref BodySet SetOf(in BodyMemoryLocation location) => ref Sets[location.SetIndex];

    internal Bodies(BufferPool pool, int initialCapacity, WorldLock world)
    {
        this.world = world;
        Pool = pool;
        initialCapacity = Math.Max(16, initialCapacity);
        pool.Take(2, out Sets);
        Sets[0] = default;
        Sets[AsleepSet] = default;
        Sets[0].Resize(initialCapacity, pool);
        HandlePool = new IdPool(initialCapacity, pool);
        owners = new HandleOwners(HandleLayout.SlotBits, HandleLayout.ValueBits, initialCapacity, pool);
        EnsureSlots(initialCapacity);
    }

    internal void Connect(Solver solver, BroadPhase broadPhase, Shapes shapes, Statics statics, IslandSleeper sleeper, IslandAwakener awakener,
        CollidableTraits traits)
    {
        this.solver = solver;
        this.broadPhase = broadPhase;
        this.shapes = shapes;
        this.statics = statics;
        this.sleeper = sleeper;
        this.awakener = awakener;
        this.traits = traits;
    }

    /// <summary>Number of bodies in all sets.</summary>
    public int CountBodies()
    {
        int count = 0;
        for (int i = 0; i < Sets.Length; ++i)
            count += Sets[i].Count;
        return count;
    }

    /// <summary>Whether nothing moves a body of this inertia.</summary>
    public static bool IsKinematic(BodyInertia inertia) => inertia.InverseMass == 0 && HasLockedInertia(inertia.InverseInertiaTensor);

    /// <summary>Whether nothing turns a body of this inertia.</summary>
    public static bool HasLockedInertia(Symmetric3x3 inertia) =>
        inertia.XX == 0 && inertia.YX == 0 && inertia.YY == 0 && inertia.ZX == 0 && inertia.ZY == 0 && inertia.ZZ == 0;

    /// <summary>Adds a body.</summary>
    /// <exception cref="ArgumentException">A value cannot be simulated, or the shape does not exist; nothing was changed.</exception>
    /// <exception cref="InvalidOperationException">There are <see cref="MaximumCount"/> bodies already.</exception>
    public BodyHandle Add(in BodyDescription description)
    {
        using var change = world.Change("Bodies.Add");
        Validate(description);
        MakeRoom(description);
        var pose = BodyChecks.Straighten(description.Pose);
        BoundingBox bounds = default;
        if (description.Collidable.Shape.Exists)
            shapes.UpdateBounds(pose, description.Collidable.Shape, out bounds);
        // All memory has been taken: from here on nothing fails.
        var handle = new BodyHandle(owners.Claim(HandlePool.Take()));
        ref var set = ref ActiveSet;
        var index = set.AddRow();
        Locations[handle.Slot] = new() { SetIndex = 0, Index = index };
        set.IndexToHandle[index] = handle;
        set.MotionStates[index] = new() { Pose = pose, Velocity = description.Velocity };
        set.SoundPoses[index] = pose;
        set.LocalInertias[index] = description.LocalInertia;
        set.Collidables[index] = new() { BroadPhaseIndex = -1 };
        WriteSettings(ref set, index, description);
        shapes.BeginUse(description.Collidable.Shape);
        PlaceInBroadPhase(ref set, index, bounds);
        return handle;
    }

    /// <summary>Removes a body and all of its constraints.</summary>
    /// <exception cref="ArgumentException">There is no such body.</exception>
    public void Remove(BodyHandle handle)
    {
        using var change = world.Change("Bodies.Remove");
        CheckHandle(handle);
        RemoveBody(handle);
    }

    /// <summary>Removes a body of the active set and all of its constraints.</summary>
    /// <exception cref="ArgumentOutOfRangeException">There is no such body.</exception>
    public void RemoveAt(int activeBodyIndex)
    {
        using var change = world.Change("Bodies.RemoveAt");
        if ((uint)activeBodyIndex >= (uint)ActiveSet.Count)
            throw new ArgumentOutOfRangeException(nameof(activeBodyIndex), activeBodyIndex, $"There are {ActiveSet.Count} active bodies.");
        RemoveBody(ActiveSet.IndexToHandle[activeBodyIndex]);
    }

    void RemoveBody(BodyHandle handle)
    {
        awakener.WakeAround(handle);
        ref var set = ref SetOf(handle, out var index);
        solver.RemoveConstraintsOf(ref set.Constraints[index]);
        RemoveFromBroadPhase(ref set, index);
        shapes.EndUse(set.Collidables[index].Shape);
        set.RemoveAt(index);
        if (index < set.Count)
        {
            Locations[set.IndexToHandle[index].Slot].Index = index;
            solver.UpdateBodyIndex(set, index);
        }
        Locations[handle.Slot].SetIndex = -1;
        traits.Forget(new(CollidableMobility.Dynamic, handle));
        owners.Release(handle.Slot);
        HandlePool.Return(handle.Slot, Pool);
    }

    /// <summary>Describes a body as it is now.</summary>
    /// <exception cref="ArgumentException">There is no such body.</exception>
    public void GetDescription(BodyHandle handle, out BodyDescription description)
    {
        CheckHandle(handle);
        ref var set = ref SetOf(handle, out var index);
        ref var collidable = ref set.Collidables[index];
        description.Pose = set.MotionStates[index].Pose;
        description.Velocity = set.MotionStates[index].Velocity;
        description.LocalInertia = set.LocalInertias[index];
        description.Collidable = new(collidable.Shape, collidable.MinimumSpeculativeMargin, collidable.MaximumSpeculativeMargin, collidable.Continuity);
        description.Activity = new(set.Activity[index].SleepThreshold, set.Activity[index].MinimumTimestepsUnderThreshold);
    }

    /// <summary>Describes a body as it is now.</summary>
    /// <exception cref="ArgumentException">There is no such body.</exception>
    public BodyDescription GetDescription(BodyHandle handle)
    {
        GetDescription(handle, out var description);
        return description;
    }

    /// <summary>Visits each body that shares a constraint with a body, once per constraint.</summary>
    /// <exception cref="ArgumentException">There is no such body.</exception>
    public void EnumerateConnectedBodies<TEnumerator>(BodyHandle bodyHandle, ref TEnumerator enumerator) where TEnumerator : IForEach<BodyHandle>
    {
        using var reading = world.Read("Bodies.EnumerateConnectedBodies");
        CheckHandle(bodyHandle);
        foreach (var constraint in GetConstraints(bodyHandle))
            solver.EnumerateOtherBodies(constraint, ref enumerator);
    }

    /// <summary>Makes room for bodies.</summary>
    /// <exception cref="ArgumentOutOfRangeException">The number is negative or more than <see cref="MaximumCount"/>; nothing was changed.</exception>
    public void EnsureCapacity(int capacity)
    {
        ArgumentOutOfRangeException.ThrowIfNegative(capacity);
        ArgumentOutOfRangeException.ThrowIfGreaterThan(capacity, MaximumCount);
        using var change = world.Change("Bodies.EnsureCapacity");
        MakeRoomFor(capacity);
    }

    internal void MakeRoomFor(int capacity)
    {
        if (capacity > ActiveSet.Capacity)
            ActiveSet.Resize(capacity, Pool);
    }

    /// <summary>The constraints of a body.</summary>
    /// <exception cref="ArgumentException">There is no such body.</exception>
    internal BodyConstraints GetConstraints(BodyHandle handle)
    {
        CheckHandle(handle);
        return new(solver, SetOf(handle, out var index).Constraints[index]);
    }

    void MakeRoom(in BodyDescription description)
    {
        ref var set = ref ActiveSet;
        if (HandleOwners.NeedsSlot(HandlePool, MaximumCount, "bodies", out var slotCount))
            EnsureSlots(slotCount);
        if (set.Count == set.Capacity)
            set.Resize(set.Capacity * 2, Pool);
        set.EnsurePrincipalFrames(description.LocalInertia.InverseInertiaTensor, Pool);
        if (description.Collidable.Shape.Exists)
            broadPhase.MakeRoomFor(broadPhase.ActiveTree.LeafCount + 1, 0);
    }

    internal void CheckShape(TypedIndex shape)
    {
        if (!shape.Exists)
            return;
        shapes.CheckExists(shape, nameof(shape));
        if (shapes.GetBatch(shape.Type).IsForStaticsOnly(shape.Index))
            throw new ArgumentException($"{shape} is for statics, or a child of it is: no body can have it.", nameof(shape));
    }

    void Validate(in BodyDescription description)
    {
        BodyChecks.Pose(description.Pose);
        BodyChecks.Velocity(description.Velocity);
        BodyChecks.Inertia(description.LocalInertia);
        BodyChecks.Activity(description.Activity);
        description.Collidable.Validate();
        CheckShape(description.Collidable.Shape);
    }

    static void WriteSettings(ref BodySet set, int index, in BodyDescription description)
    {
        var settings = description.Collidable;
        ref var collidable = ref set.Collidables[index];
        // The margin of the coming step is set by its prediction of bounds.
        collidable = new()
        {
            BroadPhaseIndex = collidable.BroadPhaseIndex,
            Shape = settings.Shape,
            Continuity = settings.Continuity,
            SpeculativeMargin = settings.MinimumSpeculativeMargin,
            MinimumSpeculativeMargin = settings.MinimumSpeculativeMargin,
            MaximumSpeculativeMargin = settings.MaximumSpeculativeMargin,
        };
        set.Activity[index] = new()
        {
            SleepThreshold = description.Activity.SleepThreshold,
            MinimumTimestepsUnderThreshold = description.Activity.MinimumTimestepCountUnderThreshold,
        };
    }

    internal static CollidableReference ReferenceAt(in BodySet set, int index) => new(
        IsKinematic(set.LocalInertias[index]) ? CollidableMobility.Kinematic : CollidableMobility.Dynamic, set.IndexToHandle[index]);

    internal void Clear()
    {
        EndUses();
        for (int i = 0; i < Sets.Length; ++i)
        {
            for (int j = 0; j < Sets[i].Count; ++j)
                Locations[Sets[i].IndexToHandle[j].Slot].SetIndex = -1;
            if (Sets[i].Allocated)
                Sets[i].Clear();
        }
        owners.ReleaseAll();
        HandlePool.Clear();
    }

    internal void Dispose()
    {
        EndUses();
        for (int i = 0; i < Sets.Length; ++i)
        {
            if (Sets[i].Allocated)
                Sets[i].Dispose(Pool);
        }
        Pool.Return(ref Sets);
        Pool.Return(ref Locations);
        owners.Dispose(Pool);
        HandlePool.Dispose(Pool);
    }

    /// <summary>Forgets all memory, which the pool has given back to the system.</summary>
    internal void Abandon()
    {
        EndUses();
        Sets = default;
        Locations = default;
        owners = default;
        HandlePool = default;
    }

    void EndUses()
    {
        var end = new UsesEnd(shapes);
        VisitShapes(ref end);
    }

    /// <summary>Visits the shape of each body, which may be none.</summary>
    internal void VisitShapes<TVisitor>(ref TVisitor visitor) where TVisitor : struct, IForEach<TypedIndex>
    {
        for (int i = 0; i < Sets.Length; ++i)
        {
            for (int j = 0; j < Sets[i].Count; ++j)
                visitor.LoopBody(Sets[i].Collidables[j].Shape);
        }
    }
}
