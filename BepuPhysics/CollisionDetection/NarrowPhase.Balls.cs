using System;
using System.Runtime.CompilerServices;
using BepuPhysics.Collidables;
using BepuUtilities;

namespace BepuPhysics.CollisionDetection;

// Balls that are apart and will meet in the step push each other along the line between their centres where they meet. That is another one than at detection
// where they meet off centre: the balls of a game of pool are found a hand's breadth apart, and would part by ten degrees too little. When they touch is
// known in closed form as long as nothing else pushes them, and the contact is that of this time, as for what is marked as continuous.
public sealed unsafe partial class NarrowPhase<TCallbacks>
{
    // Square of the least turn of the normal, rad, for which it is worth it: 1/16 of a degree.
    const float LeastTurnSquared = 1.2e-6f;

    /// <summary>Finds where two balls will touch, if they are apart and meet off centre. Then this is an impact.</summary>
    /// <param name="tested">The pair.</param>
    /// <param name="ballA">Shape of A, a ball.</param>
    /// <param name="ballB">Shape of B, a ball.</param>
    /// <param name="poseA">Where A is.</param>
    /// <param name="poseB">Where B is.</param>
    /// <param name="dt">Length of the step, s.</param>
    /// <param name="placed">Where they will touch.</param>
    [MethodImpl(MethodImplOptions.NoInlining)]
    void PlaceWhereBallsMeet(
        ref TestedPair tested, TypedIndex ballA, TypedIndex ballB, in RigidPose poseA, in RigidPose poseB, float dt, ref ImpactPoses placed)
    {
        var offset = poseB.Position - poseA.Position;
        var reach = Simulation.Shapes.GetShape<Sphere>(ballA.Index).Radius + Simulation.Shapes.GetShape<Sphere>(ballB.Index).Radius;
        var apart = Exact.LengthSquared(offset) - reach * reach;
        if (!(apart > 0))
            return;
        var velocity = VelocityOf(tested.Pair.B).Linear - VelocityOf(tested.Pair.A).Linear;
        var closing = -Exact.Dot(offset, velocity);
        // |offset + velocity t| = reach, by the root that loses no digits.
        var discriminant = closing * closing - Exact.LengthSquared(velocity) * apart;
        if (!(closing > 0 && discriminant > 0))
            return;
        var time = apart / (closing + MathF.Sqrt(discriminant));
        if (!(time <= dt * Lookahead))
            return;
        var meeting = offset + velocity * time;
        var turn = Exact.Cross(offset, meeting);
        if (!(Exact.LengthSquared(turn) > LeastTurnSquared * Exact.LengthSquared(offset) * reach * reach))
            return;
        tested.IsImpact = true;
        tested.ImpactTime = time;
        // Nobody asks how a ball is turned.
        placed.A = new(default, poseA.Orientation);
        placed.B = new(meeting, poseB.Orientation);
    }
}
