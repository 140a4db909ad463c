using System.Numerics;
using System.Runtime.CompilerServices;
using BepuUtilities;

namespace BepuPhysics.Constraints.Contact;

// Friction of the patch, along the surface and against turning about its normal, and where it acts.
readonly partial struct ConvexContactConstraint<TBodies, TContacts, TNormals>
{
    // Two rows that share an anchor, so their effective mass is a 2 x 2 block: a block solve stops sliding in one sweep where two rows in turn would not.
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static void SolveFriction(
        ref TBodies bodies, in Vector3Wide n, in Vector3Wide armA, in Vector3Wide armB, Vector<float> maximum, ref Vector3Wide impulse)
    {
        Vector3Wide.BuildOrthonormalBasis(n, out var x, out var y);
        ref var a = ref BodySlots.At(ref bodies, 0);
        var angularAX = Vector3Wide.Cross(armA, x);
        var angularAY = Vector3Wide.Cross(armA, y);
        var responseAX = a.InverseInertia * angularAX;
        var responseAY = a.InverseInertia * angularAY;
        var velocityX = Vector3Wide.Dot(a.Linear, x) + Vector3Wide.Dot(a.Angular, angularAX);
        var velocityY = Vector3Wide.Dot(a.Linear, y) + Vector3Wide.Dot(a.Angular, angularAY);
        Symmetric2x2Wide inverseMass;
        inverseMass.XX = a.InverseMass + Vector3Wide.Dot(responseAX, angularAX);
        inverseMass.YX = Vector3Wide.Dot(responseAX, angularAY);
        inverseMass.YY = a.InverseMass + Vector3Wide.Dot(responseAY, angularAY);
        Unsafe.SkipInit(out Vector3Wide responseBX);
        Unsafe.SkipInit(out Vector3Wide responseBY);
        if (TBodies.Count > 1)
        {
            ref var b = ref BodySlots.At(ref bodies, 1);
            var angularBX = Vector3Wide.Cross(x, armB);
            var angularBY = Vector3Wide.Cross(y, armB);
            responseBX = b.InverseInertia * angularBX;
            responseBY = b.InverseInertia * angularBY;
            velocityX += Vector3Wide.Dot(b.Angular, angularBX) - Vector3Wide.Dot(b.Linear, x);
            velocityY += Vector3Wide.Dot(b.Angular, angularBY) - Vector3Wide.Dot(b.Linear, y);
            inverseMass.XX += b.InverseMass + Vector3Wide.Dot(responseBX, angularBX);
            inverseMass.YX += Vector3Wide.Dot(responseBX, angularBY);
            inverseMass.YY += b.InverseMass + Vector3Wide.Dot(responseBY, angularBY);
        }
        // The block is positive definite wherever anything can move: its determinant is at least the square of the sum of inverse masses.
        var inverseDeterminant = Vector<float>.One / (inverseMass.XX * inverseMass.YY - inverseMass.YX * inverseMass.YX);
        var totalX = Vector3Wide.Dot(impulse, x) - (inverseMass.YY * velocityX - inverseMass.YX * velocityY) * inverseDeterminant;
        var totalY = Vector3Wide.Dot(impulse, y) - (inverseMass.XX * velocityY - inverseMass.YX * velocityX) * inverseDeterminant;
        var length = Vector.SquareRoot(totalX * totalX + totalY * totalY);
        var scale = Vector.ConditionalSelect(Vector.GreaterThan(length, maximum), maximum / length, Vector<float>.One);
        totalX *= scale;
        totalY *= scale;
        var total = x * totalX + y * totalY;
        var linear = total - impulse;
        impulse = total;
        var changeX = Vector3Wide.Dot(linear, x);
        var changeY = Vector3Wide.Dot(linear, y);
        a.Linear += linear * a.InverseMass;
        a.Angular += responseAX * changeX + responseAY * changeY;
        if (TBodies.Count > 1)
        {
            ref var b = ref BodySlots.At(ref bodies, 1);
            b.Linear -= linear * b.InverseMass;
            b.Angular += responseBX * changeX + responseBY * changeY;
        }
    }

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static void SolveTwist(ref TBodies bodies, in Vector3Wide n, Vector<float> maximum, ref Vector<float> impulse)
    {
        ref var a = ref BodySlots.At(ref bodies, 0);
        var responseA = a.InverseInertia * n;
        var inverseMass = Vector3Wide.Dot(responseA, n);
        var velocity = Vector3Wide.Dot(a.Angular, n);
        Unsafe.SkipInit(out Vector3Wide responseB);
        if (TBodies.Count > 1)
        {
            ref var b = ref BodySlots.At(ref bodies, 1);
            responseB = b.InverseInertia * n;
            inverseMass += Vector3Wide.Dot(responseB, n);
            velocity -= Vector3Wide.Dot(b.Angular, n);
        }
        // Bodies with locked rotation have no twist to stop.
        var turns = Vector.GreaterThan(inverseMass, Vector<float>.Zero);
        var total = impulse - Vector.ConditionalSelect(turns, velocity / inverseMass, Vector<float>.Zero);
        total = Wide.Max(Wide.Min(total, maximum), -maximum);
        var change = total - impulse;
        impulse = total;
        a.Angular += responseA * change;
        if (TBodies.Count > 1)
            BodySlots.At(ref bodies, 1).Angular -= responseB * change;
    }

    // Friction acts where the surfaces touch: at the mean of the contacts that touched at detection, or of all if none did; of a patch on several statics,
    // at that of the whole. Two bodies rarely have one.
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static Vector3Wide PatchCenter(in TBodies bodies, ref ConvexContactPrestepWide<TContacts> prestep)
    {
        if (TBodies.Count == 1)
            return CenterOnStatics(ref prestep);
        var own = OwnCenter(ref prestep);
        var joins = JoinsFriction(ref prestep);
        return joins == Vector<int>.Zero ? own : Vector3Wide.Select(joins, SharedCenter(bodies, ref prestep, own), own);
    }

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static Vector3Wide CenterOnStatics(ref ConvexContactPrestepWide<TContacts> prestep) =>
        Vector3Wide.Select(JoinsFriction(ref prestep), prestep.OffsetB, OwnCenter(ref prestep));

    // What B turns has an arm, and its place is needed for that. The parts of a patch on several such bodies have one more place in common, which takes no
    // room: the foot of the first body's centre.
    [MethodImpl(MethodImplOptions.NoInlining)]
    static Vector3Wide SharedCenter(in TBodies bodies, ref ConvexContactPrestepWide<TContacts> prestep, in Vector3Wide own)
    {
        ref var slots = ref Unsafe.AsRef(in bodies);
        var rests = IsZero(BodySlots.At(ref slots, 1).Angular);
        return Vector3Wide.Select(rests, prestep.OffsetB, prestep.Normal * Vector3Wide.Dot(own, prestep.Normal));
    }

    static bool IsFlat => TBodies.Count > 1 && TContacts.Count >= LeastFlat;

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static Vector3Wide OwnCenter(ref ConvexContactPrestepWide<TContacts> prestep)
    {
        if (TContacts.Count == 1)
            return prestep.Contacts[0].OffsetA;
        var all = prestep.Contacts[0].OffsetA;
        var least = prestep.Material.LeastDepth;
        var weight = Touching(prestep.Contacts[0].Depth, least);
        var touching = all * weight;
        for (int i = 1; i < TContacts.Count; ++i)
        {
            var one = Touching(prestep.Contacts[i].Depth, least);
            all += prestep.Contacts[i].OffsetA;
            touching += prestep.Contacts[i].OffsetA * one;
            weight += one;
        }
        var none = Vector.Equals(weight, Vector<float>.Zero);
        var sum = Vector3Wide.Select(none, all, touching);
        return sum * (Vector<float>.One / Vector.ConditionalSelect(none, new Vector<float>(TContacts.Count), weight));
    }

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static Vector<float> Touching(Vector<float> depth, Vector<float> least) =>
        Vector.ConditionalSelect(Vector.LessThan(depth, least), Vector<float>.Zero, Vector<float>.One);
}
