using System.Numerics;

namespace BepuPhysics;

// Another origin of the world.
public sealed partial class Bodies
{
    // Where no step has left any body, so that what has it was put where it is.
    const float Nowhere = float.MaxValue;

    /// <exception cref="System.ArgumentException">A body would be beyond all positions; nothing was changed.</exception>
    internal void CheckShift(Vector3 shift)
    {
        for (int i = 0; i < Sets.Length; ++i)
        {
            for (int j = 0; j < Sets[i].Count; ++j)
                BodyChecks.ShiftedPosition(Sets[i].MotionStates[j].Pose.Position, shift);
        }
    }

    /// <summary>Moves all bodies to where they are seen from a new origin.</summary>
    internal void ShiftOrigin(Vector3 shift)
    {
        for (int i = 0; i < Sets.Length; ++i)
        {
            ref var set = ref Sets[i];
            for (int j = 0; j < set.Count; ++j)
            {
                set.SoundPoses[j].Position -= shift;
                if (set.IsAsleep)
                    set.MotionStates[j].Pose.Position -= shift;
                else
                    ShiftAwake(ref set, j, shift);
            }
        }
    }

    // A body is where its last step began, and a way from there, which has more digits than its position. What the shift rounds is a part of that way
    // from now on, and comes back as soon as the position can hold it: what has moved by less than its position could tell, far away, has moved.
    static void ShiftAwake(ref BodySet set, int index, Vector3 shift)
    {
        ref var position = ref set.MotionStates[index].Pose.Position;
        ref var origin = ref set.Origins[index].Position;
        ref var way = ref set.Displacements[index].Linear;
        if (origin + way == position)
        {
            var shifted = origin - shift;
            // What the difference lost, exactly (Knuth's two-sum).
            var taken = shifted - origin;
            way += origin - (shifted - taken) - (shift + taken);
            origin = shifted;
            position = origin + way;
        }
        else
        {
            position -= shift;
            origin = new(Nowhere);
        }
    }
}
