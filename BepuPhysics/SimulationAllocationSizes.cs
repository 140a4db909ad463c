using System;
using BepuPhysics.Collidables;

namespace BepuPhysics;

/// <summary>How much room to make ahead of time; everything grows on demand.</summary>
/// <param name="bodies">Number of bodies.</param>
/// <param name="statics">Number of statics.</param>
/// <param name="islands">Number of islands that sleep.</param>
/// <param name="shapesPerType">Number of shapes of each type.</param>
/// <param name="constraints">Number of constraints, contacts included.</param>
/// <param name="constraintsPerTypeBatch">Number of constraints for which a new type batch has room.</param>
/// <param name="constraintCountPerBodyEstimate">Has no effect: constraints take no memory of bodies.</param>
public struct SimulationAllocationSizes(
    int bodies, int statics, int islands, int shapesPerType, int constraints, int constraintsPerTypeBatch, int constraintCountPerBodyEstimate)
{
    /// <summary>Number of bodies.</summary>
    public int Bodies = bodies;
    /// <summary>Number of statics.</summary>
    public int Statics = statics;
    /// <summary>Number of islands that sleep.</summary>
    public int Islands = islands;
    /// <summary>Number of shapes of each type.</summary>
    public int ShapesPerType = shapesPerType;
    /// <summary>Number of constraints, contacts included.</summary>
    public int Constraints = constraints;
    /// <summary>Number of constraints for which a new type batch has room.</summary>
    public int ConstraintsPerTypeBatch = constraintsPerTypeBatch;
    /// <summary>Has no effect: constraints take no memory of bodies. From 0 to a million.</summary>
    public int ConstraintCountPerBodyEstimate = constraintCountPerBodyEstimate;

    internal static SimulationAllocationSizes Default => new(4096, 4096, 0, 128, 16384, 256, 8);

    internal readonly void Validate()
    {
        ArgumentOutOfRangeException.ThrowIfNegative(Bodies);
        ArgumentOutOfRangeException.ThrowIfNegative(Statics);
        ArgumentOutOfRangeException.ThrowIfNegative(Islands);
        ArgumentOutOfRangeException.ThrowIfNegative(ShapesPerType);
        ArgumentOutOfRangeException.ThrowIfNegative(Constraints);
        ArgumentOutOfRangeException.ThrowIfNegative(ConstraintsPerTypeBatch);
        ArgumentOutOfRangeException.ThrowIfNegative(ConstraintCountPerBodyEstimate);
        ArgumentOutOfRangeException.ThrowIfGreaterThan(Bodies, BepuPhysics.Bodies.MaximumCount);
        ArgumentOutOfRangeException.ThrowIfGreaterThan(Statics, BepuPhysics.Statics.MaximumCount);
        ArgumentOutOfRangeException.ThrowIfGreaterThan(Constraints, Solver.MaximumCount);
        ArgumentOutOfRangeException.ThrowIfGreaterThan(ShapesPerType, TypedIndex.MaximumIndexCount);
        ArgumentOutOfRangeException.ThrowIfGreaterThan(ConstraintsPerTypeBatch, Solver.MaximumCapacityPerTypeBatch);
        ArgumentOutOfRangeException.ThrowIfGreaterThan(ConstraintCountPerBodyEstimate, BepuPhysics.Bodies.MaximumConstraintCapacity);
    }
}
