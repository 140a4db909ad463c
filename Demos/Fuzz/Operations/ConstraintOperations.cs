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
        new("Solver.CountConstraints", 1, w => w.Simulation.Solver.CountConstraints()),
    ];

    struct Sum : IForEach<float>
    {
        float sum;

        public void LoopBody(float i) => sum += i;
    }
}
