using System;
using System.Numerics;
using BepuUtilities;
using BepuUtilities.Memory;

namespace BepuPhysics.Constraints.Contact;

// What rests on what moves.
//
// A kinematic body that moves and does not turn is a floor, and what it carries moves along with it: all that is said of rest is said of velocities relative
// to the floor, and so is the kinetic energy that the transfer must lower.
//
// A game changes the velocity of a floor from step to step, and the floor has the new one from the first substep on. Nothing with a mass follows that: where
// a wagon brakes with .3 g, what lies on it would be pushed back with 1.2 g in the first of four substeps, which friction cannot, and slip a little in each
// step. What is meant is a floor that accelerates evenly. So what rests on it gets its new velocity along with it, and is pushed back by the same change
// in equal parts in all substeps: the force of inertia in a wagon that brakes. In the end nothing is added, and contacts have borne m (g + a) all along.
sealed unsafe partial class LoadPathStage
{
    // Greatest change of a floor's velocity in a step, in what acceleration from outside gives a body in that time. What is hit harder is hit.
    const float GreatestChange = 1;
    // Changes below this part of a velocity, or of a position in a step, are rounding.
    const float Rounding = 1f / (1 << 21);

    // Of each block of bodies: whether any is a floor.
    readonly bool[] hasFloorsIn = new bool[MaximumBlocks];

    bool HasFloors => hasFloorsIn.AsSpan(0, BodyBlockCount).Contains(true);

    // Whether a kinematic body moves, or did in the last step. Before the first substep its displacement is still that of the last step.
    bool IsFloor(int body)
    {
        ref var set = ref bodies.Awake;
        ref var motion = ref set.MotionStates[body];
        var velocity = motion.Velocity.Linear;
        ref var earlier = ref before[body].Angular;
        earlier = velocity;
        var displacement = set.Displacements[body].Linear;
        var inverseDt = solver.PreviousDt > 0 ? 1 / solver.PreviousDt : 0;
        // What was put elsewhere, or is new, did not move.
        if (set.Origins[body].Position + displacement == motion.Pose.Position)
        {
            var last = displacement * inverseDt;
            var rounding = Rounding * (Exact.Length(motion.Pose.Position) * inverseDt + Exact.Length(velocity));
            if (Exact.Length(last - velocity) > rounding)
                earlier = last;
        }
        return velocity != default || earlier != default;
    }

    // Of what rests on the ground none, and so are its bits as if there were no floors.
    Vector3 FloorVelocity(in LoadNode node) => node.Floor < 0 ? default : bodies.Awake.MotionStates[node.Floor].Velocity.Linear;

    void PushAlong(int start, int end, int substep)
    {
        ref var set = ref bodies.Awake;
        var part = -1f / solver.LastSubstepCount;
        if (substep == 0)
            part += 1;
        for (int i = start; i < end; ++i)
        {
            ref var node = ref graph.Nodes[i];
            if (node.Floor >= 0)
                set.MotionStates[node.Body].Velocity.Linear += node.FloorChange * part;
        }
    }

    // What a game gave a floor since the last step. Where callbacks change its velocity in each substep, that alone is its acceleration.
    static Vector3 Change(in MotionState floor, in BodyVelocity before) =>
        floor.Velocity.Linear == before.Linear ? before.Linear - before.Angular : default;

    readonly struct Motions(Buffer<MotionState> motions, Buffer<BodyVelocity> before, Buffer<BodyInertia> inertias, Buffer<ConstraintList> constraints,
        int substepCount, float dt) : IHeights, IFloors
    {
        public float Of(int body) => -Exact.Dot(motions[body].Pose.Position, Gain(body));

        public bool MoveAlike(int kinematic, int other) =>
            before[kinematic].Linear == before[other].Linear && before[kinematic].Angular == before[other].Angular;

        public bool RestsOn(int body, int kinematic)
        {
            var gain = Gain(body);
            var squared = Exact.LengthSquared(gain);
            return Rests(before[body].Linear - before[kinematic].Angular, gain, squared) && Follows(kinematic, gain, squared);
        }

        public bool Sways(int body, int kinematic)
        {
            var gain = Gain(body);
            var squared = Exact.LengthSquared(gain);
            var velocity = before[body].Linear;
            if (kinematic >= 0)
                velocity -= before[kinematic].Angular;
            var most = SupportFinder.SwayingShare * QuietSteps * substepCount;
            return Exact.LengthSquared(velocity) < most * most * squared && (kinematic < 0 || Follows(kinematic, gain, squared));
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
                velocity -= before[kinematic].Angular;
            load.Add(1 / inertias[body].InverseMass, motions[body].Pose.Position, velocity, Gain(body) * (1 / dt));
        }

        public int CountConstraints(int body) => constraints[body].Count;

        // Whether what stands on a floor follows the change of its velocity.
        bool Follows(int kinematic, Vector3 gain, float squared)
        {
            var change = Change(motions[kinematic], before[kinematic]);
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
