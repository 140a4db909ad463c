using System;
using System.Numerics;
using System.Runtime.InteropServices;
using BepuPhysics.Collidables;
using BepuUtilities;
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
/// Capacities are whole bundles, and rows behind the last body are zero up to the end of its bundle, so passes over all bodies may read whole bundles.
/// Nothing is written to rows beyond: a set that has room for twice its bodies costs no more memory for that.
/// </remarks>
public struct BodySet
{
    // Bodies that there is room for as soon as there is any.
    const int LeastCapacity = 64;

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
    internal Buffer<PrincipalFrame> PrincipalFrames;
    /// <summary>Shape and collision settings of each body.</summary>
    public Buffer<Collidable> Collidables;
    /// <summary>Progress of each body towards sleep.</summary>
    public Buffer<BodyActivity> Activity;
    /// <summary>Where the list of each body's constraints begins (<see cref="Bodies.GetConstraints"/>).</summary>
    internal Buffer<ConstraintList> Constraints;
    /// <summary>Island of each body that sleeps; only sets of sleeping bodies have it.</summary>
    internal Buffer<int> Islands;
    /// <summary>Slot of the body that follows each one in its island, after the last the first; only sets of sleeping bodies have it.</summary>
    internal Buffer<int> NextOfIsland;
    // Whether the bodies sleep: what only steps need is not kept of them.
    bool isAsleep;

    /// <summary>Whether the set has memory.</summary>
    public readonly bool Allocated => IndexToHandle.Allocated;

    /// <summary>Motion and inertia of each body in one view.</summary>
    public readonly BodyDynamicsView DynamicsState => new(this);

    internal readonly int Capacity => IndexToHandle.Length;

    /// <summary>Whether the bodies sleep.</summary>
    internal readonly bool IsAsleep => isAsleep;

    /// <summary>Every column of the set, in one place: what is done to a body as a whole is done to each of them.</summary>
    // The handles tell the capacity, so they come last, should the system refuse memory in between.
    void VisitColumns<TVisitor>(ref TVisitor visitor) where TVisitor : struct, IColumnVisitor
    {
        visitor.Visit(ref MotionStates);
        visitor.Visit(ref LocalInertias);
        visitor.Visit(ref WorldInertias);
        visitor.Visit(ref SoundPoses);
        if (isAsleep)
        {
            visitor.Visit(ref Islands);
            visitor.Visit(ref NextOfIsland);
        }
        else
        {
            visitor.Visit(ref Displacements);
            visitor.Visit(ref Origins);
        }
        visitor.Visit(ref Collidables);
        visitor.Visit(ref Activity);
        visitor.Visit(ref Constraints);
        if (Stiffness.Allocated)
            visitor.Visit(ref Stiffness);
        if (JointCounts.Allocated)
            visitor.Visit(ref JointCounts);
        if (PrincipalFrames.Allocated)
            visitor.Visit(ref PrincipalFrames);
        visitor.Visit(ref IndexToHandle);
    }

    internal void Resize(int capacity, BufferPool pool)
    {
        var resize = new ResizeColumns(WholeBundles(capacity), WholeBundles(Count), pool);
        VisitColumns(ref resize);
    }

    /// <summary>Rows of the bundles that so many bodies fill or begin.</summary>
    internal static int WholeBundles(int count) => (count + Vector<float>.Count - 1) / Vector<float>.Count * Vector<float>.Count;

    /// <summary>Adds a row that is zero. There must be room.</summary>
    /// <returns>Its index.</returns>
    internal int AddRow()
    {
        if (Count % Vector<float>.Count == 0)
        {
            var clear = new ClearRows(Count, Vector<float>.Count);
            VisitColumns(ref clear);
        }
        return Count++;
    }

    /// <summary>Makes room in a set of sleeping bodies.</summary>
    internal void ReserveAsleep(int capacity, BufferPool pool)
    {
        isAsleep = true;
        if (capacity > Capacity)
            Resize(Math.Max(Math.Max(LeastCapacity, capacity), 2 * Capacity), pool);
    }

    /// <summary>Appends a body of another set as it is there: what only steps need of it begins with zero. There must be room.</summary>
    /// <returns>Its index.</returns>
    internal int Append(in BodySet from, int index)
    {
        var added = AddRow();
        IndexToHandle[added] = from.IndexToHandle[index];
        MotionStates[added] = from.MotionStates[index];
        LocalInertias[added] = from.LocalInertias[index];
        WorldInertias[added] = from.WorldInertias[index];
        SoundPoses[added] = from.SoundPoses[index];
        Collidables[added] = from.Collidables[index];
        Activity[added] = from.Activity[index];
        Constraints[added] = from.Constraints[index];
        if (JointCounts.Allocated && from.JointCounts.Allocated)
            JointCounts[added] = from.JointCounts[index];
        return added;
    }

