using System;
using System.Numerics;
using BepuUtilities;
using BepuUtilities.Memory;

namespace BepuPhysics.Constraints.Contact;

// What a game moves by its pose.
//
// A kinematic body that is put elsewhere in each step has no velocity, so to the load path it is at rest, and what it is put into moves: by the speed at which
// contacts push that out. That speed would be handed down like a load and brought to rest, in each substep, and the body that is pushed would stay in what
// pushes it, or be passed through. So in the step in which a kinematic body is put into another, that does not rest on it: contacts between them are the
// sweeps' alone, and push as they do everywhere else. What is moved along under a body, or away from it, takes nothing of that.
sealed unsafe partial class LoadPathStage
{
    // Part of the way of the last step that is rounding where a game writes poses beside the velocities that lead there.
    const float WrittenShare = 1e-3f;

    readonly bool[] hasElsewhereIn = new bool[MaximumBlocks];
    // Per body, how far a game has put it beside where the last step left it, and how much of that is rounding; not there where it has put none.
    Buffer<Vector4> elsewhere;

    bool HasElsewhere => hasElsewhereIn.AsSpan(0, BodyBlockCount).Contains(true);

    void FindElsewhere()
    {
        ref var set = ref bodies.Awake;
        pool.TakeAtLeast(set.Count, out elsewhere);
        for (int i = 0; i < set.Count; ++i)
            elsewhere[i] = set.LocalInertias[i].InverseMass == 0 && Bodies.IsMovedByPose(set, i) ? WayTo(i) : default;
    }

    Vector4 WayTo(int body)
    {
        ref var set = ref bodies.Awake;
        // Its surfaces have moved in many ways.
        if (set.Activity[body].WasTurned)
            return new(default, float.NegativeInfinity);
        ref var origin = ref set.Origins[body].Position;
        ref var displacement = ref set.Displacements[body].Linear;
        ref var position = ref set.MotionStates[body].Pose.Position;
        // Rows of a new body are zero: it is where it was put, and what is built on it rests from the first step on. What is put back to where the last step
        // began is a belt: its surface moves, and it does not.
        if ((origin == default && displacement == default) || position == origin)
            return default;
        return new(position - (origin + displacement), WrittenShare * Exact.Length(displacement) + Rounding * Exact.Length(position));
    }
}
