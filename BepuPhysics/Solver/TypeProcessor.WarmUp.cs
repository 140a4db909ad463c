using System;
using System.Numerics;
using BepuUtilities.Memory;

namespace BepuPhysics.Constraints;

// A bundle of unused lanes: they read body 0 and write nothing.
public abstract partial class TypeProcessor
{
    /// <summary>Runs every loop of the type over a bundle without constraints, so that it is compiled.</summary>
    /// <param name="pool">Memory.</param>
    /// <param name="readsRows">Whether joints may be solved at once.</param>
    internal unsafe void WarmUp(BufferPool pool, bool readsRows)
    {
        var batch = default(TypeBatch);
        Span<int> none = stackalloc int[BodiesPerConstraint];
        none.Fill(EncodedBody.Empty);
        Allocate(ref batch, new(0), none, Vector<float>.Count, pool);
        var parts = BodiesPerConstraint * Vector<float>.Count;
        pool.Take<float>(parts, out var shares);
        pool.Take<BodyVelocity>(parts, out var velocities);
        shares.AsSpan().Fill(1);
        // Aligned as rows of bodies are; all of them zero but the rotation.
        pool.Take<MotionState>(1, out var motions);
        pool.Take<BodyInertia>(3, out var inertias);
        motions[0] = new() { Pose = RigidPose.Identity };
        inertias.Clear(0, 3);
        var bodies = new SolverBodies(
            motions.Memory, inertias.Memory, (BodyVelocity*)(inertias.Memory + 1), inertias.Memory + 2, inertias.Memory);
        var split = new SplitBodies(shares.Memory, velocities.Memory);
        // Of the first substep and of a later one, each with and without a relaxation.
        for (int i = 0; i < 6; ++i)
        {
            var substep = new Substep(i % 2, 1 / 240f, relaxations: i % 3, isRelaxation: i % 3 == 2);
            WarmStart(ref batch, bodies, substep, 0, 1);
            Solve(ref batch, bodies, substep, 0, 1);
            WarmStartSplit(ref batch, bodies, split, substep, 0, 1);
            SolveSplit(ref batch, bodies, split, substep, 0, 1);
        }
        if (readsRows && RowCount > 0)
        {
            Span<ConstraintRowWide> rows = stackalloc ConstraintRowWide[RowCount];
            rows.Clear();
            ReadRows(ref batch, bodies, new Substep(1, 1 / 240f), 0, rows);
            ReadRigidErrors(ref batch, bodies, new Substep(1, 1 / 240f), 0, out _);
        }
        Dispose(ref batch, pool);
        pool.Return(ref shares);
        pool.Return(ref velocities);
        pool.Return(ref motions);
        pool.Return(ref inertias);
    }
}
