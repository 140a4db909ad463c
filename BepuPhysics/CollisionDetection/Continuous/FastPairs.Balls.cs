using System;

namespace BepuPhysics.CollisionDetection;

// Pairs that need no sweep: balls, and those that stay apart on their foreseen ways.
sealed unsafe partial class FastPairs
{
    // Whether it is known until when pairs stay apart: after the first sweep of all in a step.
    bool knowsApart;

    // Of the foreseen ways a body keeps to a part of its inner radius, or it is seen to be thrown aside; and of what acceleration adds to its velocity in each
    // substep it is known after the first one.
    double ApartUntil(in FastPair pair, double dt)
    {
        var spare = 0.0;
        PlaceForeseen(pair.A, pair.PoseA, dt, out var linearA, out var positionA, ref spare);
        PlaceForeseen(pair.B, pair.PoseB, dt, out var linearB, out var positionB, ref spare);
        return pair.Balls.Exists
            ? pair.Balls.ApartUntil(positionB - positionA, linearA, linearB, spare)
            : pair.Gate.ApartUntil(positionA, positionB, linearA, linearB, stepDt, spare);
    }

    void PlaceForeseen(int body, in RigidPose still, double dt, out DoubleVector3 linear, out DoubleVector3 position, ref double spare)
    {
        PlaceCentre(body, still, 0, out linear, out position);
        if (body < 0)
            return;
        ref var mover = ref movers[body];
        linear = mover.ForeseenLinear;
        var substeps = Math.Round(stepDt / dt);
        spare += (mover.UnforeseenSpeed + mover.FreeChange.Length * substeps) * stepDt;
    }

    // Whoever is thrown aside has its pairs looked at again.
    void LookAtPairsOf(int body)
    {
        for (int i = firstPairs[body]; i >= 0; i = pairs[i].NextOf(body))
            pairs[i].ApartUntil = 0;
    }

    // The same from the beginning of the substep, where most are far from each other: nothing but that is found out, of two that move.
    bool MayMeetOfBalls(in FastPair pair, double dt)
    {
        if (pair.A < 0 || pair.B < 0)
            return true;
        ref var a = ref movers[pair.A];
        ref var b = ref movers[pair.B];
        return pair.Balls.MayMeet(b.Position - a.Position, a.Linear - b.Linear, dt, TouchingPart * pair.Inner);
    }

    void FindOfBalls(ref FastPair pair, double from, double dt)
    {
        PlaceCentre(pair.A, pair.PoseA, from, out var linearA, out var positionA);
        PlaceCentre(pair.B, pair.PoseB, from, out var linearB, out var positionB);
        var offsetB = positionB - positionA;
        ++pair.RoundCount;
        foreach (var part in pair.IsLate ? LateSkinParts : SkinParts)
        {
            if (!pair.Balls.TryFind(part, offsetB, linearA, linearB, TouchingPart * pair.Inner, out var time))
                continue;
            if (!(time <= dt - from))
                return;
            pair.Time = from + time;
            pair.Balls.Touch(part, offsetB + (linearB - linearA) * time, out pair.Normal, out pair.ArmA, out pair.ArmB);
            return;
        }
    }
}
