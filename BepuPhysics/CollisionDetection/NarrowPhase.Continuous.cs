using System;
using System.Numerics;
using System.Runtime.CompilerServices;
using BepuPhysics.Collidables;
using BepuUtilities;

namespace BepuPhysics.CollisionDetection;

// Pairs of which one collidable is marked as continuous, and that move far in a step. When they first touch is found as a sweep finds it; they are tested
// where that is, and the contacts hold in this step, as far ahead as the surfaces approach until then. What does not touch has no contacts ahead: no plane
// turns aside what passes an edge. What is hit does not give way: it is hit by the stage of bounces.
//
// Contacts of a solver's step are linear: n . (v + w x r) dt closes a gap. So the arms of an impact are those of its time, in world axes, and not where they
// are at the beginning; the gap is what the contact's speed at that time makes of the time.
public sealed unsafe partial class NarrowPhase<TCallbacks>
{
    // A pair is fast that moves by more than this part of the inner radius of the thinner shape, in a step; where neither has one, of the mover's radius.
    const float FastPart = .5f;
    const float FastPartOfRadius = .02f;
    // As the first, of a pair that is found within a step, and has no contacts.
    const float LateFastPart = .05f;
    // How much longer than the step is looked ahead: what pushes may hasten an impact, and a contact that is not reached does nothing.
    const float Lookahead = 1.25f;
    // Parts of the thinner shape's inner radius: how far around an impact contacts are looked for, how near is nearby, how exact an impact is at least, and
    // by how much what is hit comes nearer in a substep at least.
    const float LeastHitPart = 1e-2f;
    const float MarginPart = .5f;
    const float NearPart = .02f;
    const float ExactnessPart = 1e-3f;
    const float ProgressionPart = 1e-2f;
    // Rounds in which an impact is to be foreseen; of what takes more the ways are swept all the same.
    const int MaximumForeseenRoundCount = 1024;

    /// <summary>Poses of two collidables from the position of the first.</summary>
    struct ImpactPoses
    {
        public RigidPose A, B;
    }

    // A pair whose ways are to be swept.
    struct FastNote : INote
    {
        public CollidablePair Pair { get; init; }
        public float Inner;
        public bool IsSensor;
        // Whether it was foreseen that they hit each other.
        public bool Hits;
    }

    // Children as the callbacks know them.
    readonly struct ChildFilter(NarrowPhase<TCallbacks> narrowPhase, int workerIndex, CollidablePair pair) : ISweepFilter
    {
        public bool AllowTest(int childA, int childB) => narrowPhase.Callbacks.AllowContactGeneration(workerIndex, pair, childA, childB);
    }

