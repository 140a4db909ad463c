using System;
using System.Numerics;
using BepuPhysics.Collidables;
using BepuPhysics.Constraints;
using BepuUtilities.Collections;
using BepuUtilities.Memory;

namespace BepuPhysics.CollisionDetection;

/// <summary>Keeps fast pairs from passing each other: the ways that their bodies have gone in a substep are swept.</summary>
// Contacts know what is hit first. What was turned by a hit comes with another edge within the same step, or goes where no contact was foreseen. So when
// the bodies of a substep have moved, the cores of the shapes are swept along their ways: shapes that are thinner by a tenth of their inner radius, or of that
// of the smaller one of the two if that is less, so that what merely touches, or is pressed together, is none of this. Where cores meet an impact is made, of
// two bodies at one point, with the friction and restitution of the pair; from there both go on for the rest of the substep with the velocities that this
// leaves. Impacts are made in the order of their times, and after each the pairs of its bodies are swept anew. So no time is lost; and whatever moved the
// bodies, none is where it cannot have come to.
//
// Where there are many pairs, the ways of bodies, the first sweep of each pair, and the search for what those may meet whom the solver has thrown aside are
// what takes time. They do not depend on each other, and FastPairsShare has them done by all threads; what is left for one are the impacts.
sealed unsafe partial class FastPairs(NarrowPhase narrowPhase, Simulation simulation, BufferPool pool) : ISolverStage
{
    // Parts of the inner radius by which cores are thinner: the first at which they are apart. Who is pushed again and again, by others, comes deeper by one
    // of these in a substep at most: so their steps are small.
    static ReadOnlySpan<double> SkinParts => [.1, .15, .2, .25, .3, .35, .4, .5, .6, .7, .8, .9];
    // Those of balls that are found within a step: no contact stops them before.
    static ReadOnlySpan<double> LateSkinParts => [.01, .02, .03, .05, .07, .1, .15, .2, .25, .3, .35, .4, .5, .6, .7, .8, .9];
    // Part of the inner radius at which cores count as touching: they may come back to half of that some times, and still be apart for all that rounding tells.
    const double TouchingPart = .01;
    // Impacts of one pair in a substep from which on it does not turn any more, from which on both go on as one, and from which on it is left alone:
    // something holds it there.
    const int SlidingCount = 8;
    const int JoiningCount = 16;
    const int MaximumCount = 32;
    // Rounds in which a sweep of two parts is to end: hardly any takes more, but those that begin as good as in touch, and turn against each other all the
    // time. Of these thinner cores are tried, which are farther apart.
    const int MaximumRoundCount = 256;

    // From how many pairs on other threads take part, and pairs in a block of theirs.
    const int LeastForThreads = 16;
    const int PairsPerBlock = 8;

    QuickList<FastPair> pairs = new(16, pool);
    QuickList<FastBody> movers = new(8, pool);
    // Pairs of each mover that come first.
    QuickList<int> firstPairs = new(16, pool);
    // Of each mover, whether the solver has thrown it aside in the substep: few have been, and all are asked.
    QuickList<bool> thrown = new(16, pool);
    // Movers of the active set's bodies; -1 for the others.
    QuickList<int> moverOf = new(16, pool);
    // Of each handle: whether its body is in a marked pair that is too slow to be watched. Nothing where there was no fast pair in the last step.
    QuickList<bool> slow = new(16, pool);
    // Movers whose way an impact has changed in the substep.
    QuickList<int> changed = new(16, pool);
    // When pairs meet in the substep.
    EarliestTime times = new(pool);

    /// <summary>Number of pairs that are watched in this step.</summary>
    internal int Count => pairs.Count;

    /// <summary>Number of impacts that were made in the last step.</summary>
    internal int ImpactCount { get; private set; }

    /// <summary>How often pairs were joined in the last step, as impacts did not end.</summary>
    internal int StopCount { get; private set; }

    /// <summary>Rounds of all sweeps of the last step, which is what they cost.</summary>
    internal long RoundCount
    {
        get
        {
            var count = 0L;
            for (int i = 0; i < pairs.Count; ++i)
                count += pairs[i].RoundCount;
            return count;
        }
    }

    /// <summary>Begins a step: nothing is watched.</summary>
    /// <param name="dt">Length of the step, s.</param>
    internal void BeginStep(float dt = 0)
    {
        stepDt = dt;
        knowsApart = false;
        pairs.Count = SharedBlockCount = 0;
        ImpactCount = StopCount = 0;
    }

