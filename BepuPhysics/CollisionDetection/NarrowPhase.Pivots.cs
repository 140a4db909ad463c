using System.Runtime.CompilerServices;
using BepuPhysics.Collidables;
using BepuUtilities;

namespace BepuPhysics.CollisionDetection;

// A corner or an edge on which a body turns is where it will be in the middle of the step. The solver keeps the arm r of a contact for a step, and friction
// holds what the body has there of velocity: with the arm of the beginning the corner itself, which goes round with the body, creeps by w x (w x r) dt^2 / 2
// in each step, always to the same side. What swings on a corner, as the parts of a ragdoll that lies on the ground do, walked by half a millimetre a second,
// against its friction: that is work, and for nothing. It gained up to ten times its energy in a minute.
//
// Friction and the velocity along the normal are those of the middle of each substep, in the mean that of the step. Depths are seen as they are when substeps
// begin: the depth is changed by what makes it right then, as at rims (RimContacts).
public sealed unsafe partial class NarrowPhase<TCallbacks>
{
    // With more contacts that touch it lies on a face, and keeps its arms.
    const int GreatestPivotCount = 2;
    // Part of its arm by which a contact of three or four is open at least if it does not touch. Of what lies at rest a depth is rounding.
    const float OpenPart = 1e-2f;
    // Half of a turn in a step, rad, from which on it is worth it, and beyond which nobody knows where a corner will be.
    const float LeastPivotTurn = 1e-4f;
    const float GreatestPivotTurn = 0.3f;
    // A corner is a pivot if it moves by less than this part of how fast it goes round the centre. What slides or flies has another way to go.
    const float PivotSlip = 0.25f;

    // What is round rolls: its surface turns away under the contact. Contacts where a pair will touch are those of another time.
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static bool MayPivot(in TestedPair tested, TypedIndex shapeA) =>
        shapeA.Type is Box.Id or ConvexHull.Id && tested.Pair.B.Mobility == CollidableMobility.Static && !tested.IsImpact;

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static bool IsPivoting(in ConvexContactManifold found) => found.Count <= GreatestPivotCount || OpenCount(found) >= found.Count - GreatestPivotCount;

    static int OpenCount(in ConvexContactManifold found)
    {
        var count = 0;
        for (int i = 0; i < found.Count; ++i)
        {
            ref readonly var contact = ref found.Read(i);
            if (contact.Depth < 0 && contact.Depth * contact.Depth > OpenPart * OpenPart * Exact.LengthSquared(contact.Offset))
                ++count;
        }
        return count;
    }

    /// <summary>The contacts of a pair as the solver is to have them.</summary>
    /// <param name="pair">A body and a static.</param>
    /// <param name="found">Its contacts as they were found.</param>
    /// <param name="atRims">The same, of which some may have gone ahead already, and are left where they are.</param>
    /// <param name="moved">Room for others.</param>
    [MethodImpl(MethodImplOptions.NoInlining)]
    ref readonly ConvexContactManifold AtPivots(in CollidablePair pair, in ConvexContactManifold found, in ConvexContactManifold atRims,
        ref ConvexContactManifold moved)
    {
        ref readonly var velocity = ref MotionOf(pair.A).Velocity;
        var turn = velocity.Angular * (0.5f * stepTime);
        var squared = Exact.LengthSquared(turn);
        if (!(squared > LeastPivotTurn * LeastPivotTurn && squared < GreatestPivotTurn * GreatestPivotTurn))
            return ref atRims;
        var turnSeen = velocity.Angular * rimTime;
        if (!Unsafe.AreSame(in atRims, in moved))
            moved = found;
        for (int i = 0; i < found.Count; ++i)
        {
            var arm = found.Read(i).Offset;
            var around = Exact.Cross(velocity.Angular, arm);
            if (!(Exact.LengthSquared(velocity.Linear + around) < Exact.LengthSquared(around) * (PivotSlip * PivotSlip)))
                continue;
            ref var target = ref ConvexContactManifold.GetConvexContactReference(ref moved, i);
            if (target.Offset != arm)
                continue;
            target.Offset = RimContacts.Turn(arm, turn);
            target.Depth += Exact.Dot(found.Normal, Exact.Cross(turnSeen, target.Offset) - (RimContacts.Turn(arm, turnSeen) - arm));
        }
        return ref moved;
    }
}
