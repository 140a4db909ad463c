using System;
using System.Numerics;
using BepuPhysics.Collidables;
using BepuPhysics.Trees;
using BepuUtilities;
using BepuUtilities.Memory;

namespace BepuPhysics;

// Bodies in the broad phase: those that are awake have leaves of the active tree, those that sleep of the static tree.
public sealed unsafe partial class Bodies
{
    // Everything about a change of bounds that can fail.
    BoundingBox PrepareBounds(BodyHandle handle, in RigidPose pose, TypedIndex shape)
    {
        if (!shape.Exists)
            return default;
        shapes.UpdateBounds(pose, shape, out var bounds);
        if (!BoxMath.IsValid(bounds.Min, bounds.Max))
            throw new InvalidOperationException($"There are no finite bounds of {handle}: its pose is {pose}.");
        if (SetOf(handle, out var index).Collidables[index].BroadPhaseIndex < 0)
            broadPhase.MakeRoomFor(broadPhase.ActiveTree.LeafCount + 1, 0);
        return bounds;
    }

    // Brings the leaf of a body, if it is to have one, to its bounds. Bodies without one are awake where they get it.
    void PlaceInBroadPhase(ref BodySet set, int index, BoundingBox bounds)
    {
        ref var collidable = ref set.Collidables[index];
        if (!collidable.Shape.Exists)
            RemoveFromBroadPhase(ref set, index);
        else if (collidable.BroadPhaseIndex < 0)
            collidable.BroadPhaseIndex = broadPhase.AddActiveLeaf(ReferenceAt(set, index), bounds);
        else if (set.IsAsleep)
            broadPhase.UpdateStaticLeaf(collidable.BroadPhaseIndex, bounds.Min, bounds.Max);
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

    /// <summary>Makes room for the leaves of bodies that fall asleep.</summary>
    internal void ReserveStaticLeaves(int count)
    {
        var needed = broadPhase.StaticTree.LeafCount + count;
        if (needed > broadPhase.StaticTree.Leaves.Length)
            broadPhase.MakeRoomFor(0, Math.Max(needed, 2 * broadPhase.StaticTree.LeafCount));
    }

    /// <summary>Moves the leaf of a body that is awake, and about to sleep, to the static tree. Before the body itself.</summary>
    /// <param name="slot">The body.</param>
    /// <param name="scratch">Pool for the time of the call; there is room for the leaf.</param>
    internal void MoveLeafToStaticTree(int slot, BufferPool scratch)
    {
        var index = Locations[slot].Index;
        ref var leaf = ref Awake.Collidables[index].BroadPhaseIndex;
        if (leaf < 0)
            return;
        broadPhase.GetActiveBoundsPointers(leaf, out var min, out var max);
        var bounds = new BoundingBox(*min, *max);
        RemoveFromBroadPhase(ref Awake, index);
        leaf = broadPhase.AddStaticLeaf(ReferenceAt(Awake, index), bounds, scratch);
    }

    // Of a body that has woken.
    void MoveLeafToActiveTree(int index)
    {
        ref var leaf = ref Awake.Collidables[index].BroadPhaseIndex;
        if (leaf < 0)
            return;
        broadPhase.GetStaticBoundsPointers(leaf, out var min, out var max);
        var bounds = new BoundingBox(*min, *max);
        if (broadPhase.RemoveStaticLeafAt(leaf, out var moved))
            FollowStaticLeaf(moved, leaf);
        leaf = broadPhase.AddActiveLeaf(ReferenceAt(Awake, index), bounds);
    }

    /// <summary>Follows a leaf of the static tree, a static's or a sleeping body's, that has another index now.</summary>
    internal void FollowStaticLeaf(CollidableReference moved, int leaf)
    {
        if (moved.Mobility == CollidableMobility.Static)
            statics.StaticsBuffer[statics.Indices[moved.Slot]].BroadPhaseIndex = leaf;
        else
            SetOf(moved.BodyHandle, out var index).Collidables[index].BroadPhaseIndex = leaf;
    }

    internal void GetBoundsPointers(ref BodySet set, int index, out Vector3* min, out Vector3* max)
    {
        var leaf = set.Collidables[index].BroadPhaseIndex;
        if (leaf < 0)
            throw new InvalidOperationException($"There are no bounds of {set.IndexToHandle[index]}: it has no shape.");
        if (set.IsAsleep)
            broadPhase.GetStaticBoundsPointers(leaf, out min, out max);
        else
            broadPhase.GetActiveBoundsPointers(leaf, out min, out max);
    }
}
