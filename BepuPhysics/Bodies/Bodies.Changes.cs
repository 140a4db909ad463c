using System;
using System.Numerics;
using BepuPhysics.Collidables;
using BepuPhysics.Trees;
using BepuUtilities;

namespace BepuPhysics;

// What may be changed of a body, and its bounds. All that can fail comes before the first change.
public sealed unsafe partial class Bodies
{
    /// <summary>Makes a body what a description says; its constraints stay.</summary>
    /// <exception cref="ArgumentException">There is no such body, a value cannot be simulated, or the shape does not exist; nothing was changed.</exception>
    public void ApplyDescription(BodyHandle handle, in BodyDescription description)
    {
        using var change = world.Change("Bodies.ApplyDescription");
        CheckHandle(handle);
        Validate(description);
        ref var set = ref SetOf(handle, out var index);
        var shape = description.Collidable.Shape;
        var bounds = PrepareBounds(ref set, index, description.Pose, shape);
        set.EnsurePrincipalFrames(description.LocalInertia.InverseInertiaTensor, Pool);
        ChangeInertia(handle, description.LocalInertia);
        ref var motion = ref set.MotionStates[index];
        motion.Pose = description.Pose;
        motion.Velocity = description.Velocity;
        set.SoundPoses[index] = description.Pose;
        shapes.ChangeUse(set.Collidables[index].Shape, shape);
        WriteSettings(ref set, index, description);
        PlaceInBroadPhase(ref set, index, bounds);
    }

    /// <summary>Gives a body another shape; its inertia stays.</summary>
    /// <exception cref="ArgumentException">There is no such body or no such shape; nothing was changed.</exception>
    /// <exception cref="InvalidOperationException">The body's pose is not finite; nothing was changed.</exception>
    public void SetShape(BodyHandle handle, TypedIndex shape)
    {
        using var change = world.Change("Bodies.SetShape");
        CheckHandle(handle);
        CheckShape(shape);
        ref var set = ref SetOf(handle, out var index);
        ref var collidable = ref set.Collidables[index];
        if (collidable.Shape == shape)
            return;
        var bounds = PrepareBounds(ref set, index, set.MotionStates[index].Pose, shape);
        shapes.ChangeUse(collidable.Shape, shape);
        collidable.Shape = shape;
        PlaceInBroadPhase(ref set, index, bounds);
    }

    /// <summary>Gives a body another inertia. All zero makes it kinematic, which removes its constraints to other kinematic bodies.</summary>
    /// <exception cref="ArgumentException">There is no such body or the inertia cannot be simulated; nothing was changed.</exception>
    public void SetLocalInertia(BodyHandle handle, in BodyInertia localInertia)
    {
        using var change = world.Change("Bodies.SetLocalInertia");
        CheckHandle(handle);
        BodyChecks.Inertia(localInertia);
        SetOf(handle, out _).EnsurePrincipalFrames(localInertia.InverseInertiaTensor, Pool);
        ChangeInertia(handle, localInertia);
    }

    /// <summary>Moves the bounds of a body in the broad phase to where its pose says, as for queries between steps.</summary>
    /// <exception cref="ArgumentException">There is no such body.</exception>
    /// <exception cref="InvalidOperationException">The body's pose is not finite; nothing was changed.</exception>
    public void UpdateBounds(BodyHandle handle)
    {
        using var change = world.Change("Bodies.UpdateBounds");
        CheckHandle(handle);
        UpdateBoundsAt(ref SetOf(handle, out var index), index);
    }

    /// <summary>The set of a body that exists, and its index there.</summary>
    internal ref BodySet SetOf(BodyHandle handle, out int index)
    {
        ref var location = ref Locations[handle.Slot];
        index = location.Index;
        return ref Sets[location.SetIndex];
    }

    void ChangeInertia(BodyHandle handle, in BodyInertia localInertia)
    {
        ref var set = ref SetOf(handle, out var index);
        ref var current = ref set.LocalInertias[index];
        var changesKind = IsKinematic(current) != IsKinematic(localInertia);
        current = localInertia;
        if (!changesKind)
            return;
        solver.Recolor(handle);
        // The broad phase knows the kind of each collidable.
        var leaf = set.Collidables[index].BroadPhaseIndex;
        if (leaf >= 0)
            broadPhase.ActiveLeaves[leaf] = ReferenceAt(set, index);
    }

    // Everything about a change of bounds that can fail.
    BoundingBox PrepareBounds(ref BodySet set, int index, in RigidPose pose, TypedIndex shape)
    {
        if (!shape.Exists)
            return default;
        shapes.UpdateBounds(pose, shape, out var bounds);
        if (!BoxMath.IsValid(bounds.Min, bounds.Max))
            throw new InvalidOperationException($"There are no finite bounds of {set.IndexToHandle[index]}: its pose is {pose}.");
        if (set.Collidables[index].BroadPhaseIndex < 0)
            broadPhase.MakeRoomFor(broadPhase.ActiveTree.LeafCount + 1, 0);
        return bounds;
    }

    // Brings the leaf of a body, if it is to have one, to its bounds.
    void PlaceInBroadPhase(ref BodySet set, int index, BoundingBox bounds)
    {
        ref var collidable = ref set.Collidables[index];
        if (!collidable.Shape.Exists)
            RemoveFromBroadPhase(ref set, index);
        else if (collidable.BroadPhaseIndex < 0)
            collidable.BroadPhaseIndex = broadPhase.AddActiveLeaf(ReferenceAt(set, index), bounds);
        else
            // The whole tree at once: a query may come before the next step fits it.
            broadPhase.ActiveTree.UpdateBounds(collidable.BroadPhaseIndex, bounds.Min, bounds.Max);
    }

    void RemoveFromBroadPhase(ref BodySet set, int index)
    {
        ref var leaf = ref set.Collidables[index].BroadPhaseIndex;
        if (leaf < 0)
            return;
        if (broadPhase.RemoveActiveLeafAt(leaf, out var moved))
            SetOf(moved.BodyHandle, out var movedIndex).Collidables[movedIndex].BroadPhaseIndex = leaf;
        leaf = -1;
    }

    internal void UpdateBoundsAt(ref BodySet set, int index)
    {
        ref var collidable = ref set.Collidables[index];
        PlaceInBroadPhase(ref set, index, PrepareBounds(ref set, index, set.MotionStates[index].Pose, collidable.Shape));
    }

    internal void GetBoundsPointers(ref BodySet set, int index, out Vector3* min, out Vector3* max)
    {
        var leaf = set.Collidables[index].BroadPhaseIndex;
        if (leaf < 0)
            throw new InvalidOperationException($"There are no bounds of {set.IndexToHandle[index]}: it has no shape.");
        broadPhase.GetActiveBoundsPointers(leaf, out min, out max);
    }
}
