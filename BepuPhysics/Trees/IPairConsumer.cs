namespace BepuPhysics.Trees;

/// <summary>Hands found pairs on. Static, so that it costs no call and no copy of the handler.</summary>
unsafe interface IPairConsumer<THandler>
{
    /// <summary>Takes over some pairs of leaves; the memory is used again after the call.</summary>
    static abstract void Consume(ref THandler handler, int workerIndex, int* leavesA, int* leavesB, int count);
}
