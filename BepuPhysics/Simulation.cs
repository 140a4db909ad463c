using System;
using BepuPhysics.Collidables;
using BepuPhysics.CollisionDetection;
using BepuUtilities.Memory;

namespace BepuPhysics;

/// <summary>A world of rigid bodies.</summary>
/// <remarks>
/// One thread at a time adds, removes, writes and steps; any number may ask queries while none does. What comes at the wrong time, from another thread
/// or from a callback, is refused by an <see cref="InvalidOperationException"/>. A step uses the threads of the dispatcher that it is given.
/// The same calls give the same bits whatever the number of threads, the width of vectors and the CPU.
/// </remarks>
public sealed partial class Simulation : IDisposable, IBufferPoolUser
{
    readonly WorldLock world = new();
    readonly bool ownsShapes;
    bool isDisposed;
    readonly CollidableTraits traits;
    readonly SleepingIslands islands;
    readonly CommonMotion commonMotion;

    /// <summary>Who may do what now.</summary>
    internal WorldLock World => world;

    /// <summary>All bodies.</summary>
    public Bodies Bodies { get; }
    /// <summary>All statics.</summary>
    public Statics Statics { get; }
    /// <summary>Layers of the bodies and statics, which say what meets what.</summary>
    public CollidableLayers Layers { get; }
    /// <summary>Shapes of the bodies and statics.</summary>
    public Shapes Shapes { get; }
    /// <summary>All constraints, contacts included.</summary>
    public Solver Solver { get; }
    /// <summary>Moves bodies by their velocities.</summary>
    public IPoseIntegrator PoseIntegrator { get; }
    /// <summary>Finds collidables whose bounds overlap.</summary>
    public BroadPhase BroadPhase { get; }
    /// <summary>Finds contacts.</summary>
    public NarrowPhase NarrowPhase { get; private set; } = null!;
    /// <summary>What touched what in the last step.</summary>
    public CollisionEvents Events { get; }
    /// <summary>Puts to sleep what rests.</summary>
    public IslandSleeper Sleeper { get; }
    /// <summary>Wakes what sleeps.</summary>
    public IslandAwakener Awakener { get; }
    /// <summary>Bodies that the last step had to stop.</summary>
    public Quarantine Quarantine { get; }
    /// <summary>Seconds that each stage of the last step took.</summary>
    public SimulationProfiler Profiler { get; } = new();
    /// <summary>Memory of the simulation.</summary>
    public BufferPool BufferPool { get; }
    /// <summary>What moves along with kinematic bodies.</summary>
    internal CommonMotion CommonMotion => commonMotion;

    /// <summary>Order of the stages of a step.</summary>
    public ITimestepper Timestepper { get; }

    /// <summary>Kept for callers: results never depend on threads, whatever this says.</summary>
    public bool Deterministic { get; set; } = true;

    /// <summary>Whether handles of bodies and statics that are given out from now on are slots and nothing else, as in bepuphysics2.</summary>
    /// <remarks>
    /// False unless it is set. For games that have arrays of their own by <see cref="BodyHandle.Value"/> and do not want to write
    /// <see cref="BodyHandle.Slot"/> there. What it costs is that the handle of a body that was removed names the next one that gets its slot, and is not
    /// refused any more. To be set before anything is added. Results are the same.
    /// </remarks>
    /// <exception cref="InvalidOperationException">It is set while a stage or a query is in progress, or another thread is changing something.</exception>
    public bool PlainHandles
    {
        get => Bodies.HasPlainHandles;
        set
        {
            using var change = world.Change("Simulation.PlainHandles");
            Bodies.HasPlainHandles = value;
            Statics.HasPlainHandles = value;
        }
    }

