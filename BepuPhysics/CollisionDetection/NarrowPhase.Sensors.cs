using System;
using BepuPhysics.Collidables;

namespace BepuPhysics.CollisionDetection;

// Pairs with a sensor are tested with a margin of zero, and that they overlap is all that is wanted to know. They are in no cache: which
// of them there are in a step is told by the step alone.
public sealed unsafe partial class NarrowPhase<TCallbacks>
{
    // Sensors see what nothing pushes, too.
    bool IsSensed(CollidableReference a, CollidableReference b) =>
        Simulation.Events.UsesSensors && a.Mobility != CollidableMobility.Static && Simulation.Events.CountSensors(a, b) == 1;

    // Sensors do not see sensors, and what they see interests nobody who does not listen.
    bool IsTested(in CollidablePair pair, out bool isSensor)
    {
        var count = Simulation.Events.CountSensors(pair.A, pair.B);
        isSensor = count > 0;
        return count == 0 || (count == 1 && Simulation.Events.MaskOf(pair) != EventMask.None);
    }

    void NoteSensed<TManifold>(int workerIndex, in CollidablePair pair, ref TManifold manifold)
        where TManifold : unmanaged, IContactManifold<TManifold>
    {
        for (int i = 0; i < manifold.Count; ++i)
        {
            if (manifold.GetDepth(i) > 0)
            {
                NoteSensed(workerIndex, pair);
                return;
            }
        }
    }

    void NoteSensed(int workerIndex, in CollidablePair pair, Span<ChildResult> results)
    {
        foreach (ref var result in results)
        {
            for (int i = 0; i < result.Manifold.Count; ++i)
            {
                if (result.Manifold.GetDepth(i) > 0)
                {
                    NoteSensed(workerIndex, pair);
                    return;
                }
            }
        }
    }

    void NoteSensed(int workerIndex, in CollidablePair pair) => Note(ref workers[workerIndex].Sensed, pair, workers[workerIndex].Pool);

    // In whatever order: events are put in order by pair.
    void GatherSensed()
    {
        Simulation.Events.BeginDetection();
        for (int i = 0; i < workers.Length; ++i)
        {
            for (int j = 0; j < workers[i].Sensed.Count; ++j)
                Simulation.Events.NoteSensed(workers[i].Sensed[j]);
        }
    }
}
