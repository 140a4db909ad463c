using System;
using System.Numerics;
using System.Runtime.CompilerServices;
using BepuUtilities;

namespace BepuPhysics;

// Kinematic bodies that a game moves by their poses.
//
// They have no velocity, so all that is known of it is where the last step has left them. Where they are compared with that, position and orientation both:
// a door that is turned by its orientation alone wakes what it meets like one that is moved aside, and does not fall asleep while it is turned.
public sealed unsafe partial class Bodies
{
    // Least difference of a component of an orientation that a game means: a microradian or two. Less is what it is rounded by when it is written.
    const float LeastTurn = 1f / (1 << 20);

    /// <summary>Whether the position of an awake body is not what the last step made of its origin and displacement: it was written since.</summary>
    internal static bool IsElsewhere(in BodySet set, int index) =>
        set.Origins[index].Position + set.Displacements[index].Linear != set.MotionStates[index].Pose.Position;

    /// <summary>Whether a game has moved or turned a kinematic body by its pose since the last step. Before the first integration of a step.</summary>
    internal static bool IsMovedByPose(in BodySet set, int index) => set.Activity[index].WasTurned || IsElsewhere(set, index);

    /// <summary>
    /// Takes note of kinematic bodies that were moved by their poses since the last step. Before their poses are remembered as those of this one.
    /// </summary>
    /// <param name="start">First body of a bundle.</param>
    /// <param name="kinematics">Lanes of kinematic bodies.</param>
    [MethodImpl(MethodImplOptions.NoInlining)]
    internal void NoteMovedByPose(int start, Vector<int> kinematics)
    {
        ref var set = ref Awake;
        for (var lanes = Wide.Bits(kinematics); lanes != 0; lanes &= lanes - 1)
        {
            var index = start + BitOperations.TrailingZeroCount(lanes);
            // What the last step has turned is where that left it.
            if (set.Displacements[index].Angular == default && IsTurned(set.SoundPoses[index].Orientation, set.MotionStates[index].Pose.Orientation))
                set.Activity[index].NoteTurned();
            else if (IsElsewhere(set, index))
                set.Activity[index].Forget();
        }
    }

    // An orientation and its negative are the same.
    static bool IsTurned(Quaternion from, Quaternion to)
    {
        var sign = from.X * to.X + from.Y * to.Y + from.Z * to.Z + from.W * to.W < 0 ? -1f : 1f;
        return !(MathF.Abs(from.X - to.X * sign) <= LeastTurn && MathF.Abs(from.Y - to.Y * sign) <= LeastTurn &&
            MathF.Abs(from.Z - to.Z * sign) <= LeastTurn && MathF.Abs(from.W - to.W * sign) <= LeastTurn);
    }
}
