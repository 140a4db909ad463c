using System;
using BepuUtilities;

namespace BepuPhysics;

// Poses between the last two steps, for a game that draws more often than it steps. What a body's pose was when the last step began is kept
// in any case, so this takes neither memory nor time of a step.
public sealed unsafe partial class Bodies
{
    /// <summary>Pose of a body between the beginning and the end of the last step, as for drawing.</summary>
    /// <remarks>
    /// A body that was added since the last step, or whose position was written since, is where its pose says: what jumps is not drawn on its way.
    /// An orientation that is written alone is not recognised as a jump, but by <see cref="ApplyDescription"/>. Collisions and queries know nothing
    /// of this pose. Only reads: between steps any number of threads may ask.
    /// </remarks>
    /// <param name="handle">The body.</param>
    /// <param name="amount">0 for the beginning of the last step to 1 for its end: the part of the next step's time that has passed.</param>
    /// <exception cref="ArgumentException">There is no such body.</exception>
    /// <exception cref="ArgumentOutOfRangeException">The amount is not from 0 to 1.</exception>
    public RigidPose GetInterpolatedPose(BodyHandle handle, float amount)
    {
        CheckAmount(amount);
        using var reading = world.Read("Bodies.GetInterpolatedPose");
        CheckHandle(handle);
        ref var set = ref SetOf(handle, out var index);
        return !set.IsAsleep && HasMoved(set, index) ? Interpolate(set, index, amount) : set.MotionStates[index].Pose;
    }

    /// <summary>Poses of all bodies that moved in the last step, between its beginning and its end, as for drawing.</summary>
    /// <remarks>
    /// Bodies that are not listed are where their pose says. See <see cref="GetInterpolatedPose"/>; this is the same for all at once, in the order in
    /// which bodies are stored.
    /// </remarks>
    /// <param name="amount">0 for the beginning of the last step to 1 for its end: the part of the next step's time that has passed.</param>
    /// <param name="handles">Receives the bodies that moved.</param>
    /// <param name="poses">Receives the pose of each.</param>
    /// <returns>Number of bodies that moved.</returns>
    /// <exception cref="ArgumentOutOfRangeException">The amount is not from 0 to 1.</exception>
    /// <exception cref="ArgumentException">A span is shorter than the number of bodies that are awake.</exception>
    public int GetInterpolatedPoses(float amount, Span<BodyHandle> handles, Span<RigidPose> poses)
    {
        CheckAmount(amount);
        using var reading = world.Read("Bodies.GetInterpolatedPoses");
        ref var set = ref ActiveSet;
        CheckLength(handles.Length, set.Count, nameof(handles));
        CheckLength(poses.Length, set.Count, nameof(poses));
        int count = 0;
        for (int i = 0; i < set.Count; ++i)
        {
            if (!HasMoved(set, i))
                continue;
            handles[count] = set.IndexToHandle[i];
            poses[count++] = Interpolate(set, i, amount);
        }
        return count;
    }

    // Of those that are awake. A position that is not what the last step made of its origin and displacement was written since.
    static bool HasMoved(in BodySet set, int index)
    {
        ref var pose = ref set.MotionStates[index].Pose;
        ref var previous = ref set.SoundPoses[index];
        return (previous.Position != pose.Position || previous.Orientation != pose.Orientation) && !IsElsewhere(set, index);
    }

    static RigidPose Interpolate(in BodySet set, int index, float amount)
    {
        ref var from = ref set.SoundPoses[index];
        ref var to = ref set.MotionStates[index].Pose;
        // The end is met exactly.
        return amount == 1 ? to : new(
            from.Position + (to.Position - from.Position) * amount,
            amount == 0 ? from.Orientation : QuaternionEx.Slerp(from.Orientation, to.Orientation, amount));
    }

    static void CheckAmount(float amount)
    {
        if (!(amount >= 0 && amount <= 1))
            throw new ArgumentOutOfRangeException(nameof(amount), amount, "The amount must be from 0, the beginning of the last step, to 1, its end.");
    }

    static void CheckLength(int length, int count, string name)
    {
        if (length < count)
            throw new ArgumentException($"There is room for {length} bodies, and {count} are awake.", name);
    }
}
