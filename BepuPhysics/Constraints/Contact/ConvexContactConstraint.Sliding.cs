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
    const float GreatestTumble = 0.25f;
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
        var joins = JoinsFriction(ref prestep);
        var slides = MaySlide(ref prestep, impulses, maximum, moment) &
            Vector.LessThan((turn - n * spin).LengthSquared(), greatestTumble * greatestTumble);
        var middle = MiddleOfPressure(ref prestep, impulses, center, joins, load, maximum);
        var length = Elongation(ref prestep, impulses, middle, joins, load);
        var lever = EvenLever(ref prestep, impulses, middle, length, joins, load);

        var off = middle - center;
        var slip = AlongSurface(velocity + Vector3Wide.Cross(n, off) * spin, n);
        var (sliding, turning) = (slip.Length(), Wide.Abs(spin) * lever);
        var inverse = Vector<float>.One / Wide.Max(Wide.Max(sliding, turning), new Vector<float>(LeastMotion));
        (sliding, turning) = (sliding * inverse, turning * inverse);
        var early = new Vector<float>(2 / 3f) + length * new Vector<float>(0.15f);
        var friction = slip * (-maximum * inverse * early / NormOfFour(sliding * early, turning));
        var couple = -maximum * lever * lever * spin * inverse / NormOfFour(sliding * new Vector<float>(3 / 2f), turning);
        var twist = couple + Vector3Wide.Dot(n, Vector3Wide.Cross(off, friction));

        var angularA = Vector3Wide.Cross(armA, friction) + n * twist;
        var inverseMass = a.InverseMass;
        var response = Vector3Wide.Dot(angularA, a.InverseInertia * angularA);
        var angularB = Vector3Wide.Cross(armB, friction) + n * twist;
        if (TBodies.Count > 1)
        {
            ref var b = ref BodySlots.At(ref bodies, 1);
            inverseMass += b.InverseMass;
            response += Vector3Wide.Dot(angularB, b.InverseInertia * angularB);
        }
        response += friction.LengthSquared() * inverseMass;
        var power = -(Vector3Wide.Dot(friction, velocity) + twist * spin);
        var slowing = Wide.Select(joins, new Vector<float>(GreatestSlowing * PartOfWhole), new Vector<float>(GreatestSlowing));
        slides &= Vector.GreaterThan(power, Vector<float>.Zero) & Vector.LessThan(response, power * slowing);
        if (slides == Vector<int>.Zero)
            return false;
        // All of it from half of that slowing on, so that a rounding does not decide between two laws.
        var share = Wide.Min(Vector<float>.One, new Vector<float>(2) - (response + response) / (power * slowing));

        var before = bodies;
        var (frictionBefore, twistBefore) = (impulses.Friction, impulses.Twist);
        Hold(ref bodies, ref prestep, ref impulses, center, armA, armB, load, maximum, moment);
        friction = impulses.Friction + (friction - impulses.Friction) * share;
        twist = impulses.Twist + (twist - impulses.Twist) * share;
        impulses.Friction = Vector3Wide.Select(slides, friction, impulses.Friction);
        impulses.Twist = Wide.Select(slides, twist, impulses.Twist);
        friction -= frictionBefore;
        twist -= twistBefore;
        ref var beforeA = ref BodySlots.At(ref before, 0);
        a.Linear = Vector3Wide.Select(slides, beforeA.Linear + friction * a.InverseMass, a.Linear);
        a.Angular = Vector3Wide.Select(slides, beforeA.Angular + a.InverseInertia * (Vector3Wide.Cross(armA, friction) + n * twist), a.Angular);
        if (TBodies.Count > 1)
        {
            ref var b = ref BodySlots.At(ref bodies, 1);
            ref var beforeB = ref BodySlots.At(ref before, 1);
            b.Linear = Vector3Wide.Select(slides, beforeB.Linear - friction * b.InverseMass, b.Linear);
            b.Angular = Vector3Wide.Select(slides, beforeB.Angular - b.InverseInertia * (Vector3Wide.Cross(armB, friction) + n * twist), b.Angular);
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

    // The mean of the contacts by their loads. Parts of a patch do not know the loads of the others; but what nothing else pushes is not turned over by its
    // friction, so that the pressure is ahead of the foot of its centre by friction over load times the height, which is the same for all parts.
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static Vector3Wide MiddleOfPressure(
        ref ConvexContactPrestepWide<TContacts> prestep, in ConvexContactImpulsesWide<TNormals> impulses, in Vector3Wide center, Vector<int> joins,
        Vector<float> load, Vector<float> maximum)
    {
        var source = impulses;
        var sum = prestep.Contacts[0].OffsetA * source.Normals[0];
        for (int i = 1; i < TContacts.Count; ++i)
            sum += prestep.Contacts[i].OffsetA * source.Normals[i];
        var pressed = Vector.GreaterThan(load, Vector<float>.Zero);
        var middle = Vector3Wide.Select(pressed, sum * (Vector<float>.One / Wide.Select(pressed, load, Vector<float>.One)), center);
        if (joins == Vector<int>.Zero)
            return middle;
        var height = Vector3Wide.Dot(center, prestep.Normal);
        var greatest = Wide.Max(impulses.Friction.Length(), maximum);
        var ahead = Wide.Select(Vector.GreaterThan(greatest, Vector<float>.Zero), height * Coefficient(ref prestep) / greatest, Vector<float>.Zero);
        return Vector3Wide.Select(joins, prestep.Normal * height + impulses.Friction * ahead, middle);
    }

    // From 0 of what is round to 1 of a line: of the moments of second order the difference of the principal ones over their sum, squared.
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static Vector<float> Elongation(
        ref ConvexContactPrestepWide<TContacts> prestep, in ConvexContactImpulsesWide<TNormals> impulses, in Vector3Wide middle, Vector<int> joins,
        Vector<float> load)
    {
        // One that is a part of a patch knows nothing of the others.
        if (TContacts.Count == 1)
            return Vector<float>.Zero;
        var source = impulses;
        // Shares of the load: squares of impulses of what is small would be nothing.
        var inverse = Wide.Select(Vector.GreaterThan(load, Vector<float>.Zero), Vector<float>.One / load, Vector<float>.Zero);
        var (sum, squares) = (Vector<float>.Zero, Vector<float>.Zero);
        for (int i = 0; i < TContacts.Count; ++i)
        {
            var arm = prestep.Contacts[i].OffsetA - middle;
            var weight = source.Normals[i] * inverse;
            var moment = weight * arm.LengthSquared();
            sum += moment;
            squares += moment * moment;
            for (int j = 0; j < i; ++j)
            {
                var product = Vector3Wide.Dot(arm, prestep.Contacts[j].OffsetA - middle);
                squares += (weight + weight) * (source.Normals[j] * inverse) * product * product;
            }
        }
        sum *= sum;
        var ratio = Wide.Select(Vector.GreaterThan(sum, Vector<float>.Zero), squares / sum, new Vector<float>(0.5f));
        var length = Wide.Clamp(ratio + ratio - Vector<float>.One, Vector<float>.Zero, Vector<float>.One);
        // Three of the corners of a square have a ninth.
        if (TContacts.Count == 3)
            length = Wide.Select(joins, Wide.Max(length * new Vector<float>(9 / 8f) - new Vector<float>(1 / 8f), Vector<float>.Zero), length);
        return length;
    }

    // The mean distance from the middle of the points of the surface of which the contacts are corners: half of that of the corners for a line, .46 for a
    // triangle. Four are those of a square (.54), or of the rim of a disc (2/3): that is not known, and .6 is within a tenth of both.
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static Vector<float> EvenLever(
        ref ConvexContactPrestepWide<TContacts> prestep, in ConvexContactImpulsesWide<TNormals> impulses, in Vector3Wide middle,
        Vector<float> length, Vector<int> joins, Vector<float> load)
    {
        const float line = 0.5f, triangle = 0.46f, squareOrDisc = 0.6f;
        var source = impulses;
        var distances = Vector<float>.Zero;
        for (int i = 0; i < TContacts.Count; ++i)
            distances += source.Normals[i] * (prestep.Contacts[i].OffsetA - middle).Length();
        var round = new Vector<float>(squareOrDisc);
        if (TContacts.Count == 3)
            round = Wide.Select(joins, round, new Vector<float>(triangle));
        var share = round + (new Vector<float>(line) - round) * length;
        return Wide.Select(Vector.GreaterThan(load, Vector<float>.Zero), share * distances / load, Vector<float>.Zero);
    }

    // (a^4 + b^4)^(1/4)
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static Vector<float> NormOfFour(Vector<float> a, Vector<float> b)
    {
        (a, b) = (a * a, b * b);
        return Vector.SquareRoot(Vector.SquareRoot(a * a + b * b));
    }
}
