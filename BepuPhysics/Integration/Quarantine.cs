using System;
using System.Numerics;
using System.Runtime.CompilerServices;
using BepuUtilities.Collections;
using BepuUtilities.Memory;

namespace BepuPhysics;

/// <summary>Bodies that the last step had to stop because their numbers could not be simulated any more.</summary>
/// <remarks>
/// A body whose pose or velocity is NaN, infinite or beyond 3e12 (m, m/s, rad/s), or whose orientation is no rotation, is stopped before
/// another body reads it: it goes back to its last sound pose with no velocity, its constraints forget their impulses, and its handle is
/// listed here. From then on it is a body like all others. What to do about it is up to the game, which will have written the number, or
/// whose callbacks have, or which has masses and forces further apart than numbers can bear. A body with an inertia that is NaN or
/// infinite becomes kinematic besides, as there is no inertia to go back to.
/// </remarks>
// Where a body is looked at: when bounds are predicted, whenever it is read to be integrated (events may have written it, and constraints
// have changed its velocity), and when the callbacks have changed its velocity. In between there are only constraints. One that makes a
// velocity NaN does so to all of its bodies, and others that follow in the same sweep may to theirs: all of them are stopped when the
// substep ends.
//
// What happens to a lane is written by that lane alone, so which bodies are stopped, and how, depends on nothing else.
public sealed unsafe class Quarantine
{
    readonly Bodies bodies;
    readonly BufferPool pool;
    QuickList<BodyHandle> handles;
    // For each body of the active set whether it was stopped since the list was last brought up to date; written by any worker.
    Buffer<byte> stopped;
    bool anyStopped;

    internal Quarantine(Bodies bodies, BufferPool pool)
    {
        this.bodies = bodies;
        this.pool = pool;
        handles = new QuickList<BodyHandle>(8, pool);
        EnsureCapacity();
    }

    /// <summary>Number of bodies that were stopped.</summary>
    public int Count => handles.Count;

    /// <summary>
    /// The bodies that were stopped, in the order of their handles' values. Valid until the next step begins; those that were removed since
    /// are still listed.
    /// </summary>
    public ReadOnlySpan<BodyHandle> Bodies => handles.Span.AsSpan()[..handles.Count];

    /// <summary>Begins a step: nothing has been stopped.</summary>
    internal void BeginStep() => handles.Count = 0;

    /// <summary>Makes room for all bodies. Before workers look at them.</summary>
    internal void EnsureCapacity()
    {
        var previous = stopped.Length;
        var needed = bodies.Awake.Count;
        if (stopped.Allocated && previous >= needed)
            return;
        pool.ResizeToAtLeast(ref stopped, Math.Max(64, bodies.Awake.Capacity), 0);
        stopped.Clear(0, stopped.Length);
    }

    /// <summary>Stops those of a bundle of bodies whose lanes are set.</summary>
    [MethodImpl(MethodImplOptions.NoInlining)]
    internal void Stop(Vector<int> lanes, Vector<int> indices)
    {
        for (int i = 0; i < Vector<int>.Count; ++i)
        {
            if (lanes[i] != 0)
                Stop(indices[i]);
        }
    }

    /// <summary>Normalises sound orientations of those of a bundle of bodies whose lanes are set.</summary>
    internal void Straighten(Vector<int> lanes, Vector<int> indices)
    {
        for (int i = 0; i < Vector<int>.Count; ++i)
        {
            if (lanes[i] != 0)
                Straighten(ref bodies.Awake.MotionStates[indices[i]].Pose);
        }
    }

    static void Straighten(ref RigidPose pose)
    {
        if (Soundness.IsSound(pose))
            pose = BodyChecks.Straighten(pose);
    }

    void Stop(int index)
    {
        ref var set = ref bodies.Awake;
        ref var motion = ref set.MotionStates[index];
        if (!Soundness.IsSound(motion.Pose))
        {
            motion.Pose = set.SoundPoses[index];
            // A bounce moves it along.
            set.Origins[index].Position = motion.Pose.Position;
        }
        motion.Velocity = default;
        set.Forget(index);
        bodies.ForgetImpulses(index);
        stopped[index] = 1;
        anyStopped = true;
    }

    /// <summary>Stops all bodies that are not sound: where something may have written them that no integration follows.</summary>
    internal void StopUnsound()
    {
        EnsureCapacity();
        ref var set = ref bodies.Awake;
        for (int i = 0; i < set.Count; ++i)
        {
            ref var motion = ref set.MotionStates[i];
            if (!Soundness.IsSound(motion.Pose) || !Soundness.IsSound(motion.Velocity))
                Stop(i);
            Straighten(ref motion.Pose);
        }
        Collect();
    }

    /// <summary>Keeps the poses of a bundle of bodies as the last sound ones.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    internal void Remember(int bundle)
    {
        ref var set = ref bodies.Awake;
        var start = bundle * Vector<float>.Count;
        var motions = set.MotionStates.Memory + start;
        var poses = set.SoundPoses.Memory + start;
        // Rows behind the last body exist too.
        for (int i = 0; i < Vector<float>.Count; ++i)
            poses[i] = motions[i].Pose;
    }

    /// <summary>Lists the bodies that were stopped. After the workers have ended.</summary>
    internal void Collect()
    {
        if (!anyStopped)
            return;
        anyStopped = false;
        ref var set = ref bodies.Awake;
        for (int i = 0; i < set.Count; ++i)
        {
            if (stopped[i] == 0)
                continue;
            stopped[i] = 0;
            List(set.IndexToHandle[i]);
            if (!Soundness.IsSound(set.LocalInertias[i]))
                bodies.MakeKinematic(set.IndexToHandle[i]);
        }
    }

    // In order, and once: a body may be stopped several times in a step.
    void List(BodyHandle handle)
    {
        int place = handles.Count;
        while (place > 0 && handles[place - 1].Value > handle.Value)
            --place;
        if (place > 0 && handles[place - 1] == handle)
            return;
        handles.Add(handle, pool);
        for (int i = handles.Count - 1; i > place; --i)
            handles[i] = handles[i - 1];
        handles[place] = handle;
    }

    internal void Dispose()
    {
        handles.Dispose(pool);
        pool.Return(ref stopped);
        Abandon();
    }

    /// <summary>Forgets memory that is gone already.</summary>
    internal void Abandon()
    {
        handles = default;
        stopped = default;
        anyStopped = false;
    }
}
