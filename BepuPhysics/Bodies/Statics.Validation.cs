namespace BepuPhysics;

public sealed partial class Statics
{
    /// <summary>Handles and indices, numbers, and leaves of the broad phase.</summary>
    internal void Validate()
    {
        Invariant.Require(Count >= 0 && Count <= StaticsBuffer.Length && Count <= IndexToHandle.Length, "number of statics", Count);
        for (int index = 0; index < Count; ++index)
        {
            var handle = IndexToHandle[index];
            Invariant.Require(StaticExists(handle), "handle of the static at index", index);
            Invariant.Require(Indices[handle.Slot] == index, "index of static", handle.Slot);
            ref var target = ref StaticsBuffer[index];
            Invariant.Finite(target.Pose.Position, "position of static", handle.Slot);
            Invariant.Finite(target.Pose.Orientation, "orientation of static", handle.Slot);
            Invariant.Require(shapes.Holds(target.Shape), "shape of static", handle.Slot);
            Invariant.Require((uint)target.BroadPhaseIndex < (uint)broadPhase.StaticTree.LeafCount, "leaf of static", handle.Slot);
            Invariant.Require(broadPhase.StaticLeaves[target.BroadPhaseIndex] == new Collidables.CollidableReference(handle),
                "collidable of the leaf of static", handle.Slot);
        }
        Invariant.Ids(HandlePool, Indices.Length, "statics", id => Indices[id] >= 0);
        for (int slot = 0; slot < owners.Capacity; ++slot)
            Invariant.Require(owners.IsTaken(slot) == (slot < Indices.Length && Indices[slot] >= 0), "owner of slot", slot);
    }
}
