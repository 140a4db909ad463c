using System.Numerics;
using System.Runtime.CompilerServices;
using BepuUtilities;

namespace BepuPhysics.Constraints.Contact;

// What comes down fast on a rigid surface is stopped there, at once and by all contacts of the patch together.
//
// A contact that bears a load is a soft spring, which forgets a part of its impulse in each substep. An impact takes no time, and its
// impulse is no load: soft rows take 70 % of the approach in the substep in which surfaces meet, sink in for the rest of it, and give
// back 7 to 16 % of it as velocity on their way out; and rows that are swept in turn give the first corner of a face more than its share,
// so that what came face-on leaves with a spin. So a patch that lands is solved without softness, from equal shares of its contacts,
// which are right for what meets face-on; and its impulses are forgotten by the next substep, as nothing comes in again. That is so for
// two substeps: in the first surfaces still have a gap to close, in the second they meet. Then a load is found as by any new contact,
// unless the next corner comes down in that very substep.
readonly partial struct ConvexContactConstraint<TBodies, TContacts, TNormals>
{
    // Way of an approach in a substep, over the distance of the surface from the nearer centre, from which on it is an impact. A cube of
    // 1 m at 240 substeps a second comes at .6 m/s then, and falls by 2e-4 of this distance in the substep in which it is let go.
    const float LeastApproach = 3e-3f;

    // So many times as fast as that nothing comes by its load, but what is a few centimetres long and has one substep a step.
    const float VeryFast = 8;

    // Depth, over the same distance, to which surfaces may come: those that do not touch at all have no certain normal. What rests is
    // about as deep.
    const float LandingDepth = 5e-5f;

    // Depth, over the same distance, from which on it has to come out again, for which contacts are soft.
    const float DeepestLanding = 1e-3f;

    // Contacts of one face answer each other, and friction: from equal shares, so many sweeps leave hundredths of what one would.
    const int LandingSweeps = 8;

    // What a normal row needs to know of its bodies.
    struct LandingRow
    {
        public Vector3Wide AngularA, ResponseA, AngularB, ResponseB;
        public Vector<float> InverseMass, Target;
    }

    [InlineArray(4)]
    struct LandingRows
    {
        LandingRow first;
    }

    // In the warm start of the first substep: which patches may land in this step.
    [MethodImpl(MethodImplOptions.NoInlining)]
    static void WatchLanding(ref TBodies bodies, in Substep substep, ref ConvexContactPrestepWide<TContacts> prestep)
    {
        ref var a = ref BodySlots.At(ref bodies, 0);
        var arm = prestep.Contacts[0].OffsetA;
        var square = arm.LengthSquared();
        var velocity = Vector3Wide.Dot(a.Linear, prestep.Normal);
        var turning = a.Angular.LengthSquared() * square;
        if (TBodies.Count > 1)
        {
            ref var b = ref BodySlots.At(ref bodies, 1);
            var squareOfB = (arm - prestep.OffsetB).LengthSquared();
            velocity -= Vector3Wide.Dot(b.Linear, prestep.Normal);
            turning += b.Angular.LengthSquared() * squareOfB;
            square = Wide.Min(square, squareOfB);
        }
        var approach = Wide.Min(velocity, Vector<float>.Zero);
        // Three parts of a velocity are nowhere faster than the root of thrice the sum of their squares.
        var least = new Vector<float>(LeastApproach * substep.InverseDt);
        var isFast = Vector.GreaterThan((approach * approach + turning) * new Vector<float>(3), least * least * square);
        prestep.Material.WatchLanding(isFast);
    }

    // Before the impulses of the last substep are applied: those of an impact are not.
    [MethodImpl(MethodImplOptions.NoInlining)]
    static void AdvanceLanding(ref ConvexContactPrestepWide<TContacts> prestep, ref ConvexContactImpulsesWide<TNormals> impulses)
    {
        var landed = prestep.Material.AdvanceLanding();
        if (landed != Vector<int>.Zero)
            Forget(landed, ref impulses);
    }

    // Stops what lands. Returns the patches that do, whose contacts are solved then.
    [MethodImpl(MethodImplOptions.NoInlining)]
    static Vector<int> Land(
        ref TBodies bodies, in Substep substep, ref ConvexContactPrestepWide<TContacts> prestep,
        ref ConvexContactImpulsesWide<TNormals> impulses)
    {
        Unsafe.SkipInit(out LandingRows rows);
        PrepareLanding(ref bodies, substep, ref prestep, impulses, ref rows, out var isFast, out var isVeryFast);
        if (!substep.IsRelaxation)
            prestep.Material.BeginLanding(isFast, isVeryFast);
        var lands = prestep.Material.Lands;
        if (lands == Vector<int>.Zero)
            return lands;
        var landing = bodies;
        var found = impulses;
        ShareLanding(ref landing, prestep.Normal, rows, ref found);
        var center = PatchCenter(bodies, ref prestep);
        var centerFromB = TBodies.Count > 1 ? center - prestep.OffsetB : default;
        var coefficient = Coefficient(ref prestep);
        SweepLanding(ref landing, prestep.Normal, rows, ref found, out var load);
        for (int sweep = 1; sweep < LandingSweeps; ++sweep)
        {
            // Friction turns bodies, which may bring surfaces together again.
            SolveFriction(ref landing, prestep.Normal, center, centerFromB, coefficient * load, ref found.Friction);
            SweepLanding(ref landing, prestep.Normal, rows, ref found, out load);
        }
        for (int i = 0; i < TContacts.Count; ++i)
            impulses.Normals[i] = Wide.Select(lands, found.Normals[i], impulses.Normals[i]);
        impulses.Friction = Vector3Wide.Select(lands, found.Friction, impulses.Friction);
        for (int i = 0; i < TBodies.Count; ++i)
        {
            ref var body = ref BodySlots.At(ref bodies, i);
            ref var landed = ref BodySlots.At(ref landing, i);
            body.Linear = Vector3Wide.Select(lands, landed.Linear, body.Linear);
            body.Angular = Vector3Wide.Select(lands, landed.Angular, body.Angular);
        }
        return lands;
    }

    static void SweepLanding(
        ref TBodies bodies, in Vector3Wide n, in LandingRows rows, ref ConvexContactImpulsesWide<TNormals> impulses, out Vector<float> load)
    {
        load = Vector<float>.Zero;
        for (int i = 0; i < TContacts.Count; ++i)
        {
            var impulse = impulses.Normals[i];
            var missing = rows[i].Target - VelocityAlong(bodies, n, rows[i]);
            impulses.Normals[i] = Wide.Max(impulse + missing / rows[i].InverseMass, Vector<float>.Zero);
            Push(ref bodies, n, rows[i], impulses.Normals[i] - impulse);
            load += impulses.Normals[i];
        }
    }

    // The rows of a patch, and where a contact that bears nothing comes fast enough to be stopped within the substep.
    static void PrepareLanding(
        ref TBodies bodies, in Substep substep, ref ConvexContactPrestepWide<TContacts> prestep,
        in ConvexContactImpulsesWide<TNormals> impulses, ref LandingRows rows, out Vector<int> isFast, out Vector<int> isVeryFast)
    {
        ref var a = ref BodySlots.At(ref bodies, 0);
        var n = prestep.Normal;
        var before = impulses;
        var square = prestep.Contacts[0].OffsetA.LengthSquared();
        if (TBodies.Count > 1)
            square = Wide.Min(square, (prestep.Contacts[0].OffsetA - prestep.OffsetB).LengthSquared());
        var distance = Vector.SquareRoot(square);
        var least = distance * new Vector<float>(LeastApproach * substep.InverseDt);
        isFast = isVeryFast = Vector<int>.Zero;
        for (int i = 0; i < TContacts.Count; ++i)
        {
            ref var contact = ref prestep.Contacts[i];
            ref var row = ref rows[i];
            row.AngularA = Vector3Wide.Cross(contact.OffsetA, n);
            row.ResponseA = a.InverseInertia * row.AngularA;
            row.InverseMass = a.InverseMass + Vector3Wide.Dot(row.ResponseA, row.AngularA);
            var depth = contact.Depth - (Vector3Wide.Dot(a.Translation, n) + Vector3Wide.Dot(a.Rotation, row.AngularA));
            if (TBodies.Count > 1)
            {
                ref var b = ref BodySlots.At(ref bodies, 1);
                row.AngularB = Vector3Wide.Cross(n, contact.OffsetA - prestep.OffsetB);
                row.ResponseB = b.InverseInertia * row.AngularB;
                row.InverseMass += b.InverseMass + Vector3Wide.Dot(row.ResponseB, row.AngularB);
                depth += Vector3Wide.Dot(b.Translation, n) - Vector3Wide.Dot(b.Rotation, row.AngularB);
            }
            var inverseDt = new Vector<float>(substep.InverseDt);
            row.Target = Wide.Min((depth - distance * new Vector<float>(LandingDepth)) * inverseDt, Vector<float>.Zero);
            if (substep.IsRelaxation)
                row.Target = Wide.Select(Vector.Equals(before.Normals[i], Vector<float>.Zero), new Vector<float>(float.MinValue), row.Target);
            // What a sweep would touch lands, so that none does.
            var velocity = VelocityAlong(bodies, n, row);
            var comes = Vector.LessThan(velocity, Wide.Min(depth * inverseDt, -least)) &
                Vector.LessThan(depth, distance * new Vector<float>(DeepestLanding)) & Vector.Equals(before.Normals[i], Vector<float>.Zero);
            isFast |= comes;
            isVeryFast |= comes & Vector.LessThan(velocity, least * new Vector<float>(-VeryFast));
        }
    }

    // Gives all contacts that come too fast the same impulse: that which stops them in the mean.
    static void ShareLanding(ref TBodies bodies, in Vector3Wide n, in LandingRows rows, ref ConvexContactImpulsesWide<TNormals> impulses)
    {
        LandingRow sum = default;
        var missing = Vector<float>.Zero;
        var count = Vector<float>.Zero;
        Unsafe.SkipInit(out TNormals shares);
        for (int i = 0; i < TContacts.Count; ++i)
        {
            var wanted = rows[i].Target - VelocityAlong(bodies, n, rows[i]);
            var takes = Vector.GreaterThan(wanted, Vector<float>.Zero);
            shares[i] = Wide.Mask(takes, Vector<float>.One);
            missing += Wide.Mask(takes, wanted);
            count += shares[i];
            sum.AngularA += Vector3Wide.Mask(takes, rows[i].AngularA);
            if (TBodies.Count > 1)
                sum.AngularB += Vector3Wide.Mask(takes, rows[i].AngularB);
        }
        ref var a = ref BodySlots.At(ref bodies, 0);
        sum.ResponseA = a.InverseInertia * sum.AngularA;
        sum.InverseMass = count * count * a.InverseMass + Vector3Wide.Dot(sum.ResponseA, sum.AngularA);
        if (TBodies.Count > 1)
        {
            ref var b = ref BodySlots.At(ref bodies, 1);
            sum.ResponseB = b.InverseInertia * sum.AngularB;
            sum.InverseMass += count * count * b.InverseMass + Vector3Wide.Dot(sum.ResponseB, sum.AngularB);
        }
        var share = Wide.Mask(Vector.GreaterThan(count, Vector<float>.Zero), missing / sum.InverseMass);
        for (int i = 0; i < TContacts.Count; ++i)
            impulses.Normals[i] += shares[i] * share;
        Push(ref bodies, n * count, sum, share);
    }

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static Vector<float> VelocityAlong(in TBodies bodies, in Vector3Wide n, in LandingRow row)
    {
        ref var slots = ref Unsafe.AsRef(in bodies);
        ref var a = ref BodySlots.At(ref slots, 0);
        var velocity = Vector3Wide.Dot(a.Linear, n) + Vector3Wide.Dot(a.Angular, row.AngularA);
        if (TBodies.Count > 1)
        {
            ref var b = ref BodySlots.At(ref slots, 1);
            velocity += Vector3Wide.Dot(b.Angular, row.AngularB) - Vector3Wide.Dot(b.Linear, n);
        }
        return velocity;
    }

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static void Push(ref TBodies bodies, in Vector3Wide n, in LandingRow row, Vector<float> impulse)
    {
        ref var a = ref BodySlots.At(ref bodies, 0);
        a.Linear += n * (impulse * a.InverseMass);
        a.Angular += row.ResponseA * impulse;
        if (TBodies.Count > 1)
        {
            ref var b = ref BodySlots.At(ref bodies, 1);
            b.Linear -= n * (impulse * b.InverseMass);
            b.Angular += row.ResponseB * impulse;
        }
    }
}
