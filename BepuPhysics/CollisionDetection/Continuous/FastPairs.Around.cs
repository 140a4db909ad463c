using System.Numerics;
using BepuPhysics.Collidables;
using BepuUtilities;
using BepuUtilities.Collections;
using BepuUtilities.Memory;

namespace BepuPhysics.CollisionDetection;

// Pairs are those whose bounds meet, and bounds contain the motion that was foreseen when the step began. What is thrown aside within the step, by an impact
// or by the solver, comes to what nobody has paired it with. So whoever is found to move otherwise than was foreseen has its bounds grown by its new way, up
// to the end of the step, and is paired with all that these meet. If both of a pair are thrown aside, the second one finds the first one's grown bounds.
sealed unsafe partial class FastPairs
{
    // By how much of its inner radius in a step a body may move otherwise than was foreseen, before it looks around again. Pairs count as fast from half of
    // the thinner shape's inner radius on; with that of both bodies it is three quarters, which a contact still sees before a centre has passed.
    const double UnforeseenPart = .125;

    // What the new way of a body may meet; has memory from the first one on.
    QuickList<CollidableReference> near;
    // Length of the step, s, and its end from the beginning of the substep.
    float stepDt;
    double stepEnd;

    // In the order of slots: that of the tree depends on its shape.
    struct ByOrder : IComparerRef<CollidableReference>
    {
        public readonly int Compare(ref CollidableReference a, ref CollidableReference b) =>
            (a.Packed & CollidableReference.OrderMask).CompareTo(b.Packed & CollidableReference.OrderMask);
    }

    struct NearList(FastPairs owner, CollidableReference self) : IBreakableForEach<CollidableReference>
    {
        public readonly bool LoopBody(CollidableReference collidable)
        {
            if (collidable != self)
                owner.near.Add(collidable, owner.Pool);
            return true;
        }
    }

    BufferPool Pool => pool;

    // A body as it is when its way begins, and as its bounds have foreseen it.
    FastBody MoverOf(int body)
    {
        ref var set = ref Bodies.ActiveSet;
        ref var motion = ref set.MotionStates[body];
        var shape = set.Collidables[body].Shape;
        var (inner, radius) = shape.Exists ? narrowPhase.RadiiOf(shape) : default;
        return new FastBody
        {
            Index = body,
            CheckedPosition = motion.Pose.Position,
            CheckedOrientation = motion.Pose.Orientation,
            Inertia = set.LocalInertias[body],
            Radius = radius,
            TurningRadius = inner < radius ? radius : 0,
            IsBall = shape.Exists && shape.Type == Sphere.Id,
            UnforeseenSpeed = UnforeseenPart * inner / stepDt,
            ForeseenLinear = new(motion.Velocity.Linear),
            ForeseenSpin = Exact.Length(motion.Velocity.Angular),
        };
    }

    // What the callbacks make of velocities in a substep, which bounds have foreseen: nothing else has changed them by the time of the first integration.
    void NoteFreeMotion()
    {
        for (int i = 0; i < movers.Count; ++i)
        {
            ref var mover = ref movers[i];
            ref var velocity = ref Bodies.ActiveSet.MotionStates[mover.Index].Velocity;
            mover.FreeChange = new DoubleVector3(velocity.Linear) - mover.ForeseenLinear;
        }
    }

    // Whom the solver has thrown aside.
    void LookAroundTurnedAside(double dt)
    {
        for (int i = 0, count = movers.Count; i < count; ++i)
        {
            movers[i].ForeseenLinear += movers[i].FreeChange;
            var first = pairs.Count;
            LookAround(i, 0, dt);
            for (int j = first; j < pairs.Count; ++j)
            {
                Find(ref pairs[j], 0, dt, pool);
                times.Change(j, pairs[j].Time);
            }
        }
    }

