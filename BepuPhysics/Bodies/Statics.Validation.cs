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
            Invariant.Require(HandleToIndex[handle.Value] == index, "index of static", handle.Value);
            ref var target = ref StaticsBuffer[index];
            Invariant.Finite(target.Pose.Position, "position of static", handle.Value);
            Invariant.Finite(target.Pose.Orientation, "orientation of static", handle.Value);
            Invariant.Require(shapes.Exists(target.Shape), "shape of static", handle.Value);
            Invariant.Require((uint)target.BroadPhaseIndex < (uint)broadPhase.StaticTree.LeafCount, "leaf of static", handle.Value);
            Invariant.Require(broadPhase.StaticLeaves[target.BroadPhaseIndex] == new Collidables.CollidableReference(handle),
                "collidable of the leaf of static", handle.Value);
        }
        Invariant.Require(Count == broadPhase.StaticTree.LeafCount, "number of static leaves, statics have", Count);
        Invariant.Ids(HandlePool, HandleToIndex.Length, "statics", id => HandleToIndex[id] >= 0);
    }
}
