using BepuUtilities;

namespace BepuPhysics;

/// <summary>Called between two stages of a step, on the thread that steps.</summary>
public delegate void TimestepperStageHandler(float dt, IThreadDispatcher? threadDispatcher);

/// <summary>Chooses the order of the stages of a step.</summary>
public interface ITimestepper
{
    /// <summary>Called before collision detection.</summary>
    event TimestepperStageHandler? BeforeCollisionDetection;
    /// <summary>Called after collision detection.</summary>
    event TimestepperStageHandler? CollisionsDetected;

    /// <summary>Advances a simulation.</summary>
    void Timestep(Simulation simulation, float dt, IThreadDispatcher? threadDispatcher = null);
}

/// <summary>The usual order: sleep, bounds, collisions, constraints.</summary>
public sealed class DefaultTimestepper : ITimestepper
{
    /// <summary>Called after bodies that rest were put to sleep, before anything else of the step.</summary>
    public event TimestepperStageHandler? Slept;
    /// <inheritdoc/>
    public event TimestepperStageHandler? BeforeCollisionDetection;
    /// <inheritdoc/>
    public event TimestepperStageHandler? CollisionsDetected;
    /// <summary>Called after the constraints have been solved and the bodies moved.</summary>
    public event TimestepperStageHandler? ConstraintsSolved;

    /// <inheritdoc/>
    public void Timestep(Simulation simulation, float dt, IThreadDispatcher? threadDispatcher = null)
    {
        simulation.Sleep(threadDispatcher);                          // rest    -> islands that sleep
        Slept?.Invoke(dt, threadDispatcher);
        simulation.PredictBoundingBoxes(dt, threadDispatcher);       // bodies  -> bounds
        var mayWrite = BeforeCollisionDetection is not null;
        BeforeCollisionDetection?.Invoke(dt, threadDispatcher);
        // bounds -> pairs -> contacts -> constraints
        simulation.DetectCollisions(dt, threadDispatcher, bodiesMayBeWritten: mayWrite);
        CollisionsDetected?.Invoke(dt, threadDispatcher);
        simulation.Solve(dt, threadDispatcher);                      // constraints -> velocities -> poses
        ConstraintsSolved?.Invoke(dt, threadDispatcher);
    }
}
