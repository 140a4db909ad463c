using System.Numerics;
using BepuUtilities;

namespace BepuPhysics.Constraints.Contact;

// What rests alone on a static or a kinematic body.
//
// A body whose only constraint is a patch on what nothing pushes has nobody on it. If what its contacts bore in the last substep bears it now, there is nothing
// to hand down either: its contacts are held here, by bundles, and the graph need not know of it. What has just been put down, or is about to slip, goes the
// usual way, as friction knows its limit only once the load is there.
//
// So it is on a floor that goes on as it did, straight or round: all is as on the ground, seen from it. On one whose velocity has changed the load changes with
// it in each substep, and the graph sees to that.
readonly unsafe partial struct SupportFinder
{
    // Part of the greatest pull inwards for which a body is known to go round slowly, as arms that are kept are not quite where contacts are.
    const float SlowShare = 0.9f;

    /// <summary>Which of some bodies are kinematic.</summary>
    internal static Vector<int> AreFixed(Vector<int> references) =>
        Vector.Equals(references & new Vector<int>(EncodedBody.KinematicFlag), new(EncodedBody.KinematicFlag));

    static Vector<int> Turns(in Vector3Wide angular) => Vector.GreaterThan(
        Wide.Max(Wide.Abs(angular.X), Wide.Max(Wide.Abs(angular.Y), Wide.Abs(angular.Z))), Vector<float>.Zero);

    // Whether A rests on a floor whose velocities are those of the step before, and which takes it round slowly: all that the graph asks of what rests on a
    // floor. What falls onto it goes the usual way.
    Vector<int> RestsOnSteady(
        in Vector3Wide velocity, in Vector3Wide gain, in Vector3Wide change, in Vector3Wide turnChange, in Vector3Wide turn, in Vector3Wide toB)
    {
        var squared = gain.LengthSquared();
        var isSteady = Vector.Equals(change.LengthSquared() + turnChange.LengthSquared(), Vector<float>.Zero);
        var rests = Vector.LessThan(velocity.LengthSquared(), new Vector<float>(RestingSteps * RestingSteps) * squared);
        var inwards = turn.LengthSquared() * toB.Length() * new Vector<float>(dt);
        const float slow = SlowShare * LoadPathStage.GreatestInwardPull;
        return isSteady & rests & Vector.LessThanOrEqual(inwards * inwards, new Vector<float>(slow * slow) * squared);
    }

    // Whether A overlaps its floor by so much that it does not sleep until it is out, which the graph sees to.
    static Vector<int> IsSunken(int count, Vector<float>* prestep, Vector<float> band)
    {
        var depth = ((ContactPrestepWide*)prestep)->Depth;
        for (int i = 1; i < count; ++i)
            depth += ((ContactPrestepWide*)prestep)[i].Depth;
        return Vector.GreaterThan(depth, new Vector<float>(count * LoadPathStage.LeastOverlap) * band);
    }

    // Whether the warm start alone brings A to rest on what nothing pushes, as that takes it along in the middle of the substep. That A turns otherwise
    // would be seen in the next step.
    Vector<int> IsBorne(
        int count, in SolverBodyWide body, in SolverBodyWide floor, in Vector3Wide toFloor, in Vector3Wide normal, Vector<float>* impulses,
        Vector<float> gain, Vector<float> radius)
    {
        var load = impulses[0];
        for (int i = 1; i < count; ++i)
            load += impulses[i];
        var impulse = normal * load + *(Vector3Wide*)(impulses + ContactPrestepLayout.FrictionImpulse(count));
        var left = body.Linear + impulse * (body.InverseMass * new Vector<float>(warmStartScale));
        var along = Vector3Wide.Cross(toFloor, floor.Angular);
        left -= floor.Linear + along + Vector3Wide.Cross(floor.Angular, along) * new Vector<float>(0.5f * dt);
        return Vector.LessThan(left.Length() + (body.Angular - floor.Angular).Length() * radius, tolerance.Of(gain, radius));
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
