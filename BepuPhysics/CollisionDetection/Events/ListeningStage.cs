using System;
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
    /// <summary>Contacts of these.</summary>
    internal QuickList<EventContact> Contacts;

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
            var rows = new ContactRows(solver, bodies, manifold.Constraint, manifold.ContactCount);
            if (point == SolverPoint.BeforeSubsteps)
                manifold.ApproachSpeed = ApproachSpeed(rows, manifold.ContactCount);
            else
                Sum(rows, ref manifold);
        }
    }

    static float ApproachSpeed(in ContactRows rows, int contactCount)
    {
        var speed = float.NegativeInfinity;
        for (int i = 0; i < contactCount; ++i)
            speed = MathHelper.Max(speed, -rows.NormalRow(i).Along(rows.VelocityA, rows.VelocityB));
        return speed;
    }

    void Sum(in ContactRows rows, ref ListenedManifold manifold)
    {
        for (int i = 0; i < manifold.ContactCount; ++i)
            Contacts[manifold.FirstContact + i].Impulse += rows.Impulse(i);
        var friction = ContactPrestepLayout.FrictionImpulse(manifold.ContactCount);
        manifold.Friction += new System.Numerics.Vector3(rows.Impulse(friction), rows.Impulse(friction + 1), rows.Impulse(friction + 2));
    }
}