    Simulation(BufferPool bufferPool, IPoseIntegrator poseIntegrator, in SolveDescription solveDescription, ITimestepper timestepper,
        in SimulationAllocationSizes sizes, Shapes? shapes)
    {
        BufferPool = bufferPool;
        PoseIntegrator = poseIntegrator;
        Timestepper = timestepper;
        ownsShapes = shapes is null;
        Shapes = shapes ?? new Shapes(bufferPool, sizes.ShapesPerType);
        Shapes.Attach(world);
        BroadPhase = new BroadPhase(bufferPool, Math.Max(1, sizes.Bodies), Math.Max(1, sizes.Bodies + sizes.Statics), world);
        Bodies = new Bodies(bufferPool, sizes.Bodies, world);
        Statics = new Statics(bufferPool, BroadPhase, Shapes, sizes.Statics, world);
        Solver = new Solver(Bodies, bufferPool, solveDescription, sizes.Constraints, world)
        { MinimumCapacityPerTypeBatch = Math.Max(16, sizes.ConstraintsPerTypeBatch) };
        Bodies.MinimumConstraintCapacityPerBody = Math.Max(1, sizes.ConstraintCountPerBodyEstimate);
        traits = new CollidableTraits(Bodies, Statics, bufferPool);
        Layers = new CollidableLayers(traits, bufferPool, world);
        Events = new CollisionEvents(Bodies, traits, Solver, bufferPool, world);
        islands = new SleepingIslands(Bodies, Solver, Events, bufferPool);
        Sleeper = new IslandSleeper(Bodies, Solver, islands, bufferPool);
        Awakener = new IslandAwakener(world, Bodies, Solver, BroadPhase, islands, bufferPool);
        Bodies.Connect(Solver, BroadPhase, Shapes, Statics, Sleeper, Awakener, traits);
        Statics.Connect(Bodies, Awakener, traits);
        Solver.Connect(Awakener);
        Quarantine = new Quarantine(Bodies, bufferPool);
        commonMotion = new CommonMotion(this, bufferPool);
        DefaultTypes.RegisterDefaults(Solver);
        bufferPool.AddUser(this);
    }

    /// <summary>Creates a simulation.</summary>
    /// <param name="bufferPool">Memory of the simulation; must outlive it.</param>
    /// <param name="narrowPhaseCallbacks">Which pairs collide, and their materials. <see cref="DefaultNarrowPhaseCallbacks"/> is ready to use.</param>
    /// <param name="poseIntegratorCallbacks">What moves bodies besides constraints. <see cref="DefaultPoseIntegratorCallbacks"/> is ready to use.</param>
    /// <param name="solveDescription">Substeps and iterations, as in <c>new SolveDescription(1, 4)</c>.</param>
    /// <param name="timestepper">Order of the stages of a step; null for the usual one.</param>
    /// <param name="initialAllocationSizes">How much room to make at first; null for a few thousand bodies.</param>
    /// <param name="shapes">Shapes to share with other simulations; null for shapes of its own. Shared shapes are not disposed with the simulation.</param>
    /// <exception cref="ArgumentException">A value is out of range.</exception>
    /// <exception cref="InvalidOperationException">Ready-made callbacks are the default of their struct, with nothing set.</exception>
    public static Simulation Create<TNarrowPhaseCallbacks, TPoseIntegratorCallbacks>(
        BufferPool bufferPool, TNarrowPhaseCallbacks narrowPhaseCallbacks, TPoseIntegratorCallbacks poseIntegratorCallbacks, SolveDescription solveDescription,
        ITimestepper? timestepper = null, SimulationAllocationSizes? initialAllocationSizes = null, Shapes? shapes = null)
        where TNarrowPhaseCallbacks : struct, INarrowPhaseCallbacks where TPoseIntegratorCallbacks : struct, IPoseIntegratorCallbacks
    {
        ArgumentNullException.ThrowIfNull(bufferPool);
        solveDescription.Validate();
        var sizes = initialAllocationSizes ?? SimulationAllocationSizes.Default;
        sizes.Validate();
        var simulation = new Simulation(
            bufferPool, new PoseIntegrator<TPoseIntegratorCallbacks>(poseIntegratorCallbacks), solveDescription,
            timestepper ?? new DefaultTimestepper(), sizes, shapes);
        try
        {
            simulation.Initialize(narrowPhaseCallbacks, sizes.Constraints / 4);
        }
        catch
        {
            // The callbacks are the game's and may throw.
            simulation.ReturnMemory();
            throw;
        }
        return simulation;
    }

