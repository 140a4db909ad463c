
namespace BepuPhysics.Constraints;

/// <summary>Tells bodies how the loads of joints that are solved at once stiffen their rotation (GeometricStiffness.cs).</summary>
// Once per step, from the impulses of the first substep, when all of them are there. Several joints of a bundle may be on one body, so one worker adds them.
sealed class DirectLoadStage(Solver solver, DirectStage joints, Bodies bodies) : ISolverStage
{
    bool ISolverStage.ChangesVelocities => false;

    bool ISolverStage.BeginStep() => joints.HasJoints;

    int ISolverStage.GetBlockCount(SolverPoint point) => point == SolverPoint.AfterSolve ? 1 : 0;

    void ISolverStage.Execute(SolverPoint point, in Substep substep, int block)
    {
        if (substep.Index > 0)
            return;
        ref var set = ref bodies.Awake;
        var awake = new SolverBodies(set);
        foreach (ref var batch in joints.LeftOut.TypeBatches.AsSpan())
        {
            var processor = solver.Processor(batch.TypeId);
            for (int bundle = 0; bundle < batch.BundleCount && processor.CarriesPointLoad; ++bundle)
                processor.AddStiffness(ref batch, awake, substep, bundle, set.Stiffness);
        }
    }
}
