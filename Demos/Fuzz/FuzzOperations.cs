using System;
using Demos.Fuzz.Operations;

namespace Demos.Fuzz;

/// <summary>All calls that are made. A new one is a line in a list of its group; a new group is a line here.</summary>
static class FuzzOperations
{
    public static FuzzOperation[] All { get; } =
    [
        .. BodyOperations.All,
        .. StaticOperations.All,
        .. ShapeOperations.All,
        .. LevelOperations.All,
        .. ConstraintOperations.All,
        .. SolverOperations.All,
        .. QueryOperations.All,
        .. StepOperations.All,
        .. WorldOperations.All,
        .. SnapshotOperations.All,
    ];

    static readonly int totalWeight = Sum();

    /// <summary>One of all, as often as its weight says.</summary>
    public static FuzzOperation Draw(FuzzRandom random)
    {
        int place = random.Below(totalWeight);
        foreach (FuzzOperation operation in All)
        {
            place -= operation.Weight;
            if (place < 0)
                return operation;
        }
        throw new InvalidOperationException("weights do not add up");
    }

    static int Sum()
    {
        int sum = 0;
        foreach (FuzzOperation operation in All)
            sum += operation.Weight;
        return sum;
    }
}
