using System;
using BepuPhysics.Collidables;

namespace BepuPhysics;

// What may be changed of a body. All that can fail comes before the first change, and waking it is the first. A kinematic that is changed wakes all
// that it holds.
public sealed unsafe partial class Bodies
{
    /// <summary>Makes a body what a description says; its constraints stay.</summary>
    /// <exception cref="ArgumentException">There is no such body, a value cannot be simulated, or the shape does not exist; nothing was changed.</exception>
    public void ApplyDescription(BodyHandle handle, in BodyDescription description)
    {
        using var change = world.Change("Bodies.ApplyDescription");
        CheckHandle(handle);
        Validate(description);
        var shape = description.Collidable.Shape;
        var pose = BodyChecks.Straighten(description.Pose);
        var bounds = PrepareBounds(handle, pose, shape);
        awakener.WakeAround(handle);
        ref var set = ref SetOf(handle, out var index);
        set.EnsurePrincipalFrames(description.LocalInertia.InverseInertiaTensor, Pool);
        ChangeInertia(handle, description.LocalInertia);
        ref var motion = ref set.MotionStates[index];
        var turns = IsKinematic(description.LocalInertia) && IsTurned(motion.Pose.Orientation, pose.Orientation);
        motion.Pose = pose;
        motion.Velocity = description.Velocity;
        set.SoundPoses[index] = pose;
        shapes.ChangeUse(set.Collidables[index].Shape, shape);
        WriteSettings(ref set, index, description);
        if (turns)
            set.Activity[index].NoteTurned();
        PlaceInBroadPhase(ref set, index, bounds);
    }

    /// <summary>Gives a body another shape; its inertia stays.</summary>
    /// <exception cref="ArgumentException">There is no such body or no such shape; nothing was changed.</exception>
    /// <exception cref="InvalidOperationException">The body's pose is not finite; nothing was changed.</exception>
    public void SetShape(BodyHandle handle, TypedIndex newShape)
    {
        using var change = world.Change("Bodies.SetShape");
        CheckHandle(handle);
        CheckShape(newShape);
        ref var before = ref SetOf(handle, out var index);
        if (before.Collidables[index].Shape == newShape)
            return;
        var bounds = PrepareBounds(handle, before.MotionStates[index].Pose, newShape);
        awakener.WakeAround(handle);
        ref var set = ref SetOf(handle, out index);
        ref var collidable = ref set.Collidables[index];
        shapes.ChangeUse(collidable.Shape, newShape);
        collidable.Shape = newShape;
        PlaceInBroadPhase(ref set, index, bounds);
    }

    /// <summary>Gives a body another inertia. All zero makes it kinematic, which removes its constraints to other kinematic bodies.</summary>
    /// <exception cref="ArgumentException">There is no such body or the inertia cannot be simulated; nothing was changed.</exception>
    public void SetLocalInertia(BodyHandle handle, in BodyInertia localInertia)
    {
        using var change = world.Change("Bodies.SetLocalInertia");
        CheckHandle(handle);
        BodyChecks.Inertia(localInertia);
        awakener.WakeAround(handle);
        SetOf(handle, out _).EnsurePrincipalFrames(localInertia.InverseInertiaTensor, Pool);
        ChangeInertia(handle, localInertia);
    }

    /// <summary>Moves the bounds of a body in the broad phase to where its pose says, as for queries between steps. Wakes nobody.</summary>
    /// <exception cref="ArgumentException">There is no such body.</exception>
    /// <exception cref="InvalidOperationException">The body's pose is not finite; nothing was changed.</exception>
    public void UpdateBounds(BodyHandle bodyHandle)
    {
        using var change = world.Change("Bodies.UpdateBounds");
        CheckHandle(bodyHandle);
        ref var set = ref SetOf(bodyHandle, out var index);
        PlaceInBroadPhase(ref set, index, PrepareBounds(bodyHandle, set.MotionStates[index].Pose, set.Collidables[index].Shape));
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
}
