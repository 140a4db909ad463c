using System;
using System.Collections.Generic;
using System.Diagnostics.CodeAnalysis;
using System.Runtime.CompilerServices;
using BepuPhysics.Constraints;
using BepuUtilities.Collections;
using BepuUtilities.Memory;

namespace BepuPhysics;

/// <summary>Chooses the number of velocity iterations of a substep; values below 1 mean <see cref="Solver.VelocityIterationCount"/>.</summary>
public delegate int SubstepVelocityIterationScheduler(int substepIndex);

/// <summary>Holds all constraints and moves the velocities of bodies until the constraints are satisfied.</summary>
// How constraints are kept. Every constraint goes into the first batch in which none of its dynamic bodies occurs yet: a greedy colouring
// of the graph whose nodes are bodies. All constraints of a batch are independent, so they are solved in bundles and by any number of
// threads with the same result. A batch keeps one type batch per constraint type. Kinematic bodies do not count for the colouring: they are
// read by many constraints at once and written by none.
//
// A body with more constraints than FallbackBatchThreshold batches sends the rest of them to the fallback batch, in which bodies may
// occur any number of times: there each occurrence is a body of its own with its share of the mass (SplitBodies).
public sealed unsafe partial class Solver
{
    const int MaximumTypeCount = TypeProcessor.MaximumTypeCount;

    readonly WorldLock world;
    readonly Bodies bodies;
    readonly BufferPool pool;
    readonly TypeProcessor?[] processors = new TypeProcessor?[MaximumTypeCount];
    // Who may write into the columns of a type; null for contacts, which have no description.
    readonly Type?[] descriptionTypes = new Type?[MaximumTypeCount];
    IslandAwakener awakener = null!;
    Action<ConstraintHandle> contactRemoved = static _ => { };
    // Every type batch takes as much: what is beyond is a mistake.
    internal const int MaximumCapacityPerTypeBatch = 1_000_000;

    int minimumCapacityPerTypeBatch = 64;
    int velocityIterationCount;
    int substepCount;
    int relaxationIterationCount;
    LoadPathMode loadPath;
    bool stopsImpacts;
    bool closesGapsSlowly;
    float contactFrequency;

    /// <summary>Sets of constraints: 0 is the active one, 1 has all that sleep.</summary>
    public Buffer<ConstraintSet> Sets;
    /// <summary>Greatest number of constraints, contacts included.</summary>
    public const int MaximumCount = 1 << ConstraintHandle.SlotBits;

    /// <summary>Location of each constraint by slot.</summary>
    internal Buffer<ConstraintLocation> Locations;
    HandleOwners owners;

    /// <summary>Location of each constraint by handle value or slot.</summary>
    public HandleTable<ConstraintLocation> HandleToConstraint => new(Locations, ConstraintHandle.SlotMask);
    /// <summary>Hands out the slots of constraint handles.</summary>
    public IdPool HandlePool;
    /// <summary>Processor of each constraint type by id; null where the type is not registered.</summary>
    public IReadOnlyList<TypeProcessor?> TypeProcessors => processors;

    /// <summary>Constraints that are solved each step.</summary>
    /// <exception cref="ObjectDisposedException">The simulation was disposed, or its pool cleared.</exception>
    public ref ConstraintSet ActiveSet
    {
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        get
        {
            if (!Sets.Allocated)
                world.ThrowEnded();
            return ref Sets[0];
        }
    }

    /// <summary>Sweeps over the constraints per substep; at least 1.</summary>
    /// <remarks>At four substeps or more a further substep buys more accuracy than a further iteration.</remarks>
    public int VelocityIterationCount
    {
        get => velocityIterationCount;
        set
        {
            ArgumentOutOfRangeException.ThrowIfLessThan(value, 1, nameof(VelocityIterationCount));
            world.CheckChangeable("Solver.VelocityIterationCount");
            velocityIterationCount = value;
        }
    }

    /// <summary>
    /// Parts into which a step of the usual length is divided for integration and solving; at least 1. Steps of other lengths have more or fewer
    /// (<see cref="LastSubstepCount"/>), unless <see cref="HasFixedSubstepCount"/>.
    /// </summary>
    public int SubstepCount
    {
        get => substepCount;
        set
        {
            ArgumentOutOfRangeException.ThrowIfLessThan(value, 1, nameof(SubstepCount));
            world.CheckChangeable("Solver.SubstepCount");
            substepCount = value;
        }
    }

    /// <summary>
    /// Sweeps per substep after its bodies have moved, which take back the velocity that the correction of positions left behind; not negative.
    /// </summary>
    /// <exception cref="ArgumentOutOfRangeException">The value is negative.</exception>
    public int RelaxationIterationCount
    {
        get => relaxationIterationCount;
        set
        {
            ArgumentOutOfRangeException.ThrowIfNegative(value, nameof(RelaxationIterationCount));
            world.CheckChangeable("Solver.RelaxationIterationCount");
            relaxationIterationCount = value;
        }
    }

