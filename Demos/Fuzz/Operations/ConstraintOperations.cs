using BepuPhysics;
using BepuUtilities;

namespace Demos.Fuzz.Operations;

/// <summary>Calls to constraints of all types.</summary>
static class ConstraintOperations
{
    public static FuzzOperation[] All { get; } =
    [
        .. JointOperations.All,
        new("Solver.Remove", 14, w => w.Simulation.Solver.Remove(w.AnyConstraint())),
        new("Solver.ConstraintExists", 1, w => w.Simulation.Solver.ConstraintExists(w.AnyConstraint())),
        new("Solver.GetAccumulatedImpulseMagnitude", 2, w => w.Simulation.Solver.GetAccumulatedImpulseMagnitude(w.AnyConstraint())),
        new("Solver.GetAccumulatedImpulseMagnitudeSquared", 1, w => w.Simulation.Solver.GetAccumulatedImpulseMagnitudeSquared(w.AnyConstraint())),
        new("Solver.EnumerateAccumulatedImpulses", 2, w =>
        {
            var sum = new Sum();
            w.Simulation.Solver.EnumerateAccumulatedImpulses(w.AnyConstraint(), ref sum);
        }),
        new("Solver.GetConstraintReference", 2, w => w.Simulation.Solver.GetConstraintReference(w.AnyConstraint())),
        new("Solver.IsEnabled", 1, w => w.Simulation.Solver.IsEnabled(w.AnyConstraint())),
        new("Solver.SetEnabled", 8, w => w.Simulation.Solver.SetEnabled(w.AnyConstraint(), w.Random.Percent(50))),
        new("Solver.GetCollideConnected", 1, w => w.Simulation.Solver.GetCollideConnected(w.AnyConstraint())),
        new("Solver.SetCollideConnected", 6, w => w.Simulation.Solver.SetCollideConnected(w.AnyConstraint(), w.Random.Percent(50))),
        new("Solver.GetBreakThreshold", 1, w => w.Simulation.Solver.GetBreakThreshold(w.AnyConstraint())),
        new("Solver.SetBreakThreshold", 6, w => w.Simulation.Solver.SetBreakThreshold(w.AnyConstraint(), w.Random.Spoil(
            w.Random.Percent(20) ? BreakThreshold.Unbreakable : new BreakThreshold(w.Random.Magnitude(0.01f, 1000), w.Random.Magnitude(0.01f, 1000)), 10))),
        new("Solver.GetSeparation", 2, w => w.Simulation.Solver.GetSeparation(w.AnyConstraint())),
        new("Solver.CountConstraints", 1, w => w.Simulation.Solver.CountConstraints()),
    ];

    struct Sum : IForEach<float>
    {
        float sum;

        public void LoopBody(float i) => sum += i;
    }
}
