using System;
using BepuPhysics.Collidables;
using BepuPhysics.CollisionDetection;
using BepuUtilities.Memory;

namespace BepuPhysics;

/// <summary>A world of rigid bodies.</summary>
/// <remarks>
/// Not thread safe: one thread at a time adds, removes, reads and steps. A step uses the threads of the dispatcher that it is given.
/// The same calls give the same bits whatever the number of threads, the width of vectors and the CPU.
/// </remarks>
public sealed partial class Simulation : IDisposable
{
    bool ownsShapes;
    bool disposed;

    /// <summary>All bodies.</summary>
    public Bodies Bodies { get; }
    /// <summary>All statics.</summary>
    public Statics Statics { get; }
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
    /// <summary>Seconds that each stage of the last step took.</summary>
    public SimulationProfiler Profiler { get; } = new();
    /// <summary>Memory of the simulation.</summary>
    public BufferPool BufferPool { get; }
    /// <summary>Order of the stages of a step.</summary>
    public ITimestepper Timestepper { get; }

    /// <summary>Kept for callers: results never depend on threads, whatever this says.</summary>
    public bool Deterministic { get; set; } = true;

    Simulation(BufferPool bufferPool, IPoseIntegrator poseIntegrator, in SolveDescription solveDescription, ITimestepper timestepper,
        in SimulationAllocationSizes sizes, Shapes? shapes)
    {
        BufferPool = bufferPool;
        PoseIntegrator = poseIntegrator;
        Timestepper = timestepper;
        ownsShapes = shapes is null;
        Shapes = shapes ?? new Shapes(bufferPool, sizes.ShapesPerType);
        BroadPhase = new BroadPhase(bufferPool, Math.Max(1, sizes.Bodies), Math.Max(1, sizes.Bodies + sizes.Statics));
        Bodies = new Bodies(bufferPool, sizes.Bodies);
        Statics = new Statics(bufferPool, BroadPhase, Shapes, sizes.Statics);
        Solver = new Solver(Bodies, bufferPool, solveDescription, sizes.Constraints)
            { MinimumCapacityPerTypeBatch = Math.Max(16, sizes.ConstraintsPerTypeBatch) };
        Bodies.MinimumConstraintCapacityPerBody = Math.Max(1, sizes.ConstraintCountPerBodyEstimate);
        Bodies.Connect(Solver, BroadPhase, Shapes);
        DefaultTypes.RegisterDefaults(Solver);
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
        simulation.NarrowPhase = new NarrowPhase<TNarrowPhaseCallbacks>(
            simulation, narrowPhaseCallbacks, DefaultTypes.CreateDefaultCollisionTaskRegistry(), sizes.Constraints / 4);
        simulation.Solver.OnContactRemoved(simulation.NarrowPhase.Forget);
        simulation.PoseIntegrator.Initialize(simulation);
        simulation.NarrowPhase.Initialize();
        return simulation;
    }

    /// <summary>Removes all bodies, statics and constraints, and the shapes unless they are shared.</summary>
    public void Clear()
    {
        NarrowPhase.Clear();
        Solver.Clear();
        Bodies.Clear();
        Statics.Clear();
        BroadPhase.Clear();
        if (ownsShapes)
            Shapes.Clear();
    }

    /// <summary>Makes room ahead of time.</summary>
    public void EnsureCapacity(SimulationAllocationSizes sizes)
    {
        sizes.Validate();
        Bodies.EnsureCapacity(sizes.Bodies);
        Statics.EnsureCapacity(sizes.Statics);
        BroadPhase.EnsureCapacity(Math.Max(1, sizes.Bodies), Math.Max(1, sizes.Bodies + sizes.Statics));
        if (ownsShapes)
            Shapes.EnsureBatchCapacities(sizes.ShapesPerType);
    }

    /// <summary>Returns all memory to the pool.</summary>
    public void Dispose()
    {
        if (disposed)
            return;
        disposed = true;
        NarrowPhase.Dispose();
        Solver.Dispose();
        Bodies.Dispose();
        Statics.Dispose();
        BroadPhase.Dispose();
        if (ownsShapes)
            Shapes.Dispose();
    }
}
