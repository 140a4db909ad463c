using System;
using System.Numerics;
using BepuUtilities;
using BepuUtilities.Memory;

namespace BepuPhysics.Constraints.Contact;

// What rests on what moves.
//
// A kinematic body that moves is a floor, and what it carries moves along with it as one rigid thing: all that is said of rest is said of velocities relative
// to that motion, and so is the kinetic energy that the transfer must lower. Impulses between bodies make no difference between the two measures; those of
// the floor do no work on what is at rest on it.
//
// A game changes the velocity of a floor from step to step, and the floor has the new one from the first substep on. Nothing with a mass follows that: where
// a wagon brakes with .3 g, what lies on it would be pushed back with 1.2 g in the first of four substeps, which friction cannot, and slip a little in each
// step. What is meant is a floor that accelerates evenly. So what rests on it gets its new velocity along with it, and is pushed back by the same change
// in equal parts in all substeps: the force of inertia in a wagon that brakes. In the end nothing is added, and contacts have borne m (g + a) all along.
sealed unsafe partial class LoadPathStage
{
    // Greatest change of a floor's velocity in a step, in what acceleration from outside gives a body in that time. What is hit harder is hit.
    internal const float GreatestChange = 1;
    // Changes below this part of a velocity, or of a position in a step, are rounding.
    const float Rounding = 1f / (1 << 21);
    // The same, of what a game makes of a turn and places, as velocities of parts that turn as one.
    const float AlikeShare = 1f / (1 << 18);
    // Greatest acceleration by which a floor that turns takes along what rests on it, in what pulls at that from outside. What goes round faster is left to
    // friction, whose limit is near.
    internal const float GreatestInwardPull = 0.125f;

    // What rests alone on floors whose velocities have changed; not there where there is no floor.
    Buffer<FloorRider> riders;
    // Of each block of bodies: whether any is a floor.
    readonly bool[] hasFloorsIn = new bool[MaximumBlocks];

    bool HasFloors => hasFloorsIn.AsSpan(0, BodyBlockCount).Contains(true);

    bool HasRiders
    {
        get
        {
            for (int block = 0; block < blockCount; ++block)
            {
                if (lone[block].RiderCount > 0)
                    return true;
            }
            return false;
        }
    }

    // Of a kinematic body, whose velocity was copied.
    bool IsFloor(int body) =>
        before[body].Linear != default || before[body].Angular != default || turnsBefore[body].Linear != default || turnsBefore[body].Angular != default;

    // How a kinematic body moves, and did in the last step. Before the first substep its displacement is still that of the last step.
    void FindMotion(int body)
    {
        ref var set = ref bodies.Awake;
        ref var motion = ref set.MotionStates[body];
        var velocity = motion.Velocity.Linear;
        ref var earlier = ref before[body].Angular;
        earlier = velocity;
        ref var turn = ref turnsBefore[body];
        turn = new(motion.Velocity.Angular, motion.Velocity.Angular);
        var displacement = set.Displacements[body].Linear;
        var inverseDt = solver.PreviousDt > 0 ? 1 / solver.PreviousDt : 0;
        // What was put elsewhere, or is new, did not move.
        if (set.Origins[body].Position + displacement == motion.Pose.Position)
        {
            var last = displacement * inverseDt;
            var rounding = Rounding * (Exact.Length(motion.Pose.Position) * inverseDt + Exact.Length(velocity));
            if (Exact.Length(last - velocity) > rounding)
                earlier = last;
            last = set.Displacements[body].Angular * inverseDt;
            if (Exact.Length(last - turn.Linear) > Rounding * Exact.Length(turn.Linear))
                turn.Angular = last;
        }
    }

    // Of what rests on the ground none, and so are its bits as if there were no floors.
    FloorMotion MotionOf(in LoadNode node, float dt)
    {
        if (node.Floor < 0)
            return default;
        ref var motion = ref bodies.Awake.MotionStates[node.Floor];
        return new(motion.Velocity.Linear, motion.Velocity.Angular, motion.Pose.Position, dt * 0.5f);
    }

    bool Turns(in LoadNode node) => node.Floor >= 0 && bodies.Awake.MotionStates[node.Floor].Velocity.Angular != default;