    /// <summary>Finds where a pair will touch, if it is fast, and is apart now.</summary>
    /// <param name="workerIndex">The worker.</param>
    /// <param name="tested">The pair; its margin is that of the test.</param>
    /// <param name="shapeA">Shape of A.</param>
    /// <param name="shapeB">Shape of B.</param>
    /// <param name="poseA">Where A is.</param>
    /// <param name="poseB">Where B is.</param>
    /// <param name="placed">Where they will touch.</param>
    /// <param name="isApart">Whether it is known that they have no contacts where they are.</param>
    /// <returns>Whether they do; otherwise they are to be tested where they are.</returns>
    [MethodImpl(MethodImplOptions.NoInlining)]
    bool TryPlaceAtImpact(int workerIndex, ref TestedPair tested, TypedIndex shapeA, TypedIndex shapeB, in RigidPose poseA, in RigidPose poseB,
        ref ImpactPoses placed, out bool isApart)
    {
        isApart = false;
        var dt = workers[workerIndex].Batcher.Dt;
        var (velocityA, velocityB) = (VelocityOf(tested.Pair.A), VelocityOf(tested.Pair.B));
        if (!IsFast(shapeA, shapeB, velocityA, velocityB, dt, FastPart, out var inner, out var speed, out var gate))
        {
            FastPairs.NoteSlow(tested.Pair);
            return false;
        }
        // A sensor is passed: nothing is foreseen of it.
        tested.IsExact = !tested.IsSensor;
        tested.LeastHit = LeastHitPart * inner;
        if (!SweepPairs.IsKnown(shapeA.Type, Simulation.Shapes) || !SweepPairs.IsKnown(shapeB.Type, Simulation.Shapes))
            return false;
        Note(ref workers[workerIndex].Fast, new() { Pair = tested.Pair, Inner = inner, IsSensor = tested.IsSensor }, workers[workerIndex].Pool);
        if (tested.IsSensor)
            return false;
        var (batchA, batchB) = (Simulation.Shapes.GetBatch(shapeA.Type), Simulation.Shapes.GetBatch(shapeB.Type));
        void* pointerA = batchA.GetPointer(shapeA.Index), pointerB = batchB.GetPointer(shapeB.Index);
        var offsetB = poseB.Position - poseA.Position;
        var balls = new BallWays();
        var isStill = tested.Pair.B.Mobility == CollidableMobility.Static;
        balls.TrySet(shapeA.Type, pointerA, shapeB.Type, pointerB, poseB.Orientation, !isStill);
        if (isStill)
            FastPairs.SetStill(ref gate, tested.Pair.B, shapeB, poseB);
        if (!gate.MayMeet(new(poseA.Position), new(poseB.Position), new(velocityA.Linear), new(velocityB.Linear), dt * (double)Lookahead))
        {
            tested.SpeculativeMargin = MathHelper.Min(tested.SpeculativeMargin, NearPart * inner);
            isApart = balls.AreFartherApartThan(new(offsetB), tested.SpeculativeMargin);
            return false;
        }
        // What slides along several things that do not give way agrees with all of them.
        if (tested.IsAtSeam)
            return false;
        var continuity = ContinuityOf(tested.Pair.A);
        var other = ContinuityOf(tested.Pair.B);
        if (other.Mode == ContinuousDetectionMode.Continuous && (continuity.Mode != ContinuousDetectionMode.Continuous ||
            other.MinimumSweepTimestep < continuity.MinimumSweepTimestep))
            continuity = other;
        var maximumT = dt * (double)Lookahead;
        var convergence = LimitTime(continuity.SweepConvergenceThreshold, ExactnessPart * inner / speed);
        if (balls.Exists)
        {
            DoubleVector3 linearA = new(velocityA.Linear), linearB = new(velocityB.Linear);
            var touching = Math.Max(convergence * speed, ImpactPair.TouchingPart * inner);
            if (!balls.TryFind(0, new(offsetB), linearA, linearB, touching, out var time) ||
                !Touches(ref tested, time <= maximumT, time, inner))
            {
                isApart = balls.AreFartherApartThan(new(offsetB), tested.SpeculativeMargin);
                return false;
            }
            NoteHit(workerIndex);
            // Nobody asks how a ball is turned.
            placed.A = new(default, poseA.Orientation);
            placed.B = new((new DoubleVector3(offsetB) + (linearB - linearA) * time).ToSingle(), poseB.Orientation);
            return true;
        }
        var motion = new SweepMotion
        {
            OrientationA = DoubleMatrix3x3.FromQuaternion(poseA.Orientation),
            OrientationB = DoubleMatrix3x3.FromQuaternion(poseB.Orientation),
            LinearA = new(velocityA.Linear),
            LinearB = new(velocityB.Linear),
            AngularA = new(velocityA.Angular),
            AngularB = new(velocityB.Angular),
            OffsetB = new(offsetB),
            ReachOfB = gate.ReachOfB,
            MaximumT = maximumT,
            Accuracy = new ImpactAccuracy(
                LimitTime(continuity.MinimumSweepTimestep, ProgressionPart * inner / speed),
                convergence, MaximumForeseenRoundCount),
        };
        var filter = new ChildFilter(this, workerIndex, tested.Pair);
        SweepPairs.Test(motion, shapeA.Type, pointerA, shapeB.Type, pointerB, ref filter,
            Simulation.Shapes, workers[workerIndex].Pool, out var hit);
        if (hit.Overlaps || !Touches(ref tested, hit.Exists, hit.T, inner))
            return false;
        NoteHit(workerIndex);
        placed.A = new(default, BodyTurn.Turn(poseA.Orientation, motion.AngularA, hit.T));
        placed.B = new((motion.OffsetB + (motion.LinearB - motion.LinearA) * hit.T).ToSingle(), BodyTurn.Turn(poseB.Orientation, motion.AngularB, hit.T));
        return true;
    }

