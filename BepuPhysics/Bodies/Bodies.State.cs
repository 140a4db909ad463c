using BepuPhysics.Collidables;

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
        copy.Value(ref RipeCount);
        for (int i = 0; i < Sets.Length; ++i)
            Sets[i].CopyState(copy);
    }

    /// <summary>Notes the shapes of all bodies.</summary>
    internal void CountShapes(ref UsedShapes used)
    {
        for (int i = 0; i < Sets.Length; ++i)
        {
            for (int j = 0; j < Sets[i].Count; ++j)
                used.Add(Sets[i].Collidables[j].Shape);
        }
    }

    /// <summary>Counts the bodies among the users of their shapes.</summary>
    internal void BeginUses()
    {
        for (int i = 0; i < Sets.Length; ++i)
        {
            for (int j = 0; j < Sets[i].Count; ++j)
                shapes.BeginUse(Sets[i].Collidables[j].Shape);
        }
    }
}
