using System.Numerics;
using BepuUtilities;

namespace BepuPhysics.Constraints.Contact;

// What rests alone on a static or a kinematic body.
//
// A body whose only constraint is a patch on what nothing pushes has nobody on it. If what its contacts bore in the last substep bears it
// now, there is nothing to hand down either: its contacts are held here, by bundles, and the graph need not know of it. What has just
// been put down, or is about to slip, goes the usual way, as friction knows its limit only once the load is there.
//
// So it is on a floor: all is as on the ground, seen from it. Where a game changes its velocities, what rests on it is pushed along as
// the graph's bodies are.
readonly unsafe partial struct SupportFinder
{
    // Part of the greatest pull inwards, and change of velocity, for which a body is known to follow: arms that are kept are not quite
    // where contacts are.
    const float SureShare = 0.9f;
    // Overlap of what rests alone, in half widths of the band in which held contacts know none.
    const float GreatestLoneOverlap = 2;

    /// <summary>Which of some bodies are kinematic.</summary>
    internal static Vector<int> AreFixed(Vector<int> references) =>
        Vector.Equals(references & new Vector<int>(EncodedBody.KinematicFlag), new(EncodedBody.KinematicFlag));

    static Vector<int> Turns(in Vector3Wide angular) => Vector.GreaterThan(
        Wide.Max(Wide.Abs(angular.X), Wide.Max(Wide.Abs(angular.Y), Wide.Abs(angular.Z))), Vector<float>.Zero);

    // Whether A rests on a floor that takes it round slowly and changes its velocities by no more than A follows: all that the graph asks
    // of what rests on a floor. What falls onto it goes the usual way, and so does what is pressed on by a floor that starts upwards at
    // once.
    Vector<int> RestsOnFloor(
        in Vector3Wide velocity, in Vector3Wide gain, in Vector3Wide change, in Vector3Wide turnChange, in Vector3Wide turn, in Vector3Wide toB)
    {
        var squared = gain.LengthSquared();
        var rests = Vector.LessThan(velocity.LengthSquared(), new Vector<float>(RestingSteps * RestingSteps) * squared);
        var inwards = turn.LengthSquared() * toB.Length() * new Vector<float>(dt);
        const float slow = SureShare * LoadPathStage.GreatestInwardPull;
        var most = SureShare * LoadPathStage.GreatestChange * SubstepCount;
        return rests & Vector.LessThanOrEqual(inwards * inwards, new Vector<float>(slow * slow) * squared) &
            Vector.LessThanOrEqual(ChangeAt(change, turnChange, toB).LengthSquared(), new Vector<float>(most * most) * squared);
    }

    float SubstepCount => quietSteps / LoadPathStage.QuietSteps;

    // What a floor has changed of the velocity of what moves along with it, at A.
    static Vector3Wide ChangeAt(in Vector3Wide change, in Vector3Wide turnChange, in Vector3Wide toB) => change + Vector3Wide.Cross(toB, turnChange);

    // Whether A overlaps what it rests on by so much that it is moved out by the graph. What is less is taken out by a velocity: it does not matter.
    static Vector<int> Overlaps(int count, Vector<float>* prestep, Vector<float> band)
    {
        var depth = ((ContactPrestepWide*)prestep)->Depth;
        for (int i = 1; i < count; ++i)
            depth = Wide.Max(depth, ((ContactPrestepWide*)prestep)[i].Depth);
        return Vector.GreaterThan(depth, new Vector<float>(GreatestLoneOverlap) * band);
    }

    // Whether the warm start alone brings A to rest on what nothing pushes, as that takes it along in the middle of the substep, once it
    // was pushed along for what the floor has changed. That A turns otherwise would be seen in the next step.
    Vector<int> IsBorne(
        int count, in SolverBodyWide body, in SolverBodyWide floor, in Vector3Wide toFloor, in Vector3Wide change, in Vector3Wide turnChange,
        in Vector3Wide normal, Vector<float>* impulses, Vector<float> gain, Vector<float> radius)
    {
        var load = impulses[0];
        for (int i = 1; i < count; ++i)
            load += impulses[i];
        var impulse = normal * load + *(Vector3Wide*)(impulses + ContactPrestepLayout.FrictionImpulse(count));
        var left = body.Linear + impulse * (body.InverseMass * new Vector<float>(warmStartScale));
        var along = Vector3Wide.Cross(toFloor, floor.Angular);
        left -= floor.Linear + along + Vector3Wide.Cross(floor.Angular, along) * new Vector<float>(0.5f * dt);
        var part = new Vector<float>(1 - 1 / SubstepCount);
        left += ChangeAt(change, turnChange, toFloor) * part;
        var turn = body.Angular - floor.Angular + turnChange * part;
        return Vector.LessThan(left.Length() + turn.Length() * radius, tolerance.Of(gain, radius));
    }

    // What has to be pushed along with its floor in each substep.
    static void ListRiders(Vector<int> lanes, Vector<int>* references, ref LoneRests lone)
    {
        for (var left = Wide.Bits(lanes); left != 0; left &= left - 1)
        {
            var lane = BitOperations.TrailingZeroCount(left);
            ref var rider = ref lone.Riders[lone.RiderCount++];
            rider.Body = references[0][lane] & EncodedBody.IndexMask;
            rider.Floor = references[1][lane] & EncodedBody.IndexMask;
        }
    }

    // Whether a body has no constraint but this one.
    Vector<int> IsAlone(int* references)
    {
        var counts = Vector<int>.Zero;
        for (int lane = 0; lane < Vector<int>.Count; ++lane)
            ((int*)&counts)[lane] = references[lane] >= 0 ? constraints[references[lane] & EncodedBody.IndexMask].Count : 0;
        return Vector.Equals(counts, Vector<int>.One);
    }

    static void Hold(Vector<int> lanes, Vector<int> bit, int count, Vector<int> away, Vector<float> band, Vector<float>* spring)
    {
        var touching = new Vector<int>(count);
        for (int i = 0; i < count; ++i)
            touching -= away >> i & Vector<int>.One;
        lanes &= Vector.GreaterThanOrEqual(touching, new(LeastContacts));
        *spring = Wide.Select(lanes, ContactMaterialWide.HeldSpring(band, bit), *spring);
    }
}