    // Kept arms are not where contacts are, and those contacts of the sweeps are at rest that would be if they were. Who handed momentum down until bodies are
    // at rest where they are would work against the sweeps in each substep.
    void FindLags(int start, int end)
    {
        ref var set = ref bodies.Awake;
        for (int i = start; i < end; ++i)
        {
            ref var node = ref graph.Nodes[i];
            if (!Turns(node))
                continue;
            // All the way down, in the order in which each has its supports.
            node.Lag = default;
            for (int body = node.Body; body >= 0;)
            {
                ref var link = ref graph.Links[graph.Nodes[graph.NodeOf[body]].FirstSupport];
                var lower = link.Lower >= 0 ? link.Lower : SupportLink.Floor(link.Lower);
                if (link.KnowsLower)
                    node.Lag += set.MotionStates[body].Pose.Position - set.MotionStates[lower].Pose.Position + link.ToLower;
                body = link.Lower;
            }
        }
    }

    void FindFloorChange(ref LoadNode node) => FindFloorChange(node.Body, node.Floor, out node.FloorChange, out node.FloorTurnChange);

    // Of the velocity of what moves along with a floor, where a body is.
    void FindFloorChange(int body, int kinematic, out Vector3 linear, out Vector3 angular)
    {
        ref var set = ref bodies.Awake;
        ref var floor = ref set.MotionStates[kinematic];
        angular = TurnChange(floor, turnsBefore[kinematic]);
        linear = Change(floor, before[kinematic]) + Exact.Cross(angular, set.MotionStates[body].Pose.Position - floor.Pose.Position);
    }

    float PartOfChange(int substep) => (substep == 0 ? 1 : 0) - 1f / solver.LastSubstepCount;

    void PushAlong(int start, int end, int substep)
    {
        var part = PartOfChange(substep);
        for (int i = start; i < end; ++i)
        {
            ref var node = ref graph.Nodes[i];
            if (node.Floor >= 0)
                Push(node.Body, node.FloorChange * part, node.FloorTurnChange * part);
        }
    }

    void PushRiders(int block, int substep)
    {
        var part = PartOfChange(substep);
        var found = new Span<FloorRider>(lone[block].Riders, lone[block].RiderCount);
        foreach (ref var rider in found)
        {
            if (substep == 0)
                FindFloorChange(rider.Body, rider.Floor, out rider.FloorChange, out rider.FloorTurnChange);
            Push(rider.Body, rider.FloorChange * part, rider.FloorTurnChange * part);
        }
    }

    void Push(int body, Vector3 linear, Vector3 angular)
    {
        ref var velocity = ref bodies.Awake.MotionStates[body].Velocity;
        velocity.Linear += linear;
        velocity.Angular += angular;
    }

    // What is remembered of a patch for the next step (where its arms end, along which normal and with which friction it pushes) is remembered in the world.
    // On a floor that turns it is to be as it was on the floor. Otherwise a deck that tips leaves the arms behind, which its load does not see as long as
    // they are kept; then it rubs along with the velocity of another place, and walks down the deck by millimetres a second.
    //
    // What tips over turns together, and the arms between its bodies with it, beside what the floor turns. Arms that stayed as they were would have each of
    // the bodies go on along a line, and not round the edge that all of it tips over: those above would be lifted off those below.
    void TurnPatches(int block, float dt)
    {
        ref var set = ref bodies.Awake;
        var start = FirstOf(block, blockCount, graph.Nodes.Count);
        var end = FirstOf(block + 1, blockCount, graph.Nodes.Count);
        if (start == end)
            return;
        var island = graph.IslandOf(start);
        for (int i = start; i < end; ++i)
        {
            while (i >= graph.Islands[island + 1])
                ++island;
            ref var node = ref graph.Nodes[i];
            var floor = node.Floor >= 0 ? set.MotionStates[node.Floor].Velocity.Angular : default;
            var tips = graph.Nodes[graph.Islands[island]].Tips;
            if (floor == default && !tips)
                continue;
            var turn = TurnIn(dt, floor);
            for (int j = node.FirstSupport; j < node.FirstSupport + node.SupportCount; ++j)
            {
                ref var link = ref graph.Links[j];
                if (floor != default)
                    link.Turn(turn);
                if (tips && link.Lower >= 0)
                {
                    var both = set.MotionStates[node.Body].Velocity.Angular + set.MotionStates[link.Lower].Velocity.Angular;
                    link.TurnArms(TurnIn(dt, both * 0.5f - floor));
                }
            }
        }
    }