    void Initialize<TNarrowPhaseCallbacks>(in TNarrowPhaseCallbacks narrowPhaseCallbacks, int initialPairCapacity)
        where TNarrowPhaseCallbacks : struct, INarrowPhaseCallbacks
    {
        NarrowPhase = new NarrowPhase<TNarrowPhaseCallbacks>(
            this, narrowPhaseCallbacks, DefaultTypes.CreateDefaultCollisionTaskRegistry(), initialPairCapacity);
        Solver.OnContactRemoved(NarrowPhase.Forget);
        islands.NarrowPhase = NarrowPhase;
        PoseIntegrator.Initialize(this);
        NarrowPhase.Initialize();
    }

    /// <summary>Removes all bodies, statics and constraints, and the shapes unless they are shared.</summary>
    /// <exception cref="InvalidOperationException">A stage or a query is in progress, or another simulation uses the shapes; nothing was changed.</exception>
    public void Clear()
    {
        using var change = world.Change("Simulation.Clear");
        CheckShapesNotLent("cleared");
        NarrowPhase.Clear();
        Solver.Clear();
        Bodies.Clear();
        Statics.Clear();
        traits.Clear();
        Events.Clear();
        BroadPhase.RemoveAllLeaves();
        islands.Clear();
        Sleeper.Clear();
        Quarantine.BeginStep();
        if (ownsShapes)
            Shapes.ClearUnlocked();
    }

    /// <summary>Makes room ahead of time.</summary>
    public void EnsureCapacity(SimulationAllocationSizes allocationTarget)
    {
        allocationTarget.Validate();
        using var change = world.Change("Simulation.EnsureCapacity");
        Bodies.MakeRoomFor(allocationTarget.Bodies);
        Statics.MakeRoomFor(allocationTarget.Statics);
        BroadPhase.MakeRoomFor(Math.Max(1, allocationTarget.Bodies), Math.Max(1, allocationTarget.Bodies + allocationTarget.Statics));
        if (ownsShapes)
            Shapes.MakeRoomFor(allocationTarget.ShapesPerType);
    }

    /// <summary>Whether it is disposed of, as while its callbacks let go of what they have, or its memory is gone.</summary>
    internal bool IsEnding => isDisposed || world.HasEnded;

    /// <summary>Returns all memory to the pool. From then on everything but a second call is refused.</summary>
    /// <exception cref="InvalidOperationException">A step or a query is in progress, or another simulation uses the shapes; nothing was changed.</exception>
    public void Dispose()
    {
        if (world.HasEnded)
            return;
        using var change = world.ChangeOutsideOfSteps("Simulation.Dispose");
        CheckShapesNotLent("disposed");
        isDisposed = true;
        try
        {
            // The callbacks are the game's and may throw.
            NarrowPhase.DisposeCallbacks();
        }
        finally
        {
            ReturnMemory();
        }
    }

    void ReturnMemory()
    {
        NarrowPhase?.Dispose();
        Solver.Dispose();
        commonMotion.ReturnMemory();
        islands.Dispose();
        Awakener.Dispose();
        Quarantine.Dispose();
        Bodies.Dispose();
        Statics.Dispose();
        traits.Clear();
        Events.Clear();
        BroadPhase.ReturnMemory();
        if (ownsShapes)
            Shapes.EndWithSimulation();
        else
            Shapes.Detach(world);
        BufferPool.RemoveUser(this);
        world.End("The simulation was disposed.");
    }

    void CheckShapesNotLent(string operation)
    {
        if (ownsShapes && Shapes.IsUsedByOthers(world))
            throw new InvalidOperationException($"The simulation cannot be {operation}: another one uses its shapes.");
    }

    void IBufferPoolUser.CheckNotBusy()
    {
        using var change = world.ChangeOutsideOfSteps("BufferPool.Clear");
    }

    void IBufferPoolUser.ForgetMemory()
    {
        NarrowPhase.Abandon();
        Solver.Abandon();
        commonMotion.Abandon();
        islands.Abandon();
        Awakener.Abandon();
        Bodies.Abandon();
        Quarantine.Abandon();
        Statics.Abandon();
        traits.Abandon();
        Events.Abandon();
        BroadPhase.Abandon();
        if (!ownsShapes)
            Shapes.Detach(world);
        world.End("The pool of the simulation was cleared, and with it all of its memory.");
    }
}
