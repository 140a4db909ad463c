using BepuUtilities.Memory;
using BepuUtilities.TaskScheduling;

namespace BepuPhysics;

// Code of constraints, compiled ahead of time.
public sealed partial class Solver
{
    /// <summary>Runs the loops of a type, if there is one of this id, over a bundle without constraints. Types may be warmed up side by side.</summary>
    internal void WarmUp(int typeId)
    {
        if (processors[typeId] is not { } processor)
            return;
        using var pool = new BufferPool();
        processor.WarmUp(pool, readsRows: directJoints != DirectJointsMode.Off && MayBeDirect(typeId));
    }

    /// <summary>Compiles what moves free bodies.</summary>
    internal static void CompileFreeFlight() => StagedWork.Compile<FreeFlight>();
}
