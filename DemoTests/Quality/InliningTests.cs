using System;
using System.Linq;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Constraints;
using BepuUtilities.Memory;
using Xunit;

namespace DemoTests.Quality;

/// <summary>A constraint whose math no longer fits the JIT's inliner silently runs at half speed. Here it fails a test instead.</summary>
public unsafe class InliningTests
{
    [Fact]
    public void EveryConstraintFitsTheInliner()
    {
        // At 4 and 16 lanes a gather is twice the code and leaves calls behind. Measured at 4: gathers as roots of their own, which end
        // that, cost more than the calls (four contacts on two bodies 283 ns against 245 per bundle).
        if (JitWatch.BuildIsUnoptimized || Vector<float>.Count != 8)
            return;
        using var pool = new BufferPool();
        // Only the list of types is wanted of it.
        var solver = new Solver(null!, pool, new SolveDescription(1, 1), 16);
        DefaultTypes.RegisterDefaults(solver);
        var processors = solver.TypeProcessors;
        Assert.True(processors.Count(p => p is not null) >= 15);
        foreach (var processor in processors)
        {
            if (processor is not null)
                RunOneBundle(processor, pool);
        }
        var overflows = JitWatch.Instance.Overflows("BepuPhysics.Constraints.");
        Assert.True(overflows.Count == 0, string.Join("\n", overflows));
    }

    // One bundle of unused lanes: they read body 0 and write nothing.
    static void RunOneBundle(TypeProcessor processor, BufferPool pool)
    {
        var batch = default(TypeBatch);
        Span<int> none = stackalloc int[processor.BodiesPerConstraint];
        none.Fill(EncodedBody.Empty);
        processor.Allocate(ref batch, new(0), none, Vector<float>.Count, pool);
        pool.Take<MotionState>(1, out var motions);
        pool.Take<BodyInertia>(1, out var inertias);
        pool.Take<BodyInertia>(1, out var stiffness);
        pool.Take<BodyVelocity>(1, out var displacements);
        motions.Clear(0, 1);
        inertias.Clear(0, 1);
        stiffness.Clear(0, 1);
        displacements.Clear(0, 1);
        motions[0].Pose.Orientation = Quaternion.Identity;
        var bodies = new SolverBodies(motions.Memory, inertias.Memory, displacements.Memory, stiffness.Memory);
        var substep = new Substep(1, 1 / 240f, 1, 1);
        processor.WarmStart(ref batch, bodies, substep, 0, 1);
        // Once a step, in its first substep.
        processor.WarmStart(ref batch, bodies, new Substep(0, 1 / 240f), 0, 1);
        processor.Solve(ref batch, bodies, substep, 0, 1);
        processor.Dispose(ref batch, pool);
        pool.Return(ref motions);
        pool.Return(ref inertias);
        pool.Return(ref stiffness);
        pool.Return(ref displacements);
    }
}
