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
}
