namespace BepuPhysics.CollisionDetection;

// Bounces come before the substep that they fall in: a body that is hit at a time t within it, and gains the velocity c, is moved back by t c, and so is at
// the end where it would be. But where the solver then takes that velocity away again, as from a plate that lies on a floor and is shot at, what it was moved
// back by is left over: the plate was a metre above the floor, at rest. What the solver adds, s, comes from the time t on too: so the body is moved by -t s.
sealed unsafe partial class FastPairs
{
    // Of the bodies that are watched, nobody has been hit.
    void ForgetStrikes()
    {
        ref var strikes = ref narrowPhase.Restitution.Strikes;
        if (strikes.Count < Bodies.ActiveSet.Count)
        {
            if (!strikes.Span.Allocated)
                strikes = new(Bodies.ActiveSet.Count, pool);
            strikes.EnsureCapacity(Bodies.ActiveSet.Count, pool);
            strikes.Count = Bodies.ActiveSet.Count;
        }
        for (int i = 0; i < movers.Count; ++i)
            strikes[movers[i].Index] = default;
    }

    void PutBack(in FastBody mover)
    {
        ref var place = ref narrowPhase.Restitution.Strikes[mover.Index];
        var strike = place;
        // Those of the next substep begin anew, also after one that moved nothing back: at its beginning, or before it.
        place = default;
        if (!(strike.Time > 0))
            return;
        ref var motion = ref Bodies.ActiveSet.MotionStates[mover.Index];
        // Without what acceleration adds in the next substep, which is there already.
        var solved = new DoubleVector3(motion.Velocity.Linear - mover.Velocity.Linear - strike.Change) - mover.FreeChange;
        var way = solved * -strike.Time;
        // Less is seen by the sweeps, and by the contacts of the next step.
        if (!(way.Length > mover.UnforeseenSpeed * stepDt))
            return;
        ref var origin = ref Bodies.ActiveSet.Origins[mover.Index].Position;
        origin += way.ToSingle();
        motion.Pose.Position = origin + Bodies.ActiveSet.Displacements[mover.Index].Linear;
    }
}
