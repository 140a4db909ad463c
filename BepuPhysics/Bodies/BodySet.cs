using System.Numerics;
using System.Runtime.InteropServices;
using BepuPhysics.Collidables;
using BepuUtilities;
using BepuUtilities.Collections;
using BepuUtilities.Memory;

namespace BepuPhysics;

/// <summary>Where a body is stored.</summary>
public struct BodyMemoryLocation
{
    /// <summary>Set of the body: 0 is the active one; -1 says that there is no such body.</summary>
    public int SetIndex;
    /// <summary>Index within the set.</summary>
    public int Index;
}

/// <summary>A constraint as its body knows it.</summary>
public struct BodyConstraintReference
{
    /// <summary>The constraint.</summary>
    public ConstraintHandle ConnectingConstraintHandle;
    /// <summary>Which of the constraint's bodies this one is.</summary>
    public int BodyIndexInConstraint;
}

/// <summary>What the integrator keeps of a body beside its state: a row of 32 bytes.</summary>
[StructLayout(LayoutKind.Explicit, Size = 32)]
struct StepOrigin
{
    /// <summary>
    /// Position when the step began, to which its whole translation is added once. Between steps: the position that the last step wrote, by
    /// which a position that was written since is recognised.
    /// </summary>
    [FieldOffset(0)] public Vector3 Position;
    /// <summary>X of the velocity that the last step ended with, by which one that was written since is recognised. Only where some was lost.</summary>
    [FieldOffset(12)] public float VelocityX;
    /// <summary>What rounding took of the velocity of a fast body, to be added to its next change.</summary>
    [FieldOffset(16)] public Vector3 LostVelocity;
    /// <summary>Y of the velocity that the last step ended with. Z is in the row of the displacement, behind the translation.</summary>
    [FieldOffset(28)] public float VelocityY;
}

/// <summary>Bodies that are stored together, each property in an array of its own.</summary>
/// <remarks>
/// Bodies stay scalar structs, since constraints gather them in any order. What the solver touches is kept in rows of 32 bytes,
/// and what it does not touch (the local inertia) is kept apart, so that no cache line carries dead weight through it.
/// Capacities are whole bundles and rows behind the last body are zero, so passes over all bodies may read whole bundles.
/// </remarks>
public struct BodySet
{
    /// <summary>Number of bodies.</summary>
    public int Count;
    /// <summary>Handle of each body.</summary>
    public Buffer<BodyHandle> IndexToHandle;
    /// <summary>Pose and velocity of each body.</summary>
    public Buffer<MotionState> MotionStates;
    /// <summary>Inverse inertia of each body in its own frame.</summary>
    public Buffer<BodyInertia> LocalInertias;
    /// <summary>Inverse inertia of each body in world axes; valid while the solver runs.</summary>
    internal Buffer<BodyInertia> WorldInertias;
    /// <summary>
    /// Translation and rotation of each body since collision detection. Between steps the translation is what was too small to change the
    /// position: the part of the last step that rounding left over.
    /// </summary>
    internal Buffer<BodyVelocity> Displacements;
    /// <summary>Where each body was when the step began, and what rounding has taken of its velocity.</summary>
    internal Buffer<StepOrigin> Origins;
    /// <summary>Where each body was when the last step began that found it sound.</summary>
    internal Buffer<RigidPose> SoundPoses;
    /// <summary>Geometric stiffness of each body in the place of an inertia tensor; allocated only once a joint can add to it.</summary>
    internal Buffer<BodyInertia> Stiffness;
    /// <summary>Number of each body's joints that make hubs; allocated with the first of them.</summary>
    internal Buffer<int> JointCounts;
    /// <summary>Principal frames of the bodies, as far as they are known; allocated only once a body's inertia is not diagonal.</summary>
    // They say themselves what they are of: they need not move with the bodies.
    internal Buffer<PrincipalFrame> PrincipalFrames;
    /// <summary>Shape and collision settings of each body.</summary>
    public Buffer<Collidable> Collidables;
    /// <summary>Progress of each body towards sleep.</summary>
    public Buffer<BodyActivity> Activity;
    /// <summary>Constraints of each body.</summary>
    public Buffer<QuickList<BodyConstraintReference>> Constraints;

    /// <summary>Whether the set has memory.</summary>
    public readonly bool Allocated => IndexToHandle.Allocated;

    /// <summary>Motion and inertia of each body in one view.</summary>
    public readonly BodyDynamicsView DynamicsState => new(this);

    internal readonly int Capacity => IndexToHandle.Length;

    internal void Resize(int capacity, BufferPool pool)
    {
        capacity = (capacity + Vector<float>.Count - 1) / Vector<float>.Count * Vector<float>.Count;
        ResizeZeroed(ref MotionStates, capacity, Count, pool);
        ResizeZeroed(ref LocalInertias, capacity, Count, pool);
        ResizeZeroed(ref WorldInertias, capacity, Count, pool);
        ResizeZeroed(ref Displacements, capacity, Count, pool);
        ResizeZeroed(ref Origins, capacity, Count, pool);
        ResizeZeroed(ref SoundPoses, capacity, Count, pool);
        if (Stiffness.Allocated)
            ResizeZeroed(ref Stiffness, capacity, Count, pool);
        if (JointCounts.Allocated)
            ResizeZeroed(ref JointCounts, capacity, Count, pool);
        if (PrincipalFrames.Allocated)
            ResizeZeroed(ref PrincipalFrames, capacity, Count, pool);
        ResizeZeroed(ref Collidables, capacity, Count, pool);
        ResizeZeroed(ref Activity, capacity, Count, pool);
        ResizeZeroed(ref Constraints, capacity, Count, pool);
        // It tells the capacity, so it comes last, should the system refuse memory in between.
        ResizeZeroed(ref IndexToHandle, capacity, Count, pool);
    }

