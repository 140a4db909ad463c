using System;
using System.Numerics;
using System.Runtime.CompilerServices;
using BepuPhysics.Constraints.Contact;
using BepuUtilities;

namespace BepuPhysics.CollisionDetection;

// Impacts that do not end are those of a body that lies against the other, or spins against it edge by edge, or is pressed against it by others. What stops
// them are impulses between the two at the place where they meet, all at once: they keep momentum and angular momentum, and as those that bring velocities
// to zero, and no farther, they take energy.
//
// Of two that are joined at last each goes on as a part of one rigid body: on an arc about the common centre, that nothing leaves on which the other is.
sealed unsafe partial class FastPairs
{
    // A direction of which so small a part is left after the others is none of its own: as where a turn is locked.
    const double LeastPivot = 1e-6;

    const int MostRows = 6;

    [InlineArray(MostRows)]
    struct Rows
    {
        ContactRow first;
    }

    // It stops to approach, and to turn but about the normal: then no part of it comes nearer to a face.
    static void Stop(in FastPair pair, ref FastBody a, ref FastBody b)
    {
        Vector3 normal = pair.Normal.ToSingle(), armA = pair.ArmA.ToSingle(), armB = pair.ArmB.ToSingle();
        Rows rows = default;
        rows[0] = new(normal, Exact.Cross(armA, normal), Exact.Cross(normal, armB));
        var count = 1;
        // How a ball turns brings it no nearer.
        if (!a.IsBall && !b.IsBall)
        {
            var x = ContactRow.Across(normal);
            var y = Exact.Cross(normal, x);
            rows[count++] = new(default, x, -x);
            rows[count++] = new(default, y, -y);
        }
        BringToRest(rows, count, a.WorldInertia, b.WorldInertia, ref a.Velocity, ref b.Velocity);
    }

    void Join(ref FastPair pair, ref FastBody a, ref FastBody b)
    {
        ++StopCount;
        pair.IsJoined = true;
        Vector3 armA = pair.ArmA.ToSingle(), armB = pair.ArmB.ToSingle();
        Rows rows = default;
        var count = 0;
        foreach (var axis in (ReadOnlySpan<Vector3>)[Vector3.UnitX, Vector3.UnitY, Vector3.UnitZ])
        {
            rows[count++] = new(axis, Exact.Cross(armA, axis), Exact.Cross(axis, armB));
            rows[count++] = new(default, axis, -axis);
        }
        BringToRest(rows, count, a.WorldInertia, b.WorldInertia, ref a.Velocity, ref b.Velocity);
    }

    static void GoOnTogether(in FastPair pair, ref FastBody a, ref FastBody b, double dt)
    {
        // What has no mass here goes on as it does.
        double weightA = b.InverseMass, weightB = a.InverseMass;
        if (!(weightA + weightB > 0))
            return;
        var offset = pair.ArmA - pair.ArmB;
        var fromA = offset * (weightB / (weightA + weightB));
        var velocity = (new DoubleVector3(a.Velocity.Linear) * weightA + new DoubleVector3(b.Velocity.Linear) * weightB) * (1 / (weightA + weightB));
        if (a.InverseMass > 0)
            a.GoOnAbout(-fromA, velocity, dt);
        if (b.InverseMass > 0)
            b.GoOnAbout(offset - fromA, velocity, dt);
    }

    // By impulses along rows, of which each changes the velocities in the others too: K x = -v, by elimination, as K is symmetric and has no negative values.
    static void BringToRest(in Rows rows, int count, in BodyInertia inertiaA, in BodyInertia inertiaB, ref BodyVelocity a, ref BodyVelocity b)
    {
        const int stride = MostRows + 1;
        Span<double> k = stackalloc double[MostRows * stride];
        for (int i = 0; i < count; ++i)
        {
            var (responseA, responseB) = (rows[i].ResponseOfA(inertiaA, 1), rows[i].ResponseOfB(inertiaB, 1));
            for (int j = 0; j < count; ++j)
                k[j * stride + i] = rows[j].Along(responseA, responseB);
            k[i * stride + MostRows] = -rows[i].Along(a, b);
        }
        Span<double> least = stackalloc double[MostRows];
        for (int i = 0; i < count; ++i)
            least[i] = LeastPivot * k[i * stride + i];
        for (int i = 0; i < count; ++i)
        {
            for (int j = i + 1; j < count && k[i * stride + i] > least[i]; ++j)
            {
                var part = k[j * stride + i] / k[i * stride + i];
                for (int column = i; column <= MostRows; ++column)
                    k[j * stride + column] -= part * k[i * stride + column];
            }
        }
        for (int i = count - 1; i >= 0; --i)
        {
            var impulse = k[i * stride + MostRows];
            for (int j = i + 1; j < count; ++j)
                impulse -= k[i * stride + j] * k[j * stride + MostRows];
            k[i * stride + MostRows] = impulse = k[i * stride + i] > least[i] ? impulse / k[i * stride + i] : 0;
            var (changeA, changeB) = (rows[i].ResponseOfA(inertiaA, (float)impulse), rows[i].ResponseOfB(inertiaB, (float)impulse));
            a = new(a.Linear + changeA.Linear, a.Angular + changeA.Angular);
            b = new(b.Linear + changeB.Linear, b.Angular + changeB.Angular);
        }
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