    /// <summary>Whether rigid contacts stop what comes fast at once; see <see cref="SolveDescription.StopsImpacts"/>.</summary>
    public bool StopsImpacts
    {
        get => stopsImpacts;
        set
        {
            world.CheckChangeable("Solver.StopsImpacts");
            stopsImpacts = value;
        }
    }

    /// <summary>
    /// Frequency of rigid contacts, Hz; 0 for as stiff as sweeps hold. See <see cref="SolveDescription.ContactFrequency"/>.
    /// </summary>
    /// <exception cref="ArgumentOutOfRangeException">It is negative, not a number, or greater than that of any spring; nothing was changed.</exception>
    public float ContactFrequency
    {
        get => contactFrequency;
        set
        {
            SolveDescription.CheckFrequency(value);
            world.CheckChangeable("Solver.ContactFrequency");
            contactFrequency = value;
        }
    }

    // rad/s; where none was given one that no substep holds.
    internal float RigidContactFrequency => contactFrequency > 0 ? MathF.Tau * contactFrequency : Limits.MaximumSpringFrequency;

    /// <summary>
    /// Whether rigid joints that are added, or enabled, from now on close slowly what they are off by; see <see cref="SolveDescription.ClosesGapsSlowly"/>.
    /// </summary>
    public bool ClosesGapsSlowly
    {
        get => closesGapsSlowly;
        set
        {
            world.CheckChangeable("Solver.ClosesGapsSlowly");
            closesGapsSlowly = value;
        }
    }

    /// <summary>Whether loads of what rests on others are handed down to the ground in one go.</summary>
    /// <exception cref="ArgumentOutOfRangeException">There is no such mode.</exception>
    public LoadPathMode LoadPath
    {
        get => loadPath;
        set
        {
            SolveDescription.Check(value);
            world.CheckChangeable("Solver.LoadPath");
            loadPath = value;
        }
    }

    /// <summary>Chooses the number of velocity iterations of each substep; null for <see cref="VelocityIterationCount"/> in all.</summary>
    /// <remarks>
    /// It is asked for indices below <see cref="SubstepCount"/>. In a step with more or fewer substeps, for the index at the same part of the step.
    /// </remarks>
    public SubstepVelocityIterationScheduler? VelocityIterationScheduler { get; set; }
    /// <summary>Number of batches before constraints go to the fallback batch.</summary>
    public int FallbackBatchThreshold { get; }
    /// <summary>Least number of constraints for which a new type batch has room; from 0 to a million.</summary>
    /// <exception cref="ArgumentOutOfRangeException">The number is negative or more than a million; nothing was changed.</exception>
    public int MinimumCapacityPerTypeBatch
    {
        get => minimumCapacityPerTypeBatch;
        set
        {
            ArgumentOutOfRangeException.ThrowIfNegative(value, nameof(MinimumCapacityPerTypeBatch));
            ArgumentOutOfRangeException.ThrowIfGreaterThan(value, MaximumCapacityPerTypeBatch, nameof(MinimumCapacityPerTypeBatch));
            world.CheckChangeable("Solver.MinimumCapacityPerTypeBatch");
            minimumCapacityPerTypeBatch = value;
        }
    }

    internal Solver(Bodies bodies, BufferPool pool, in SolveDescription description, int initialCapacity, WorldLock? world = null)
    {
        this.world = world ?? new WorldLock();
        description.Validate();
        this.bodies = bodies;
        this.pool = pool;
        velocityIterationCount = description.VelocityIterationCount;
        substepCount = description.SubstepCount;
        relaxationIterationCount = description.RelaxationIterationCount;
        loadPath = description.LoadPath;
        stopsImpacts = description.StopsImpacts;
        closesGapsSlowly = description.ClosesGapsSlowly;
        contactFrequency = description.ContactFrequency;
        directJoints = description.DirectJoints;
        hasFixedSubstepCount = description.HasFixedSubstepCount;
        governor = description.Governor;
        directStage = new DirectStage(this, bodies, pool);
        OptionalStages.Add(directStage);
        OptionalStages.Add(new DirectLoadStage(this, directStage, bodies));
        needStage = new JointNeedStage(this, directStage, bodies);
        OptionalStages.Add(needStage);
        errorStage = new ConstraintErrorStage(this, bodies);
        OptionalStages.Add(errorStage);
        OptionalStages.Add(new BreakStage(this));
        VelocityIterationScheduler = description.VelocityIterationScheduler;
        jointsToShuffle = JointsToShuffle;
        FallbackBatchThreshold = description.FallbackBatchThreshold;
        pool.Take(2, out Sets);
        Sets[AsleepSet] = default;
        Sets[0] = new ConstraintSet { Batches = new QuickList<ConstraintBatch>(16, pool) };
        initialCapacity = Math.Max(16, initialCapacity);
        HandlePool = new IdPool(initialCapacity, pool);
        owners = new HandleOwners(ConstraintHandle.SlotBits, ConstraintHandle.ValueBits, initialCapacity, pool);
        EnsureSlots(initialCapacity);
    }

