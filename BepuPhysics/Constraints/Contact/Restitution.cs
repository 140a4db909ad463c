using System;
using BepuUtilities;
using BepuUtilities.Collections;
using BepuUtilities.Memory;

namespace BepuPhysics.Constraints.Contact;

/// <summary>Lets the contacts that ask for it bounce, once per step, after the substeps.</summary>
// Contacts bring two surfaces to rest against each other; what the impact speed was is lost by then. So the pairs that have a coefficient of
// restitution (no others are visited) are watched: each substep notes the speed at which their contacts approach, and where a contact
// begins to push, the speed at the instant of impact. A substep that begins with a gap s above an approach of speed v meets the surface
// after the part s / (v h) of its time, and has gained that part of the substep's acceleration: so a bounce does not depend on where
// within a substep it happened to fall.
//
// After the last substep each contact that was hit gets the velocity -e times its speed of impact, by sequential impulses over the hit
// contacts alone. The corners of a box do not hit at the same instant: the first to stop turns the box about itself, and the next hits the
// faster for it. To give each its own speed of impact back would give that energy twice; so a body that bounces off the world ends
// with no more kinetic energy than it had before the first of its impacts. Contacts no faster than what the acceleration of two steps gives
// do not bounce: they rest.
sealed unsafe class Restitution(Solver solver, Bodies bodies, BufferPool pool) : ISolverStage
{
    const int PairsPerBlock = 64;
    // The hit contacts of a box that lands flat share one bounce; their coupling converges by about a factor of two a sweep.
    const int Sweeps = 8;
    // Steps of acceleration that a contact may gather while it rests.
    const float RestingSteps = 2;

    QuickList<BouncingPair> pairs = new(16, pool);
    int substepCount;

    struct BouncingPair
    {
        public ConstraintHandle Constraint;
        public int ContactCount;
        public float Coefficient;
        // Normal velocity of each contact after the last two integrations; negative while approaching.
        public FourFloats Previous;
        public FourFloats Current;
        public FourFloats Gap;
        // Normal velocity at the instant of impact; 0 where there was none.
        public FourFloats Impact;
        public FourFloats Impulse;
        // Kinetic energy of A before the first impact.
        public float Energy;
        public bool Hit;
    }

    /// <summary>Watches a contact constraint in the coming step.</summary>
    internal void Watch(ConstraintHandle constraint, int contactCount, float coefficient) =>
        pairs.Add(new() { Constraint = constraint, ContactCount = contactCount, Coefficient = coefficient }, pool);

    /// <summary>Begins a step: nothing is watched.</summary>
    internal void BeginStep()
    {
        pairs.Count = 0;
        substepCount = solver.SubstepCount;
    }

    /// <summary>No longer watches a contact constraint that is removed between collision detection and the solver.</summary>
    internal void Forget(ConstraintHandle constraint)
    {
        for (int i = 0; i < pairs.Count; ++i)
        {
            if (pairs[i].Constraint != constraint)
                continue;
            // The others keep their order, in which they bounce.
            pairs.RemoveAt(i);
            return;
        }
    }

    internal void Dispose() => pairs.Dispose(pool);

    int ISolverStage.GetBlockCount(SolverPoint point) => point switch
    {
        SolverPoint.AfterWarmStart => 0,
        // Bounces push bodies that others push too: they are made in one order.
        SolverPoint.AfterSubsteps => pairs.Count > 0 ? 1 : 0,
        _ => (pairs.Count + PairsPerBlock - 1) / PairsPerBlock,
    };

    void ISolverStage.Execute(SolverPoint point, in Substep substep, int block)
    {
        if (point == SolverPoint.AfterSubsteps)
        {
            Bounce();
            return;
        }
        var end = Math.Min(pairs.Count, (block + 1) * PairsPerBlock);
        for (int i = block * PairsPerBlock; i < end; ++i)
        {
            ref var pair = ref pairs[i];
            var rows = new ContactRows(solver, bodies, pair.Constraint, pair.ContactCount);
            if (point == SolverPoint.AfterSolve)
                NoteImpacts(ref pair, rows, substep);
            else
                NoteApproach(ref pair, rows);
        }
    }

    static void NoteApproach(ref BouncingPair pair, in ContactRows rows)
    {
        for (int i = 0; i < pair.ContactCount; ++i)
        {
            pair.Previous[i] = pair.Current[i];
            pair.Current[i] = rows.NormalVelocity(i);
            pair.Gap[i] = rows.Gap(i);
        }
        if (!pair.Hit)
            pair.Energy = rows.KineticEnergyOfA();
    }

    static void NoteImpacts(ref BouncingPair pair, in ContactRows rows, in Substep substep)
    {
        for (int i = 0; i < pair.ContactCount; ++i)
        {
            if (pair.Impact[i] < 0 || !(rows.NormalImpulse(i) > 0) || !(pair.Current[i] < 0))
                continue;
            var part = MathHelper.Clamp(pair.Gap[i] / (-pair.Current[i] * substep.Dt), 0, 1);
            pair.Impact[i] = pair.Previous[i] + (pair.Current[i] - pair.Previous[i]) * part;
            pair.Hit = true;
        }
    }

    void Bounce()
    {
        for (int i = 0; i < pairs.Count; ++i)
            DropSlowImpacts(ref pairs[i]);
        for (int sweep = 0; sweep < Sweeps; ++sweep)
        {
            for (int i = 0; i < pairs.Count; ++i)
            {
                ref var pair = ref pairs[i];
                var rows = new ContactRows(solver, bodies, pair.Constraint, pair.ContactCount);
                for (int j = 0; j < pair.ContactCount; ++j)
                {
                    if (pair.Impact[j] < 0)
                        rows.Push(j, -pair.Coefficient * pair.Impact[j], ref pair.Impulse[j]);
                }
            }
        }
        LimitEnergy();
    }

    void LimitEnergy()
    {
        for (int i = 0; i < pairs.Count; ++i)
        {
            ref var pair = ref pairs[i];
            var rows = new ContactRows(solver, bodies, pair.Constraint, pair.ContactCount);
            if (pair.Hit && rows.HasOneBody)
                rows.LimitEnergyOfA(pair.Energy, pair.Impulse);
        }
    }

    void DropSlowImpacts(ref BouncingPair pair)
    {
        for (int i = 0; i < pair.ContactCount; ++i)
        {
            var gained = MathHelper.Max(0, pair.Previous[i] - pair.Current[i]) * substepCount;
            if (!(-pair.Impact[i] > RestingSteps * gained))
                pair.Impact[i] = 0;
        }
    }
}
