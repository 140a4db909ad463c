using BepuPhysics;
using BepuUtilities.Memory;

namespace DemoTests.Support;

/// <summary>A simulation with nothing in it but gravity.</summary>
static class EmptySimulation
{
    public static Simulation Create(BufferPool pool, int substeps = 4) =>
        Simulation.Create(pool, new DefaultNarrowPhaseCallbacks(), new DefaultPoseIntegratorCallbacks(), new SolveDescription(1, substeps));
}
