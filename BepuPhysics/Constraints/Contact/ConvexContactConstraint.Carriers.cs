using System.Numerics;
using System.Runtime.CompilerServices;
using BepuUtilities;

namespace BepuPhysics.Constraints.Contact;

// What stands and rolls on what turns: turntables, decks, drums.
readonly partial struct ConvexContactConstraint<TBodies, TContacts, TNormals>
{
    // What is so many times as heavy as another body and turns so fast, rad/s, carries it: platforms. Of what rocks on each other neither carries the other.
    const float CarrierMass = 8;
    const float CarrierTurn = 0.1f;

    // Greatest turn in a step, rad, up to which a place on what turns is known from its velocity.
    const float GreatestCarrierTurn = 0.5f;
    // Greatest way along the surface, as a part of an arm, on what is not kinematic: what moves farther is thrown off, and on what is small and heavy friction
    // would have a lever that is not there, with which no impulse was warm started.
    const float GreatestWay = 0.5f;

    // Fewer contacts may be those of something round, whose surface stays where it is as it turns.
    const int LeastFlat = 3;

    // Whether a body may carry another, by their masses. Nearly all patches of two bodies ask no more than this.
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static bool MayCarry(in TBodies bodies)
    {
        if (TBodies.Count == 1)
            return false;
        var (carriesA, carriesB) = ByMass(bodies);
        return (carriesA | carriesB) != Vector<int>.Zero;
    }

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static (Vector<int> A, Vector<int> B) ByMass(in TBodies bodies)
    {
        ref var slots = ref Unsafe.AsRef(in bodies);
        var (massA, massB) = (BodySlots.At(ref slots, 0).InverseMass, BodySlots.At(ref slots, 1).InverseMass);
        var share = new Vector<float>(1 / CarrierMass);
        return (Vector.LessThan(massA, massB * share), Vector.LessThan(massB, massA * share));
    }

    // Those that turn fast enough, and not too fast.
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static (Vector<int> A, Vector<int> B) Turning(in TBodies bodies, in SolverBodyWide a, in SolverBodyWide b, Vector<float> ahead)
    {
        var (carriesA, carriesB) = ByMass(bodies);
        var turn = new Vector<float>(CarrierTurn * CarrierTurn);
        return (carriesA & Vector.GreaterThan(a.Angular.LengthSquared(), turn) & IsKnown(a, ahead),
            carriesB & (IsKinematic(b) | Vector.GreaterThan(b.Angular.LengthSquared(), turn)) & IsKnown(b, ahead));
    }

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static Vector<int> IsKnown(in SolverBodyWide body, Vector<float> ahead) => Vector.LessThan(
        (body.Rotation + body.Angular * ahead).LengthSquared(), new Vector<float>(GreatestCarrierTurn * GreatestCarrierTurn));

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static Vector<float> Ahead(in Substep substep) => new(substep.IsRelaxation ? 0 : 0.5f * substep.Dt);

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static Vector3Wide AlongSurface(in Vector3Wide way, in Vector3Wide n) => way - n * Vector3Wide.Dot(way, n);

    // On what carries another body, as a turntable, the surface's velocity points elsewhere as soon as that has moved on: friction for where it was at
    // detection makes all that turns along spiral outwards. So the patch goes along with what is carried: on the other body it is where that is in the
    // middle of the substep, or now, in a relaxation. For the middle, v = w x (r + v dt / 2), and a circle is left to the third order. Across the surface arms
    // end there already; on a kinematic body's face, which goes up or down as it turns, they go along with that.
    [MethodImpl(MethodImplOptions.NoInlining)]
    static void GoAlong(in TBodies bodies, in Substep substep, in Vector3Wide n, ref Vector3Wide armA, ref Vector3Wide armB)
    {
        ref var slots = ref Unsafe.AsRef(in bodies);
        ref var a = ref BodySlots.At(ref slots, 0);
        ref var b = ref BodySlots.At(ref slots, 1);
        var ahead = Ahead(substep);
        var (turnsA, turnsB) = Turning(bodies, a, b, ahead);
        var moved = AlongSurface(a.Translation - b.Translation + (a.Linear - b.Linear) * ahead, n);
        var way = moved.LengthSquared();
        turnsA &= Vector.LessThan(way, armA.LengthSquared() * new Vector<float>(GreatestWay * GreatestWay));
        turnsB &= IsKinematic(b) | Vector.LessThan(way, armB.LengthSquared() * new Vector<float>(GreatestWay * GreatestWay));
        armA -= Vector3Wide.Mask(turnsA, moved);
        var risen = IsFlat ? Vector3Wide.Dot(n, Vector3Wide.Cross(b.Rotation + b.Angular * ahead, armB)) : Vector<float>.Zero;
        armB += Vector3Wide.Mask(turnsB, moved);
        if (IsFlat)
            armB += n * Wide.Mask(turnsB & IsKinematic(b), risen);
    }

    // Bodies that are held on each other on a floor that turns, as bricks on a carousel, go round each other in a step. Friction for where they were at
    // detection makes them part by the square of that, which a brick on two others cannot: the two would pull at it against each other, more in each step,
    // until all friction is at its limit and holds nothing any more. So the patch is where both have it in the middle of the substep, half way between; where
    // one carries the other, the patch has gone along with that.
    [MethodImpl(MethodImplOptions.NoInlining)]
    static void TurnTogether(in TBodies bodies, in Substep substep, in Vector3Wide n, Vector<int> lanes, ref Vector3Wide armA, ref Vector3Wide armB)
    {
        ref var slots = ref Unsafe.AsRef(in bodies);
        ref var a = ref BodySlots.At(ref slots, 0);
        ref var b = ref BodySlots.At(ref slots, 1);
        var ahead = Ahead(substep);
        var (turnsA, turnsB) = Turning(bodies, a, b, ahead);
        lanes = Vector.AndNot(lanes, turnsA | turnsB | IsKinematic(b));
        var moved = AlongSurface(a.Translation - b.Translation + (a.Linear - b.Linear) * ahead, n);
        moved = Vector3Wide.Mask(lanes, moved * new Vector<float>(0.5f));
        armA -= moved;
        armB += moved;
    }

    // The face of a drum comes towards what is carried along it, faster the farther that has come: n (w x s) after a way s along it, which is how the drum
    // takes it round. For the place at detection it would come only at the beginning of the next step, and press in the first substeps alone; in the others
    // friction would bear nothing, and what it holds would slip down. So a kinematic body has, while the contacts are solved, the velocity and the displacement
    // of its face there. Others, which what they carry moves, are left as they are: heaps that tumble are no drums.
    [MethodImpl(MethodImplOptions.NoInlining)]
    static void TurnSurface(ref TBodies bodies, in Substep substep, in Vector3Wide n, out Vector3Wide pressed)
    {
        ref var a = ref BodySlots.At(ref bodies, 0);
        ref var b = ref BodySlots.At(ref bodies, 1);
        var isKinematic = IsKinematic(b) & IsKnown(b, Ahead(substep));
        var way = AlongSurface(a.Translation - b.Translation, n);
        var middle = way + AlongSurface(a.Linear - b.Linear, n) * Ahead(substep);
        pressed = n * Wide.Mask(isKinematic, Vector3Wide.Dot(n, Vector3Wide.Cross(b.Angular, middle)));
        b.Translation += n * (new Vector<float>(0.5f) * Wide.Mask(isKinematic, Vector3Wide.Dot(n, Vector3Wide.Cross(b.Rotation, way))));
        b.Linear += pressed;
    }

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static Vector<int> IsKinematic(in SolverBodyWide body) => Vector.Equals(body.InverseMass, Vector<float>.Zero);
}
