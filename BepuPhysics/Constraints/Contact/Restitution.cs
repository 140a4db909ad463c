using System;
using System.Numerics;
using BepuUtilities;
using BepuUtilities.Collections;
using BepuUtilities.Memory;

namespace BepuPhysics.Constraints.Contact;

/// <summary>Lets the pairs that ask for it bounce, at the beginning of the substep in which they meet.</summary>
// Contacts bring two surfaces to rest against each other; a bounce that came after them would have to know who had given what to whom. So
// the pairs that have a coefficient of restitution (no others are visited) bounce before a substep is solved. Bodies move in straight
// lines within it: a gap s that closes at a speed v closes at the time s / v. Impacts are made one after the other in the order of their
// times, and each looks again at the pairs of its two bodies. So a blow passes through a row of spheres within one substep, each impact
// is one of two bodies or of those that meet at the same time, and none adds energy (SharedImpact). What then still approaches comes to rest by the solver.
//
// A body gets its new velocity at the beginning of the substep, but bounces at the time t: it is moved back by t times the change, and so
// is at the end of the substep where it would be. In between it overlaps what it has bounced off.
//
// Pairs that nobody expected to meet, since a third body sent the one against the other, overlap when they are found. They should have met
// at the negative time s / v, and bounce as if they had. What overlap is left then is taken out by moving the bodies.
// The solver is told of neither overlap: it would push them out with a velocity, and a contact that bounces keeps that energy. Where a contact
// carries a load it is told: that contact rests, and overlaps by its softness.
//
// Contacts no faster than what the acceleration of two steps gives do not bounce: they rest.
sealed unsafe partial class Restitution(Solver solver, Bodies bodies, BufferPool pool) : ISolverStage
{
    /// <summary>Coefficient of what does not bounce, but stops as what does: zero is that of what is hit at a corner while others hold it.</summary>
    internal const float LeastCoefficient = 1e-30f;

    const int PairsPerBlock = 64;
    // Steps of acceleration that a contact may gather while it rests.
    const float RestingSteps = 2;
    // Steps in which surfaces that part are out of an overlap by themselves.
    const float PartingSteps = 8;
    // Part of the weight of either body from which on a contact carries a load: a body that rests on many contacts gives each a part.
    const float LoadingShare = 1 / 16f;
    // Part of the speed at which two bodies were stopped below which they are not stopped again in the same substep: neighbours push each other on by ever
    // less, and the solver stops what is left. What does not give way stops all: it is met at corners, with something else in turn.
    const float StoppedShare = 1 / 16f;
    // What a rigid contact gives way under the weight of a body, of the way that it falls in a substep: 1 / (w h)^2.
    const float SunkShare = 1.6f;
    // Part of gravity along a normal from which on one of the two lies on the other.
    const float BearingShare = 1 / 2f;
    // Part of the least hit of a pair up to which the solver takes out its overlaps.
    const float OverlapShare = 1e-2f;
    // Speed of approach over speed of the bodies that may be rounding.
    const float RoundingShare = 1e-6f;

    QuickList<BouncingPair> pairs = new(16, pool);
    readonly ImpactStructures structures = new(solver, bodies, pool);
    ImpactGroups groups = new(pool);
    bool isLinked;
    bool anyMeets;
    bool anySleeps;
    // Without, nobody looks for them.
    bool anyJoints;

    /// <summary>What impacts of a substep have made of bodies, by their index in the active set; nothing where nobody asks for it.</summary>
    internal QuickList<Strike> Strikes;

    /// <summary>Watches a contact constraint in the coming step.</summary>
    internal void Watch(ConstraintHandle constraint, int contactCount, float coefficient, float leastHit) =>
        pairs.Add(new() { Constraint = constraint, ContactCount = contactCount, Coefficient = coefficient, LeastHit = leastHit }, pool);

    /// <summary>Number of contact constraints that are watched.</summary>
    internal int PairCount => pairs.Count;

    /// <summary>Impacts of a constraint in the last substep in which its group had any.</summary>
    internal int ImpactCountOf(int index) => pairs[index].ImpactCount;

