using System.Numerics;

namespace BepuPhysics;

// Saving and restoring, and another origin of the world.
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
        CopyMoved(copy);
    }

    /// <exception cref="System.ArgumentException">A static would be beyond all positions; nothing was changed.</exception>
    internal void CheckShift(Vector3 shift)
    {
        for (int i = 0; i < Count; ++i)
            BodyChecks.ShiftedPosition(StaticsBuffer[i].Pose.Position, shift);
    }

    /// <summary>Moves all statics to where they are seen from a new origin.</summary>
    internal void ShiftOrigin(Vector3 shift)
    {
        for (int i = 0; i < Count; ++i)
            StaticsBuffer[i].Pose.Position -= shift;
    }
}
