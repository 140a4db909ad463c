using System;

namespace BepuPhysics.CollisionDetection;

/// <summary>
/// What a thread has gone through since it stepped a simulation last: where that is much, the simulation finds nothing of its own in the caches.
/// </summary>
// A character's cloth, or a rig that learns, is often a small simulation of its own, one of hundreds that take turns.
struct TurnsOfThread
{
    [ThreadStatic] static long bytesOfThread;

    long bytesAtLastTurn;

    /// <summary>Counts a step. For a guess of what takes less time: after a step on another thread it may be too little.</summary>
    /// <param name="bytes">Bytes that the step goes through.</param>
    /// <returns>Bytes that the thread has gone through from the end of the simulation's last step to the end of this one.</returns>
    public long Count(long bytes)
    {
        bytesOfThread += bytes;
        var since = bytesOfThread - bytesAtLastTurn;
        bytesAtLastTurn = bytesOfThread;
        return Math.Max(since, bytes);
    }
}
