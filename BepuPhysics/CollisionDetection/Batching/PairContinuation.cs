namespace BepuPhysics.CollisionDetection;

/// <summary>What becomes of the result of a pair.</summary>
/// <param name="pairId">Id that the callbacks get with the result; any value.</param>
public readonly struct PairContinuation(int pairId)
{
    /// <summary>Id that the callbacks get with the result.</summary>
    public int PairId { get; } = pairId;
}
