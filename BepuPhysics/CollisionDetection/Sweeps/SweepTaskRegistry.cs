using BepuPhysics.Collidables;

namespace BepuPhysics.CollisionDetection;

/// <summary>Knows which task sweeps which pair of shape types.</summary>
public sealed class SweepTaskRegistry
{
    const int TypeSpan = HalfSpace.Id + 1;
    readonly SweepTask?[] tasks = new SweepTask?[TypeSpan * TypeSpan];

    /// <summary>Creates a registry with a task for each pair of the library's shape types but two half-spaces.</summary>
    public SweepTaskRegistry()
    {
        for (int a = 0; a < TypeSpan; ++a)
        {
            for (int b = a; b < TypeSpan; ++b)
            {
                if (SweepPairs.IsKnown(a) && SweepPairs.IsKnown(b) && !(a == HalfSpace.Id && b == HalfSpace.Id))
                    tasks[a * TypeSpan + b] = tasks[b * TypeSpan + a] = new SweepTask(a, b);
            }
        }
    }

    /// <summary>Finds the task of a pair of shape types, in any order.</summary>
    /// <param name="topLevelTypeA">Type id of one shape.</param>
    /// <param name="topLevelTypeB">Type id of the other shape.</param>
    /// <returns>The task; null where there is none.</returns>
    public SweepTask? GetTask(int topLevelTypeA, int topLevelTypeB) =>
        (uint)topLevelTypeA < TypeSpan && (uint)topLevelTypeB < TypeSpan ? tasks[topLevelTypeA * TypeSpan + topLevelTypeB] : null;

    /// <summary>Finds the task of a pair of shape types, in any order.</summary>
    /// <typeparam name="TShapeA">Type of one shape.</typeparam>
    /// <typeparam name="TShapeB">Type of the other shape.</typeparam>
    /// <returns>The task; null where there is none.</returns>
    public SweepTask? GetTask<TShapeA, TShapeB>() where TShapeA : unmanaged, IShape where TShapeB : unmanaged, IShape =>
        GetTask(TShapeA.TypeId, TShapeB.TypeId);
}
