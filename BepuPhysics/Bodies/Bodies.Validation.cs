using System;
using System.Numerics;
using System.Runtime.InteropServices;

namespace BepuPhysics;

public sealed partial class Bodies
{
    /// <summary>Handles and places, numbers, leaves of the broad phase.</summary>
    internal void Validate()
    {
        int leafCount = 0;
        int asleepLeafCount = 0;
        for (int setIndex = 0; setIndex < Sets.Length; ++setIndex)
        {
            ref var set = ref Sets[setIndex];
            Invariant.Require(set.Count >= 0 && set.Count <= set.Capacity, "number of bodies in set", setIndex);
            for (int index = 0; index < set.Count; ++index)
            {
                var handle = set.IndexToHandle[index];
                Invariant.Require(BodyExists(handle), "handle of the body at an index", setIndex, index);
                var location = Locations[handle.Slot];
                Invariant.Require(location.SetIndex == setIndex && location.Index == index, "location of body", handle.Slot);
                ValidateNumbers(ref set, index, handle.Slot);
                ValidateCollidable(ref set, index, handle.Slot, ref set.IsAsleep ? ref asleepLeafCount : ref leafCount);
            }
            Invariant.Require(IsZeroBehindLast(ref set), "rows behind the last body of set", setIndex);
        }
        Invariant.Require(leafCount == broadPhase.ActiveTree.LeafCount, "number of active leaves, bodies have", leafCount);
        Invariant.Require(asleepLeafCount + statics.Count == broadPhase.StaticTree.LeafCount, "number of static leaves, sleeping bodies have", asleepLeafCount);
        Invariant.Ids(HandlePool, Locations.Length, "bodies", id => Locations[id].SetIndex >= 0);
        for (int slot = 0; slot < owners.Capacity; ++slot)
            Invariant.Require(owners.IsTaken(slot) == (slot < Locations.Length && Locations[slot].SetIndex >= 0), "owner of slot", slot);
    }

    static void ValidateNumbers(ref BodySet set, int index, int handle)
    {
        ref var motion = ref set.MotionStates[index];
        Invariant.Finite(motion.Pose.Position, "position of body", handle);
        Invariant.Finite(motion.Pose.Orientation, "orientation of body", handle);
        Invariant.Finite(motion.Velocity.Linear, "linear velocity of body", handle);
        Invariant.Finite(motion.Velocity.Angular, "angular velocity of body", handle);
        ref var inertia = ref set.LocalInertias[index];
        ref var tensor = ref inertia.InverseInertiaTensor;
        Invariant.Finite(new Vector3(tensor.XX, tensor.YY, tensor.ZZ), "inverse inertia of body", handle);
        Invariant.Finite(new Vector3(tensor.YX, tensor.ZX, tensor.ZY), "inverse inertia of body", handle);
        Invariant.Require(float.IsFinite(inertia.InverseMass) && inertia.InverseMass >= 0, "inverse mass of body", handle);
    }

    void ValidateCollidable(ref BodySet set, int index, int handle, ref int leafCount)
    {
        ref var collidable = ref set.Collidables[index];
        if (!collidable.Shape.Exists)
        {
            Invariant.Require(collidable.BroadPhaseIndex < 0, "leaf of body without a shape", handle);
            return;
        }
        Invariant.Require(shapes.Holds(collidable.Shape), "shape of body", handle);
        var leafLimit = set.IsAsleep ? broadPhase.StaticTree.LeafCount : broadPhase.ActiveTree.LeafCount;
        Invariant.Require((uint)collidable.BroadPhaseIndex < (uint)leafLimit, "leaf of body", handle);
        // Also that the leaf knows whether the body is kinematic.
        var leaves = set.IsAsleep ? broadPhase.StaticLeaves : broadPhase.ActiveLeaves;
        Invariant.Require(leaves[collidable.BroadPhaseIndex] == ReferenceAt(set, index), "collidable of the leaf of body", handle);
        ++leafCount;
    }

    // Passes over whole bundles read them.
    static bool IsZeroBehindLast(ref BodySet set)
    {
        var end = BodySet.WholeBundles(set.Count);
        var motions = MemoryMarshal.AsBytes(set.MotionStates.AsSpan()[set.Count..end]);
        var inertias = MemoryMarshal.AsBytes(set.LocalInertias.AsSpan()[set.Count..end]);
        return motions.IndexOfAnyExcept((byte)0) < 0 && inertias.IndexOfAnyExcept((byte)0) < 0;
    }
}
