using System;
using BepuPhysics.Collidables;
using BepuUtilities;
using BepuUtilities.Collections;

namespace BepuPhysics;

// Saving the state between two steps, and going on from there.
public sealed partial class Simulation
{
    /// <summary>Copies the state of the simulation into a snapshot, in place of what that holds.</summary>
    /// <param name="snapshot">Takes the state. Only its memory grows, where it must.</param>
    /// <exception cref="InvalidOperationException">A step or a query is in progress.</exception>
    public void Save(SimulationSnapshot snapshot)
    {
        ArgumentNullException.ThrowIfNull(snapshot);
        using var change = world.ChangeOutsideOfSteps("Simulation.Save");
        snapshot.CheckAlive();
        var copy = snapshot.Copy;
        do
        {
            copy.BeginSave(BufferPool);
            CopyNeeds(copy);
            CopyState(copy);
        }
        while (!copy.TryEndSave());
    }

    /// <summary>Makes the state of the simulation that of a snapshot.</summary>
    /// <remarks>
    /// All handles mean what they meant then, and those that were given out since mean nothing. Events of the last step are gone. The simulation
    /// may be another one than that which was saved, if it has the same shapes under the same names and its callbacks do the same. If memory runs
    /// out meanwhile, the simulation is in no state to go on with, and can only be disposed.
    /// </remarks>
    /// <exception cref="InvalidOperationException">
    /// The snapshot holds nothing; a shape that it needs is not there any more, or a type of constraint is not registered; the solver has another fallback
    /// threshold; or a step or a query is in progress. Nothing was changed.
    /// </exception>
    public void Restore(SimulationSnapshot snapshot)
    {
        ArgumentNullException.ThrowIfNull(snapshot);
        using var change = world.ChangeOutsideOfSteps("Simulation.Restore");
        snapshot.CheckFilled();
        var copy = snapshot.Copy;
        copy.BeginRestore(BufferPool);
        CopyNeeds(copy);
        var end = new UsesEnd(Shapes);
        VisitShapes(ref end);
        CopyState(copy);
        var begin = new UsesBegin(Shapes);
        VisitShapes(ref begin);
        Quarantine.BeginStep();
    }

    // What a simulation must have to take the state: written before all else, so that it can be refused before anything has changed.
    void CopyNeeds(StateCopy copy)
    {
        var threshold = copy.Value(Solver.FallbackBatchThreshold);
        var types = new QuickList<ConstraintLayout>(16, BufferPool);
        var used = new UsedShapes(Shapes, BufferPool);
        try
        {
            if (!copy.Restores)
            {
                Solver.CountTypes(ref types);
                VisitShapes(ref used);
            }
            copy.List(ref types);
            used.CopyState(copy);
            if (!copy.Restores)
                return;
            if (threshold != Solver.FallbackBatchThreshold)
            {
                throw new InvalidOperationException(
                    $"The snapshot is of a solver with a fallback threshold of {threshold} batches; this one has {Solver.FallbackBatchThreshold}. " +
                    "Nothing was changed.");
            }
            Solver.CheckTypes(types);
            used.CheckExist();
        }
        finally
        {
            types.Dispose(BufferPool);
            used.Dispose();
        }
    }

    void VisitShapes<TVisitor>(ref TVisitor visitor) where TVisitor : struct, IForEach<TypedIndex>
    {
        Bodies.VisitShapes(ref visitor);
        Statics.VisitShapes(ref visitor);
    }

    void CopyState(StateCopy copy)
    {
        Bodies.CopyState(copy);
        Statics.CopyState(copy);
        traits.CopyState(copy);
        Solver.CopyState(copy);
        BroadPhase.CopyState(copy);
        NarrowPhase.CopyState(copy, Solver.UsedSlotCount);
        islands.CopyState(copy);
        Sleeper.CopyState(copy);
        Events.CopyState(copy);
        PoseIntegrator.CopyState(copy);
    }
}
