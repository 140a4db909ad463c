using BepuPhysics.Collidables;

namespace BepuPhysics;

// Saving and restoring.
public sealed unsafe partial class Statics
{
    internal void CopyState(StateCopy copy)
    {
        owners.CopyState(copy);
        copy.Ids(ref HandlePool);
        copy.Rows(ref Indices, HandlePool.HighestPossiblyClaimedId + 1, -1);
        if (copy.Restores)
            EnsureSlots(Indices.Length);
        copy.Rows(ref IndexToHandle, Count);
        Count = copy.Rows(ref StaticsBuffer, Count);
    }

    /// <summary>Notes the shapes of all statics.</summary>
    internal void CountShapes(ref UsedShapes used)
    {
        for (int i = 0; i < Count; ++i)
            used.Add(StaticsBuffer[i].Shape);
    }

    /// <summary>Counts the statics among the users of their shapes.</summary>
    internal void BeginUses()
    {
        for (int i = 0; i < Count; ++i)
            shapes.BeginUse(StaticsBuffer[i].Shape);
    }
}
