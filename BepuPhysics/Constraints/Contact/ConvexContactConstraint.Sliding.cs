using System.Numerics;
using System.Runtime.CompilerServices;
using BepuUtilities;

namespace BepuPhysics.Constraints.Contact;

// Friction of what slides, turns, or both, faster than it can be stopped in a substep.
//
// In each point of the surface friction is against that point's own velocity, so sliding and turning share it: what spins slides on for long, as most of its
// friction turns against the spin. Let the surface press evenly, slide with v at the middle of its pressure, and turn with w. Its lever L is the mean distance
// of its points from the middle. Coulomb's law, summed over a disc or a square, is to a few hundredths of mu N and of mu N L, with s = v / (w L),
//
//     f = mu N  (2/3 s) / ((2/3 s)^4 + 1)^(1/4)        t = mu N L / ((3/2 s)^4 + 1)^(1/4)
//
// Both are against the motion, at the middle of the pressure. They are taken only where they slow the patch and cannot stop it: all that an impulse J does
// to the energy is J v + J W J / 2, so where J W J is less than - J v it takes some out.
// What is slower is held as if it stood, with friction and twist each for itself: contacts are the corners of the surface, and to be still is their matter.
readonly partial struct ConvexContactConstraint<TBodies, TContacts, TNormals>
{
    // Parts of their bounds from which friction and twist may be those of something that slides. On the curve above one of both is always beyond its own.
    const float SlidingFriction = 0.7f;
    const float TurningTwist = 0.3f;
    // Greatest part of the sliding that friction may stop in a substep.
    const float GreatestSlowing = 1 / 3f;
    // A part of a patch does not know what the others bear. A whole one has four contacts as a rule, and each bears as much.
    static float PartOfWhole => TContacts.Count / 4f;
    // Greatest turn in a substep, rad, about what is not the normal: what tumbles by more has no face on which it slides.
    const float GreatestTumble = 0.05f;
    // Motion, m/s, that is none.
    const float LeastMotion = 1e-30f;

    // A lone contact has no friction to share, but where it is a part of a patch.
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static Vector<int> MaySlide(
        ref ConvexContactPrestepWide<TContacts> prestep, in ConvexContactImpulsesWide<TNormals> impulses, Vector<float> maximum, Vector<float> moment)
    {
        var friction = maximum * new Vector<float>(SlidingFriction);
        var slides = Vector.GreaterThan(impulses.Friction.LengthSquared(), friction * friction) |
            Vector.GreaterThan(Wide.Abs(impulses.Twist), moment * new Vector<float>(TurningTwist));
        return TContacts.Count > 1 ? slides : slides & JoinsFriction(ref prestep);
    }

    // Solves the friction of a bundle in which something slides. Says so if nothing does, and leaves it as it is.
    // It is told values and not where they are: locals of the sweep whose place is known to somebody are not kept in registers.
    [MethodImpl(MethodImplOptions.NoInlining)]
    static bool Slide(
        ref TBodies bodies, float inverseDt, ref ConvexContactPrestepWide<TContacts> prestep, ref ConvexContactImpulsesWide<TNormals> impulses,
        Vector3Wide center, Vector3Wide armA, Vector3Wide armB, Vector<float> load, Vector<float> maximum, Vector<float> moment)
    {
        var n = prestep.Normal;
        ref var a = ref BodySlots.At(ref bodies, 0);
        var velocity = a.Linear + Vector3Wide.Cross(a.Angular, armA);
        var turn = a.Angular;
        if (TBodies.Count > 1)
        {
            ref var b = ref BodySlots.At(ref bodies, 1);
            velocity -= b.Linear + Vector3Wide.Cross(b.Angular, armB);
            turn -= b.Angular;
        }
        var spin = Vector3Wide.Dot(turn, n);
        var greatestTumble = new Vector<float>(GreatestTumble * inverseDt);
        var slides = MaySlide(ref prestep, impulses, maximum, moment) & ~prestep.Material.IsHeld &
            Vector.LessThan((turn - n * spin).LengthSquared(), greatestTumble * greatestTumble);
        // Most that is at its bounds creeps, and needs no more than this.
        var inverseMass = a.InverseMass;
        if (TBodies.Count > 1)
            inverseMass += BodySlots.At(ref bodies, 1).InverseMass;
        var stopped = maximum * inverseMass;
        var rim = Vector<float>.Zero;
        for (int i = 0; i < TContacts.Count; ++i)
            rim = Wide.Max(rim, (prestep.Contacts[i].OffsetA - center).LengthSquared());
        slides &= Vector.GreaterThan(velocity.LengthSquared() + spin * spin * rim, stopped * stopped);
        if (slides == Vector<int>.Zero)
            return false;

        Vector3Wide.BuildOrthonormalBasis(n, out var x, out var y);
        var joins = JoinsFriction(ref prestep);
        var face = Face(ref prestep, impulses, center, x, y, joins, load, maximum);
        var slip = new Vector2Wide(Vector3Wide.Dot(velocity, x) - spin * face.Middle.Y, Vector3Wide.Dot(velocity, y) + spin * face.Middle.X);
        var (sliding, turning) = (slip.Length(), Wide.Abs(spin) * face.Lever);
        var inverse = Vector<float>.One / Wide.Max(Wide.Max(sliding, turning), new Vector<float>(LeastMotion));
        (sliding, turning) = (sliding * inverse, turning * inverse);
        var early = new Vector<float>(2 / 3f) + face.Elongation * new Vector<float>(0.15f);
        var late = new Vector<float>(3 / 2f);
        if (face.Rim != Vector<float>.Zero)
        {
            early -= face.Rim * new Vector<float>(1 / 6f) * (Vector<float>.One - sliding * sliding);
            late += face.Rim * new Vector<float>(0.5f) * (Vector<float>.One - turning * turning);
        }
        var along = -maximum * inverse * early / NormOfFour(sliding * early, turning);
        var couple = -maximum * face.Lever * face.Lever * spin * inverse / NormOfFour(sliding * late, turning);
        var twist = couple + (face.Middle.X * slip.Y - face.Middle.Y * slip.X) * along;
        var friction = (x * slip.X + y * slip.Y) * along;

        var angularA = Vector3Wide.Cross(armA, friction) + n * twist;
        var response = friction.LengthSquared() * inverseMass + Vector3Wide.Dot(angularA, a.InverseInertia * angularA);
        if (TBodies.Count > 1)
        {
            var angularB = Vector3Wide.Cross(armB, friction) + n * twist;
            response += Vector3Wide.Dot(angularB, BodySlots.At(ref bodies, 1).InverseInertia * angularB);
        }
        var power = -(Vector3Wide.Dot(friction, velocity) + twist * spin);
        var slowing = Wide.Select(joins, new Vector<float>(GreatestSlowing * PartOfWhole), new Vector<float>(GreatestSlowing));
        slides &= Vector.GreaterThan(power, Vector<float>.Zero) & Vector.LessThan(response, power * slowing);
        if (slides == Vector<int>.Zero)
            return false;
        // All of it from half of that slowing on, so that a rounding does not decide between two laws.
        var share = Wide.Min(Vector<float>.One, new Vector<float>(2) - (response + response) / (power * slowing));

        var (linearA, turnedA) = (a.Linear, a.Angular);
        var (linearB, turnedB) = TBodies.Count > 1 ? (BodySlots.At(ref bodies, 1).Linear, BodySlots.At(ref bodies, 1).Angular) : default;
        var (frictionBefore, twistBefore) = (impulses.Friction, impulses.Twist);
        Hold(ref bodies, ref prestep, ref impulses, center, armA, armB, load, maximum, moment);
        friction = impulses.Friction + (friction - impulses.Friction) * share;
        twist = impulses.Twist + (twist - impulses.Twist) * share;
        impulses.Friction = Vector3Wide.Select(slides, friction, impulses.Friction);
        impulses.Twist = Wide.Select(slides, twist, impulses.Twist);
        friction -= frictionBefore;
        twist -= twistBefore;
        a.Linear = Vector3Wide.Select(slides, linearA + friction * a.InverseMass, a.Linear);
        a.Angular = Vector3Wide.Select(slides, turnedA + a.InverseInertia * (Vector3Wide.Cross(armA, friction) + n * twist), a.Angular);
        if (TBodies.Count > 1)
        {
            ref var b = ref BodySlots.At(ref bodies, 1);
            b.Linear = Vector3Wide.Select(slides, linearB - friction * b.InverseMass, b.Linear);
            b.Angular = Vector3Wide.Select(slides, turnedB - b.InverseInertia * (Vector3Wide.Cross(armB, friction) + n * twist), b.Angular);
        }
        return true;
    }

    // Friction of what stands: along the surface and against turning, each with its own bound.
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static void Hold(
        ref TBodies bodies, ref ConvexContactPrestepWide<TContacts> prestep, ref ConvexContactImpulsesWide<TNormals> impulses,
        in Vector3Wide center, in Vector3Wide armA, in Vector3Wide armB, Vector<float> load, Vector<float> maximum, Vector<float> moment)
    {
        SolveFriction(ref bodies, prestep.Normal, armA, armB, maximum, ref impulses.Friction);
        if (TContacts.Count > 1)
            SolveTwist(ref bodies, prestep.Normal, moment, ref impulses.Twist);
        else
            SolveLoneTwist(ref bodies, ref prestep, center, load, ref impulses.Twist);
    }

    // A face that presses evenly, seen along two tangents from the centre where friction acts.
    struct PressedFace
    {
        /// <summary>The middle of the pressure.</summary>
        public Vector2Wide Middle;
        /// <summary>
        /// From 0 of what is round to 1 of a line: of the moments of second order the difference of the principal ones over their sum, squared.
        /// </summary>
        public Vector<float> Elongation;
        /// <summary>Mean distance of its points from the middle, m.</summary>
        public Vector<float> Lever;
        /// <summary>From 0 of a full face to 1 of one that presses at its rim alone.</summary>
        public Vector<float> Rim;
    }

    // The middle is the mean of the contacts by their loads. Parts of a patch do not know the loads of the others; but what nothing else pushes is not turned
    // over by its friction, so that the pressure is ahead of the foot of its centre by friction over load times the height, which is the same for all parts.
    //
    // Contacts are the corners of the face. The mean distance of its points is half of theirs for a line, .46 for a triangle. Four are those of a square (.54),
    // or of the rim of a disc (2/3): that is not known, and .6 is within a tenth of both.
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static PressedFace Face(
        ref ConvexContactPrestepWide<TContacts> prestep, in ConvexContactImpulsesWide<TNormals> impulses, in Vector3Wide center, in Vector3Wide x,
        in Vector3Wide y, Vector<int> joins, Vector<float> load, Vector<float> maximum)
    {
        const float line = 0.5f, triangle = 0.46f, squareOrDisc = 0.6f;
        var source = impulses;
        Unsafe.SkipInit(out TNormals alongX);
        Unsafe.SkipInit(out TNormals alongY);
        // Shares of the load: squares of the impulses of what is small would be nothing.
        var inverse = Wide.Select(Vector.GreaterThan(load, Vector<float>.Zero), Vector<float>.One / load, Vector<float>.Zero);
        PressedFace face;
        face.Middle = default;
        for (int i = 0; i < TContacts.Count; ++i)
        {
            var arm = prestep.Contacts[i].OffsetA - center;
            alongX[i] = Vector3Wide.Dot(arm, x);
            alongY[i] = Vector3Wide.Dot(arm, y);
            face.Middle.X += alongX[i] * source.Normals[i];
            face.Middle.Y += alongY[i] * source.Normals[i];
        }
        face.Middle *= inverse;
        if (joins != Vector<int>.Zero)
        {
            var greatest = Wide.Max(impulses.Friction.Length(), maximum);
            var height = Vector3Wide.Dot(center, prestep.Normal);
            var ahead = Wide.Select(Vector.GreaterThan(greatest, Vector<float>.Zero), height * Coefficient(ref prestep) / greatest, Vector<float>.Zero);
            var way = impulses.Friction * ahead - center;
            face.Middle.X = Wide.Select(joins, Vector3Wide.Dot(way, x), face.Middle.X);
            face.Middle.Y = Wide.Select(joins, Vector3Wide.Dot(way, y), face.Middle.Y);
        }
        var distance = Vector<float>.Zero;
        var (xx, yy, xy) = (Vector<float>.Zero, Vector<float>.Zero, Vector<float>.Zero);
        for (int i = 0; i < TContacts.Count; ++i)
        {
            var (wayX, wayY) = (alongX[i] - face.Middle.X, alongY[i] - face.Middle.Y);
            var weight = source.Normals[i] * inverse;
            var (squareX, squareY) = (wayX * wayX, wayY * wayY);
            distance += weight * Vector.SquareRoot(squareX + squareY);
            xx += weight * squareX;
            yy += weight * squareY;
            xy += weight * (wayX * wayY);
        }
        face.Elongation = Vector<float>.Zero;
        var round = new Vector<float>(squareOrDisc);
        // A contact that is alone is a part, and knows nothing of the others.
        if (TContacts.Count > 1)
        {
            var (sum, difference) = (xx + yy, xx - yy);
            sum *= sum;
            face.Elongation = Wide.Select(
                Vector.GreaterThan(sum, Vector<float>.Zero), (difference * difference + new Vector<float>(4) * (xy * xy)) / sum, Vector<float>.Zero);
        }
        if (TContacts.Count == 3)
        {
            // Three corners of a square have a ninth.
            var part = Wide.Max(face.Elongation * new Vector<float>(9 / 8f) - new Vector<float>(1 / 8f), Vector<float>.Zero);
            face.Elongation = Wide.Select(joins, part, face.Elongation);
            round = Wide.Select(joins, round, new Vector<float>(triangle));
        }
        face.Lever = round + (new Vector<float>(line) - round) * face.Elongation;
        FaceLever.Read(prestep.Material.MaximumRecoveryVelocity, ref face.Lever, ref face.Elongation, out face.Rim);
        face.Lever *= distance;
        return face;
    }

    // (a^4 + b^4)^(1/4)
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static Vector<float> NormOfFour(Vector<float> a, Vector<float> b)
    {
        (a, b) = (a * a, b * b);
        return Vector.SquareRoot(Vector.SquareRoot(a * a + b * b));
    }
}
