using System;
using System.Numerics;
using BepuUtilities;

namespace BepuPhysics.Constraints.Contact;

/// <summary>An impact at one contact that does not bounce, and whose normal turns nothing, as that of balls: it needs no sweeps.</summary>
// Then neither friction changes what the normal stops, nor the other way round: each is solved once, and what they push is what SharedImpact comes to.
struct LoneImpact
{
    // Part of the speed that is stopped which may be left along the surface, or against it, by what the normal turns.
    const float CouplingShare = 1e-5f;

    /// <summary>What it adds to the velocity of A.</summary>
    internal BodyVelocity ChangeOfA;
    /// <summary>What it adds to the velocity of B.</summary>
    internal BodyVelocity ChangeOfB;
    /// <summary>What it pushes along the normal, N s.</summary>
    internal float Impulse;
    /// <summary>What friction pushes A with, N s.</summary>
    internal Vector3 Friction;

    /// <summary>Makes the impact of a pair of one contact.</summary>
    /// <param name="pair">The pair.</param>
    /// <param name="contacts">Its contact.</param>
    /// <param name="time">When it is, s from the beginning of the substep.</param>
    /// <param name="dt">Length of the substep, s.</param>
    /// <returns>Whether it is such an impact.</returns>
    internal bool TryMake(in BouncingPair pair, in ContactRows contacts, float time, float dt)
    {
        this = default;
        ref readonly var row = ref pair.Rows[0];
        BodyVelocity a = contacts.VelocityA, b = contacts.VelocityB;
        var speed = -row.Along(a, b);
        if (!(contacts.Gap(0, row) - pair.Reach(MathHelper.Max(speed, 0), dt) <= 0))
            return true;
        BodyInertia inertiaA = contacts.InertiaA, inertiaB = contacts.InertiaB;
        var inverseMass = row.Along(row.ResponseOfA(inertiaA, 1), row.ResponseOfB(inertiaB, 1));
        // The velocity has gained what the acceleration of the whole substep gives. A parabola has gained half of that when the substep begins.
        speed += row.Along(pair.GainInA, pair.GainInB) * (0.5f - time / dt);
        if (!(inverseMass > 0) || !(speed > 0))
            return true;
        Impulse = speed / inverseMass;
        ChangeOfA = row.ResponseOfA(inertiaA, Impulse);
        ChangeOfB = row.ResponseOfB(inertiaB, Impulse);
        var most = contacts.Friction * Impulse;
        return !(most > 0) || TryRub(contacts, a, b, inertiaA, inertiaB, CouplingShare * speed, most);
    }

    bool TryRub(
        in ContactRows contacts, in BodyVelocity a, in BodyVelocity b, in BodyInertia inertiaA, in BodyInertia inertiaB, float coupling, float most)
    {
        var normal = contacts.Normal;
        var direction = ContactRow.Across(normal);
        var x = contacts.Row(contacts.Arm(0), direction);
        var y = contacts.Row(contacts.Arm(0), Exact.Cross(normal, direction));
        float turnedX = x.Along(ChangeOfA, ChangeOfB), turnedY = y.Along(ChangeOfA, ChangeOfB);
        if (!(MathHelper.Max(MathF.Abs(turnedX), MathF.Abs(turnedY)) <= coupling))
            return false;
        BodyVelocity responseA = x.ResponseOfA(inertiaA, 1), responseB = x.ResponseOfB(inertiaB, 1);
        float massX = x.Along(responseA, responseB), cross = y.Along(responseA, responseB);
        var massY = y.Along(y.ResponseOfA(inertiaA, 1), y.ResponseOfB(inertiaB, 1));
        var determinant = massX * massY - cross * cross;
        if (!(determinant > 0))
            return true;
        float velocityX = x.Along(a, b) + turnedX, velocityY = y.Along(a, b) + turnedY;
        var pushX = (cross * velocityY - massY * velocityX) / determinant;
        var pushY = (cross * velocityX - massX * velocityY) / determinant;
        var length = MathF.Sqrt(pushX * pushX + pushY * pushY);
        var scale = length > most ? most / length : 1;
        Friction = (direction * pushX + Exact.Cross(normal, direction) * pushY) * scale;
        Add(ref ChangeOfA, x.ResponseOfA(inertiaA, pushX * scale), y.ResponseOfA(inertiaA, pushY * scale));
        Add(ref ChangeOfB, x.ResponseOfB(inertiaB, pushX * scale), y.ResponseOfB(inertiaB, pushY * scale));
        return true;
    }

    static void Add(ref BodyVelocity velocity, in BodyVelocity x, in BodyVelocity y)
    {
        velocity.Linear += x.Linear + y.Linear;
        velocity.Angular += x.Angular + y.Angular;
    }
}