    internal void Connect(IslandAwakener awakener) => this.awakener = awakener;

    /// <summary>Chooses who is told when a contact constraint is removed by anyone but the narrow phase.</summary>
    internal void OnContactRemoved(Action<ConstraintHandle> action) => contactRemoved = action;

    /// <summary>Number of constraints in all sets.</summary>
    public int CountConstraints()
    {
        int count = 0;
        for (int i = 0; i < Sets.Length; ++i)
            count += Sets[i].CountConstraints();
        return count;
    }

    /// <summary>Whether a handle names a constraint.</summary>
    public bool ConstraintExists(ConstraintHandle constraintHandle) => owners.Has(constraintHandle.Value, constraintHandle.Slot);

    /// <summary>Where a constraint is; valid until constraints are added or removed.</summary>
    /// <exception cref="ArgumentException">There is no such constraint.</exception>
    public ConstraintReference GetConstraintReference(ConstraintHandle handle)
    {
        CheckHandle(handle);
        ref var location = ref Locations[handle.Slot];
        return new(this, handle, (TypeBatch*)Unsafe.AsPointer(ref TypeBatchAt(location)), location.IndexInTypeBatch);
    }

    internal ref TypeBatch TypeBatchAt(in ConstraintLocation location)
    {
        ref var batch = ref Sets[location.SetIndex].Batches[location.BatchIndex];
        return ref batch.TypeBatches[batch.Find(location.TypeId)];
    }

    internal TypeProcessor Processor(int typeId) => processors[typeId]!;

    void CheckHandle(ConstraintHandle handle)
    {
        if (!ConstraintExists(handle))
            ThrowMissing(handle);
    }

    [DoesNotReturn]
    void ThrowMissing(ConstraintHandle handle)
    {
        world.CheckAlive();
        throw owners.Missing(handle, handle.Value, handle.Slot);
    }

    /// <summary>Makes room for the handles of so many more constraints, as far as there may be so many.</summary>
    internal void EnsureFreeSlots(int count)
    {
        var needed = (long)HandlePool.HighestPossiblyClaimedId + 1 - HandlePool.AvailableIdCount + count;
        EnsureSlots((int)Math.Min(needed, MaximumCount));
    }

    void EnsureSlots(int count)
    {
        owners.EnsureSlots(count, new ConstraintLocation { SetIndex = -1 }, ref Locations, ref HandlePool, pool);
        Edges.EnsureCapacity(Locations.Length, pool);
    }

    internal void Clear()
    {
        for (int i = 0; i < Sets.Length; ++i)
        {
            ref var batches = ref Sets[i].Batches;
            for (int j = 0; j < batches.Count; ++j)
                DisposeBatch(ref batches[j]);
            batches.Count = 0;
        }
        ++jointVersion;
        for (int i = 0; i < Locations.Length; ++i)
            Locations[i].SetIndex = -1;
        owners.ReleaseAll();
        ForgetOptions();
        ForgetNeeds();
        needTurn = 0;
        HandlePool.Clear();
        ForgetStepLengths();
        stepNumber = 0;
        AsleepOfKinematics = 0;
    }

    void DisposeBatch(ref ConstraintBatch batch)
    {
        for (int i = 0; i < batch.TypeBatches.Count; ++i)
            Processor(batch.TypeBatches[i].TypeId).Dispose(ref batch.TypeBatches[i], pool);
        batch.TypeBatches.Dispose(pool);
        if (batch.DynamicBodies.Flags.Allocated)
            batch.DynamicBodies.Dispose(pool);
    }

    internal void Dispose()
    {
        Clear();
        for (int i = 0; i < Sets.Length; ++i)
            Sets[i].Batches.DisposeIfTaken(pool);
        pool.Return(ref Sets);
        pool.Return(ref Locations);
        Edges.Dispose(pool);
        directStage.Dispose();
        DisposeOptions();
        DisposeNeeds();
        owners.Dispose(pool);
        HandlePool.Dispose(pool);
    }

    /// <summary>Forgets all memory, which the pool has given back to the system.</summary>
    internal void Abandon()
    {
        Sets = default;
        Locations = default;
        Edges = default;
        directStage.Abandon();
        AbandonOptions();
        needs = default;
        owners = default;
        HandlePool = default;
    }
}