    /// <summary>Makes room for geometric stiffness, from the first joint on that can add to it.</summary>
    internal void EnsureStiffness(BufferPool pool)
    {
        if (!Stiffness.Allocated)
            AddColumn(ref Stiffness, pool);
    }

    /// <summary>Makes room for counts of joints, from the first joint on that is counted.</summary>
    internal void EnsureJointCounts(BufferPool pool)
    {
        if (!JointCounts.Allocated)
            AddColumn(ref JointCounts, pool);
    }

    /// <summary>Makes room for principal frames, if this is the first body whose inertia is not diagonal.</summary>
    internal void EnsurePrincipalFrames(in Symmetric3x3 inverseInertia, BufferPool pool)
    {
        var isDiagonal = inverseInertia.YX == 0 && inverseInertia.ZX == 0 && inverseInertia.ZY == 0;
        if (!isDiagonal && !PrincipalFrames.Allocated)
            AddColumn(ref PrincipalFrames, pool);
    }

    void AddColumn<T>(ref Buffer<T> column, BufferPool pool) where T : unmanaged
    {
        new ResizeColumns(Capacity, 0, pool).Visit(ref column);
        column.Clear(0, WholeBundles(Count));
    }

    /// <summary>Moves a body within a step, beside its velocity.</summary>
    // Until the step ends the position is that of its beginning and what was travelled since.
    internal void Move(int index, Vector3 way)
    {
        ref var origin = ref Origins[index].Position;
        origin += way;
        MotionStates[index].Pose.Position = origin + Displacements[index].Linear;
    }

    /// <summary>Turns a body within a step, beside its velocity; by so little that the sine is the angle.</summary>
    internal void Turn(int index, Vector3 way)
    {
        ref var orientation = ref MotionStates[index].Pose.Orientation;
        orientation = Exact.Normalize(Exact.Concatenate(orientation, new(way.X * 0.5f, way.Y * 0.5f, way.Z * 0.5f, 1)));
    }

    /// <summary>Makes what the integrator keeps of a body agree with a pose that was written in the middle of a step.</summary>
    internal void Forget(int index)
    {
        Displacements[index] = new(MotionStates[index].Pose.Position - Origins[index].Position, default);
        Origins[index].LostVelocity = default;
        if (Stiffness.Allocated)
            Stiffness[index] = default;
    }

    /// <summary>Moves the last body into the place of a removed one. Its own row is zero then, as all rows behind the last body.</summary>
    internal void RemoveAt(int index)
    {
        var remove = new MoveRow(--Count, index);
        VisitColumns(ref remove);
    }

    /// <summary>Removes all bodies. No row keeps anything of them, or it would be found by those that come after.</summary>
    internal void Clear()
    {
        var clear = new ClearRows(0, Count);
        VisitColumns(ref clear);
        Count = 0;
    }

    /// <summary>Copies all bodies out of the set, or others into their place.</summary>
    internal void CopyState(StateCopy copy)
    {
        var count = copy.Value(Count);
        var columns = copy.Value(
            (IsAsleep: isAsleep, HasStiffness: Stiffness.Allocated, HasJointCounts: JointCounts.Allocated, HasFrames: PrincipalFrames.Allocated));
        if (copy.Restores)
        {
            Count = 0;
            isAsleep |= columns.IsAsleep;
            if (count > Capacity || (columns.HasJointCounts && Capacity == 0))
                Resize(Math.Max(LeastCapacity, count), copy.Pool);
            Require(ref Stiffness, columns.HasStiffness, copy.Pool);
            Require(ref JointCounts, columns.HasJointCounts, copy.Pool);
            Require(ref PrincipalFrames, columns.HasFrames, copy.Pool);
            Count = count;
        }
        var rows = new CopyColumns(copy, WholeBundles(count));
        VisitColumns(ref rows);
    }

    // A column that is there only where it is needed.
    void Require<T>(ref Buffer<T> column, bool isNeeded, BufferPool pool) where T : unmanaged
    {
        if (isNeeded && !column.Allocated)
            AddColumn(ref column, pool);
        else if (!isNeeded && column.Allocated)
            pool.Return(ref column);
    }

    internal void Dispose(BufferPool pool)
    {
        var dispose = new ReturnColumns(pool);
        VisitColumns(ref dispose);
        Count = 0;
    }
}
