using System;
using System.Numerics;
using System.Runtime.CompilerServices;
using BepuPhysics.Constraints;
using BepuPhysics.Constraints.Contact;
using BepuUtilities;
using BepuUtilities.Collections;

namespace BepuPhysics.CollisionDetection;

/// <summary>Sums up what listened contacts push in the substeps of a step. Reads what the solver does, and changes nothing.</summary>
// Accumulated impulses are those of one substep. What a substep has made of them, relaxation included, is read when the next has integrated
// its bodies, before its warm start scales them, and for the last one when the bodies have moved.
sealed unsafe class ListeningStage(Solver solver, Bodies bodies) : ISolverStage
{
    const int ManifoldsPerBlock = 64;

    /// <summary>Constraints to read. Blocks write to those of theirs.</summary>
    internal QuickList<ListenedManifold> Manifolds;

    bool ISolverStage.ChangesVelocities => false;

    bool ISolverStage.BeginStep() => Manifolds.Count > 0;

    int ISolverStage.GetBlockCount(SolverPoint point) => point is SolverPoint.BeforeSubsteps or SolverPoint.AfterIntegration or SolverPoint.AfterSubsteps
        ? (Manifolds.Count + ManifoldsPerBlock - 1) / ManifoldsPerBlock
        : 0;

    void ISolverStage.Execute(SolverPoint point, in Substep substep, int block)
    {
        if (point == SolverPoint.AfterIntegration && substep.Index == 0)
            return;
        var end = Math.Min(Manifolds.Count, (block + 1) * ManifoldsPerBlock);
        for (int i = block * ManifoldsPerBlock; i < end; ++i)
        {
            ref var manifold = ref Manifolds[i];
            if (point == SolverPoint.BeforeSubsteps)
                Begin(ref manifold);
            else
                Sum(ref manifold);
        }
    }

    // Impulses stay where they are until the solver has ended.
    void Begin(ref ListenedManifold manifold)
    {
        var rows = new ContactRows(solver, bodies, manifold.Constraint, manifold.ContactCount);
        manifold.Impulses = (float*)Unsafe.AsPointer(ref rows.Impulse(0));
        var (velocityA, velocityB) = (rows.VelocityA, rows.VelocityB);
        manifold.ApproachSpeed = float.NegativeInfinity;
        for (int i = 0; i < manifold.ContactCount; ++i)
            manifold.ApproachSpeed = MathHelper.Max(manifold.ApproachSpeed, -rows.NormalRow(i).Along(velocityA, velocityB));
    }

    static void Sum(ref ListenedManifold manifold)
    {
        var impulse = manifold.Impulses;
        for (int i = 0; i < manifold.ContactCount; ++i, impulse += Vector<float>.Count)
            manifold.Normals[i] += *impulse;
        manifold.Friction += new Vector3(*impulse, impulse[Vector<float>.Count], impulse[2 * Vector<float>.Count]);
    }
}
