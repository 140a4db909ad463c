using System;
using System.Numerics;
using BepuPhysics.Collidables;
using BepuUtilities;

namespace BepuPhysics.CollisionDetection;

/// <summary>Contacts at the rims of a cylinder, and at balls that are not where their body turns, where they will be a part of the step later.</summary>
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
//
// So it is with a ball whose middle is at q from the centre of its body, as a child of a compound: l = q - R n. A toy that rights itself, with its weight
// below the middle of a ball, rocked ever higher on the arms of the beginning. The side of a capsule that is a child is a ball at each of its contacts.
//
// A convex shape of a game's own is asked for its farthest point now and later, each in its own frame.
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

    // Part of its way by which the lowest point of a shape of a game's own may be beside the middle of that on half of the way. What runs along a surface is
    // near it; what goes from one corner to another, or over a face, is at one of the ends.
    const float GreatestBend = 0.25f;

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
            var along = Exact.Dot(contact.Offset - center - pose.Position, axis);
            var end = pose.Position + axis * (along < 0 ? -cylinder.HalfLength : cylinder.HalfLength);
            Move(contact, end + lowest, Turn(end, turn) + lowestLater, center, normal, turn, bound, ref moved, i);
        }
    }

    /// <summary>Moves those contacts that are the lowest points of a ball.</summary>
    /// <param name="found">Contacts as they were found.</param>
    /// <param name="radius">Radius of the ball.</param>
    /// <param name="middle">Where it is, from the centre of its body.</param>
    /// <param name="center">Centre of its body less that of A.</param>
    /// <param name="normal">The normal of the contacts, from the other body to the ball.</param>
    /// <param name="turn">By how much its body will have turned against the other one until then, rad.</param>
    /// <param name="moved">The same contacts, of which some may have been moved already, and are left where they are.</param>
    public static void MoveAhead(in ConvexContactManifold found, float radius, in Vector3 middle, in Vector3 center, in Vector3 normal, in Vector3 turn,
        ref ConvexContactManifold moved)
    {
        var least = LeastTurn * radius;
        if (!(Exact.LengthSquared(Exact.Cross(turn, middle)) > least * least))
            return;
        var lowest = normal * -radius;
        var later = Turn(middle, turn);
        for (int i = 0; i < found.Count; ++i)
            Move(found.Read(i), middle + lowest, later + lowest, center, normal, turn, Tolerance * radius, ref moved, i);
    }

    /// <summary>Moves those contacts that are at the side of a capsule, or its ends.</summary>
    /// <param name="found">Contacts as they were found.</param>
    /// <param name="capsule">The capsule.</param>
    /// <param name="pose">Where it is, from the centre of its body.</param>
    /// <param name="center">Centre of its body less that of A.</param>
    /// <param name="normal">The normal of the contacts, from the other body to the capsule.</param>
    /// <param name="turn">By how much its body will have turned against the other one until then, rad.</param>
    /// <param name="moved">The same contacts, of which some may have been moved already, and are left where they are.</param>
    public static void MoveAhead(in ConvexContactManifold found, in Capsule capsule, in RigidPose pose, in Vector3 center, in Vector3 normal,
        in Vector3 turn, ref ConvexContactManifold moved)
    {
        var axis = Exact.Rotate(Vector3.UnitY, pose.Orientation);
        var lowest = normal * -capsule.Radius;
        var least = LeastTurn * capsule.Radius;
        for (int i = 0; i < found.Count; ++i)
        {
            var along = Exact.Dot(found.Read(i).Offset - center - pose.Position - lowest, axis);
            var middle = pose.Position + axis * Math.Clamp(along, -capsule.HalfLength, capsule.HalfLength);
            if (Exact.LengthSquared(Exact.Cross(turn, middle)) > least * least)
                Move(found.Read(i), middle + lowest, Turn(middle, turn) + lowest, center, normal, turn, Tolerance * capsule.Radius, ref moved, i);
        }
    }

    /// <summary>Moves the contact of a convex shape of a game's own, if it has one and that is where the shape is lowest.</summary>
    /// <param name="found">Contacts as they were found.</param>
    /// <param name="core">The shape.</param>
    /// <param name="pose">Where it is, from the centre of its body.</param>
    /// <param name="center">Centre of its body less that of A.</param>
    /// <param name="normal">The normal of the contacts, from the other body to the shape.</param>
    /// <param name="turn">By how much its body will have turned against the other one until then, rad.</param>
    /// <param name="moved">The same contacts, of which some may have been moved already, and are left where they are.</param>
    public static void MoveAhead(in ConvexContactManifold found, in ImpactCore core, in RigidPose pose, in Vector3 center, in Vector3 normal,
        in Vector3 turn, ref ConvexContactManifold moved)
    {
        if (found.Count != 1 || !(Exact.LengthSquared(turn) > LeastTurn * LeastTurn))
            return;
        var lowest = LowestAfter(core, pose, normal, default);
        var later = LowestAfter(core, pose, normal, turn);
        var shift = later - lowest;
        var bend = LowestAfter(core, pose, normal, turn * 0.5f) - lowest - shift * 0.5f;
        // What rolls from one corner to another, or over a face, stays on the one that it touches.
        if (Exact.LengthSquared(bend) <= GreatestBend * GreatestBend * Exact.LengthSquared(shift))
            Move(found.Read(0), lowest, later, center, normal, turn, Tolerance * (float)core.Size, ref moved, 0);
    }

    // Where the lowest point is once the body has turned, which that point has, too.
    static Vector3 LowestAfter(in ImpactCore core, in RigidPose pose, in Vector3 normal, in Vector3 turn) =>
        Turn(FarthestOf(core, pose, Turn(-normal, -turn)), turn);

    static Vector3 FarthestOf(in ImpactCore core, in RigidPose pose, in Vector3 direction)
    {
        var local = Exact.RotateByInverse(direction, pose.Orientation);
        var point = core.Support(new(local)).ToSingle() + local * (float)core.Margin;
        return pose.Position + Exact.Rotate(point, pose.Orientation);
    }

    // From the lowest point to that of later, if it is there.
    static void Move(in ConvexContact contact, in Vector3 lowest, in Vector3 later, in Vector3 center, in Vector3 normal, in Vector3 turn, float bound,
        ref ConvexContactManifold moved, int index)
    {
        var beside = contact.Offset - center - lowest;
        // Tests of pairs put contacts anywhere between the surfaces.
        var above = Exact.Dot(beside, normal);
        beside -= normal * above;
        ref var target = ref ConvexContactManifold.GetConvexContactReference(ref moved, index);
        if (Exact.LengthSquared(beside) > bound * bound || MathF.Abs(above) > MathF.Abs(contact.Depth) + bound || target.Offset != contact.Offset)
            return;
        var shift = later - lowest;
        target.Offset += shift;
        target.Depth += Exact.Dot(normal, Exact.Cross(turn, later) - shift);
    }

    /// <summary>A vector that has been turned.</summary>
    // By 2 atan(|turn| / 2), which is |turn| to third order, and needs no sine.
    internal static Vector3 Turn(in Vector3 v, in Vector3 turn)
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
