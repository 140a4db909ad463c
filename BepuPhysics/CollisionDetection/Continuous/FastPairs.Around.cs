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

    // What a look finds is kept for so many; who finds more looks again.
    const int FoundPerLook = 8;

    // A body that was thrown aside.
    struct Look
    {
        public int Body;
        // What its new way may meet, and what was known of its bounds before.
        public BoundingBox Way, Known;
        public int FoundCount;
    }

    // Those whom the solver has thrown aside in a substep, and what they have found. These have memory from the first one on.
    QuickList<Look> looks;
    QuickList<CollidableReference> found;
    // What the new way of a body may meet.
    QuickList<CollidableReference> near;
    // Length of the step, s, and its end from the beginning of the substep.
    float stepDt;
    double stepEnd;
    // End of the substep, s from the beginning of the step.
    double substepEnd;

    // In the order of slots: that of the tree depends on its shape.
    struct ByOrder : IComparerRef<CollidableReference>
    {
        public readonly int Compare(ref CollidableReference a, ref CollidableReference b) =>
            (a.Packed & CollidableReference.OrderMask).CompareTo(b.Packed & CollidableReference.OrderMask);
    }

    // Most of what is found is watched already.
    struct NearList(FastPairs owner, int body, CollidableReference self) : IBreakableForEach<CollidableReference>
    {
        public readonly bool LoopBody(CollidableReference collidable)
        {
            if (collidable != self && !owner.IsWatched(body, collidable))
                owner.near.Add(collidable, owner.Pool);
            return true;
        }
    }

    struct FoundList(FastPairs owner, int body, CollidableReference self, CollidableReference* places) : IBreakableForEach<CollidableReference>
    {
        public int Count;

        public bool LoopBody(CollidableReference collidable)
        {
            if (collidable == self || owner.IsWatched(body, collidable))
                return true;
            if (Count < FoundPerLook)
                places[Count] = collidable;
            ++Count;
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
            Inner = inner,
            Radius = radius,
            TurningRadius = inner < radius ? radius : 0,
            Look = -1,
            MayHaveOthers = MayBeSlow(set.IndexToHandle[body]),
            IsBall = shape.Exists && shape.Type == Sphere.Id,
            UnforeseenSpeed = UnforeseenPart * inner / stepDt,
            ForeseenLinear = new(motion.Velocity.Linear),
            Linear = new(motion.Velocity.Linear),
            Angular = new(motion.Velocity.Angular),
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
            mover.Velocity = velocity;
        }
    }

    /// <summary>Finds out whom the solver has thrown aside, and grows their bounds.</summary>
    internal void GrowTurnedAside(double end)
    {
        stepEnd = end;
        looks.Count = 0;
        for (int i = 0; i < movers.Count; ++i)
        {
            if (!thrown[i] || !TryGrow(i, 0, out var look))
                continue;
            if (!looks.Span.Allocated)
                (looks, found) = (new(16, pool), new(16 * FoundPerLook, pool));
            movers[i].Look = looks.Count;
            looks.Add(look, pool);
        }
        if (looks.Count == 0)
            return;
        found.EnsureCapacity(looks.Count * FoundPerLook, pool);
        found.Count = looks.Count * FoundPerLook;
    }

    /// <summary>Looks around for a part of those who were thrown aside.</summary>
    internal void LookAll(int block, int blockCount)
    {
        for (int i = StartOf(block, blockCount, looks.Count); i < StartOf(block + 1, blockCount, looks.Count); ++i)
        {
            var list = new FoundList(this, looks[i].Body, ReferenceOf(looks[i].Body), found.Span.Memory + i * FoundPerLook);
            simulation.BroadPhase.FindOverlapping(looks[i].Way, ref list);
            looks[i].FoundCount = list.Count;
        }
    }

    void PairTurnedAside(double dt)
    {
        for (int i = 0; i < looks.Count; ++i)
        {
            if (looks[i].FoundCount > FoundPerLook)
            {
                FindNear(looks[i]);
            }
            else
            {
                ClearNear();
                for (int j = 0; j < looks[i].FoundCount; ++j)
                    near.Add(found[i * FoundPerLook + j], pool);
            }
            var first = pairs.Count;
            PairWithNear(looks[i], i, dt);
            for (int j = first; j < pairs.Count; ++j)
            {
                Find(ref pairs[j], 0, dt, pool);
                times.Change(j, pairs[j].Time, pool);
            }
        }
    }

    /// <summary>Pairs a body that moves otherwise than was foreseen with all that is new on its way.</summary>
    void LookAround(int body, double time, double dt)
    {
        if (body < 0 || !movers[body].IsUnforeseen || !TryGrow(body, time, out var look))
            return;
        FindNear(look);
        PairWithNear(look, looks.Count, dt);
    }

    // Of a body that moves otherwise than was foreseen.
    bool TryGrow(int body, double time, out Look look)
    {
        ref var mover = ref movers[body];
        look = default;
        if (knowsApart)
            LookAtPairsOf(body);
        mover.ForeseenLinear = mover.Linear;
        mover.ForeseenSpin = mover.Angular.Length;
        var leaf = Bodies.ActiveSet.Collidables[mover.Index].BroadPhaseIndex;
        if (leaf < 0)
            return false;
        // The farthest point of the shape from its centre, in any direction: a turn changes nothing of that.
        var reach = new Vector3((float)mover.Radius);
        Vector3 from = mover.PositionAt(time).ToSingle(), to = mover.PositionAt(stepEnd).ToSingle();
        var tree = simulation.BroadPhase.ActiveTree;
        look.Body = body;
        look.Way = new(Exact.Min(from, to) - reach, Exact.Max(from, to) + reach);
        look.Known = tree.GetBounds(leaf);
        // Whatever meets the bounds that it began with, or those of its last look, was found then, and is watched; and whoever has come to meet them since has
        // looked, and found this one. Of bounds that have grown this does not hold: a box around two contains more than both.
        if (!mover.MayHaveOthers && BoundingBox.Contains(mover.HasLooked ? mover.Searched : look.Known, look.Way))
            return false;
        mover.HasLooked = true;
        mover.Searched = look.Way;
        tree.UpdateBounds(leaf, Exact.Min(look.Way.Min, look.Known.Min), Exact.Max(look.Way.Max, look.Known.Max));
        return true;
    }

    CollidableReference ReferenceOf(int body) => BepuPhysics.Bodies.ReferenceAt(Bodies.ActiveSet, movers[body].Index);

    void ClearNear()
    {
        if (!near.Span.Allocated)
            near = new(16, pool);
        near.Count = 0;
    }

    void FindNear(in Look look)
    {
        ClearNear();
        var list = new NearList(this, look.Body, ReferenceOf(look.Body));
        simulation.BroadPhase.FindOverlapping(look.Way, ref list);
    }

    // All have grown before any looks. Who comes later finds whoever came before with its bounds as they are now, and is found with those that it had.
    void PairWithNear(in Look look, int number, double dt)
    {
        var self = ReferenceOf(look.Body);
        var order = new ByOrder();
        QuickSort.Sort(near.AsSpan(), ref order);
        for (int i = 0; i < near.Count; ++i)
        {
            if (LookOf(near[i]) is var other && other > number && !BoundingBox.Intersects(look.Way, looks[other].Known))
                continue;
            Pair(look.Body, self, near[i], dt);
        }
    }

    // -1 for who was not thrown aside by the solver.
    int LookOf(CollidableReference collidable)
    {
        if (collidable.Mobility == CollidableMobility.Static || Bodies.IsAsleep(collidable.Slot))
            return -1;
        var mover = moverOf[Bodies.Locations[collidable.Slot].Index];
        return mover < 0 ? -1 : movers[mover].Look;
    }

    void Pair(int body, CollidableReference self, CollidableReference other, double dt)
    {
        if (!TryMakePair(body, self, other, out var pair))
            return;
        var number = pairs.Count;
        pair.IsLate = true;
        pair.NextOfA = LinkLate(ref pair.A, number, dt);
        pair.NextOfB = LinkLate(ref pair.B, number, dt);
        pairs.Add(pair, pool);
        times.Add(number, pair.Time, pool);
    }

    void PairFromTheBeginning(int body, CollidableReference self, CollidableReference other)
    {
        if (!TryMakePair(body, self, other, out var pair))
            return;
        pair.NextOfA = Link(ref pair.A, pairs.Count);
        pair.NextOfB = Link(ref pair.B, pairs.Count);
        pairs.Add(pair, pool);
    }

    bool TryMakePair(int body, CollidableReference self, CollidableReference other, out FastPair pair)
    {
        pair = default;
        // Who came before may have found it.
        if (IsWatched(body, other))
            return false;
        NarrowPhase.SortCollidableReferencesForPair(self, other, out _, out _, out var a, out var b);
        pair = new FastPair { Pair = new(a, b), Time = FastPair.Never };
        if (!TryFind(a, out pair.ShapeA, out pair.PoseA, out pair.A) ||
            !TryFind(b, out pair.ShapeB, out pair.PoseB, out pair.B))
            return false;
        if (narrowPhase.WatchesLate(pair.Pair, pair.ShapeA, pair.ShapeB, VelocityOf(pair.A), VelocityOf(pair.B), stepDt, out pair.Inner))
            return true;
        HaveOthers(pair.A);
        HaveOthers(pair.B);
        return false;
    }

    // Whether a body's pair with something is watched.
    bool IsWatched(int body, CollidableReference other)
    {
        for (int i = firstPairs[body]; i >= 0;)
        {
            ref var pair = ref pairs[i];
            var isA = pair.A == body;
            if ((isA ? pair.Pair.B : pair.Pair.A) == other)
                return true;
            i = isA ? pair.NextOfA : pair.NextOfB;
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
        mover.MayHaveOthers = true;
        narrowPhase.Restitution.Strikes[index] = default;
        mover.CheckedPosition = end.Pose.Position - end.Velocity.Linear * (float)dt;
        mover.CheckedOrientation = BodyTurn.Turn(end.Pose.Orientation, new(end.Velocity.Angular), -dt);
        mover.Begin(end, dt);
        return next;
    }
}