    /// <summary>Makes room for geometric stiffness, from the first joint on that can add to it.</summary>
    internal void EnsureStiffness(BufferPool pool)
    {
        if (!Stiffness.Allocated)
            ResizeZeroed(ref Stiffness, Capacity, 0, pool);
    }

    /// <summary>Makes room for counts of joints, from the first joint on that is counted.</summary>
    internal void EnsureJointCounts(BufferPool pool)
    {
        if (!JointCounts.Allocated)
            ResizeZeroed(ref JointCounts, Capacity, 0, pool);
    }

    /// <summary>Makes room for principal frames, if this is the first body whose inertia is not diagonal.</summary>
    internal void EnsurePrincipalFrames(in Symmetric3x3 inverseInertia, BufferPool pool)
    {
        var isDiagonal = inverseInertia.YX == 0 && inverseInertia.ZX == 0 && inverseInertia.ZY == 0;
        if (!isDiagonal && !PrincipalFrames.Allocated)
            ResizeZeroed(ref PrincipalFrames, Capacity, 0, pool);
    }

    static void ResizeZeroed<T>(ref Buffer<T> buffer, int length, int used, BufferPool pool) where T : unmanaged
    {
        pool.Take<T>(length, out var larger);
        if (buffer.Allocated)
        {
            buffer.CopyTo(0, larger, 0, used);
            pool.Return(ref buffer);
        }
        larger.Clear(used, length - used);
        buffer = larger;
    }

    /// <summary>Makes what the integrator keeps of a body agree with a pose that was written in the middle of a step.</summary>
    internal void Forget(int index)
    {
        Displacements[index] = new(MotionStates[index].Pose.Position - Origins[index].Position, default);
        Origins[index].LostVelocity = default;
        if (Stiffness.Allocated)
            Stiffness[index] = default;
    }

    // Moves the last body into the place of a removed one.
    internal void RemoveAt(int index)
    {
        var last = --Count;
        if (index != last)
        {
            IndexToHandle[index] = IndexToHandle[last];
            MotionStates[index] = MotionStates[last];
            LocalInertias[index] = LocalInertias[last];
            WorldInertias[index] = WorldInertias[last];
            Displacements[index] = Displacements[last];
            Origins[index] = Origins[last];
            SoundPoses[index] = SoundPoses[last];
            if (Stiffness.Allocated)
                Stiffness[index] = Stiffness[last];
            if (JointCounts.Allocated)
                JointCounts[index] = JointCounts[last];
            Collidables[index] = Collidables[last];
            Activity[index] = Activity[last];
            Constraints[index] = Constraints[last];
        }
        IndexToHandle[last] = default;
        MotionStates[last] = default;
        LocalInertias[last] = default;
        WorldInertias[last] = default;
        Displacements[last] = default;
        Origins[last] = default;
        if (Stiffness.Allocated)
            Stiffness[last] = default;
        if (JointCounts.Allocated)
            JointCounts[last] = default;
        Collidables[last] = default;
        Activity[last] = default;
        Constraints[last] = default;
    }

    /// <summary>Removes all bodies. No row keeps anything of them, or it would be found by those that come after.</summary>
    internal void Clear(BufferPool pool)
    {
        for (int i = 0; i < Count; ++i)
            Constraints[i].Dispose(pool);
        IndexToHandle.Clear(0, Count);
        MotionStates.Clear(0, Count);
        LocalInertias.Clear(0, Count);
        WorldInertias.Clear(0, Count);
        Displacements.Clear(0, Count);
        Origins.Clear(0, Count);
        if (Stiffness.Allocated)
            Stiffness.Clear(0, Count);
        if (JointCounts.Allocated)
            JointCounts.Clear(0, Count);
        Collidables.Clear(0, Count);
        Activity.Clear(0, Count);
        Constraints.Clear(0, Count);
        Count = 0;
    }

    internal void Dispose(BufferPool pool)
    {
        for (int i = 0; i < Count; ++i)
            Constraints[i].Dispose(pool);
        pool.Return(ref IndexToHandle);
        pool.Return(ref MotionStates);
        pool.Return(ref LocalInertias);
        pool.Return(ref WorldInertias);
        pool.Return(ref Displacements);
        pool.Return(ref Origins);
        pool.Return(ref SoundPoses);
        if (Stiffness.Allocated)
            pool.Return(ref Stiffness);
        if (JointCounts.Allocated)
            pool.Return(ref JointCounts);
        if (PrincipalFrames.Allocated)
            pool.Return(ref PrincipalFrames);
        pool.Return(ref Collidables);
        pool.Return(ref Activity);
        pool.Return(ref Constraints);
        Count = 0;
    }
}
