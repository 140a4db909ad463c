namespace BepuPhysics.CollisionDetection;

/// <summary>Receives the pairs of leaves whose bounds overlap, from all workers at once.</summary>
public interface IBroadPhaseOverlapHandler
{
    /// <summary>Called on worker threads in no particular order, exactly once for each pair.</summary>
    /// <param name="workerIndex">The worker that calls; no two calls with the same index run at the same time.</param>
    /// <param name="leafA">Index of a leaf of the active tree.</param>
    /// <param name="leafB">Index of another leaf of the active tree, above <paramref name="leafA"/>, or of a leaf of the static
    /// tree.</param>
    /// <param name="bIsStatic">Whether <paramref name="leafB"/> is in the static tree.</param>
    void Handle(int workerIndex, int leafA, int leafB, bool bIsStatic);
}
