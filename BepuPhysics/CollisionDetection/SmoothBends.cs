using System;
using System.Numerics;
using BepuPhysics.Constraints;
using BepuUtilities;
using BepuUtilities.Collections;
using BepuUtilities.Memory;

namespace BepuPhysics.CollisionDetection;

/// <summary>A smooth surface that bends up below what goes along it.</summary>
struct SmoothBend
{
    /// <summary>What is round.</summary>
    public BodyHandle Body;
    /// <summary>Normal of the plane that holds it in this step.</summary>
    public Vector3 Normal;
    /// <summary>What of its squared speed it has across that plane, and had along the last one, m2/s2.</summary>
    public float Across;
    /// <summary>Its squared speed along the plane, m2/s2.</summary>
    public float Along;
    /// <summary>Its energy before constraints of a substep, and what these have taken of it until now: twice that over its mass, m2/s2.</summary>
    public float Before, Taken;
}

/// <summary>Gives back what goes along smooth bends the speed that planes take as they turn below it.</summary>
// A plane stops what comes towards it, and each step has another: by itself that takes the part p^2 / 2 of the speed at a turn by p, on any surface. But
// the force of a smooth one is across the way, and takes nothing. It has to be there, as friction is a part of it, and games ask for it: so contacts stop what
// comes towards the plane as ever, and what that took is given back along it when the last substep is solved. Never more than constraints have taken.
sealed class SmoothBends(Solver solver, Bodies bodies, BufferPool pool) : ISolverStage
{
    QuickList<SmoothBend> bends;

    bool ISolverStage.ChangesVelocities => false;

    /// <summary>Forgets the bends of a step.</summary>
    public void Clear() => bends.DisposeIfTaken(pool);

    /// <summary>Adds a bend of this step, in an order that does not depend on threads.</summary>
    public void Add(in SmoothBend bend)
    {
        if (!bends.Span.Allocated)
            bends = new QuickList<SmoothBend>(16, pool);
        bends.Add(bend, pool);
    }

    /// <summary>Forgets all memory, which the pool has given back to the system.</summary>
    public void Abandon() => bends = default;

    bool ISolverStage.BeginStep() => bends.Count > 0;

    int ISolverStage.GetBlockCount(SolverPoint point) => point is SolverPoint.BeforeWarmStart or SolverPoint.AfterSolve ? 1 : 0;

    void ISolverStage.Execute(SolverPoint point, in Substep substep, int block)
    {
        var given = 0f;
        for (int i = 0; i < bends.Count; ++i)
        {
            ref var bend = ref bends[i];
            // Where a game calls the stages of a step by itself, it may have removed the body since, or put it to sleep.
            if (!bodies.BodyExists(bend.Body) || bodies.Locations[bend.Body.Slot].SetIndex != 0)
                continue;
            var index = bodies.Locations[bend.Body.Slot].Index;
            ref var motion = ref bodies.Awake.MotionStates[index];
            var energy = Energy(motion, bodies.Awake.LocalInertias[index]);
            if (point == SolverPoint.BeforeWarmStart)
            {
                bend.Before = energy;
                continue;
            }
            bend.Taken += bend.Before - energy;
            if (substep.Index < solver.LastSubstepCount - 1)
                continue;
            // Bends of one body follow one another.
            if (i == 0 || bends[i - 1].Body != bend.Body)
                given = 0;
            given += GiveBack(bend, bend.Taken - given, ref motion.Velocity.Linear);
        }
    }

    void ISolverStage.EndStep() => Clear();

    // Twice the kinetic energy over the mass, m2/s2. What cannot be turned has no part in it.
    static float Energy(in MotionState motion, in BodyInertia inertia)
    {
        var linear = Exact.LengthSquared(motion.Velocity.Linear);
        var turn = Exact.RotateByInverse(motion.Velocity.Angular, motion.Pose.Orientation);
        var angular = Exact.Dot(turn, Symmetric3x3.Invert(inertia.InverseInertiaTensor) * turn) * inertia.InverseMass;
        return angular > 0 && float.IsFinite(angular) ? linear + angular : linear;
    }

    // Returns what it gives, m2/s2.
    static float GiveBack(in SmoothBend bend, float most, ref Vector3 velocity)
    {
        var along = velocity - bend.Normal * Exact.Dot(velocity, bend.Normal);
        var squared = Exact.LengthSquared(along);
        // What is slower now would have lost as much less.
        var given = MathHelper.Min(most, bend.Across * MathHelper.Min(1, squared / bend.Along));
        if (!(given > 0) || !(given < squared))
            return 0;
        velocity += along * (MathF.Sqrt(1 + given / squared) - 1);
        return given;
    }
}
