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
        var index = Locations[handle.Slot].Index;
        var shape = description.Collidable.Shape;
        var bounds = PrepareBounds(index, description.Pose, shape);
        ActiveSet.EnsurePrincipalFrames(description.LocalInertia.InverseInertiaTensor, Pool);
        ChangeInertia(handle, description.LocalInertia);
        ref var motion = ref ActiveSet.MotionStates[index];
        motion.Pose = description.Pose;
        motion.Velocity = description.Velocity;
        ActiveSet.SoundPoses[index] = description.Pose;
        shapes.ChangeUse(ActiveSet.Collidables[index].Shape, shape);
        WriteSettings(index, description);
        PlaceInBroadPhase(index, bounds);
    }

    /// <summary>Gives a body another shape; its inertia stays.</summary>
    /// <exception cref="ArgumentException">There is no such body or no such shape; nothing was changed.</exception>
    /// <exception cref="InvalidOperationException">The body's pose is not finite; nothing was changed.</exception>
    public void SetShape(BodyHandle handle, TypedIndex shape)
    {
        using var change = world.Change("Bodies.SetShape");
        CheckHandle(handle);
        CheckShape(shape);
        var index = Locations[handle.Slot].Index;
        ref var collidable = ref ActiveSet.Collidables[index];
        if (collidable.Shape == shape)
            return;
        var bounds = PrepareBounds(index, ActiveSet.MotionStates[index].Pose, shape);
        shapes.ChangeUse(collidable.Shape, shape);
        collidable.Shape = shape;
        PlaceInBroadPhase(index, bounds);
    }

    /// <summary>Gives a body another inertia. All zero makes it kinematic, which removes its constraints to other kinematic bodies.</summary>
    /// <exception cref="ArgumentException">There is no such body or the inertia cannot be simulated; nothing was changed.</exception>
    public void SetLocalInertia(BodyHandle handle, in BodyInertia localInertia)
    {
        using var change = world.Change("Bodies.SetLocalInertia");
        CheckHandle(handle);
        BodyChecks.Inertia(localInertia);
        ActiveSet.EnsurePrincipalFrames(localInertia.InverseInertiaTensor, Pool);
        ChangeInertia(handle, localInertia);
    }

    /// <summary>Moves the bounds of a body in the broad phase to where its pose says, as for queries between steps.</summary>
    /// <exception cref="ArgumentException">There is no such body.</exception>
    /// <exception cref="InvalidOperationException">The body's pose is not finite; nothing was changed.</exception>
    public void UpdateBounds(BodyHandle handle)
    {
        using var change = world.Change("Bodies.UpdateBounds");
        CheckHandle(handle);
        UpdateBoundsAt(Locations[handle.Slot].Index);
    }

    void ChangeInertia(BodyHandle handle, in BodyInertia localInertia)
    {
        var index = Locations[handle.Slot].Index;
        ref var current = ref ActiveSet.LocalInertias[index];
        var changesKind = IsKinematic(current) != IsKinematic(localInertia);
        current = localInertia;
        if (!changesKind)
            return;
        solver.Recolor(handle);
        // The broad phase knows the kind of each collidable.
        var leaf = ActiveSet.Collidables[index].BroadPhaseIndex;
        if (leaf >= 0)
            broadPhase.ActiveLeaves[leaf] = ReferenceAt(index);
    }

    // Everything about a change of bounds that can fail.
    BoundingBox PrepareBounds(int index, in RigidPose pose, TypedIndex shape)
    {
        if (!shape.Exists)
            return default;
        shapes.UpdateBounds(pose, shape, out var bounds);
        if (!BoxMath.IsValid(bounds.Min, bounds.Max))
            throw new InvalidOperationException($"There are no finite bounds of {ActiveSet.IndexToHandle[index]}: its pose is {pose}.");
        if (ActiveSet.Collidables[index].BroadPhaseIndex < 0)
            broadPhase.MakeRoomFor(broadPhase.ActiveTree.LeafCount + 1, 0);
        return bounds;
    }

    // Brings the leaf of a body, if it is to have one, to its bounds.
    void PlaceInBroadPhase(int index, BoundingBox bounds)
    {
        ref var collidable = ref ActiveSet.Collidables[index];
        if (!collidable.Shape.Exists)
            RemoveFromBroadPhase(index);
        else if (collidable.BroadPhaseIndex < 0)
            collidable.BroadPhaseIndex = broadPhase.AddActiveLeaf(ReferenceAt(index), bounds);
        else
            // The whole tree at once: a query may come before the next step fits it.
            broadPhase.ActiveTree.UpdateBounds(collidable.BroadPhaseIndex, bounds.Min, bounds.Max);
    }

    void RemoveFromBroadPhase(int index)
    {
        ref var leaf = ref ActiveSet.Collidables[index].BroadPhaseIndex;
        if (leaf < 0)
            return;
        if (broadPhase.RemoveActiveLeafAt(leaf, out var moved))
            ActiveSet.Collidables[Locations[moved.BodyHandle.Slot].Index].BroadPhaseIndex = leaf;
        leaf = -1;
    }

    internal void UpdateBoundsAt(int index)
    {
        ref var collidable = ref ActiveSet.Collidables[index];
        PlaceInBroadPhase(index, PrepareBounds(index, ActiveSet.MotionStates[index].Pose, collidable.Shape));
    }

    internal void GetBoundsPointers(int index, out Vector3* min, out Vector3* max)
    {
        var leaf = ActiveSet.Collidables[index].BroadPhaseIndex;
        if (leaf < 0)
            throw new InvalidOperationException($"There are no bounds of {ActiveSet.IndexToHandle[index]}: it has no shape.");
        broadPhase.GetActiveBoundsPointers(leaf, out min, out max);
    }
}
