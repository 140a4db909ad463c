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
        if (pair.ImpactCount >= SlidingCount)
            Stop(pair, ref a, ref b);
        else
            Bounce(ref pair, ref a, ref b);
        if (pair.ImpactCount == MaximumCount)
            Hold(pair, ref a, ref b);
        var (bodyA, bodyB) = (pair.A, pair.B);
        GoOn(bodyA, dt);
        GoOn(bodyB, dt);
        // These may find more pairs, which moves all of them in memory.
        LookAround(bodyA, time, dt);
        LookAround(bodyB, time, dt);
        SweepAgain(bodyA, -1, time, dt);
        SweepAgain(bodyB, bodyA, time, dt);
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

    // The pair with somebody whose pairs were swept before is known.
    void SweepAgain(int body, int done, double time, double dt)
    {
        if (body < 0)
            return;
        for (int i = firstPairs[body]; i >= 0; i = pairs[i].NextOf(body))
        {
            ref var pair = ref pairs[i];
            if ((done >= 0 && pair.OtherThan(body) == done) || pair.ApartUntil >= substepEnd)
                continue;
            Find(ref pair, time, dt, pool);
            times.Change(i, pair.Time, pool);
        }
    }

    static void Bounce(ref FastPair pair, ref FastBody a, ref FastBody b)
    {
        Vector3 normal = pair.Normal.ToSingle(), armA = pair.ArmA.ToSingle(), armB = pair.ArmB.ToSingle();
        var (inertiaA, inertiaB) = (a.InverseMass > 0 || pair.A >= 0 ? a.WorldInertia : default, pair.B >= 0 ? b.WorldInertia : default);
        var row = new ContactRow(normal, Exact.Cross(armA, normal), Exact.Cross(normal, armB));
        // What comes back at once comes from an edge that does not leave: it is stopped there.
        var restitution = pair.ImpactCount == 1 ? pair.Restitution : 0;
        var approach = -row.Along(a.Velocity, b.Velocity);
        var pushed = Push(row, inertiaA, inertiaB, (1 + restitution) * approach, float.MaxValue, ref a.Velocity, ref b.Velocity);
        pair.Impulse += pushed;
        if (!(pair.Friction > 0) || !(pushed > 0))
            return;
        var sliding = a.Velocity.Linear + Exact.Cross(a.Velocity.Angular, armA) - b.Velocity.Linear - Exact.Cross(b.Velocity.Angular, armB);
        sliding -= normal * Exact.Dot(sliding, normal);
        var speed = Exact.Length(sliding);
        if (!(speed > 0))
            return;
        var tangent = sliding * (-1 / speed);
        pair.FrictionImpulse += tangent * Push(
            new ContactRow(tangent, Exact.Cross(armA, tangent), Exact.Cross(tangent, armB)), inertiaA, inertiaB, speed,
            pair.Friction * pushed, ref a.Velocity, ref b.Velocity);
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

    // Impacts that do not end are those of a body that lies against the other, or spins against it edge by edge. It stops to approach, and to turn but about
    // the normal: then no part of it comes nearer to a face. Where that does not help it stops altogether. The heavier body keeps its turn.
    void Stop(in FastPair pair, ref FastBody a, ref FastBody b)
    {
        var normal = pair.Normal.ToSingle();
        var inverseMass = a.InverseMass + b.InverseMass;
        // Who is held is met by what does not give way either.
        if (!(inverseMass > 0) && (a.IsHeld || b.IsHeld))
            return;
        var aIsLighter = a.InverseMass > b.InverseMass;
        ref var lighter = ref aIsLighter ? ref a : ref b;
        ref var heavier = ref aIsLighter ? ref b : ref a;
        var isLast = pair.ImpactCount >= StoppingCount;
        StopCount += isLast ? 1 : 0;
        var spin = lighter.Velocity.Angular - heavier.Velocity.Angular;
        lighter.Velocity.Angular = heavier.Velocity.Angular + (isLast ? default : lighter.SpinAbout(normal, spin));
        // Of the place of the impact, as a part of the heavier body.
        var arm = (aIsLighter ? pair.ArmB - pair.ArmA : pair.ArmA - pair.ArmB).ToSingle();
        var relative = lighter.Velocity.Linear - heavier.Velocity.Linear - Exact.Cross(heavier.Velocity.Angular, arm);
        if (!isLast)
            relative = normal * (aIsLighter ? MathHelper.Min(0, Exact.Dot(relative, normal)) : MathHelper.Max(0, Exact.Dot(relative, normal)));
        if (!(inverseMass > 0))
            return;
        lighter.Velocity.Linear -= relative * (lighter.InverseMass / inverseMass);
        heavier.Velocity.Linear += relative * (heavier.InverseMass / inverseMass);
    }

    // A pair of so many impacts is left alone. With a wall, against which others push it, it would be pushed through that: a mesh is one wall to all sides,
    // and all of its impacts are those of one pair. So it stays where it is, for the rest of the substep, and the others meet a wall.
    static void Hold(in FastPair pair, ref FastBody a, ref FastBody b)
    {
        if (a.InverseMass > 0 == b.InverseMass > 0)
            return;
        var aIsHeld = a.InverseMass > 0;
        ref var held = ref aIsHeld ? ref a : ref b;
        ref var holder = ref aIsHeld ? ref b : ref a;
        var arm = (aIsHeld ? pair.ArmB - pair.ArmA : pair.ArmA - pair.ArmB).ToSingle();
        held.Velocity = new(holder.Velocity.Linear + Exact.Cross(holder.Velocity.Angular, arm), holder.Velocity.Angular);
        held.IsHeld = true;
    }
}
