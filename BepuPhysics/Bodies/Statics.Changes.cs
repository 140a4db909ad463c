using System;
using BepuPhysics.Collidables;
using BepuPhysics.Trees;
using BepuUtilities;

namespace BepuPhysics;

// What may be changed of a static, and who wakes then. All that can fail comes before the first change.
public sealed unsafe partial class Statics
{
    /// <summary>Gives a static another shape and wakes the dynamic bodies that it may touch, or may have touched.</summary>
    /// <exception cref="ArgumentException">There is no such static or no such shape; nothing was changed.</exception>
    public void SetShape(StaticHandle handle, TypedIndex newShape)
    {
        var filter = default(StaticsShouldntAwakenKinematics);
        SetShape(handle, newShape, ref filter);
    }

    /// <summary>Gives a static another shape and wakes the bodies that a filter chooses.</summary>
    /// <exception cref="ArgumentException">There is no such static or no such shape; nothing was changed.</exception>
    public void SetShape<TAwakeningFilter>(StaticHandle handle, TypedIndex newShape, ref TAwakeningFilter filter)
        where TAwakeningFilter : struct, IStaticChangeAwakeningFilter
    {
        using var change = world.Change("Statics.SetShape");
        CheckHandle(handle);
        shapes.CheckExists(newShape, nameof(newShape));
        var index = Indices[handle.Slot];
        ref var target = ref StaticsBuffer[index];
        var bounds = CheckedBounds(index, target.Pose, newShape);
        RequestAround(index, bounds, ref filter);
        shapes.ChangeUse(target.Shape, newShape);
        target.Shape = newShape;
        Replace(index, bounds);
    }

    /// <summary>Makes a static what a description says and wakes the dynamic bodies that it may touch, or may have touched.</summary>
    /// <exception cref="ArgumentException">There is no such static, a value cannot be simulated, or the shape does not exist; nothing was changed.</exception>
    public void ApplyDescription(StaticHandle handle, in StaticDescription description)
    {
        var filter = default(StaticsShouldntAwakenKinematics);
        ApplyDescription(handle, description, ref filter);
    }

    /// <summary>Makes a static what a description says and wakes the bodies that a filter chooses.</summary>
    /// <exception cref="ArgumentException">There is no such static, a value cannot be simulated, or the shape does not exist; nothing was changed.</exception>
    public void ApplyDescription<TAwakeningFilter>(StaticHandle handle, in StaticDescription description, ref TAwakeningFilter filter)
        where TAwakeningFilter : struct, IStaticChangeAwakeningFilter
    {
        using var change = world.Change("Statics.ApplyDescription");
        CheckHandle(handle);
        Validate(description);
        var index = Indices[handle.Slot];
        ref var target = ref StaticsBuffer[index];
        var pose = BodyChecks.Straighten(description.Pose);
        var bounds = CheckedBounds(index, pose, description.Shape);
        RequestAround(index, bounds, ref filter);
        shapes.ChangeUse(target.Shape, description.Shape);
        if (target.Pose.Position != pose.Position || target.Pose.Orientation != pose.Orientation)
            NoteMoved(handle.Slot, BoundsAt(index), bounds);
        target.Pose = pose;
        target.Shape = description.Shape;
        target.Continuity = description.Continuity;
        Replace(index, bounds);
    }

    /// <summary>Moves the bounds of a static to where its pose says and wakes the dynamic bodies there, and where they were.</summary>
    /// <exception cref="ArgumentException">There is no such static.</exception>
    /// <exception cref="InvalidOperationException">Its pose is not finite; nothing was changed.</exception>
    public void UpdateBounds(StaticHandle handle)
    {
        using var change = world.Change("Statics.UpdateBounds");
        CheckHandle(handle);
        var index = Indices[handle.Slot];
        ref var target = ref StaticsBuffer[index];
        var bounds = CheckedBounds(index, target.Pose, target.Shape);
        var filter = default(StaticsShouldntAwakenKinematics);
        RequestAround(index, bounds, ref filter);
        NoteMoved(handle.Slot, BoundsAt(index), bounds);
        Replace(index, bounds);
    }

    /// <summary>Wakes the dynamic bodies whose bounds meet those of a static.</summary>
    internal void WakeAround(StaticHandle handle)
    {
        var filter = default(StaticsShouldntAwakenKinematics);
        awakener.BeginRequests();
        awakener.Request(BoundsAt(Indices[handle.Slot]), ref filter);
        awakener.WakeRequested();
    }

    BoundingBox CheckedBounds(int index, in RigidPose pose, TypedIndex shape)
    {
        var bounds = BoundsOf(pose, shape);
        if (!BoxMath.IsValid(bounds.Min, bounds.Max))
            throw new InvalidOperationException($"There are no finite bounds of {IndexToHandle[index]}: its pose is {pose}.");
        return bounds;
    }

    // Bounds of still things are not refitted every step, so a static that moved is taken out of its tree and put in anew. Wakes who was asked for.
    void Replace(int index, BoundingBox bounds)
    {
        RemoveFromBroadPhase(index);
        AddToBroadPhase(index, bounds);
        awakener.WakeRequested();
    }

    // Who wakes is found before anything changes: the filter is the game's and may throw.
    void RequestAround<TAwakeningFilter>(int index, in BoundingBox bounds, ref TAwakeningFilter filter)
        where TAwakeningFilter : struct, IStaticChangeAwakeningFilter
    {
        awakener.BeginRequests();
        awakener.Request(BoundsAt(index), ref filter);
        awakener.Request(bounds, ref filter);
    }

    BoundingBox BoundsAt(int index)
    {
        broadPhase.GetStaticBoundsPointers(StaticsBuffer[index].BroadPhaseIndex, out var min, out var max);
        return new(*min, *max);
    }
}
