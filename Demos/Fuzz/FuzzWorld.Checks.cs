using System;
using BepuPhysics;

namespace Demos.Fuzz;

sealed partial class FuzzWorld
{
    // Walking all invariants takes longer than most calls.
    const int CallsPerValidation = 7;

    /// <summary>What must hold after any call.</summary>
    public void Check(int call)
    {
        Sync();
        DisposeLostShapes(false);
        if (Bodies.Live.Count != Simulation.Bodies.CountBodies())
            throw new FuzzFailure($"{Simulation.Bodies.CountBodies()} bodies, {Bodies.Live.Count} handles");
        if (Statics.Live.Count != Simulation.Statics.Count)
            throw new FuzzFailure($"{Simulation.Statics.Count} statics, {Statics.Live.Count} handles");
        CheckWorkers();
        CheckNumbers();
        if (call % CallsPerValidation == 0)
            Validate();
    }

    // They hold memory for no longer than a stage of a step, however that ends.
    void CheckWorkers()
    {
        try
        {
            dispatcher.WorkerPools.AssertEmpty();
        }
        catch (InvalidOperationException error)
        {
            throw new FuzzFailure("memory of the workers was not returned: " + error.Message, error);
        }
    }
}
