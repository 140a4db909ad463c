using System.Numerics;
using BepuPhysics.Collidables;
using BepuUtilities.Collections;

namespace BepuPhysics.CollisionDetection;

// Pairs of which one body at least sleeps. Their contacts, if they have any, sleep too, or one of the two has to wake.
public abstract partial class NarrowPhase
{
    /// <summary>Keys of the pairs that have woken since the tests of this step, one for each constraint; not allocated where there are none.</summary>
    private protected QuickList<ulong> Woken;

    /// <summary>Whether pairs that wake are listed.</summary>
    private protected bool ListsWoken;

    /// <summary>Moves the pair of a contact constraint among those that sleep.</summary>
    internal void PutToSleep(int constraint)
    {
        Pairs.PutToSleep(pairOfConstraint[constraint], Pool);
        Restitution.NoteSleep();
    }

    /// <summary>Moves the pair of a contact constraint among those that are tested in each step.</summary>
    internal void Awaken(int constraint)
    {
        var pair = pairOfConstraint[constraint];
        Pairs.Awaken(pair, Pool);
        if (ListsWoken)
            NoteWoken(pair);
        Simulation.Events.NoteAwake(pair);
    }

    private protected static ulong Key(in CollidablePair pair) => (ulong)pair.A.Packed << 32 | pair.B.Packed;

    void NoteWoken(in CollidablePair pair)
    {
        if (!Woken.Span.Allocated)
            Woken = new(64, Pool);
        Woken.Add(Key(pair), Pool);
    }

    /// <summary>Whether the contacts of a pair sleep.</summary>
    internal bool Sleeps(in CollidablePair pair) => Pairs.IsAsleep(pair);

    /// <summary>Whether there is nothing to do: no body is awake, and nothing is left to be forgotten of those that were.</summary>
    internal bool IsAtRest => Simulation.Bodies.Awake.Count == 0 && Pairs.Pairs.Count == 0;

    /// <summary>What a step does in which there is nothing to do.</summary>
    internal void Rest()
    {
        SkippedPairCount = 0;
        Simulation.Events.BeginDetection();
        Restitution.BeginStep();
        SmoothBends.Clear();
    }

    /// <summary>Whether a kinematic body that is awake moves, be it only that a game has put it elsewhere since the last step. Before the solver.</summary>
    internal static bool Moves(in BodySet set, int index)
    {
        ref var velocity = ref set.MotionStates[index].Velocity;
        return velocity.Linear != Vector3.Zero || velocity.Angular != Vector3.Zero || Bodies.IsMovedByPose(set, index);
    }

    /// <summary>Whether a body that is awake wakes one that sleeps by touching it.</summary>
    private protected bool Wakes(CollidableReference awake) =>
        awake.Mobility == CollidableMobility.Dynamic || Moves(Simulation.Bodies.Awake, Simulation.Bodies.Locations[awake.Slot].Index);
}
