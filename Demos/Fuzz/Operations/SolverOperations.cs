using System;
using BepuPhysics;

namespace Demos.Fuzz.Operations;

/// <summary>Settings of the solver and of a simulation.</summary>
static class SolverOperations
{
    public static FuzzOperation[] All { get; } =
    [
        new("Solver.VelocityIterationCount", 2, w => w.Simulation.Solver.VelocityIterationCount = Few(w)),
        new("Solver.SubstepCount", 2, w => w.Simulation.Solver.SubstepCount = Few(w)),
        new("Solver.RelaxationIterationCount", 2, w => w.Simulation.Solver.RelaxationIterationCount = Few(w)),
        new("Solver.LoadPath", 2, w => w.Simulation.Solver.LoadPath = Mode(w)),
        new("Solver.DirectJoints", 2, w => w.Simulation.Solver.DirectJoints = JointMode(w)),
        new("Solver.StopsImpacts", 2, w => w.Simulation.Solver.StopsImpacts = w.Random.Percent(50)),
        new("Solver.ClosesGapsSlowly", 2, w => w.Simulation.Solver.ClosesGapsSlowly = w.Random.Percent(50)),
        new("Solver.ContactFrequency", 2, w => w.Simulation.Solver.ContactFrequency = w.Random.Of((ReadOnlySpan<float>)[0, 0, 30, 15, 1e-3f, -1, float.NaN])),
        new("Solver.Governor", 2, Govern),
        new("Solver.MinimumCapacityPerTypeBatch", 2, w => w.Simulation.Solver.MinimumCapacityPerTypeBatch = w.AnyCount()),
        new("Solver.VelocityIterationScheduler", 2, Schedule),
        new("Simulation.Deterministic", 1, w => w.Simulation.Deterministic = w.Random.Percent(50)),
        new("SolveDescription", 1, w => _ = new SolveDescription(Few(w), Few(w), w.Random.Count()) { RelaxationIterationCount = Few(w) }),
        new("SolveDescription of a list", 1, w => _ = new SolveDescription([Few(w), Few(w)])),
    ];

    // Steps must stay short.
    static int Few(FuzzWorld w)
    {
        int count = w.Random.Percent(80) ? w.Random.Below(5) : w.Random.Of((ReadOnlySpan<int>)[-1, int.MinValue, 7]);
        w.Tell($"{count}");
        return count;
    }

    static LoadPathMode Mode(FuzzWorld w)
    {
        var mode = w.Random.Percent(90) ? (LoadPathMode)w.Random.Below(3) : (LoadPathMode)w.Random.Of((ReadOnlySpan<int>)[-1, 3, int.MaxValue]);
        w.Tell($"{mode}");
        return mode;
    }

    static DirectJointsMode JointMode(FuzzWorld w)
    {
        var mode = (DirectJointsMode)(w.Random.Percent(90) ? w.Random.Below(3) : w.Random.Of((ReadOnlySpan<int>)[-1, 3, int.MaxValue]));
        w.Tell($"{mode}");
        return mode;
    }

    static void Govern(FuzzWorld w)
    {
        if (w.Random.Percent(30))
        {
            w.Tell($"{null}");
            w.Simulation.Solver.Governor = null;
            return;
        }
        var target = w.Random.Percent(80) ? 0.001f : w.Random.Of((ReadOnlySpan<float>)[0, -1, float.NaN, float.PositiveInfinity, 1e-30f, 1e30f]);
        w.Tell($"{target}");
        w.Simulation.Solver.Governor = new() { TargetError = target, LeastSubstepCount = Few(w), GreatestSubstepCount = Few(w) };
    }

    static void Schedule(FuzzWorld w)
    {
        int count = w.Has(FuzzScope.BadCallbacks) ? Few(w) : w.Random.Below(3);
        w.Simulation.Solver.VelocityIterationScheduler = w.Random.Percent(50) ? null : substep => substep == 1 ? 2 : count;
    }
}