    /// <summary>Watches a pair in the coming step.</summary>
    /// <param name="pair">The pair.</param>
    /// <param name="inner">Inner radius of the thinner shape, m.</param>
    /// <param name="isSensor">Whether one of them is a sensor.</param>
    internal void Watch(in CollidablePair pair, float inner, bool isSensor) =>
        pairs.Add(new() { Pair = pair, Inner = inner, IsSensor = isSensor }, pool);

    /// <summary>Whether one of a pair is a sensor.</summary>
    internal bool IsSensor(int index, out CollidablePair pair)
    {
        pair = pairs[index].Pair;
        return pairs[index].IsSensor;
    }

    /// <summary>Whether a pair is one of a sensor that was met in the step.</summary>
    internal bool HasPassed(int index) => pairs[index].HasPassed;

    /// <summary>What the impacts of a pair have pushed along their normals, and what friction of them has pushed A with, N s.</summary>
    internal float ImpulseOf(int index, out CollidablePair pair, out Vector3 friction)
    {
        (pair, friction) = (pairs[index].Pair, pairs[index].FrictionImpulse);
        return pairs[index].Impulse;
    }

    internal void Dispose()
    {
        pairs.Dispose(pool);
        movers.Dispose(pool);
        firstPairs.Dispose(pool);
        thrown.Dispose(pool);
        moverOf.Dispose(pool);
        changed.Dispose(pool);
        slow.Dispose(pool);
        near.DisposeIfTaken(pool);
        pushed.DisposeIfTaken(pool);
        pushedBy.DisposeIfTaken(pool);
        if (looks.Span.Allocated)
        {
            looks.Dispose(pool);
            found.Dispose(pool);
        }
        times.Dispose(pool);
    }

    internal void Abandon()
    {
        pairs = default;
        movers = default;
        firstPairs = default;
        thrown = default;
        moverOf = default;
        changed = default;
        slow = default;
        near = default;
        pushed = default;
        pushedBy = default;
        looks = default;
        found = default;
        times = default;
    }

    bool ISolverStage.BeginStep() => pairs.Count > 0;

    int ISolverStage.GetBlockCount(SolverPoint point) =>
        point is SolverPoint.BeforeSubsteps or SolverPoint.AfterIntegration or SolverPoint.AfterSubsteps && pairs.Count > 0 ? 1 : 0;

    void ISolverStage.Execute(SolverPoint point, in Substep substep, int block)
    {
        if (point == SolverPoint.BeforeSubsteps)
            Link();
        else if (HasMoved(point, substep))
            Check(substep.Dt, EndOf(point, substep));
        else
            NoteFreeMotion();
    }

    /// <summary>Whether the bodies of a substep have moved before a point.</summary>
    internal static bool HasMoved(SolverPoint point, in Substep substep) => point == SolverPoint.AfterSubsteps || substep.Index > 0;

    /// <summary>Where the step ends, s from the beginning of the substep in which bodies have moved.</summary>
    internal double EndOf(SolverPoint point, in Substep substep) =>
        point == SolverPoint.AfterSubsteps ? substep.Dt : stepDt - (substep.Index - 1) * substep.Dt;

    /// <summary>Blocks for other threads; 0 if there is too little for them to do. Those of a step: pairs that are found in it make blocks larger.</summary>
    internal int SharedBlockCount { get; private set; }

    /// <summary>Divides what is watched among threads.</summary>
    internal void Share() => SharedBlockCount = pairs.Count < LeastForThreads ? 0 : (pairs.Count + PairsPerBlock - 1) / PairsPerBlock;

    /// <summary>Begins the ways of one block's bodies.</summary>
    internal void BeginWays(int block, int blockCount, double dt)
    {
        for (int i = StartOf(block, blockCount, movers.Count); i < StartOf(block + 1, blockCount, movers.Count); ++i)
        {
            ref var mover = ref movers[i];
            PutBack(mover);
            mover.Begin(Bodies.ActiveSet.MotionStates[mover.Index], dt);
            mover.ForeseenLinear += mover.FreeChange;
            mover.Look = -1;
            thrown[i] = mover.IsUnforeseen;
        }
    }

    /// <summary>Sweeps the pairs of one block along the ways of the substep.</summary>
    internal void SweepAll(int block, int blockCount, double dt, double end, BufferPool workerPool)
    {
        var until = TimeInStep(dt, end);
        for (int i = StartOf(block, blockCount, pairs.Count); i < StartOf(block + 1, blockCount, pairs.Count); ++i)
        {
            ref var pair = ref pairs[i];
            pair.ImpactCount = 0;
            pair.IsJoined = false;
            if (!pair.IsKnown && !pair.Passes)
            {
                SetGate(ref pair);
                pair.ApartUntil = ApartUntil(pair, dt);
            }
            pair.Time = FastPair.Never;
            if (pair.ApartUntil < until && (!pair.Balls.Exists || MayMeetOfBalls(pair, dt)))
                Find(ref pair, 0, dt, workerPool);
        }
    }

