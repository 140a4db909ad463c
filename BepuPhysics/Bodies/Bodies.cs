using System;
using System.Numerics;
using BepuPhysics.Collidables;
using BepuPhysics.CollisionDetection;
using BepuUtilities;
using BepuUtilities.Collections;
using BepuUtilities.Memory;

namespace BepuPhysics;

/// <summary>All bodies of a simulation.</summary>
public sealed unsafe partial class Bodies
{
    // Every body takes as much: what is beyond is a mistake.
    const int MaximumConstraintCapacity = 1_000_000;

    int minimumConstraintCapacity = 4;

    Solver solver = null!;
    BroadPhase broadPhase = null!;
    Shapes shapes = null!;

    /// <summary>Sets of bodies; set 0 is the active one.</summary>
    public Buffer<BodySet> Sets;
    /// <summary>Memory of the bodies.</summary>
    public BufferPool Pool { get; }
    /// <summary>Least number of constraints for which the list of a body has room; from 0 to a million.</summary>
    /// <exception cref="ArgumentOutOfRangeException">The number is negative or more than a million; nothing was changed.</exception>
    public int MinimumConstraintCapacityPerBody
    {
        get => minimumConstraintCapacity;
        set
        {
            ArgumentOutOfRangeException.ThrowIfNegative(value, nameof(MinimumConstraintCapacityPerBody));
            ArgumentOutOfRangeException.ThrowIfGreaterThan(value, MaximumConstraintCapacity, nameof(MinimumConstraintCapacityPerBody));
            minimumConstraintCapacity = value;
        }
    }

    /// <summary>Bodies that are awake.</summary>
    public ref BodySet ActiveSet => ref Sets[0];

    internal Bodies(BufferPool pool, int initialCapacity)
    {
        Pool = pool;
        initialCapacity = Math.Max(16, initialCapacity);
        pool.Take(1, out Sets);
        Sets[0] = default;
        Sets[0].Resize(initialCapacity, pool);
        HandlePool = new IdPool(initialCapacity, pool);
        owners = new HandleOwners(HandleLayout.SlotBits, HandleLayout.ValueBits, initialCapacity, pool);
        EnsureSlots(initialCapacity);
    }

    internal void Connect(Solver solver, BroadPhase broadPhase, Shapes shapes)
    {
        this.solver = solver;
        this.broadPhase = broadPhase;
        this.shapes = shapes;
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
        Validate(description);
        MakeRoom(description);
        var constraints = new QuickList<BodyConstraintReference>(MinimumConstraintCapacityPerBody, Pool);
        // All memory has been taken: from here on nothing fails.
        var handle = new BodyHandle(owners.Claim(HandlePool.Take()));
        ref var set = ref ActiveSet;
        var index = set.Count++;
        Locations[handle.Slot] = new() { SetIndex = 0, Index = index };
        set.IndexToHandle[index] = handle;
        set.MotionStates[index] = new() { Pose = description.Pose, Velocity = description.Velocity };
        set.LocalInertias[index] = description.LocalInertia;
        set.Constraints[index] = constraints;
        set.Collidables[index] = new() { BroadPhaseIndex = -1 };
        WriteSettings(index, description);
        if (description.Collidable.Shape.Exists)
            AddToBroadPhase(index);
        return handle;
    }

    /// <summary>Removes a body and all of its constraints.</summary>
    /// <exception cref="ArgumentException">There is no such body.</exception>
    public void Remove(BodyHandle handle)
    {
        CheckHandle(handle);
        RemoveAt(Locations[handle.Slot].Index);
    }

    /// <summary>Removes a body of the active set and all of its constraints.</summary>
    /// <exception cref="ArgumentOutOfRangeException">There is no such body.</exception>
    public void RemoveAt(int activeBodyIndex)
    {
        if ((uint)activeBodyIndex >= (uint)ActiveSet.Count)
            throw new ArgumentOutOfRangeException(nameof(activeBodyIndex), activeBodyIndex, $"There are {ActiveSet.Count} active bodies.");
        ref var set = ref ActiveSet;
        ref var constraints = ref set.Constraints[activeBodyIndex];
        while (constraints.Count > 0)
            solver.Remove(constraints[constraints.Count - 1].ConnectingConstraintHandle);
        constraints.Dispose(Pool);
        RemoveFromBroadPhase(activeBodyIndex);
        var handle = set.IndexToHandle[activeBodyIndex];
        set.RemoveAt(activeBodyIndex);
        if (activeBodyIndex < set.Count)
        {
            Locations[set.IndexToHandle[activeBodyIndex].Slot].Index = activeBodyIndex;
            solver.UpdateBodyIndex(activeBodyIndex);
        }
        Locations[handle.Slot].SetIndex = -1;
        owners.Release(handle.Slot);
        HandlePool.Return(handle.Slot, Pool);
    }

