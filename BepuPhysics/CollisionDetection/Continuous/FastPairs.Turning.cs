using System;
using BepuPhysics.Constraints.Contact;
using BepuUtilities;

namespace BepuPhysics.CollisionDetection;

// A ball on the face of what turns. The ball goes straight on, the face comes after it again and again, as often as a sweep can tell: a plate that was hit by
// a fast ball off its middle turned into it by centimetres within a substep, in as many impacts as a pair may have, and then passed it.
//
// With n and d, from the centre of the body to that of the ball, fixed to a body that turns by w, the gap g opens by n . (u - w x d), where u is the velocity
// of the ball against the centre, and that changes by
//   g'' = 2 (w x n) . u - (w x n) . (w x d)
// as u and w stay what they are. If the ball leaves with -g'' t / 2, gap and ball are back after a time t: what pushes all the time pushes as much in it. So it
// leaves with that at once. The energy for that is what the pair's impacts have taken along their normals in this step, and no more: so they make none.
sealed unsafe partial class FastPairs
{
    // By how much the face may turn until the ball comes back, rad: to there the gap is nearly a parabola.
    const double MostTurn = .5;

    static void KeepAhead(ref FastPair pair, in ContactRow row, in BodyInertia inertiaA, in BodyInertia inertiaB, ref FastBody a, ref FastBody b, double rest)
    {
        bool aIsBall = pair.A >= 0 && a.IsBall, bIsBall = pair.B >= 0 && b.IsBall;
        if (aIsBall == bIsBall || !(pair.Lost > 0))
            return;
        ref readonly var ball = ref aIsBall ? ref a.Velocity : ref b.Velocity;
        ref readonly var body = ref aIsBall ? ref b.Velocity : ref a.Velocity;
        var normal = aIsBall ? pair.Normal : -pair.Normal;
        var offset = aIsBall ? pair.ArmB - pair.ArmA : pair.ArmA - pair.ArmB;
        DoubleVector3 spin = new(body.Angular), sliding = new(ball.Linear - body.Linear);
        var turn = DoubleVector3.Cross(spin, normal);
        var approach = DoubleVector3.Dot(turn, DoubleVector3.Cross(spin, offset)) - 2 * DoubleVector3.Dot(turn, sliding);
        var speed = turn.Length;
        if (!(approach > 0) || !(speed > 0))
            return;
        var time = Math.Min(rest, MostTurn / speed);
        var parting = row.Along(a.Velocity, b.Velocity);
        var inverseMass = row.Along(row.ResponseOfA(inertiaA, 1), row.ResponseOfB(inertiaB, 1));
        // Half of the square of a speed, over the inverse mass, is an energy.
        var most = (float)Math.Sqrt((double)parting * parting + 2 * (double)pair.Lost * inverseMass);
        var change = MathHelper.Min((float)(approach * time * .5), most) - parting;
        var pushed = Push(row, inertiaA, inertiaB, change, float.MaxValue, ref a.Velocity, ref b.Velocity);
        pair.Impulse += pushed;
        pair.Lost -= pushed * (parting + .5f * change);
    }
}
