using System;
using System.Numerics;
using BepuPhysics.Collidables;
using BepuUtilities;

namespace BepuPhysics.CollisionDetection;

/// <summary>Contacts at the rims of a cylinder, where they will be a part of the step later.</summary>
// What rolls on a rim touches at a point that runs around it, by an angle W t within the step. The solver keeps the arm of the contact; with that of the
// beginning it sees the surfaces part by w r sin(W t) too slowly or too fast, lets the body sink in by half of w r W dt^2 in each step, and pushes it out
// again: that is energy. With the arm of a later time it errs to the other side before that, and what is left over a step is of a higher order.
//
// Where a rim is lowest over a plane is known in closed form, of its axis alone, so nothing is tested again. With the unit normal n from the plane and the
// axis a it is, of the end at H,
//
//     l = H a + R (c a - n) / |c a - n|,  c = a . n.
//
// With the axis of later that is m. The solver sees the depth d less n . (t x m) there when the cylinder has turned by t against the other body; what it is
// to see is what the rim has, d less n . (m - l). So the contact at l goes to m with the depth d + n . (t x m) - n . (m - l).
static class RimContacts
{
    /// <summary>Greatest number of contacts of a manifold that has some at rims: with more an end lies flat, and with all of its rim.</summary>
    public const int GreatestCount = 2;

    // Sine of the least angle between axis and normal. Rounding of either, some 1e-7, is a thousandth of that at most in the place around the rim.
    const float LeastSine = 1e-3f;

    // Part of the radius by which a contact, seen along the normal, may be beside the lowest point and still be it. That is what LeastSine leaves, and what
    // tests of pairs leave. The next thing that it could be is a corner by which contacts of an end are named, .2 radii away; one that is near by chance is
    // moved by a wrong way only by this part of it.
    const float Tolerance = 1e-2f;

    // Way of the axis, or of the middle, in radii, below which nothing is worth moving: depths change by its square. What rolls fast turns its axis by some
    // thousandths of what it turns about that, as it sways on its contacts.
    const float LeastTurn = 1e-4f;

    /// <summary>Moves those contacts that are the lowest points of the rims.</summary>
    /// <param name="found">Contacts as they were found, of which there are at most <see cref="GreatestCount"/>.</param>
    /// <param name="cylinder">The cylinder.</param>
    /// <param name="pose">Where it is, from the centre of its body.</param>
    /// <param name="center">Centre of its body less that of A.</param>
    /// <param name="normal">The normal of the contacts, from the other body to the cylinder.</param>
    /// <param name="turn">By how much its body will have turned against the other one until then, rad.</param>
    /// <param name="moved">The same contacts, of which some may have been moved already, and are left where they are.</param>
    public static void MoveAhead(in ConvexContactManifold found, in Cylinder cylinder, in RigidPose pose, in Vector3 center, in Vector3 normal,
        in Vector3 turn, ref ConvexContactManifold moved)
    {
        var axis = Exact.Rotate(Vector3.UnitY, pose.Orientation);
        // What turns about its axis alone goes on touching where it does.
        var way = Exact.LengthSquared(Exact.Cross(turn, axis * cylinder.Radius)) + Exact.LengthSquared(Exact.Cross(turn, pose.Position));
        var least = LeastTurn * cylinder.Radius;
        if (!(way > least * least))
            return;
        var axisLater = Turn(axis, turn);
        if (!TryFindLowest(cylinder.Radius, axis, normal, out var lowest) || !TryFindLowest(cylinder.Radius, axisLater, normal, out var lowestLater))
            return;
        var bound = Tolerance * cylinder.Radius;
        for (int i = 0; i < found.Count; ++i)
        {
            ref readonly var contact = ref found.Read(i);
            var place = contact.Offset - center;
            var end = pose.Position + axis * (Exact.Dot(place - pose.Position, axis) < 0 ? -cylinder.HalfLength : cylinder.HalfLength);
            var beside = place - (end + lowest);
            // Tests of pairs put contacts anywhere between the surfaces.
            var above = Exact.Dot(beside, normal);
            beside -= normal * above;
            ref var target = ref ConvexContactManifold.GetConvexContactReference(ref moved, i);
            if (Exact.LengthSquared(beside) > bound * bound || MathF.Abs(above) > MathF.Abs(contact.Depth) + bound || target.Offset != contact.Offset)
                continue;
            var arm = Turn(end, turn) + lowestLater;
            var shift = arm - (end + lowest);
            target.Offset += shift;
            target.Depth += Exact.Dot(normal, Exact.Cross(turn, arm) - shift);
        }
    }

    // By 2 atan(|turn| / 2), which is |turn| to third order, and needs no sine.
    static Vector3 Turn(in Vector3 v, in Vector3 turn)
    {
        var across = Exact.Cross(turn, v);
        return v + (across + Exact.Cross(turn, across) * 0.5f) * (1 / (1 + Exact.LengthSquared(turn) * 0.25f));
    }

    // The lowest point of a rim from the middle of its end.
    static bool TryFindLowest(float radius, in Vector3 axis, in Vector3 normal, out Vector3 lowest)
    {
        var down = axis * Exact.Dot(axis, normal) - normal;
        var sine = Exact.Length(down);
        var isRim = sine > LeastSine;
        lowest = isRim ? down * (radius / sine) : default;
        return isRim;
    }
}
