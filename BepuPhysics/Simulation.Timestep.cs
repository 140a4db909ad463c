using System;
using BepuUtilities;
using BepuUtilities.TaskScheduling;

namespace BepuPhysics;

// The step. DefaultTimestepper calls these stages in order; Docs/Timestep.md says what each reads and writes.
public sealed partial class Simulation
{
    // Some seconds: what is needed so often is not worth giving back.
    const int StepsBetweenTrims = 256;

    int stepsUntilTrim = StepsBetweenTrims;

    /// <summary>Advances the simulation.</summary>
    /// <param name="dt">Time to advance by, s, within <see cref="Limits"/>. May change from step to step.</param>
    /// <param name="threadDispatcher">Threads to use; null for the calling thread alone.</param>
    /// <exception cref="ArgumentOutOfRangeException">The time is not within <see cref="Limits"/>.</exception>
    public void Timestep(float dt, IThreadDispatcher? threadDispatcher = null)
    {
        CheckDt(dt);
        using var step = world.Step("Simulation.Timestep");
        Quarantine.BeginStep();
        if (NarrowPhase.IsAtRest)
        {
            Profiler.Clear();
            Timestepper.Timestep(this, dt, threadDispatcher);
            // Nobody works, so the workers' pools may be anybody's.
            TrimPools(null);
            return;
        }
        using (Profiler.Time(this))
            Timestepper.Timestep(this, dt, threadDispatcher);
        TrimPools(threadDispatcher);
    }

    // Tables that grow leave their old memory behind, and the first step of a scene needs many times what others do. What all sleep in needs none of it.
    void TrimPools(IThreadDispatcher? threadDispatcher)
    {
        if (--stepsUntilTrim > 0)
            return;
        stepsUntilTrim = StepsBetweenTrims;
        BufferPool.Trim();
        threadDispatcher?.WorkerPools.Trim();
    }

    /// <summary>Puts islands to sleep that have rested long enough: reads rest and velocities.</summary>
    /// <param name="threadDispatcher">Threads to use; null for the calling thread alone.</param>
    public void Sleep(IThreadDispatcher? threadDispatcher = null)
    {
        using var stage = world.Stage(operation: "Simulation.Sleep");
        if (NarrowPhase.IsAtRest)
            return;
        using var timer = Profiler.Time(Sleeper);
        Sleeper.Update(threadDispatcher);
    }

    /// <summary>Bodies to bounds that contain their motion: reads poses and velocities, writes bounds and speculative margins.</summary>
    public void PredictBoundingBoxes(float dt, IThreadDispatcher? threadDispatcher = null)
    {
        CheckDt(dt);
        using var stage = world.Stage(operation: "Simulation.PredictBoundingBoxes");
        Shapes.CheckAlive();
        if (NarrowPhase.IsAtRest)
            return;
        using var timer = Profiler.Time(PoseIntegrator);
        Bodies.RestCounts = 0;
        Quarantine.EnsureCapacity();
        // What rests may be apart by a part of its size, which the margin of a usual step covers and that of a much shorter one does not: its
        // contacts would go, and with them what they bear. See Docs/decisions/step-length.md.
        var reach = MathHelper.Max(dt, Solver.UsualDt);
        PoseIntegrator.Prepare(reach);
        var dispatcher = Bodies.Awake.Count < BoundsPredictor.MinimumBodyCountForThreads ? null : threadDispatcher;
        // Whether there is anything to be remembered of is known afterwards. Mostly it is as in the last step.
        var work = new BoundsPredictor
        {
            Bodies = Bodies,
            Shapes = Shapes,
            BroadPhase = BroadPhase,
            Integrator = PoseIntegrator,
            Dt = reach,
            CountsRest = Sleeper.Counts(dt),
            Motions = commonMotion.Begin(Bodies.HasMovingKinematics),
        };
        Bodies.HasMovingKinematics = false;
        try
        {
            StagedWork.Run(ref work, dispatcher);
            if (Bodies.HasMovingKinematics && !work.Motions.Allocated)
            {
                work.Motions = commonMotion.Begin(true);
                work.IsRepeated = true;
                StagedWork.Run(ref work, dispatcher);
            }
        }
        catch
        {
            // A callback threw after some bounds had been written: the tree has to contain them.
            BroadPhase.UpdateTrees();
            throw;
        }
        finally
        {
            Quarantine.Collect();
        }
    }

    /// <summary>Bounds to pairs, pairs to contacts, contacts to constraints.</summary>
    public void CollisionDetection(float dt, IThreadDispatcher? threadDispatcher = null) =>
        DetectCollisions(dt, threadDispatcher, bodiesMayBeWritten: true);

    /// <summary>Bounds to pairs, pairs to contacts, contacts to constraints.</summary>
    /// <param name="dt">Time of the step, s.</param>
    /// <param name="threadDispatcher">Threads to use; null for the calling thread alone.</param>
    /// <param name="bodiesMayBeWritten">Whether anybody can have written bodies since their bounds were predicted.</param>
    internal void DetectCollisions(float dt, IThreadDispatcher? threadDispatcher, bool bodiesMayBeWritten)
    {
        CheckDt(dt);
        using var stage = world.Stage(allowsQueries: true, "Simulation.CollisionDetection");
        Shapes.CheckAlive();
        if (NarrowPhase.IsAtRest && !BroadPhase.IsUpdateDue)
        {
            NarrowPhase.Rest();
            Statics.ForgetMoved();
            return;
        }
        if (bodiesMayBeWritten)
            Quarantine.StopUnsound();
        using (Profiler.Time(BroadPhase))
            BroadPhase.UpdateTrees(threadDispatcher);
        using (Profiler.Time(NarrowPhase))
        {
            commonMotion.Apply();
            NarrowPhase.FindContacts(dt, threadDispatcher);
        }
        using (Profiler.Time(SimulationProfiler.Flush))
            NarrowPhase.Flush(threadDispatcher);
        Statics.ForgetMoved();
    }

    /// <summary>Constraints to velocities, velocities to poses, in substeps.</summary>
    public void Solve(float dt, IThreadDispatcher? threadDispatcher = null)
    {
        CheckDt(dt);
        using var stage = world.Stage(operation: "Simulation.Solve");
        if (NarrowPhase.IsAtRest)
        {
            NarrowPhase.BeginEvents();
            Solver.Rest();
            NarrowPhase.EndEvents();
            return;
        }
        using var timer = Profiler.Time(Solver);
        Quarantine.EnsureCapacity();
        NarrowPhase.BeginEvents();
        try
        {
            Solver.Step(dt, PoseIntegrator, threadDispatcher);
            // Who is stopped loses contacts that these tell of.
            NarrowPhase.EndEvents();
            // Sweeps and bounces after the last integration: nothing else has looked at what they made of velocities.
            if (Solver.EndsWithVelocities)
                Quarantine.StopUnsound();
        }
        catch
        {
            // A callback threw in the middle of a substep: what constraints have made of velocities would have been looked at when it ends.
            Quarantine.StopUnsound();
            throw;
        }
        finally
        {
            Quarantine.Collect();
        }
    }

    static void CheckDt(float dt)
    {
        if (!(dt >= Limits.MinimumTimestep && dt <= Limits.MaximumTimestep))
        {
            throw new ArgumentOutOfRangeException(nameof(dt), dt,
                $"The time of a step must be from {Limits.MinimumTimestep} to {Limits.MaximumTimestep} s." +
                (dt > Limits.MaximumTimestep ? " Is this in milliseconds? A frame that took long may be cut: Math.Min(frameTime, 0.1f)." : ""));
        }
    }
}
