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
    const int PairsPerBlock = 64;

    /// <summary>Pairs to read, whose list is another's. Blocks write to those of theirs.</summary>
    internal QuickList<ListenedPair> Pairs;
    /// <summary>Constraints of these pairs.</summary>
    internal QuickList<ListenedManifold> Manifolds;
    /// <summary>Speed of approach from which on a touch is a hit.</summary>
    internal float HitSpeed;

    bool ISolverStage.ChangesVelocities => false;

    bool ISolverStage.BeginStep() => Manifolds.Count > 0;

    int ISolverStage.GetBlockCount(SolverPoint point) => point is SolverPoint.BeforeSubsteps or SolverPoint.AfterIntegration or SolverPoint.AfterSubsteps
        ? (Pairs.Count + PairsPerBlock - 1) / PairsPerBlock
        : 0;

    void ISolverStage.Execute(SolverPoint point, in Substep substep, int block)
    {
        if (point == SolverPoint.AfterIntegration && substep.Index == 0)
            return;
        var end = Math.Min(Pairs.Count, (block + 1) * PairsPerBlock);
        for (int i = block * PairsPerBlock; i < end; ++i)
        {
            ref var pair = ref Pairs[i];
            if (pair.ManifoldCount == 0)
                continue;
            if (point == SolverPoint.BeforeSubsteps)
                Begin(ref pair);
            else if (pair.IsMeasured)
                Sum(pair);
        }
    }

    void Begin(ref ListenedPair pair)
    {
        pair.ApproachSpeed = float.NegativeInfinity;
        for (int i = pair.FirstManifold; i < pair.FirstManifold + pair.ManifoldCount; ++i)
        {
            ref var manifold = ref Manifolds[i];
            var rows = new ContactRows(solver, bodies, manifold.Constraint, manifold.ContactCount);
            // Impulses stay where they are until the solver has ended.
            manifold.Impulses = (float*)Unsafe.AsPointer(ref rows.Impulse(0));
            var (velocityA, velocityB) = (rows.VelocityA, rows.VelocityB);
            for (int j = 0; j < manifold.ContactCount; ++j)
            {
                manifold.Depths[j] = rows.Depth(j);
                pair.Overlaps |= rows.Depth(j) > 0;
                pair.ApproachSpeed = MathHelper.Max(pair.ApproachSpeed, -rows.NormalRow(j).Along(velocityA, velocityB));
            }
            pair.CenterOfA = rows.PositionOfA;
            pair.OffsetB = rows.PositionOfBFromA;
        }
        // What overlaps as in the step before touches whatever it pushes.
        pair.IsMeasured = !(pair.Touches && pair.Overlaps) || (pair.Mask & EventMask.Persist) != 0
            || ((pair.Mask & EventMask.Hit) != 0 && pair.ApproachSpeed >= HitSpeed);
    }

    void Sum(in ListenedPair pair)
    {
        for (int i = pair.FirstManifold; i < pair.FirstManifold + pair.ManifoldCount; ++i)
        {
            ref var manifold = ref Manifolds[i];
            var impulse = manifold.Impulses;
            for (int j = 0; j < manifold.ContactCount; ++j, impulse += Vector<float>.Count)
                manifold.Normals[j] += *impulse;
            manifold.Friction += new Vector3(*impulse, impulse[Vector<float>.Count], impulse[2 * Vector<float>.Count]);
        }
    }

    /// <summary>Writes the contacts of a manifold, when the solver has ended.</summary>
    internal void Describe(in ListenedPair pair, in ListenedManifold manifold, Span<EventContact> contacts)
    {
        var rows = new ContactRows(solver, bodies, manifold.Constraint, manifold.ContactCount);
        for (int i = 0; i < contacts.Length; ++i)
        {
            contacts[i] = new()
            {
                Position = pair.CenterOfA + rows.Arm(i),
                Normal = rows.Normal,
                Depth = manifold.Depths[i],
                Impulse = manifold.Normals[i],
                FeatureId = manifold.Cached->Features[i],
                ChildA = manifold.Children.A,
                ChildB = manifold.Children.B,
            };
        }
    }
}