    /// <summary>What the bounces of a constraint have pushed in the last step, N s.</summary>
    /// <param name="index">Which of those that are watched.</param>
    /// <param name="constraint">The constraint.</param>
    /// <param name="impulse">Along its normal.</param>
    /// <param name="friction">What friction pushed A with.</param>
    /// <returns>Whether there were any.</returns>
    internal bool TryGetBounce(int index, out ConstraintHandle constraint, out float impulse, out Vector3 friction)
    {
        ref var pair = ref pairs[index];
        (constraint, impulse, friction) = (pair.Constraint, pair.Impulse, pair.Friction);
        return impulse > 0;
    }

    /// <summary>Begins a step: nothing is watched.</summary>
    internal void BeginStep()
    {
        pairs.Count = 0;
        anySleeps = false;
    }

    /// <summary>Tells that a contact constraint, which may be watched, falls asleep.</summary>
    internal void NoteSleep() => anySleeps = true;

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

    internal void Dispose()
    {
        pairs.Dispose(pool);
        groups.Dispose();
        structures.Dispose();
        Strikes.DisposeIfTaken(pool);
    }

    internal void Abandon()
    {
        pairs = default;
        groups = default;
        Strikes = default;
        structures.Abandon();
    }

    // Where a game calls the stages of a step by itself, it may solve again what it has removed bodies from in between, or put them to sleep.
    bool ISolverStage.BeginStep()
    {
        isLinked = false;
        anyMeets = false;
        if (anySleeps)
            ForgetSleepers();
        anyJoints = pairs.Count > 0 && structures.AnyJoints();
        return pairs.Count > 0;
    }

    // Whole islands fall asleep at once: all their pairs are looked for in one pass.
    void ForgetSleepers()
    {
        anySleeps = false;
        int kept = 0;
        for (int i = 0; i < pairs.Count; ++i)
        {
            if (!solver.IsAsleep(pairs[i].Constraint.Slot))
                pairs[kept++] = pairs[i];
        }
        pairs.Count = kept;
    }

    int ISolverStage.GetBlockCount(SolverPoint point) => point switch
    {
        SolverPoint.BeforeSubsteps or SolverPoint.AfterIntegration => (pairs.Count + PairsPerBlock - 1) / PairsPerBlock,
        SolverPoint.BeforeWarmStart => ImpactGroups.MostBlocks(pairs.Count),
        _ => 0,
    };

    int ISolverStage.CountBlocks(SolverPoint point, int most)
    {
        if (point != SolverPoint.BeforeWarmStart)
            return most;
        if (!anyMeets)
            return 0;
        anyMeets = false;
        if (!isLinked)
        {
            structures.Find(ref pairs);
            groups.Link(ref pairs, bodies.ActiveSet.Count, structures);
        }
        isLinked = true;
        return groups.BlockCount;
    }

    void ISolverStage.Execute(SolverPoint point, in Substep substep, int block, BufferPool workerPool)
    {
        if (point == SolverPoint.BeforeWarmStart)
        {
            Bounce(block, substep, workerPool);
            return;
        }
        var end = Math.Min(pairs.Count, (block + 1) * PairsPerBlock);
        for (int i = block * PairsPerBlock; i < end; ++i)
        {
            ref var pair = ref pairs[i];
            if (point == SolverPoint.BeforeSubsteps)
                pair.Place = new(solver, pair.Constraint);
            var contacts = Contacts(pair);
            if (point == SolverPoint.BeforeSubsteps)
            {
                pair.A = contacts.A;
                pair.B = contacts.IsFixedB ? -1 : contacts.B;
                pair.GainA = contacts.VelocityA;
                pair.GainB = contacts.VelocityB;
                continue;
            }
            if (pair.Overlaps)
                contacts.Show(ref pair.Hidden);
            if (substep.Index == 0)
            {
                pair.GainA = Difference(contacts.VelocityA, pair.GainA);
                pair.GainB = Difference(contacts.VelocityB, pair.GainB);
                Begin(ref pair, contacts);
            }
            pair.Stopped = 0;
            pair.IsLoaded = IsLoaded(pair, contacts);
            pair.Sunk = pair.IsLoaded ? SunkShare * MathF.Sqrt(pair.GainSquared) * substep.Dt : 0;
            Predict(ref pair, contacts, substep.Dt);
            // Whichever block writes it writes the same.
            if (pair.Time < BouncingPair.Never || pair.Overlaps || (pair.Presses && anyJoints))
                anyMeets = true;
        }
    }

    ContactRows Contacts(in BouncingPair pair) => new(bodies, pair.Place, pair.ContactCount);

