using System;
using BepuUtilities;
using BepuUtilities.Memory;
using BepuUtilities.TaskScheduling;

namespace BepuPhysics;

// Bodies that have no constraint in a step, and so no need of its substeps. Who is free is found when the first substep begins, and stays so
// to the end of the step.
public sealed unsafe partial class Solver
{
    /// <summary>Bodies below which moving them once ends before another thread is awake.</summary>
    const int MinimumFreeBodyCountForThreads = 1024;

    FreeBodies TakeFreeBodies()
    {
        pool.Take(BundleIndexing.GetBundleCount(bodies.Awake.Count), out Buffer<uint> lanes);
        return new(lanes);
    }

    // After the substeps: until then, events find these bodies where they were when the step began.
    void MoveFreeBodies(in SolveWork work, float dt, IThreadDispatcher? dispatcher)
    {
        if (!work.FreeBodies.Any)
            return;
        work.Integrator.Prepare(dt);
        var flight = new FreeFlight
        {
            Integrator = work.Integrator,
            FreeBodies = work.FreeBodies,
            BundleCount = BundleIndexing.GetBundleCount(bodies.Awake.Count),
            Dt = dt,
        };
        StagedWork.Run(ref flight, bodies.Awake.Count < MinimumFreeBodyCountForThreads ? null : dispatcher);
    }

    struct FreeFlight : IStagedWork
    {
        public IPoseIntegrator Integrator;
        public FreeBodies FreeBodies;
        public int BundleCount;
        public float Dt;

        public readonly int StageCount => 1;

        public readonly int GetBlockCount(int stage) => BlockCount(BundleCount, BodyBundlesPerBlock);

        public readonly void Execute(int stage, int block, int workerIndex)
        {
            var start = block * BodyBundlesPerBlock;
            Integrator.IntegrateFree(Dt, FreeBodies, start, Math.Min(start + BodyBundlesPerBlock, BundleCount), workerIndex);
        }
    }
}
