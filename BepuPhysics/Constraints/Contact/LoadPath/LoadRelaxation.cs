using System;
using System.Numerics;
using System.Runtime.Intrinsics;
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
/// <param name="bodies">Room for one more than there are bodies.</param>
/// <param name="motions">Of the active set.</param>
/// <param name="inertias">Of the active set.</param>
/// <param name="floor">How that moves on which they come to rest.</param>
readonly unsafe ref partial struct LoadRelaxation(Span<LoadNode> nodes, Span<LoadSupport> supports, PatchRelaxation* patches, BodyRelaxation* bodies,
    Buffer<MotionState> motions, Buffer<BodyInertia> inertias, in FloorMotion floor)
{
    // There and back is a round. An arch that has just been put down stands with twelve of them if it has thirteen stones, with 32 if 21, with 128 if 31; what
    // stands takes few. With fewer a small arch of thirteen creeps by what they leave.
    const int MaximumRounds = 192;
    // The same where none leans: what was handed down before has left little. With 16 a house of four storeys that landed moving aside ended 7 mm aside in the
    // mean, and not 1. A wall that tips over does so in its time with eight of them, one of 30 rows with 32.
    const int RoundsOfStructure = 32;
    // And of what leans in no row, as rubble does: that moves on in the next substep, and was never at rest after any number.
    const int RoundsOfRubble = 16;
    // Part of what the first round has changed, as energy, below which a round changes nothing.
    const float LeastChange = 1e-6f;
    // Part of what a substep of acceleration gives, as energy, below which a round changes nothing where there is more to come in the next substep: that is
    // .02 of the velocity, from which on the load path works at all. An arch would creep by it, and a wall that tips over would do so too early.
    const float LeastShare = 4e-4f;

    readonly Span<LoadNode> nodes = nodes;
    readonly Span<LoadSupport> supports = supports;
    readonly PatchRelaxation* patches = patches;
    // The one before the first stands for what does not move: its node is -1.
    readonly BodyRelaxation* bodies = bodies + 1;
    readonly FloorMotion floor = floor;

    /// <summary>Relaxes the island; what that changes is in the nodes and supports.</summary>
    /// <param name="mayTip">Whether what tips over is to do so in its time.</param>
    /// <returns>How many rounds it took.</returns>
    internal int Run(bool mayTip)
    {
        Begin();
        var most = MostRounds();
        var rounds = RunRounds(most, mayTip || most == MaximumRounds ? 0 : LeastShare * Gain());
        End();
        return rounds;
    }

    int RunRounds(int most, float least)
    {
        var end = patches + supports.Length;
        float before = 0, first = 0;
        for (int round = 1; ; ++round)
        {
            for (var patch = end - 1; patch >= patches; --patch)
                patch->Solve(bodies);
            for (var patch = patches; patch < end; ++patch)
                patch->Solve(bodies);
            if (round == most)
                return round;
            var change = Change();
            if (round == 1)
                first = change;
            if (!(change > MathHelper.Max(least, LeastChange * first)))
                return round;
            // Where rounds change more and more, what went before was no good direction.
            Follow(round > 1 && change < before ? change / before : 0);
            before = change;
        }
    }

    // What pulls at the bodies for a substep gives them, in the measure of what a round changes.
    float Gain()
    {
        float sum = 0;
        foreach (ref readonly var node in nodes)
            sum += node.Gain * node.Gain / inertias[node.Body].InverseMass;
        return sum;
    }

    // Bodies lean as the stones of an arch where each is on one on either side: what stands on some of them is let be. Each patch then has one way on, and a
    // load goes all along. Of rubble that leans each body has three neighbours or four.
    int MostRounds()
    {
        int leaning = 0, neighbours = 0;
        foreach (ref readonly var node in nodes)
            leaning += node.Leans ? 1 : 0;
        for (int i = 0; i < supports.Length; ++i)
            neighbours += Leans(patches[i].Upper) + Leans(patches[i].Lower);
        if (leaning == 0)
            return RoundsOfStructure;
        return 2 * neighbours <= 5 * leaning ? MaximumRounds : RoundsOfRubble;
    }

    int Leans(int node) => node >= 0 && nodes[node].Leans ? 1 : 0;

    void Begin()
    {
        bodies[-1] = default;
        for (int i = 0; i < nodes.Length; ++i)
        {
            ref var node = ref nodes[i];
            ref var inertia = ref inertias[node.Body];
            ref var motion = ref motions[node.Body];
            bodies[i].Linear = (motion.Velocity.Linear - floor.At(motion.Pose.Position - node.Lag) + node.Linear * inertia.InverseMass).AsVector128();
            bodies[i].Angular = (motion.Velocity.Angular - floor.Angular + inertia.InverseInertiaTensor * node.Angular).AsVector128();
            bodies[i].Begin();
        }
        for (int i = 0; i < supports.Length; ++i)
        {
            patches[i].Describe(supports[i], InertiaOf(patches[i].Upper), InertiaOf(patches[i].Lower));
            patches[i].Begin();
        }
    }

    BodyInertia InertiaOf(int node) => node < 0 ? default : inertias[nodes[node].Body];

    // What has become of the impulses, and what they do to the bodies.
    void End()
    {
        foreach (ref var node in nodes)
            node.Linear = node.Angular = default;
        for (int i = 0; i < supports.Length; ++i)
        {
            ref var patch = ref patches[i];
            ref var support = ref supports[i];
            for (int c = 0; c < support.Count; ++c)
                support.After[c] = patch.Normals[c];
            Vector3 x = patch.X.AsVector3(), y = patch.Y.AsVector3();
            support.FrictionAfter +=
                x * (patch.Across[0] - Exact.Dot(support.FrictionAfter, x)) + y * (patch.Across[1] - Exact.Dot(support.FrictionAfter, y));
            support.TwistAfter = patch.Across[2];
            support.Change(out var linear, out var angular);
            nodes[patch.Upper].Linear += linear;
            nodes[patch.Upper].Angular += angular;
            if (patch.Lower < 0)
                continue;
            nodes[patch.Lower].Linear -= linear;
            nodes[patch.Lower].Angular -= angular - Exact.Cross(support.ToLower, linear);
        }
    }

    // What the round has changed.
    float Change()
    {
        var sum = Vector128<float>.Zero;
        for (int i = 0; i < supports.Length; ++i)
            sum += patches[i].Change();
        return RowLanes.Sum(sum);
    }

    void Follow(float share)
    {
        var shares = Vector128.Create(share);
        for (int i = 0; i < supports.Length; ++i)
            patches[i].Follow(shares);
        for (int i = 0; i < nodes.Length; ++i)
            bodies[i].Follow(shares);
    }
}