    // Of the pair that was noted last.
    void NoteHit(int workerIndex)
    {
        ref var fast = ref workers[workerIndex].Fast;
        fast[fast.Count - 1].Hits = true;
    }

    // What a test would say of balls that are apart. They keep no history.
    [MethodImpl(MethodImplOptions.NoInlining)]
    void CompleteApart(int workerIndex, in TestedPair tested, in Vector3 offsetB)
    {
        var manifold = new ConvexContactManifold { OffsetB = offsetB };
        Complete(workerIndex, tested, ref manifold);
    }

    // What does not touch has contacts only where it is as good as touching.
    static bool Touches(ref TestedPair tested, bool touches, double time, float inner)
    {
        tested.IsImpact = touches;
        tested.ImpactTime = touches ? (float)time : 0;
        tested.SpeculativeMargin = touches ? MarginPart * inner : MathHelper.Min(tested.SpeculativeMargin, NearPart * inner);
        return touches;
    }

    bool IsFast(TypedIndex shapeA, TypedIndex shapeB, in BodyVelocity velocityA, in BodyVelocity velocityB, float dt, float part, out float inner,
        out float speed, out WayGate gate)
    {
        var (batchA, batchB) = (Simulation.Shapes.GetBatch(shapeA.Type), Simulation.Shapes.GetBatch(shapeB.Type));
        float innerA = batchA.InnerRadius(shapeA.Index), innerB = batchB.InnerRadius(shapeB.Index);
        float radiusA = batchA.MaximumRadius(shapeA.Index), radiusB = batchB.MaximumRadius(shapeB.Index);
        inner = innerA > 0 && innerB > 0 ? MathHelper.Min(innerA, innerB) : MathHelper.Max(innerA, innerB);
        if (!(inner > 0))
            inner = MathHelper.Min(radiusA, radiusB) * (FastPartOfRadius / FastPart);
        speed = Exact.Length(velocityA.Linear - velocityB.Linear) +
            SurfaceSpeed(velocityA.Angular, radiusA, innerA) + SurfaceSpeed(velocityB.Angular, radiusB, innerB);
        gate = default;
        // Twice what may count as touching.
        gate.Set(radiusA, radiusB, 2 * ExactnessPart * inner);
        return speed * dt > part * inner;
    }

    internal override (float Inner, float Radius) RadiiOf(TypedIndex shape)
    {
        var batch = Simulation.Shapes.GetBatch(shape.Type);
        float inner = batch.InnerRadius(shape.Index), radius = batch.MaximumRadius(shape.Index);
        return (inner > 0 ? inner : radius * (FastPartOfRadius / FastPart), radius);
    }

    // What the broad phase and TestPair ask of a pair that they find. Sensors are left out: nobody could be told any more that their pair is watched.
    internal override bool WatchesLate(
        in CollidablePair pair, TypedIndex shapeA, TypedIndex shapeB, in BodyVelocity velocityA, in BodyVelocity velocityB, float dt, out float inner)
    {
        inner = 0;
        if (pair.A.Mobility != CollidableMobility.Dynamic || (ContinuityOf(pair.A).Mode != ContinuousDetectionMode.Continuous &&
            ContinuityOf(pair.B).Mode != ContinuousDetectionMode.Continuous))
            return false;
        if (!IsFast(shapeA, shapeB, velocityA, velocityB, dt, LateFastPart, out inner, out _, out _) ||
            !SweepPairs.IsKnown(shapeA.Type, Simulation.Shapes) || !SweepPairs.IsKnown(shapeB.Type, Simulation.Shapes))
            return false;
        if ((Simulation.Layers.IsUsed && !CollisionLayers.MayMeet(Simulation.Layers.Of(pair.A), Simulation.Layers.Of(pair.B))) ||
            (Simulation.Events.UsesSensors && Simulation.Events.CountSensors(pair.A, pair.B) > 0))
            return false;
        var margin = 0f;
        return AskFirst(0, pair, ref margin);
    }