    /// <summary>Describes a body as it is now.</summary>
    /// <exception cref="ArgumentException">There is no such body.</exception>
    public void GetDescription(BodyHandle handle, out BodyDescription description)
    {
        CheckHandle(handle);
        var index = Locations[handle.Slot].Index;
        ref var set = ref ActiveSet;
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

    /// <summary>Makes a body what a description says; its constraints stay.</summary>
    /// <exception cref="ArgumentException">There is no such body, a value cannot be simulated, or the shape does not exist; nothing was changed.</exception>
    public void ApplyDescription(BodyHandle handle, in BodyDescription description)
    {
        CheckHandle(handle);
        Validate(description);
        var index = Locations[handle.Slot].Index;
        ref var motion = ref ActiveSet.MotionStates[index];
        motion.Pose = description.Pose;
        motion.Velocity = description.Velocity;
        ChangeInertia(handle, description.LocalInertia);
        var changesShape = ActiveSet.Collidables[index].Shape != description.Collidable.Shape;
        if (changesShape)
            RemoveFromBroadPhase(index);
        WriteSettings(index, description);
        if (changesShape && description.Collidable.Shape.Exists)
            AddToBroadPhase(index);
        UpdateBoundsAt(index);
    }

    /// <summary>Gives a body another shape; its inertia stays.</summary>
    /// <exception cref="ArgumentException">There is no such body or no such shape; nothing was changed.</exception>
    public void SetShape(BodyHandle handle, TypedIndex shape)
    {
        CheckHandle(handle);
        CheckShape(shape);
        var index = Locations[handle.Slot].Index;
        ref var collidable = ref ActiveSet.Collidables[index];
        if (collidable.Shape == shape)
            return;
        RemoveFromBroadPhase(index);
        collidable.Shape = shape;
        if (shape.Exists)
            AddToBroadPhase(index);
    }

    /// <summary>Gives a body another inertia. All zero makes it kinematic, which removes its constraints to other kinematic bodies.</summary>
    /// <exception cref="ArgumentException">There is no such body or the inertia cannot be simulated; nothing was changed.</exception>
    public void SetLocalInertia(BodyHandle handle, in BodyInertia localInertia)
    {
        CheckHandle(handle);
        BodyChecks.Inertia(localInertia);
        ChangeInertia(handle, localInertia);
    }

    /// <summary>Moves the bounds of a body in the broad phase to where its pose says, as for queries between steps.</summary>
    /// <exception cref="ArgumentException">There is no such body.</exception>
    public void UpdateBounds(BodyHandle handle)
    {
        CheckHandle(handle);
        UpdateBoundsAt(Locations[handle.Slot].Index);
    }

    /// <summary>Visits each body that shares a constraint with a body, once per constraint.</summary>
    /// <exception cref="ArgumentException">There is no such body.</exception>
    public void EnumerateConnectedBodies<TEnumerator>(BodyHandle handle, ref TEnumerator enumerator) where TEnumerator : IForEach<BodyHandle>
    {
        CheckHandle(handle);
        ref var constraints = ref ActiveSet.Constraints[Locations[handle.Slot].Index];
        for (int i = 0; i < constraints.Count; ++i)
            solver.EnumerateOtherBodies(constraints[i], ref enumerator);
    }

    /// <summary>Makes room for bodies.</summary>
    /// <exception cref="ArgumentOutOfRangeException">The number is negative or more than <see cref="MaximumCount"/>; nothing was changed.</exception>
    public void EnsureCapacity(int capacity)
    {
        ArgumentOutOfRangeException.ThrowIfNegative(capacity);
        ArgumentOutOfRangeException.ThrowIfGreaterThan(capacity, MaximumCount);
        if (capacity > ActiveSet.Capacity)
            ActiveSet.Resize(capacity, Pool);
    }

    internal void AddConstraint(BodyHandle body, ConstraintHandle constraint, int bodyIndexInConstraint) =>
        ActiveSet.Constraints[Locations[body.Slot].Index].Add(
            new() { ConnectingConstraintHandle = constraint, BodyIndexInConstraint = bodyIndexInConstraint }, Pool);

    internal void RemoveConstraint(int bodyIndex, ConstraintHandle constraint)
    {
        ref var constraints = ref ActiveSet.Constraints[bodyIndex];
        for (int i = 0; i < constraints.Count; ++i)
        {
            if (constraints[i].ConnectingConstraintHandle == constraint)
            {
                constraints.FastRemoveAt(i);
                return;
            }
        }
    }

    void MakeRoom(in BodyDescription description)
    {
        ref var set = ref ActiveSet;
        if (HandlePool.AvailableIdCount == 0)
        {
            var slot = HandlePool.HighestPossiblyClaimedId + 1;
            if (slot >= MaximumCount)
                throw new InvalidOperationException($"There are {MaximumCount} bodies, as many as a simulation holds.");
            EnsureSlots(slot + 1);
        }
        if (set.Count == set.Capacity)
            set.Resize(set.Capacity * 2, Pool);
        set.EnsurePrincipalFrames(description.LocalInertia.InverseInertiaTensor, Pool);
        if (description.Collidable.Shape.Exists)
            broadPhase.EnsureCapacity(broadPhase.ActiveTree.LeafCount + 1, 0);
    }

    internal void CheckShape(TypedIndex shape)
    {
        if (shape.Exists)
            shapes.CheckExists(shape, nameof(shape));
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

    void ChangeInertia(BodyHandle handle, in BodyInertia localInertia)
    {
        var index = Locations[handle.Slot].Index;
        ref var current = ref ActiveSet.LocalInertias[index];
        var changesKind = IsKinematic(current) != IsKinematic(localInertia);
        current = localInertia;
        ActiveSet.EnsurePrincipalFrames(localInertia.InverseInertiaTensor, Pool);
        if (!changesKind)
            return;
        solver.Recolor(handle);
        // The broad phase knows the kind of each collidable.
        if (ActiveSet.Collidables[index].BroadPhaseIndex >= 0)
        {
            RemoveFromBroadPhase(index);
            AddToBroadPhase(index);
        }
    }

    void WriteSettings(int index, in BodyDescription description)
    {
        var settings = description.Collidable;
        ref var collidable = ref ActiveSet.Collidables[index];
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
        ActiveSet.Activity[index] = new()
        {
            SleepThreshold = description.Activity.SleepThreshold,
            MinimumTimestepsUnderThreshold = description.Activity.MinimumTimestepCountUnderThreshold,
        };
    }

    internal CollidableReference ReferenceAt(int index) => new(
        IsKinematic(ActiveSet.LocalInertias[index]) ? CollidableMobility.Kinematic : CollidableMobility.Dynamic, ActiveSet.IndexToHandle[index]);

    void AddToBroadPhase(int index)
    {
        ref var collidable = ref ActiveSet.Collidables[index];
        shapes.UpdateBounds(ActiveSet.MotionStates[index].Pose, collidable.Shape, out var bounds);
        collidable.BroadPhaseIndex = broadPhase.AddActive(ReferenceAt(index), ref bounds);
    }

    void RemoveFromBroadPhase(int index)
    {
        ref var leaf = ref ActiveSet.Collidables[index].BroadPhaseIndex;
        if (leaf < 0)
            return;
        if (broadPhase.RemoveActiveAt(leaf, out var moved))
            ActiveSet.Collidables[Locations[moved.BodyHandle.Slot].Index].BroadPhaseIndex = leaf;
        leaf = -1;
    }

    internal void UpdateBoundsAt(int index)
    {
        ref var collidable = ref ActiveSet.Collidables[index];
        if (collidable.BroadPhaseIndex < 0)
            return;
        shapes.UpdateBounds(ActiveSet.MotionStates[index].Pose, collidable.Shape, out var bounds);
        // The whole tree at once: a query may come before the next step fits it.
        broadPhase.UpdateActiveBounds(collidable.BroadPhaseIndex, bounds.Min, bounds.Max);
    }

    internal void GetBoundsPointers(int index, out Vector3* min, out Vector3* max)
    {
        var leaf = ActiveSet.Collidables[index].BroadPhaseIndex;
        if (leaf < 0)
            throw new InvalidOperationException($"There are no bounds of {ActiveSet.IndexToHandle[index]}: it has no shape.");
        broadPhase.GetActiveBoundsPointers(leaf, out min, out max);
    }

    internal void Clear()
    {
        ref var set = ref ActiveSet;
        for (int i = 0; i < set.Count; ++i)
            Locations[set.IndexToHandle[i].Slot].SetIndex = -1;
        owners.ReleaseAll();
        set.Clear(Pool);
        HandlePool.Clear();
    }

    internal void Dispose()
    {
        ActiveSet.Dispose(Pool);
        Pool.Return(ref Sets);
        Pool.Return(ref Locations);
        owners.Dispose(Pool);
        HandlePool.Dispose(Pool);
    }
}
