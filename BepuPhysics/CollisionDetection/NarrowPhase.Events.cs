using System;

namespace BepuPhysics.CollisionDetection;

// What the events of a step need to know of pairs and bounces.
public abstract partial class NarrowPhase
{
    // Made once: a step makes no garbage.
    readonly Action tellPersisting;

    /// <summary>Finds the contacts whose impulses are to be told.</summary>
    internal void BeginEvents()
    {
        if (!Simulation.Events.IsUsed)
            return;
        for (int i = 0; i < FastPairs.Count; ++i)
        {
            if (FastPairs.IsSensor(i, out var pair))
                Simulation.Events.NoteSwept(pair);
        }
        Simulation.Events.BeginSolve(ref Pairs, IsAtRest);
    }

    /// <summary>Tells what has happened in the step.</summary>
    internal void EndEvents()
    {
        if (!Simulation.Events.IsUsed)
            return;
        // A bounce is no impulse of a constraint.
        for (int i = 0; i < Restitution.PairCount; ++i)
        {
            if (Restitution.TryGetBounce(i, out var constraint, out var impulse, out var friction))
                Simulation.Events.AddBounce(pairOfConstraint[constraint.Slot], impulse, friction);
        }
        for (int i = 0; i < FastPairs.Count; ++i)
        {
            var impulse = FastPairs.ImpulseOf(i, out var pair, out var friction);
            if (impulse > 0)
                Simulation.Events.AddBounce(pair, impulse, friction);
            else if (FastPairs.HasPassed(i))
                Simulation.Events.AddPassed(pair);
        }
        if (Simulation.Events.EndSolve(ref Pairs))
            World.LeaveUnread(tellPersisting);
    }
}