    // By which its turn moves the surface of a shape that is not a ball.
    static float SurfaceSpeed(in Vector3 angular, float radius, float inner) => inner < radius ? Exact.Length(angular) * radius : 0;

    static double LimitTime(float time, float limit) => Math.Clamp(time, 0, limit);

    ContinuousDetection ContinuityOf(CollidableReference collidable)
    {
        if (collidable.Mobility == CollidableMobility.Static)
            return Simulation.Statics.StaticsBuffer[Simulation.Statics.Indices[collidable.Slot]].Continuity;
        ref var location = ref Simulation.Bodies.Locations[collidable.Slot];
        return Simulation.Bodies.SetOf(location).Collidables[location.Index].Continuity;
    }

    // Contacts of the time of an impact, as far ahead as the surfaces approach until then. Along the normal B is as far away, aside it stays where it will be.
    void MoveBack<TManifold>(in TestedPair tested, ref TManifold manifold) where TManifold : unmanaged, IContactManifold<TManifold>
    {
        if (typeof(TManifold) == typeof(ConvexContactManifold))
            MoveBack(tested, ref Unsafe.As<TManifold, ConvexContactManifold>(ref manifold));
    }

    void MoveBack(in TestedPair tested, Span<ChildResult> results)
    {
        foreach (ref var result in results)
            MoveBack(tested, ref result.Manifold);
    }

    void MoveBack(in TestedPair tested, ref ConvexContactManifold manifold)
    {
        var (velocityA, velocityB) = (VelocityOf(tested.Pair.A), VelocityOf(tested.Pair.B));
        float all = 0;
        for (int i = 0; i < manifold.Count; ++i)
        {
            ref readonly var contact = ref manifold.Read(i);
            var velocity = velocityA.Linear - velocityB.Linear + Exact.Cross(velocityA.Angular, contact.Offset) -
                Exact.Cross(velocityB.Angular, contact.Offset - manifold.OffsetB);
            // What parts at that time was farther away on its way, as far as a line tells, and is not to be pushed by what the line makes of it.
            var closing = MathHelper.Max(0, -Exact.Dot(velocity, manifold.Normal));
            manifold.AddDepth(i, -closing * tested.ImpactTime);
            all += closing * tested.ImpactTime;
        }
        manifold.OffsetB -= manifold.Normal * (all / MathHelper.Max(1, manifold.Count));
    }

    void WatchFastPairs()
    {
        FastPairs.BeginStep(workers[0].Batcher.Dt);
        if (SkippedPairCount > 0)
            FastPairs.KnowNoneSlow();
        order.Count = 0;
        for (int i = 0; i < workers.Length; ++i)
            Gather(ref workers[i].Fast, i);
        SortByKey();
        for (int i = 0; i < order.Count; ++i)
        {
            ref var note = ref workers[order[i].Worker].Fast[order[i].Index];
            FastPairs.Watch(note.Pair, note.Inner, note.IsSensor);
        }
        FastPairs.Share();
    }

    // Nobody else calls back while the solver runs, so that any worker's number will do.
    internal override bool ConfigureImpact(in CollidablePair pair, ref ConvexContactManifold manifold, out float friction, out float restitution)
    {
        friction = restitution = 0;
        if (!Callbacks.ConfigureContactManifold(0, pair, ref manifold, out var material) || manifold.Count == 0)
            return false;
        CallbackChecks.Contacts(pair, manifold, material);
        friction = material.FrictionCoefficient;
        restitution = TCallbacks.SurfaceOf(ref Callbacks, 0, pair, ref manifold).Restitution;
        CallbackChecks.Restitution(pair, restitution);
        return true;
    }
}