    // The same of what is held alone on a floor, and is no node.
    void TurnLone(ref TypeBatch batch, int bundle, int count, Vector<int> lanes, float dt)
    {
        ref var set = ref bodies.Awake;
        var references = (Vector<int>*)batch.BodyReferences.Memory + 2 * bundle;
        var prestep = (float*)((Vector<float>*)batch.Prestep.Memory + bundle * ContactPrestepLayout.PrestepFloats(count));
        var impulses = (float*)((Vector<float>*)batch.AccumulatedImpulses.Memory + bundle * ContactPrestepLayout.ImpulseFloats(count));
        lanes &= SupportFinder.AreFixed(references[1]);
        for (var left = Wide.Bits(lanes); left != 0; left &= left - 1)
        {
            var lane = BitOperations.TrailingZeroCount(left);
            if (graph.Nodes.Count > 0 && graph.NodeOf[references[0][lane] & EncodedBody.IndexMask] >= 0)
                continue;
            var link = new SupportLink { Prestep = prestep + lane, Impulses = impulses + lane, Count = (byte)count };
            link.Turn(TurnIn(dt, set.MotionStates[references[1][lane] & EncodedBody.IndexMask].Velocity.Angular));
        }
    }

    // The third power of an angle of a step is left.
    static Quaternion TurnIn(float dt, Vector3 angular)
    {
        var half = angular * (dt * 0.5f);
        var length = MathF.Sqrt(1 + Exact.LengthSquared(half));
        return new(half / length, 1 / length);
    }

    // What a game gave a floor since the last step. Where callbacks change its velocity in each substep, that alone is its acceleration.
    static Vector3 Change(in MotionState floor, in BodyVelocity before) =>
        floor.Velocity.Linear == before.Linear ? before.Linear - before.Angular : default;

    static Vector3 TurnChange(in MotionState floor, in BodyVelocity turnsBefore) =>
        floor.Velocity.Angular == turnsBefore.Linear ? turnsBefore.Linear - turnsBefore.Angular : default;

