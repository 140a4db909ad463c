
namespace BepuPhysics.Constraints;

/// <summary>Tells bodies how the loads of joints that are solved at once stiffen their rotation (GeometricStiffness.cs).</summary>
// In each substep, when all impulses are there: a blow may be a hundred times the load of the substep before it, and a taut chain of light links that is not
// quite straight, as one that comes from the sweeps never is, is thrown about by the stiffness that it had then (joints-where-sweeps-fail.md). Several joints
// of a bundle may be on one body, so one worker adds them.
sealed class DirectLoadStage(Solver solver, DirectStage joints, Bodies bodies) : ISolverStage
{
    bool ISolverStage.ChangesVelocities => false;

    bool ISolverStage.BeginStep() => joints.HasJoints;

    int ISolverStage.GetBlockCount(SolverPoint point) => point == SolverPoint.AfterSolve ? 1 : 0;

    void ISolverStage.Execute(SolverPoint point, in Substep substep, int block)
    {
        ref var set = ref bodies.Awake;
        // There is none where no joint carries a load.
        if (!set.Stiffness.Allocated)
            return;
        joints.BeginLoads(substep.Index == 0, set.Stiffness);
        var awake = new SolverBodies(set);
        foreach (ref var batch in joints.LeftOut.TypeBatches.AsSpan())
        {
            var processor = solver.Processor(batch.TypeId);
            for (int bundle = 0; bundle < batch.BundleCount && processor.CarriesPointLoad; ++bundle)
                processor.AddStiffness(ref batch, awake, substep, bundle, set.Stiffness);
        }
    }
}