    // Where a substep of that length ends, s from the beginning of the step, which ends at a time from the substep's beginning.
    double TimeInStep(double dt, double end) => stepDt - end + dt;

    static int StartOf(int block, int blockCount, int count) => (int)((long)count * block / blockCount);

    void Link()
    {
        ForgetMovers();
        for (int i = pairs.Count - 1; i >= 0; --i)
        {
            ref var pair = ref pairs[i];
            // A game may have removed one of them since collisions were detected, or given it another shape.
            pair.Passes = !TryFind(pair.Pair.A, out pair.ShapeA, out pair.PoseA, out pair.A) ||
                !TryFind(pair.Pair.B, out pair.ShapeB, out pair.PoseB, out pair.B) ||
                !SweepPairs.IsKnown(pair.ShapeA.Type, simulation.Shapes) || !SweepPairs.IsKnown(pair.ShapeB.Type, simulation.Shapes);
            if (pair.Passes)
                pair.A = pair.B = -1;
            pair.NextOfA = Link(ref pair.A, i);
            pair.NextOfB = Link(ref pair.B, i);
        }
        WatchPushed();
        FollowPushed();
        ForgetStrikes();
    }

    // Only what the last step has written: what is marked costs nothing for bodies that are not.
    void ForgetMovers()
    {
        for (int i = 0; i < movers.Count; ++i)
            moverOf[movers[i].Index] = -1;
        movers.Count = firstPairs.Count = thrown.Count = 0;
        var known = moverOf.Count;
        if (known >= Bodies.ActiveSet.Count)
            return;
        moverOf.EnsureCapacity(Bodies.ActiveSet.Count, pool);
        moverOf.Count = Bodies.ActiveSet.Count;
        moverOf.AsSpan()[known..].Fill(-1);
    }

    Bodies Bodies => simulation.Bodies;

    bool TryFind(CollidableReference collidable, out TypedIndex shape, out RigidPose pose, out int index)
    {
        (shape, pose, index) = (default, default, -1);
        var isStatic = collidable.Mobility == CollidableMobility.Static;
        if (!(isStatic ? simulation.Statics.StaticExists(collidable.StaticHandle) : Bodies.BodyExists(collidable.BodyHandle)))
            return false;
        // What sleeps does not move.
        if (isStatic || Bodies.IsAsleep(collidable.Slot))
        {
            simulation.GetPoseAndShape(collidable, out pose, out shape);
            return shape.Exists;
        }
        index = Bodies.Locations[collidable.Slot].Index;
        shape = Bodies.ActiveSet.Collidables[index].Shape;
        return shape.Exists;
    }

    // Turns the index of a body into that of its mover.
    void Link(ref int body)
    {
        ref var mover = ref moverOf[body];
        if (mover < 0)
        {
            mover = movers.Count;
            movers.Add(MoverOf(body), pool);
            firstPairs.Add(-1, pool);
            thrown.Add(false, pool);
        }
        body = mover;
    }

    int Link(ref int body, int pair)
    {
        if (body < 0)
            return -1;
        Link(ref body);
        var next = firstPairs[body];
        firstPairs[body] = pair;
        return next;
    }

    // The way of a substep, which is that long, in a step that ends at a time from the substep's beginning.
    void Check(double dt, double end)
    {
        if (SharedBlockCount == 0)
        {
            BeginWays(0, 1, dt);
            GrowTurnedAside(end);
            SweepAll(0, 1, dt, end, pool);
            LookAll(0, 1);
        }
        knowsApart = true;
        substepEnd = TimeInStep(dt, end);
        times.Clear(pairs.Count, pool);
        for (int i = 0; i < pairs.Count; ++i)
            times.Change(i, pairs[i].Time, pool);
        changed.Count = 0;
        PairTurnedAside(dt);
        for (int next; (next = times.First) >= 0;)
            MakeImpact(next, dt);
        for (int i = 0; i < changed.Count; ++i)
            End(ref movers[changed[i]], dt);
    }

    void Find(ref FastPair pair, double from, double dt, BufferPool temporary)
    {
        pair.Time = FastPair.Never;
        if (pair.Passes || pair.IsJoined || pair.ImpactCount >= MaximumCount)
            return;
        if (!pair.IsKnown)
            SetGate(ref pair);
        if (pair.Balls.Exists)
            FindOfBalls(ref pair, from, dt);
        else
            FindOfAny(ref pair, from, dt, temporary);
    }
}