    readonly partial struct Motions(Solver solver, Buffer<MotionState> motions, Buffer<BodyVelocity> before, Buffer<BodyVelocity> turnsBefore,
        Buffer<BodyInertia> inertias, Buffer<ConstraintList> constraints, int substepCount, float dt) : IHeights, IFloors
    {
        public float Of(int body) => -Exact.Dot(motions[body].Pose.Position, Gain(body));

        public bool MoveAlike(int kinematic, int other)
        {
            ref var turn = ref turnsBefore[kinematic];
            ref var turnOfOther = ref turnsBefore[other];
            if (turn.Linear != turnOfOther.Linear || turn.Angular != turnOfOther.Angular)
                return false;
            ref var own = ref before[kinematic];
            ref var others = ref before[other];
            if (turn.Linear == default && turn.Angular == default)
                return own.Linear == others.Linear && own.Angular == others.Angular;
            var offset = motions[other].Pose.Position - motions[kinematic].Pose.Position;
            return IsAlike(own.Linear, Exact.Cross(turn.Linear, offset), others.Linear) &&
                IsAlike(own.Angular, Exact.Cross(turn.Angular, offset), others.Angular);
        }

        // Velocities of parts that a game turns as one are rounded.
        static bool IsAlike(Vector3 linear, Vector3 turning, Vector3 other) =>
            Exact.Length(linear + turning - other) <= AlikeShare * (Exact.Length(linear) + Exact.Length(turning));

        // The velocity of the last step of what moves along with a kinematic body, where another body is.
        Vector3 Earlier(int kinematic, int body) => Exact.VelocityAt(
            before[kinematic].Angular, turnsBefore[kinematic].Angular, motions[body].Pose.Position - motions[kinematic].Pose.Position);

        public bool RestsOn(int body, int kinematic)
        {
            var gain = Gain(body);
            var squared = Exact.LengthSquared(gain);
            return Rests(before[body].Linear - Earlier(kinematic, body), gain, squared) && Follows(kinematic, body, gain, squared) &&
                GoesRoundSlowly(body, kinematic, squared);
        }

        public bool Sways(int body, int kinematic)
        {
            var gain = Gain(body);
            var squared = Exact.LengthSquared(gain);
            var velocity = before[body].Linear;
            if (kinematic >= 0)
                velocity -= Earlier(kinematic, body);
            var most = SupportFinder.SwayingShare * QuietSteps * substepCount;
            return Exact.LengthSquared(velocity) < most * most * squared && (kinematic < 0 ||
                (Follows(kinematic, body, gain, squared) && GoesRoundSlowly(body, kinematic, squared)));
        }

        public bool IsBalanced(in SupportLink support, int kinematic, ref StandingLoad load)
        {
            Add(support.Upper, kinematic, ref load);
            return load.IsOver([new LoadSupport(support)], motions[support.Upper].Pose.Position);
        }

        public bool IsBalanced(ReadOnlySpan<SupportLink> supports, int kinematic, ref StandingLoad load, Span<StandingLoad> parts)
        {
            var body = supports[0].Upper;
            Add(body, kinematic, ref load);
            Span<LoadSupport> read = stackalloc LoadSupport[SupportGraph.MaximumSupports];
            read = read[..supports.Length];
            float radius = 0;
            for (int i = 0; i < supports.Length; ++i)
            {
                read[i] = new LoadSupport(supports[i]);
                radius = MathHelper.Max(radius, supports[i].Radius);
            }
            var position = motions[body].Pose.Position;
            return load.IsOver(read, position) && load.ShareOut(read, position, radius, parts);
        }

        void Add(int body, int kinematic, ref StandingLoad load)
        {
            var velocity = before[body].Linear;
            if (kinematic >= 0)
                velocity -= Earlier(kinematic, body);
            load.Add(1 / inertias[body].InverseMass, motions[body].Pose.Position, velocity, Gain(body) * (1 / dt));
        }

        public int CountConstraints(int body) => constraints[body].Count;

        bool GoesRoundSlowly(int body, int kinematic, float squared)
        {
            ref var turn = ref turnsBefore[kinematic].Linear;
            if (turn == default)
                return true;
            var inwards = Exact.Cross(turn, Exact.Cross(turn, motions[body].Pose.Position - motions[kinematic].Pose.Position)) * dt;
            return Exact.LengthSquared(inwards) < GreatestInwardPull * GreatestInwardPull * squared;
        }

        // Whether what stands on a floor follows the change of its velocity.
        bool Follows(int kinematic, int body, Vector3 gain, float squared)
        {
            var change = Change(motions[kinematic], before[kinematic]) + Exact.Cross(TurnChange(motions[kinematic], turnsBefore[kinematic]),
                motions[body].Pose.Position - motions[kinematic].Pose.Position);
            // Against what pulls at the body it is only pressed on.
            var against = MathHelper.Min(0, Exact.Dot(change, gain));
            var greatest = GreatestChange * substepCount;
            return Exact.LengthSquared(change) * squared - against * against <= greatest * greatest * squared * squared;
        }

        // As it is found for what rests on the ground.
        bool Rests(Vector3 velocity, Vector3 gain, float squared)
        {
            var resting = SupportFinder.RestingSteps * SupportFinder.RestingSteps * squared;
            if (Exact.LengthSquared(velocity) < resting)
                return true;
            var fall = Exact.Dot(velocity, gain);
            if (!(fall > 0))
                return false;
            fall = MathHelper.Min(fall / squared, SupportFinder.FallingShare * QuietSteps * substepCount);
            var aside = MathHelper.Min(resting, fall * fall * squared * SupportFinder.StraightShare * SupportFinder.StraightShare);
            return Exact.LengthSquared(velocity - gain * fall) < aside;
        }

        Vector3 Gain(int body) => motions[body].Velocity.Linear - before[body].Linear;
    }
}