    /// <summary>Pairs a body that moves otherwise than was foreseen with all that is new on its way.</summary>
    void LookAround(int body, double time, double dt)
    {
        if (body < 0 || !movers[body].IsUnforeseen)
            return;
        ref var mover = ref movers[body];
        mover.ForeseenLinear = mover.Linear;
        mover.ForeseenSpin = mover.Angular.Length;
        var leaf = Bodies.ActiveSet.Collidables[mover.Index].BroadPhaseIndex;
        if (leaf < 0)
            return;
        // The farthest point of the shape from its centre, in any direction: a turn changes nothing of that.
        var reach = new Vector3((float)mover.Radius);
        Vector3 from = mover.PositionAt(time).ToSingle(), to = mover.PositionAt(stepEnd).ToSingle();
        var bounds = new BoundingBox(Exact.Min(from, to) - reach, Exact.Max(from, to) + reach);
        var tree = simulation.BroadPhase.ActiveTree;
        var known = tree.GetBounds(leaf);
        tree.UpdateBounds(leaf, Exact.Min(bounds.Min, known.Min), Exact.Max(bounds.Max, known.Max));
        var self = BepuPhysics.Bodies.ReferenceAt(Bodies.ActiveSet, mover.Index);
        if (!near.Span.Allocated)
            near = new(16, pool);
        near.Count = 0;
        var list = new NearList(this, self);
        simulation.BroadPhase.FindOverlapping(bounds, ref list);
        var order = new ByOrder();
        QuickSort.Sort(near.AsSpan(), ref order);
        for (int i = 0; i < near.Count; ++i)
            Pair(body, self, near[i], dt);
    }

    void Pair(int body, CollidableReference self, CollidableReference other, double dt)
    {
        NarrowPhase.SortCollidableReferencesForPair(self, other, out _, out _, out var a, out var b);
        var pair = new FastPair { Pair = new(a, b), Time = FastPair.Never };
        if (IsWatched(body, pair.Pair) || !TryFind(a, out pair.ShapeA, out pair.PoseA, out pair.A) || !TryFind(b, out pair.ShapeB, out pair.PoseB, out pair.B)
            || !narrowPhase.WatchesLate(pair.Pair, pair.ShapeA, pair.ShapeB, VelocityOf(pair.A), VelocityOf(pair.B), stepDt, out pair.Inner))
            return;
        pair.SmallerInner = SmallerInner(pair);
        var number = pairs.Count;
        pair.NextOfA = LinkLate(ref pair.A, number, dt);
        pair.NextOfB = LinkLate(ref pair.B, number, dt);
        pairs.Add(pair, pool);
        times.Add(number, pair.Time, pool);
    }

    // A half-space has no inner radius, and reaches farthest.
    float SmallerInner(in FastPair pair)
    {
        var (a, b) = (narrowPhase.RadiiOf(pair.ShapeA), narrowPhase.RadiiOf(pair.ShapeB));
        return a.Radius <= b.Radius ? a.Inner : b.Inner;
    }

    bool IsWatched(int body, in CollidablePair pair)
    {
        for (int i = firstPairs[body]; i >= 0; i = pairs[i].NextOf(body))
        {
            if (pairs[i].Pair.A == pair.A && pairs[i].Pair.B == pair.B)
                return true;
        }
        return false;
    }

    // Of a body of the active set: that of its way, or that which it has.
    BodyVelocity VelocityOf(int body)
    {
        if (body < 0)
            return default;
        var mover = moverOf[body];
        return mover < 0 ? Bodies.ActiveSet.MotionStates[body].Velocity : new(movers[mover].Linear.ToSingle(), movers[mover].Angular.ToSingle());
    }

    // Whoever was not watched was not turned aside by what is: it has come here as it moves.
    int LinkLate(ref int body, int pair, double dt)
    {
        var isNew = body >= 0 && moverOf[body] < 0;
        var index = body;
        var next = Link(ref body, pair);
        if (!isNew)
            return next;
        ref var end = ref Bodies.ActiveSet.MotionStates[index];
        ref var mover = ref movers[body];
        mover.CheckedPosition = end.Pose.Position - end.Velocity.Linear * (float)dt;
        mover.CheckedOrientation = BodyTurn.Turn(end.Pose.Orientation, new(end.Velocity.Angular), -dt);
        mover.Begin(end, dt);
        return next;
    }
}
