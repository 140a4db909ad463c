using BepuUtilities.TaskScheduling;

namespace BepuPhysics;

// Code of constraints, compiled ahead of time.
public sealed unsafe partial class Solver
{
    /// <summary>Runs the loops of each registered type over a bundle without constraints, and compiles what moves free bodies.</summary>
    internal void WarmUp()
    {
        foreach (var processor in processors)
            processor?.WarmUp(pool);
        StagedWork.Compile<FreeFlight>();
    }
}
