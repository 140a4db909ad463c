using System.Numerics;
using System.Runtime.CompilerServices;
using BepuUtilities;

namespace BepuPhysics.Constraints.Contact;

// What lies by itself on something that does not move, and has come to rest, needs no solving: the impulses that bore it in the last substep bear it in
// this one. The warm start sees that they do, and takes out what rounding has left of its velocity; a sweep would find nothing to do then, and is left out.
//
// That is also what keeps numbers away that are too small for a processor to be quick with. A body that is held comes to rest by a factor in each sweep,
// without end, until products of what is left are below the least normal number, where an operation takes many times as long.
readonly partial struct ConvexContactConstraint<TBodies, TContacts, TNormals>
{
    // Part of the velocity that the impulses take from a body, below which what they leave is nothing. Impulses know no more than some 1e-7 of themselves, and
    // a body is turned by several of them; what is within this of the angle of friction rests, that is by so much of the tangent.
    const float RestShare = 1e-5f;
    // As much of the limit of friction is its rounding.
    const float LimitShare = 1 + 1e-5f;
    // Part of the load below which an impulse beside it is nothing: half of what the last bit of the load stands for.
    const float ImpulseShare = 1f / (1 << 24);

    // Only these are ever held alone.
    static bool MayRestAlone
    {
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        get => TBodies.Count == 1 && TContacts.Count >= SupportFinder.LeastContacts;
    }

    // Brings bodies to rest of which the warm start has left nothing but rounding. What friction does not stop is left to go on, however slow it is, and so is
    // what has more friction than its surfaces give now.
    [MethodImpl(MethodImplOptions.NoInlining)]
    static void BringToRest(
        Vector<int> lone, in Vector3Wide linear, Vector<float> load, ref SolverBodyWide body,
        ref ConvexContactPrestepWide<TContacts> prestep, ref ConvexContactImpulsesWide<TNormals> impulses)
    {
        var squaredRadius = prestep.Contacts[0].OffsetA.LengthSquared();
        for (int i = 1; i < TContacts.Count; ++i)
            squaredRadius = Wide.Max(squaredRadius, prestep.Contacts[i].OffsetA.LengthSquared());
        var left = body.Linear.LengthSquared() + body.Angular.LengthSquared() * squaredRadius;
        var friction = prestep.Material.FrictionCoefficient;
        var share = Wide.Min(friction, Vector<float>.One) * body.InverseMass * new Vector<float>(RestShare);
        var rests = lone & Vector.LessThanOrEqual(left, linear.LengthSquared() * (share * share));
        var limit = friction * load * new Vector<float>(LimitShare);
        rests &= Vector.LessThanOrEqual(impulses.Friction.LengthSquared(), limit * limit);
        if (rests != Vector<int>.Zero)
        {
            rests &= IsTwistWithinLimit(friction, ref prestep, ref impulses);
            var moves = ~rests;
            body.Linear = Vector3Wide.Mask(moves, body.Linear);
            body.Angular = Vector3Wide.Mask(moves, body.Angular);
            var least = load * new Vector<float>(ImpulseShare);
            impulses.Friction.X = WithoutDust(rests, impulses.Friction.X, least);
            impulses.Friction.Y = WithoutDust(rests, impulses.Friction.Y, least);
            impulses.Friction.Z = WithoutDust(rests, impulses.Friction.Z, least);
            impulses.Twist = WithoutDust(rests, impulses.Twist, least * Vector.SquareRoot(squaredRadius));
        }
        prestep.Material.SetAtRest(lone, rests);
    }

    static Vector<int> IsTwistWithinLimit(
        Vector<float> friction, ref ConvexContactPrestepWide<TContacts> prestep, ref ConvexContactImpulsesWide<TNormals> impulses)
    {
        if (Vector.EqualsAll(impulses.Twist, Vector<float>.Zero))
            return new(-1);
        var center = CenterOnStatics(ref prestep);
        var moment = Vector<float>.Zero;
        for (int i = 0; i < TContacts.Count; ++i)
            moment += impulses.Normals[i] * (prestep.Contacts[i].OffsetA - center).Length();
        return Vector.LessThanOrEqual(Wide.Abs(impulses.Twist), friction * moment * new Vector<float>(LimitShare));
    }

    // Bodies that a sweep would leave at rest: nothing has moved them since the warm start, or turned them before, and all of their depths are within the band.
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static Vector<int> Resting(ref TBodies bodies, ref ConvexContactPrestepWide<TContacts> prestep)
    {
        ref var a = ref BodySlots.At(ref bodies, 0);
        var rests = prestep.Material.IsAtRest & IsZero(a.Linear) & IsZero(a.Angular) & IsZero(a.Rotation);
        // What its position has left over of the last step, that is: it has not moved in this one.
        var apart = Vector3Wide.Dot(a.Translation, prestep.Normal);
        var band = -prestep.Material.SpringSettings.AngularFrequency;
        for (int i = 0; i < TContacts.Count; ++i)
            rests &= Vector.LessThanOrEqual(Wide.Abs(prestep.Contacts[i].Depth - apart), band);
        return rests;
    }

    // Lanes of a bundle in which others move: they are to have what they would have had among themselves.
    [MethodImpl(MethodImplOptions.NoInlining)]
    static void LeaveAtRest(
        Vector<int> rests, in ConvexContactImpulsesWide<TNormals> before, ref SolverBodyWide body, ref ConvexContactImpulsesWide<TNormals> impulses)
    {
        body.Linear = Vector3Wide.Mask(~rests, body.Linear);
        body.Angular = Vector3Wide.Mask(~rests, body.Angular);
        var source = before;
        for (int i = 0; i < TNormals.Count; ++i)
            impulses.Normals[i] = Wide.Select(rests, source.Normals[i], impulses.Normals[i]);
        impulses.Friction = Vector3Wide.Select(rests, source.Friction, impulses.Friction);
        impulses.Twist = Wide.Select(rests, source.Twist, impulses.Twist);
    }

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static Vector<int> IsZero(in Vector3Wide v) =>
        Vector.Equals(v.X, Vector<float>.Zero) & Vector.Equals(v.Y, Vector<float>.Zero) & Vector.Equals(v.Z, Vector<float>.Zero);

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static Vector<float> WithoutDust(Vector<int> lanes, Vector<float> value, Vector<float> least) =>
        Wide.Mask(~(lanes & Vector.LessThan(Wide.Abs(value), least)), value);
}
