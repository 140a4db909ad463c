namespace BepuPhysics;

// Saving and restoring.
public sealed partial class Bodies
{
    internal void CopyState(StateCopy copy)
    {
        owners.CopyState(copy);
        copy.Ids(ref HandlePool);
        copy.Rows(ref Locations, HandlePool.HighestPossiblyClaimedId + 1, new BodyMemoryLocation { SetIndex = -1 });
        if (copy.Restores)
            EnsureSlots(Locations.Length);
        copy.Value(ref RestCounts);
        for (int i = 0; i < Sets.Length; ++i)
            Sets[i].CopyState(copy);
    }
}
