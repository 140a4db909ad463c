using System.Numerics;
using BepuPhysics.Constraints.Contact;
using BepuUtilities;

namespace BepuPhysics.CollisionDetection;

// Impacts of fast pairs, in the order of their times.
sealed unsafe partial class FastPairs
{
    void MakeImpact(int index, double dt)
    {
        ref var pair = ref pairs[index];
        var time = pair.Time;
        if (pair.IsSensor)
        {
            // Once is enough to know, and in the order of times: nobody sees a way on which a wall before it has let nothing go.
            pair.HasPassed = pair.Passes = true;
            pair.Time = FastPair.Never;
            times.Change(index, pair.Time, pool);
            return;
        }
        if (!pair.IsAsked)
        {
            var manifold = new ConvexContactManifold { Normal = pair.Normal.ToSingle(), Count = 1 };
            manifold.OffsetB = (pair.ArmA - pair.ArmB).ToSingle();
            manifold.Contact0.Offset = pair.ArmA.ToSingle();
            pair.IsAsked = true;
            pair.Passes = !narrowPhase.ConfigureImpact(pair.Pair, ref manifold, out pair.Friction, out pair.Restitution);
            if (pair.Passes)
            {
                pair.Time = FastPair.Never;
                times.Change(index, pair.Time, pool);
                return;
            }
        }
        ++pair.ImpactCount;
        ++ImpactCount;
        FastBody still = default;
        ref var a = ref pair.A >= 0 ? ref movers[pair.A] : ref still;
        ref var b = ref pair.B >= 0 ? ref movers[pair.B] : ref still;
        if (pair.A >= 0)
            a.GoTo(time, dt);
        if (pair.B >= 0)
            b.GoTo(time, dt);
        var isLast = pair.ImpactCount >= JoiningCount;
        if (isLast)
            Join(ref pair, ref a, ref b);
        else if (pair.ImpactCount >= SlidingCount)
            Stop(pair, ref a, ref b);
        else
            Bounce(ref pair, ref a, ref b, dt - time);
        if (pair.ImpactCount == MaximumCount)
            Hold(pair, ref a, ref b);
        var (bodyA, bodyB) = (pair.A, pair.B);
        GoOn(bodyA, dt);
        GoOn(bodyB, dt);
        if (isLast)
            GoOnTogether(pair, ref a, ref b, dt);
        // These may find more pairs, which moves all of them in memory.
        LookAround(bodyA, time, dt);
        LookAround(bodyB, time, dt);
        SweepAgain(bodyA, -1, index, time, dt);
        SweepAgain(bodyB, bodyA, index, time, dt);
    }

    void End(ref FastBody mover, double dt)
    {
        ref var set = ref Bodies.ActiveSet;
        ref var motion = ref set.MotionStates[mover.Index];
        ref var displacement = ref set.Displacements[mover.Index];
        displacement.Linear += (mover.PositionAt(dt) - new DoubleVector3(motion.Pose.Position)).ToSingle();
        displacement.Angular += BodyTurn.Between(motion.Pose.Orientation, mover.EndOrientation, default).ToSingle();
        motion.Pose.Position = set.Origins[mover.Index].Position + displacement.Linear;
        motion.Pose.Orientation = mover.EndOrientation;
        motion.Velocity = mover.Velocity;
        set.WorldInertias[mover.Index].InverseInertiaTensor =
            Symmetric3x3.RotateInverseInertia(mover.Inertia.InverseInertiaTensor, motion.Pose.Orientation);
        mover.CheckedPosition = motion.Pose.Position;
        mover.CheckedOrientation = motion.Pose.Orientation;
    }

    void GoOn(int body, double dt)
    {
        if (body < 0)
            return;
        ref var mover = ref movers[body];
        if (!mover.HasChanged)
            changed.Add(body, pool);
        mover.GoOn(dt);
    }

    // The pair with somebody whose pairs were swept before is known. Who was joined with another one is not any more, as it has been hit.
    void SweepAgain(int body, int done, int hit, double time, double dt)
    {
        if (body < 0)
            return;
        for (int i = firstPairs[body]; i >= 0; i = pairs[i].NextOf(body))
        {
            ref var pair = ref pairs[i];
            if ((done >= 0 && pair.OtherThan(body) == done) || pair.ApartUntil >= substepEnd)
                continue;
            pair.IsJoined &= i == hit;
            Find(ref pair, time, dt, pool);
            times.Change(i, pair.Time, pool);
        }
    }

    static void Bounce(ref FastPair pair, ref FastBody a, ref FastBody b, double rest)
    {
        Vector3 normal = pair.Normal.ToSingle(), armA = pair.ArmA.ToSingle(), armB = pair.ArmB.ToSingle();
        var (inertiaA, inertiaB) = (a.InverseMass > 0 || pair.A >= 0 ? a.WorldInertia : default, pair.B >= 0 ? b.WorldInertia : default);
        var row = new ContactRow(normal, Exact.Cross(armA, normal), Exact.Cross(normal, armB));
        // What comes back at once comes from an edge that does not leave: it is stopped there.
        var restitution = pair.ImpactCount == 1 ? pair.Restitution : 0;
        var approach = -row.Along(a.Velocity, b.Velocity);
        var pushed = Push(row, inertiaA, inertiaB, (1 + restitution) * approach, float.MaxValue, ref a.Velocity, ref b.Velocity);
        pair.Impulse += pushed;
        pair.Lost += pushed * .5f * (1 - restitution) * approach;
        Rub(ref pair, normal, armA, armB, inertiaA, inertiaB, pushed, ref a.Velocity, ref b.Velocity);
        KeepAhead(ref pair, row, inertiaA, inertiaB, ref a, ref b, rest);
    }

    static void Rub(ref FastPair pair, in Vector3 normal, in Vector3 armA, in Vector3 armB, in BodyInertia inertiaA, in BodyInertia inertiaB, float pushed,
        ref BodyVelocity a, ref BodyVelocity b)
    {
        if (!(pair.Friction > 0) || !(pushed > 0))
            return;
        var sliding = a.Linear + Exact.Cross(a.Angular, armA) - b.Linear - Exact.Cross(b.Angular, armB);
        sliding -= normal * Exact.Dot(sliding, normal);
        var speed = Exact.Length(sliding);
        if (!(speed > 0))
            return;
        var tangent = sliding * (-1 / speed);
        pair.FrictionImpulse += tangent * Push(
            new ContactRow(tangent, Exact.Cross(armA, tangent), Exact.Cross(tangent, armB)), inertiaA, inertiaB, speed,
            pair.Friction * pushed, ref a, ref b);
    }

    // By the impulse along a row that changes the velocity in it.
    static float Push(in ContactRow row, in BodyInertia inertiaA, in BodyInertia inertiaB, float change, float most, ref BodyVelocity a, ref BodyVelocity b)
    {
        var inverseMass = row.Along(row.ResponseOfA(inertiaA, 1), row.ResponseOfB(inertiaB, 1));
        if (!(change > 0) || !(inverseMass > 0))
            return 0;
        var impulse = MathHelper.Min(change / inverseMass, most);
        var (changeA, changeB) = (row.ResponseOfA(inertiaA, impulse), row.ResponseOfB(inertiaB, impulse));
        a = new(a.Linear + changeA.Linear, a.Angular + changeA.Angular);
        b = new(b.Linear + changeB.Linear, b.Angular + changeB.Angular);
        return impulse;
    }
}
