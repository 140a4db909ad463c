namespace BepuPhysics.CollisionDetection;

// Saving and restoring. What was told of the last step is no part of it: after a restore nothing is told until the next.
public sealed unsafe partial class CollisionEvents
{
    /// <summary>Not before those who listen were copied.</summary>
    internal void CopyState(StateCopy copy)
    {
        copy.List(ref pairs);
        copy.List(ref added);
        copy.List(ref held);
        copy.List(ref turned);
        copy.Dictionary(ref touchingAsleep);
        copy.Value(ref hitSpeed);
        copy.Value(ref hasNewListener);
        copy.Value(ref isSettled);
        copy.Value(ref removalsSeen);
        UsesSensors = copy.Value(UsesSensors);
        if (!copy.Restores)
            return;
        began.Count = ended.Count = hits.Count = persisting.Count = slept.Count = woke.Count = sensed.Count = 0;
        manifolds.Count = contacts.Count = bounces.Count = holding.Count = 0;
        for (int i = 0; i < pairs.Count; ++i)
            pairs[i].ManifoldCount = pairs[i].Bounce = 0;
        isStale = true;
        stage.Forget();
        solver.OptionalStages.Remove(stage);
        if (IsUsed)
            solver.OptionalStages.Add(stage);
    }
}
