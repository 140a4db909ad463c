using System;
using System.Numerics;
using BepuUtilities;
using BepuUtilities.Memory;

namespace BepuPhysics.Constraints.Contact;

/// <summary>Brings an island to rest whose bodies lean on each other, or sway.</summary>
/// <remarks>
/// Sweeps over its patches, there and back, each row solved exactly and within its bounds, as the solver's sweeps do: so each of them lowers the kinetic
/// energy. Between them the impulses go on in the direction of the rounds before, conjugate to what they have changed (Silcowitz, Niebuhr and Erleben,
/// A nonsmooth nonlinear conjugate gradient method for interactive contact force problems, 2010): a sweep alone would take some n^2 of them for n bodies
/// in a row. What is done ends with a sweep, hence within all bounds.
/// </remarks>
/// <param name="nodes">Its bodies.</param>
/// <param name="supports">Their supports, as they were read.</param>
/// <param name="patches">As many, of which the nodes are written.</param>
/// <param name="motions">Of the active set.</param>
/// <param name="inertias">Of the active set.</param>
/// <param name="floor">How that moves on which they come to rest.</param>
readonly unsafe ref partial struct LoadRelaxation(
    Span<LoadNode> nodes, Span<LoadSupport> supports, Span<PatchRelaxation> patches, Buffer<MotionState> motions, Buffer<BodyInertia> inertias,
    in FloorMotion floor)
{
    // There and back is a round. An arch that has just been put down stands with twelve of them if it has thirteen stones, with 32 if 21, with 128 if 31; what
    // stands takes few. With fewer a small arch of thirteen creeps by what they leave.
    const int MaximumRounds = 192;
    // The same where none leans: what was handed down before has left little. With 48 a wall that rocked took three times as long, and stood no better.
    // And of what leans in no row, as rubble does: that moves on in the next substep, and was never at rest after any number.
    internal const int RoundsOfStructure = 16;
    // And for who asks for what tips over: a wall of 16 rows tips over in its time with eight of them, one of 30 rows with 32.
    internal const int RoundsOfTipping = 32;
    // Part of what the first round has changed, as energy, below which a round changes nothing.
    const float LeastChange = 1e-6f;

    readonly Span<LoadNode> nodes = nodes;
    readonly Span<LoadSupport> supports = supports;
    readonly Span<PatchRelaxation> patches = patches;
    readonly FloorMotion floor = floor;

    // A body that impulses of the present patch move.
    ref struct Moved
    {
        internal Vector3 Linear, Angular;
        internal float InverseMass;
        internal Symmetric3x3 InverseInertia;

        internal void Push(Vector3 impulse, Vector3 torque)
        {
            Linear += impulse * InverseMass;
            Angular += InverseInertia * torque;
        }
    }

    /// <summary>Relaxes the island; what that changes is in the nodes and supports.</summary>
    /// <param name="roundsOfOthers">Most rounds of what does not lean in a row.</param>
    /// <returns>How many rounds it took.</returns>
    internal int Run(int roundsOfOthers)
    {
        for (int i = 0; i < patches.Length; ++i)
            Prepare(i);
        float before = 0, first = 0;
        var most = LeansInARow() ? MaximumRounds : roundsOfOthers;
        for (int round = 1; ; ++round)
        {
            for (int i = 0; i < patches.Length; ++i)
                patches[i].Start = supports[i].Present;
            for (int i = patches.Length - 1; i >= 0; --i)
                Solve(i);
            for (int i = 0; i < patches.Length; ++i)
                Solve(i);
            if (round == most)
                return round;
            var change = Change();
            if (round == 1)
                first = change;
            if (!(change > LeastChange * first))
                return round;
            // Where rounds change more and more, what went before was no good direction.
            Follow(round > 1 && change < before ? change / before : 0);
            before = change;
        }
    }

    // Whether bodies lean as the stones of an arch, each on one on either side: what stands on some of them is let be. Each patch then has one way on, and a
    // load goes all along. Of rubble that leans each body has three neighbours or four.
    bool LeansInARow()
    {
        int bodies = 0, neighbours = 0;
        foreach (ref readonly var node in nodes)
            bodies += node.Leans ? 1 : 0;
        foreach (ref readonly var patch in patches)
            neighbours += Leans(patch.Upper) + Leans(patch.Lower);
        return bodies > 0 && 2 * neighbours <= 5 * bodies;
    }

    int Leans(int node) => node >= 0 && nodes[node].Leans ? 1 : 0;

    void Prepare(int index)
    {
        ref var patch = ref patches[index];
        ref var support = ref supports[index];
        patch.Direction = default;
        Read(patch.Upper, out var upper);
        Read(patch.Lower, out var lower);
        for (int i = 0; i < support.Count; ++i)
        {
            var a = Exact.Cross(support.Arms[i], support.Normal);
            var b = Exact.Cross(support.Arms[i] - support.ToLower, support.Normal);
            patch.Masses[i] = 1 / (upper.InverseMass + lower.InverseMass + Exact.Dot(a, upper.InverseInertia * a) + Exact.Dot(b, lower.InverseInertia * b));
        }
        var x = MathF.Abs(support.Normal.X) < 0.7f ? new Vector3(1, 0, 0) : new Vector3(0, 1, 0);
        patch.X = Exact.Normalize(x - support.Normal * Exact.Dot(x, support.Normal));
        patch.Y = Exact.Cross(support.Normal, patch.X);
        var armB = support.Center - support.ToLower;
        Vector3 ax = Exact.Cross(support.Center, patch.X), ay = Exact.Cross(support.Center, patch.Y);
        Vector3 bx = Exact.Cross(armB, patch.X), by = Exact.Cross(armB, patch.Y);
        var mass = upper.InverseMass + lower.InverseMass;
        var xx = mass + Exact.Dot(ax, upper.InverseInertia * ax) + Exact.Dot(bx, lower.InverseInertia * bx);
        var yx = Exact.Dot(ax, upper.InverseInertia * ay) + Exact.Dot(bx, lower.InverseInertia * by);
        var yy = mass + Exact.Dot(ay, upper.InverseInertia * ay) + Exact.Dot(by, lower.InverseInertia * by);
        var inverse = 1 / (xx * yy - yx * yx);
        patch.MassXX = yy * inverse;
        patch.MassYX = -yx * inverse;
        patch.MassYY = xx * inverse;
        var turn = Exact.Dot(support.Normal, upper.InverseInertia * support.Normal) + Exact.Dot(support.Normal, lower.InverseInertia * support.Normal);
        patch.TwistMass = turn > 0 ? 1 / turn : 0;
    }

    void Read(int index, out Moved body)
    {
        body = default;
        if (index < 0)
            return;
        ref var node = ref nodes[index];
        ref var inertia = ref inertias[node.Body];
        ref var motion = ref motions[node.Body];
        body.InverseMass = inertia.InverseMass;
        body.InverseInertia = inertia.InverseInertiaTensor;
        body.Linear = motion.Velocity.Linear - floor.At(motion.Pose.Position - node.Lag) + node.Linear * body.InverseMass;
        body.Angular = motion.Velocity.Angular - floor.Angular + body.InverseInertia * node.Angular;
    }

    void Solve(int index)
    {
        ref var patch = ref patches[index];
        ref var support = ref supports[index];
        Read(patch.Upper, out var upper);
        Read(patch.Lower, out var lower);
        Vector3 linear = default, angular = default;
        float load = 0, lever = 0;
        for (int i = 0; i < support.Count; ++i)
        {
            if ((support.Open & 1 << i) == 0)
            {
                var arm = support.Arms[i];
                var velocity = Exact.Dot(support.Normal, Apart(support, upper, lower, arm));
                var total = MathHelper.Max(0, support.After[i] - velocity * patch.Masses[i]);
                Push(support, ref upper, ref lower, support.Normal * (total - support.After[i]), arm, ref linear, ref angular);
                support.After[i] = total;
            }
            load += support.After[i];
            lever += support.After[i] * Exact.Distance(support.Arms[i], support.Center);
        }
        var across = Apart(support, upper, lower, support.Center);
        float vx = Exact.Dot(across, patch.X), vy = Exact.Dot(across, patch.Y);
        var friction = support.FrictionAfter - patch.X * (patch.MassXX * vx + patch.MassYX * vy) - patch.Y * (patch.MassYX * vx + patch.MassYY * vy);
        friction = LoadTransfer.Limit(friction, support.Friction * load);
        Push(support, ref upper, ref lower, friction - support.FrictionAfter, support.Center, ref linear, ref angular);
        support.FrictionAfter = friction;
        var twist = support.TwistAfter - Exact.Dot(support.Normal, upper.Angular - lower.Angular) * patch.TwistMass;
        twist = Math.Clamp(twist, -support.Friction * lever, support.Friction * lever);
        angular += support.Normal * (twist - support.TwistAfter);
        support.TwistAfter = twist;
        Add(patch, support, linear, angular);
    }

    static Vector3 Apart(in LoadSupport support, in Moved upper, in Moved lower, Vector3 arm) =>
        upper.Linear + Exact.Cross(upper.Angular, arm) - lower.Linear - Exact.Cross(lower.Angular, arm - support.ToLower);

    static void Push(
        in LoadSupport support, ref Moved upper, ref Moved lower, Vector3 impulse, Vector3 arm, ref Vector3 linear, ref Vector3 angular)
    {
        var torque = Exact.Cross(arm, impulse);
        upper.Push(impulse, torque);
        lower.Push(-impulse, -Exact.Cross(arm - support.ToLower, impulse));
        linear += impulse;
        angular += torque;
    }

    void Add(in PatchRelaxation patch, in LoadSupport support, Vector3 linear, Vector3 angular)
    {
        nodes[patch.Upper].Linear += linear;
        nodes[patch.Upper].Angular += angular;
        if (patch.Lower < 0)
            return;
        nodes[patch.Lower].Linear -= linear;
        nodes[patch.Lower].Angular -= angular - Exact.Cross(support.ToLower, linear);
    }

    // What the round has changed: the squares of the impulses over the masses that they move.
    float Change()
    {
        float sum = 0;
        for (int index = 0; index < patches.Length; ++index)
        {
            ref var patch = ref patches[index];
            ref var support = ref supports[index];
            for (int i = 0; i < support.Count; ++i)
            {
                var normal = support.After[i] - patch.Start.Normals[i];
                sum += normal * normal / patch.Masses[i];
            }
            sum += 2 * Exact.LengthSquared(support.FrictionAfter - patch.Start.Friction) / (patch.MassXX + patch.MassYY);
            var twist = support.TwistAfter - patch.Start.Twist;
            sum += patch.TwistMass > 0 ? twist * twist / patch.TwistMass : 0;
        }
        return sum;
    }

    // Goes on in the direction of the rounds before, by a share of it, and takes what this round has changed into the direction.
    void Follow(float share)
    {
        for (int index = 0; index < patches.Length; ++index)
        {
            ref var patch = ref patches[index];
            ref var support = ref supports[index];
            PatchImpulses more;
            more.Friction = patch.Direction.Friction * share;
            more.Twist = patch.Direction.Twist * share;
            more.Normals = default;
            for (int i = 0; i < support.Count; ++i)
            {
                more.Normals[i] = patch.Direction.Normals[i] * share;
                patch.Direction.Normals[i] = more.Normals[i] + (support.After[i] - patch.Start.Normals[i]);
                support.After[i] += more.Normals[i];
            }
            patch.Direction.Friction = more.Friction + (support.FrictionAfter - patch.Start.Friction);
            support.FrictionAfter += more.Friction;
            patch.Direction.Twist = more.Twist + (support.TwistAfter - patch.Start.Twist);
            support.TwistAfter += more.Twist;
            if (share == 0)
                continue;
            support.Sum(more, out var linear, out var angular);
            Add(patch, support, linear, angular);
        }
    }
}
