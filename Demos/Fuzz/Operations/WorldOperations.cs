using BepuPhysics;
using BepuUtilities.Diagnostics;

namespace Demos.Fuzz.Operations;

/// <summary>Calls to a simulation as a whole.</summary>
static class WorldOperations
{
    public static FuzzOperation[] All { get; } =
    [
        new("Simulation.Clear", 1, w => w.Simulation.Clear()),
        new("Simulation.Validate", 2, Validate),
        new("Simulation.WarmUp", 1, w => w.Simulation.WarmUp(w.AnyDispatcher())),
        new("Simulation.ShiftOrigin", 2, w => w.Simulation.ShiftOrigin(w.Random.Spoil(w.Random.Vector(w.Random.Magnitude(1e-3f, 1e6f)), 10))),
        new("Simulation.EnsureCapacity", 2, w => w.Simulation.EnsureCapacity(Sizes(w))),
        new("BroadPhase.EnsureCapacity", 1, w => w.Simulation.BroadPhase.EnsureCapacity(w.AnyCount(), w.AnyCount())),
        new("BroadPhase.Resize", 2, w => w.Simulation.BroadPhase.Resize(w.AnyCount(), w.AnyCount())),
        new("BroadPhase.Update", 2, w => w.Simulation.BroadPhase.Update(w.AnyDispatcher())),
        new("Simulation.Create", 1, w =>
        {
            using var other = Simulation.Create(w.Pool, new FuzzNarrowPhaseCallbacks(w.Plan),
                new FuzzPoseIntegratorCallbacks(w.Plan, AngularIntegrationMode.ConserveMomentum), new SolveDescription(1, 1), null, Sizes(w));
            other.Timestep(0.01f);
        }),
    ];

    // It may say that there is a number that was written through a reference. What else it may have to say then is found after the call.
    static void Validate(FuzzWorld w)
    {
        try
        {
            w.Simulation.Validate();
        }
        catch (PhysicsInvariantException) when (w.HasUnsoundNumbers)
        {
        }
    }

    static SimulationAllocationSizes Sizes(FuzzWorld w) =>
        new(w.AnyCount(), w.AnyCount(), w.AnyCount(), w.AnyCount(), w.AnyCount(), w.AnyCount(), w.AnyCount());
}
