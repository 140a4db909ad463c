using System;
using System.Linq;
using System.Numerics;
using BepuPhysics;
using BepuUtilities.Diagnostics;
using BepuUtilities.Memory;
using Xunit;

namespace DemoTests.Quality;

/// <summary>A constraint whose math no longer fits the JIT's inliner silently runs at half speed. Here it fails a test instead.</summary>
public unsafe class InliningTests
{
    // Parts of the loops that a step runs, and methods of their own only where a test calls them by themselves, which may have been before this one.
    static readonly string[] callsAlone = ["BepuPhysics.Constraints.JointConstraint`", "BepuPhysics.Constraints.IJacobianJoint`"];

    [Fact]
    public void EveryConstraintFitsTheInliner()
    {
        // At 4 and 16 lanes a gather is twice the code and leaves calls behind. Measured at 4: gathers as roots of their own, which end
        // that, cost more than the calls (four contacts on two bodies 283 ns against 245 per bundle).
        // Checks take room as well.
        if (JitWatch.BuildIsUnoptimized || Check.IsEnabled || Vector<float>.Count != 8)
            return;
        using var pool = new BufferPool();
        // Only the list of types is wanted of it.
        var solver = new Solver(null!, pool, new SolveDescription(1, 1), 16);
        DefaultTypes.RegisterDefaults(solver);
        var processors = solver.TypeProcessors;
        Assert.True(processors.Count(p => p is not null) >= 15);
        for (int typeId = 0; typeId < processors.Count; ++typeId)
            solver.WarmUp(typeId);
        var overflows = JitWatch.Instance.Overflows("BepuPhysics.Constraints.")
            .Where(root => !callsAlone.Any(start => root.StartsWith(start, StringComparison.Ordinal)));
        Assert.Empty(overflows);
    }
}
