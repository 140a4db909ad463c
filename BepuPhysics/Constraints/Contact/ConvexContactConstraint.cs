using System.Numerics;
using System.Runtime.CompilerServices;
using BepuUtilities;

namespace BepuPhysics.Constraints.Contact;

/// <summary>A convex manifold of one to four contacts on one or two bodies: non-penetration per contact, friction per patch.</summary>
// Notation: n normal from B to A, rA lever arm from the centre of A to the contact, rB = rA - offsetB.
// Normal rows     C_i = separation_i >= 0        J_i = [ n, rA_i x n, -n, n x rB_i ]         lambda_i >= 0
// Friction rows   at the patch centre c, along two tangents                                  |f| <= mu sum(lambda_i)   (Coulomb, for the patch)
// Twist row       J = [ 0, n, 0, -n ]                                                       |t| <= mu sum(lambda_i |c - c_i|)
// A patch that lies on several statics side by side has a constraint for each. All of them have friction at the centre of the whole, so that theirs add up to
// that of one patch on one static; there a single contact has a lever, and twist, too. So has one on kinematic bodies. Of those that do not turn the arm
// makes no difference, and the centre is written in its place; those that turn need it, and let friction act at the foot of A's centre.
// Friction is bounded by the sum of the normal impulses, so it does not depend on how many contacts represent the patch, and it is
// solved after them, so that it knows the load of this very sweep.
//
// Contacts follow their bodies within a step: separation = separation at detection + J_i (displacement since then), with the arms kept.
// Arms, normal and displacement are consistent to first order, so what a contact takes at one arm it gives back at the same arm.
readonly partial struct ConvexContactConstraint<TBodies, TContacts, TNormals> :
    IConstraint<TBodies, ConvexContactPrestepWide<TContacts>, ConvexContactImpulsesWide<TNormals>>
    where TBodies : unmanaged, IBodySlots where TContacts : unmanaged, IFew<ContactPrestepWide> where TNormals : unmanaged, IFew<Vector<float>>
{
    // Least part of its softness that a row keeps whose recovery is limited, and which bears a load.
    const float LeastSoftness = 0.25f;

    /// <inheritdoc/>
    public static BodyAccess WarmStartAccess => BodyAccess.Velocity | BodyAccess.Mass;
    /// <inheritdoc/>
    public static BodyAccess SolveAccess => BodyAccess.Velocity | BodyAccess.Mass | BodyAccess.Displacement;

    /// <inheritdoc/>
    // All impulses of the manifold are summed to one force and one torque before they touch the bodies:
    // sum(rA_i x n l_i) = (sum l_i rA_i) x n, and the same about B with every arm shifted by -offsetB.
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void WarmStart(
        ref TBodies bodies, in Substep substep, ref ConvexContactPrestepWide<TContacts> prestep, ref ConvexContactImpulsesWide<TNormals> impulses)
    {
        if (substep.WarmStartScale != 1)
            Scale(ref impulses, new Vector<float>(substep.WarmStartScale));
        ForgetSpinning(bodies, substep, ref impulses);
        if (substep.Index == 0 && substep.Lands)
            WatchLanding(ref bodies, substep, ref prestep);
        if (prestep.Material.Landing != Vector<float>.Zero)
            AdvanceLanding(ref prestep, ref impulses);
        var load = impulses.Normals[0];
        var arm = prestep.Contacts[0].OffsetA * load;
        for (int i = 1; i < TContacts.Count; ++i)
        {
            load += impulses.Normals[i];
            arm += prestep.Contacts[i].OffsetA * impulses.Normals[i];
        }
        var linear = prestep.Normal * load + impulses.Friction;
        var angularA = Vector3Wide.Cross(arm, prestep.Normal) + Vector3Wide.Cross(PatchCenter(bodies, ref prestep), impulses.Friction);
        if (TContacts.Count > 1)
            angularA += prestep.Normal * impulses.Twist;
        else
            WarmStartLoneTwist(ref prestep, impulses.Twist, ref angularA);
        ref var a = ref BodySlots.At(ref bodies, 0);
        a.Linear += linear * a.InverseMass;
        a.Angular += a.InverseInertia * angularA;
        if (MayRestAlone)
        {
            var lone = prestep.Material.IsHeldAlone;
            if (lone != Vector<int>.Zero)
                BringToRest(lone, linear, load, ref a, ref prestep, ref impulses);
        }
        if (TBodies.Count > 1)
        {
            ref var b = ref BodySlots.At(ref bodies, 1);
            b.Linear -= linear * b.InverseMass;
            b.Angular -= b.InverseInertia * (angularA - Vector3Wide.Cross(prestep.OffsetB, linear));
        }
    }

    /// <inheritdoc/>
    // A JIT root of its own: inlined into the loop, it and the gathers are more than the JIT's inliner takes.
    [MethodImpl(MethodImplOptions.NoInlining)]
    public static void Solve(
        ref TBodies bodies, in Substep substep, ref ConvexContactPrestepWide<TContacts> prestep, ref ConvexContactImpulsesWide<TNormals> impulses)
    {
        var isHeld = prestep.Material.IsHeld;
        var anyHeld = isHeld != Vector<int>.Zero;
        var rests = Vector<int>.Zero;
        Unsafe.SkipInit(out ConvexContactImpulsesWide<TNormals> before);
        if (MayRestAlone && anyHeld)
        {
            rests = Resting(ref bodies, ref prestep);
            if (Vector.EqualsAll(rests, new Vector<int>(-1)))
                return;
            before = impulses;
        }
        var softness = prestep.Material.SpringSettings.ForSubstep(substep, substep.Contacts);
        var band = Vector<float>.Zero;
        if (anyHeld)
            band = Harden(isHeld, substep, prestep.Material.SpringSettings.AngularFrequency, ref softness);
        var inverseDt = new Vector<float>(substep.InverseDt);
        var mayCarry = MayCarry(bodies);
        Unsafe.SkipInit(out Vector3Wide pressed);
        if (IsFlat && mayCarry)
            TurnSurface(ref bodies, substep, prestep.Normal, out pressed);
        if (substep.Lands && prestep.Material.Landing != Vector<float>.Zero)
        {
            var lands = Land(ref bodies, substep, ref prestep, ref impulses);
            // Nothing is recovered either: a limit of that would divide by the scale of the mass.
            softness.ErrorToVelocity = Wide.Mask(~lands, softness.ErrorToVelocity);
            softness.MassScale = Wide.Mask(~lands, softness.MassScale);
            softness.ImpulseScale = Wide.Mask(~lands, softness.ImpulseScale);
        }
        var load = Vector<float>.Zero;
        for (int i = 0; i < TContacts.Count; ++i)
        {
            SolveNormal(ref bodies, substep, ref prestep, prestep.Contacts[i], softness, anyHeld, band, inverseDt, ref impulses.Normals[i]);
            load += impulses.Normals[i];
        }
        if (IsFlat && mayCarry)
            BodySlots.At(ref bodies, 1).Linear -= pressed;
        var center = PatchCenter(bodies, ref prestep);
        var coefficient = Coefficient(ref prestep);
        Vector3Wide rubbedA = center, rubbedB = default;
        if (TBodies.Count > 1)
        {
            rubbedB = center - prestep.OffsetB;
            if (mayCarry)
                GoAlong(bodies, substep, prestep.Normal, ref rubbedA, ref rubbedB);
            if (anyHeld && prestep.Material.TurnsAlong != Vector<int>.Zero)
                TurnTogether(bodies, substep, prestep.Normal, prestep.Material.TurnsAlong, ref rubbedA, ref rubbedB);
        }
        var maximum = coefficient * load;
        var moment = Vector<float>.Zero;
        if (TContacts.Count > 1)
        {
            for (int i = 0; i < TContacts.Count; ++i)
                moment += impulses.Normals[i] * (prestep.Contacts[i].OffsetA - center).Length();
            moment *= coefficient;
        }
        if (MaySlide(ref prestep, impulses, maximum, moment) == Vector<int>.Zero ||
            !Slide(ref bodies, substep.InverseDt, ref prestep, ref impulses, center, rubbedA, rubbedB, load, maximum, moment))
            Hold(ref bodies, ref prestep, ref impulses, center, rubbedA, rubbedB, load, maximum, moment);
        if (MayRestAlone && rests != Vector<int>.Zero)
            LeaveAtRest(rests, before, ref BodySlots.At(ref bodies, 0), ref impulses);
    }

    // The impulses of the substep before are where this one begins, as what rests is loaded alike in both. What turns by more than this, rad, in a substep has
    // nothing of the kind: a corner that hit is not the one that hits next, and one sweep does not take back what a wrong impulse gives at the end of an arm.
    const float GreatestKeptTurn = 3.5f;

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static void ForgetSpinning(in TBodies bodies, in Substep substep, ref ConvexContactImpulsesWide<TNormals> impulses)
    {
        ref var slots = ref Unsafe.AsRef(in bodies);
        var square = BodySlots.At(ref slots, 0).Angular.LengthSquared();
        if (TBodies.Count > 1)
            square = Wide.Max(square, BodySlots.At(ref slots, 1).Angular.LengthSquared());
        var greatest = GreatestKeptTurn * substep.InverseDt;
        var spins = Vector.GreaterThan(square, new Vector<float>(greatest * greatest));
        if (spins != Vector<int>.Zero)
            Forget(spins, ref impulses);
    }

    [MethodImpl(MethodImplOptions.NoInlining)]
    static void Forget(Vector<int> lanes, ref ConvexContactImpulsesWide<TNormals> impulses)
    {
        for (int i = 0; i < TNormals.Count; ++i)
            impulses.Normals[i] = Wide.Mask(~lanes, impulses.Normals[i]);
        impulses.Friction = Vector3Wide.Mask(~lanes, impulses.Friction);
        impulses.Twist = Wide.Mask(~lanes, impulses.Twist);
    }

    // Lanes without a centre of their own have no twist, and are left as they are to the last bit.
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static void WarmStartLoneTwist(ref ConvexContactPrestepWide<TContacts> prestep, Vector<float> twist, ref Vector3Wide angular)
    {
        var joins = JoinsFriction(ref prestep);
        if (joins != Vector<int>.Zero)
            angular = Vector3Wide.Select(joins, angular + prestep.Normal * twist, angular);
    }

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static void SolveLoneTwist(
        ref TBodies bodies, ref ConvexContactPrestepWide<TContacts> prestep, in Vector3Wide center, Vector<float> load, ref Vector<float> twist)
    {
        var joins = JoinsFriction(ref prestep);
        if (joins == Vector<int>.Zero)
            return;
        // What B is moved by in the lanes that join is nothing, and in the others left.
        ref var angular = ref BodySlots.At(ref bodies, 0).Angular;
        var before = angular;
        var angularB = TBodies.Count > 1 ? BodySlots.At(ref bodies, 1).Angular : default;
        var solved = twist;
        var lever = (prestep.Contacts[0].OffsetA - center).Length();
        SolveTwist(ref bodies, prestep.Normal, Wide.Mask(joins, Coefficient(ref prestep) * load * lever), ref solved);
        angular = Vector3Wide.Select(joins, angular, before);
        if (TBodies.Count > 1)
            BodySlots.At(ref bodies, 1).Angular = angularB;
        twist = Wide.Select(joins, solved, twist);
    }

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static Vector<int> JoinsFriction(ref ConvexContactPrestepWide<TContacts> prestep) => TBodies.Count > 1
        ? prestep.Material.SharesFriction : Vector.GreaterThan(prestep.OffsetB.LengthSquared(), Vector<float>.Zero);

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static Vector<float> Coefficient(ref ConvexContactPrestepWide<TContacts> prestep) => TBodies.Count > 1
        ? Wide.Abs(prestep.Material.FrictionCoefficient) : prestep.Material.FrictionCoefficient;

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static void SolveNormal(
        ref TBodies bodies, in Substep substep, ref ConvexContactPrestepWide<TContacts> prestep, in ContactPrestepWide contact,
        in SoftnessWide softness, bool anyHeld, Vector<float> band, Vector<float> inverseDt, ref Vector<float> impulse)
    {
        ref var a = ref BodySlots.At(ref bodies, 0);
        var n = prestep.Normal;
        var angularA = Vector3Wide.Cross(contact.OffsetA, n);
        var responseA = a.InverseInertia * angularA;
        var inverseMass = a.InverseMass + Vector3Wide.Dot(responseA, angularA);
        var velocity = Vector3Wide.Dot(a.Linear, n) + Vector3Wide.Dot(a.Angular, angularA);
        var depth = contact.Depth - (Vector3Wide.Dot(a.Translation, n) + Vector3Wide.Dot(a.Rotation, angularA));
        Unsafe.SkipInit(out Vector3Wide responseB);
        if (TBodies.Count > 1)
        {
            ref var b = ref BodySlots.At(ref bodies, 1);
            var angularB = Vector3Wide.Cross(n, contact.OffsetA - prestep.OffsetB);
            responseB = b.InverseInertia * angularB;
            inverseMass += b.InverseMass + Vector3Wide.Dot(responseB, angularB);
            velocity += Vector3Wide.Dot(b.Angular, angularB) - Vector3Wide.Dot(b.Linear, n);
            depth += Vector3Wide.Dot(b.Translation, n) - Vector3Wide.Dot(b.Rotation, angularB);
        }
        if (anyHeld)
            depth -= Wide.Clamp(depth, -band, band);
        // Surfaces that are apart may close their gap within the substep but no more; penetration is pushed out as the spring says.
        var recovery = depth * softness.ErrorToVelocity;
        var isLimited = Vector.GreaterThan(recovery, prestep.Material.MaximumRecoveryVelocity);
        var wanted = Wide.Min(depth * inverseDt, Wide.Min(recovery, prestep.Material.MaximumRecoveryVelocity));
        var massScale = softness.MassScale;
        var impulseScale = softness.ImpulseScale;
        if (!Vector.EqualsAll(isLimited, Vector<int>.Zero))
        {
            var kept = KeptSoftness(prestep.Material.MaximumRecoveryVelocity, recovery, velocity, impulse * inverseMass);
            Stiffen(isLimited, kept, ref massScale, ref impulseScale);
        }
        // What has not pushed in this substep has left nothing behind; what will be hit in the next one keeps its speed until then.
        if (substep.IsRelaxation)
            massScale = Wide.Mask(Vector.GreaterThan(impulse, Vector<float>.Zero), massScale);
        var total = Wide.Max(impulse + (wanted - velocity) * (massScale / inverseMass) - impulse * impulseScale, Vector<float>.Zero);
        var change = total - impulse;
        impulse = total;
        a.Linear += n * (change * a.InverseMass);
        a.Angular += responseA * change;
        if (TBodies.Count > 1)
        {
            ref var b = ref BodySlots.At(ref bodies, 1);
            b.Linear -= n * (change * b.InverseMass);
            b.Angular += responseB * change;
        }
    }

    // A held patch brings its surfaces to rest without softness, and takes out slowly what overlap is beyond the band: what is left of the load is moved by
    // the load path, and softness would leak it.
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static Vector<float> Harden(Vector<int> isHeld, in Substep substep, Vector<float> angularFrequency, ref SoftnessWide softness)
    {
        softness.MassScale = Wide.Select(isHeld, Vector<float>.One, softness.MassScale);
        softness.ImpulseScale = Vector.AndNot(softness.ImpulseScale, Vector.AsVectorSingle(isHeld));
        var recovery = new Vector<float>(substep.IsRelaxation ? 0 : ContactMaterialWide.HeldRecovery * substep.InverseDt);
        softness.ErrorToVelocity = Wide.Select(
            isHeld, Wide.Mask(~ContactMaterialWide.IsLifted(angularFrequency), recovery), softness.ErrorToVelocity);
        return Wide.Mask(isHeld, -angularFrequency);
    }

    // At rest a soft row carries wanted / (softness x inverse mass): were only its velocity limited, so would be its force, and a light
    // body under a pile would sink without end. Its softness falls with the velocity, and the force goes on to rise with the depth; to
    // four times what it was, as many bodies in one place throw each other about when their rows are all but hard.
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static void Stiffen(Vector<int> isLimited, Vector<float> kept, ref Vector<float> massScale, ref Vector<float> impulseScale)
    {
        var softness = impulseScale / massScale * kept;
        var stiffMassScale = Vector<float>.One / (Vector<float>.One + softness);
        massScale = Wide.Select(isLimited, stiffMassScale, massScale);
        impulseScale = Wide.Select(isLimited, softness * stiffMassScale, impulseScale);
    }

    // The part of its softness that a limited row keeps. Only what bears a load needs the force. What of the velocity that the last impulse gave, as this
    // substep began with it, is there now was no load, and given once more it throws the upper of two bodies on each other out faster than the limit,
    // which one sweep does not take back. So much has all its softness, which forgets the impulse.
    [MethodImpl(MethodImplOptions.NoInlining)]
    static Vector<float> KeptSoftness(Vector<float> maximum, Vector<float> recovery, Vector<float> velocity, Vector<float> given)
    {
        var least = Wide.Max(maximum / recovery, new Vector<float>(LeastSoftness));
        var thrown = Wide.Clamp(Wide.DivideOrZero(velocity, Wide.Max(given, maximum)), Vector<float>.Zero, Vector<float>.One);
        return least + thrown * (Vector<float>.One - least);
    }

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static void Scale(ref ConvexContactImpulsesWide<TNormals> impulses, Vector<float> scale)
    {
        for (int i = 0; i < TNormals.Count; ++i)
            impulses.Normals[i] *= scale;
        impulses.Friction *= scale;
        // Nothing that rests loads its contacts with a twist: it is what stops a turn, which is no force, and grown with each longer substep it
        // would turn a tower more and more.
        impulses.Twist *= Wide.Min(scale, Vector<float>.One);
    }
}