    // What is the same in all substeps.
    static void Begin(ref BouncingPair pair, in ContactRows contacts)
    {
        // In a pile that falls nobody falls against another, and yet its contacts rest on the floor below.
        var along = MathHelper.Max(
            MathF.Abs(Exact.Dot(pair.GainA.Linear, contacts.Normal)), MathF.Abs(Exact.Dot(pair.GainB.Linear, contacts.Normal)));
        pair.Bears = along * along > BearingShare * BearingShare * pair.GainSquared;
        for (int i = 0; i < pair.ContactCount; ++i)
        {
            pair.Rows[i] = contacts.NormalRow(i);
            pair.Gained[i] = MathHelper.Max(MathF.Abs(pair.Rows[i].Along(pair.GainA, pair.GainB)), along);
        }
    }

    internal static BodyVelocity Times(in BodyVelocity velocity, float factor) => new(velocity.Linear * factor, velocity.Angular * factor);

    static BodyVelocity Difference(in BodyVelocity a, in BodyVelocity b) => new(a.Linear - b.Linear, a.Angular - b.Angular);

    // When a pair meets, and where it should have before.
    void Predict(ref BouncingPair pair, in ContactRows contacts, float dt)
    {
        pair.Time = BouncingPair.Never;
        pair.Speed = 0;
        pair.Overlap = 0;
        pair.Overlaps = false;
        pair.Stays = false;
        pair.Presses = false;
        var stays = false;
        // Who hangs in joints bounces where he is: what is moved along joints for so long is moved uphill, and others of its structure into who is in the way.
        var earliest = pair.IsLoaded || pair.Hangs ? 0 : -dt * solver.LastSubstepCount;
        for (int i = 0; i < pair.ContactCount; ++i)
        {
            var gap = contacts.Gap(i, pair.Rows[i]);
            var speed = -pair.Rows[i].Along(contacts.VelocityA, contacts.VelocityB);
            var overlaps = gap < -MathHelper.Max(OverlapShare * pair.LeastHit, pair.Sunk);
            pair.Presses |= overlaps && pair.IsLoaded;
            if (overlaps && (!pair.IsLoaded || pair.Hangs))
            {
                pair.Overlaps = true;
                // Who bounced and parts by himself in a few steps is not moved: to move him is work, of gravity above all.
                var parting = pair.Coefficient > 0 ? PartingSteps * solver.LastSubstepCount * dt : dt;
                var left = MathHelper.Min(0, speed) * parting - gap;
                stays |= left > 0;
                pair.Overlap = MathHelper.Max(pair.Overlap, MathHelper.Min(left, contacts.MaximumRecoveryVelocity * dt));
            }
            if (!(speed > 0) || !(gap <= pair.Reach(speed, dt)) || !(pair.WithGain(i, speed) > RestingSpeed(pair, contacts, pair.Gained[i], dt)) ||
                (pair.B >= 0 && !(speed > StoppedShare * pair.Stopped)))
                continue;
            var time = MathHelper.Max(earliest, gap / speed);
            if (pair.Stopped > 0)
                time = MathHelper.Min(time, dt);
            if (!(time < pair.Time))
                continue;
            pair.Time = time;
            pair.Speed = speed;
        }
        // To move one body out of an overlap is to move all of its structure, some of it into others.
        if (!pair.IsInStructure || !(pair.IsLoaded ? pair.Overlaps : stays))
            return;
        pair.Stays = pair.Hangs;
        pair.Overlaps = pair.Hangs;
        pair.Overlap = 0;
    }

    float RestingSpeed(in BouncingPair pair, in ContactRows contacts, float gained, float dt)
    {
        var moving = MathF.Sqrt(Exact.LengthSquared(contacts.VelocityA.Linear) + Exact.LengthSquared(contacts.VelocityB.Linear));
        // What does not come back from its impact may make it at any speed but that at which it rests.
        var substeps = pair.Coefficient > 0 ? RestingSteps * solver.LastSubstepCount : RestingSteps;
        return MathHelper.Max(MathHelper.Max(substeps * gained, RoundingShare * moving), pair.LeastHit / dt);
    }

    static bool IsLoaded(in BouncingPair pair, in ContactRows contacts)
    {
        var weight = pair.GainSquared;
        if (!(weight > 0))
            return false;
        var load = contacts.Load * (contacts.InertiaA.InverseMass + contacts.InertiaB.InverseMass);
        return load * load > LoadingShare * LoadingShare * weight;
    }
}
