using System;
using System.Numerics;
using BepuPhysics.Collidables;
using BepuPhysics.Trees;
using BepuUtilities.Memory;

namespace BepuPhysics.CollisionDetection;

/// <summary>Checks of what a sweep is given.</summary>
static class SweepChecks
{
    /// <summary>Checks the shape that is asked about.</summary>
    /// <param name="shape">The shape.</param>
    /// <param name="shapes">Shapes that there are.</param>
    /// <param name="refusal">What is said of shapes of a type that cannot be asked about, behind the name of the type.</param>
    public static void Shape<TShape>(in TShape shape, Shapes shapes, string refusal) where TShape : unmanaged, IConvexShape
    {
        if (!ImpactCore.Exists(TShape.TypeId, shapes) || TShape.TypeId == HalfSpace.Id)
            ThrowShape(typeof(TShape), TShape.TypeId, refusal, nameof(shape));
        shape.Validate();
    }

    // Not in what is generic, where it would be compiled for each type.
    static void ThrowShape(Type type, int typeId, string refusal, string name)
    {
        var advice = typeId > ShapeLimits.LastTypeId
            ? " Shapes of a game's own can where their batch is a SupportShapeBatch, and one of them was added to the shapes of the simulation."
            : "";
        throw new ArgumentException($"Shapes of type {type.Name} {refusal}.{advice}", name);
    }

    public static void Offset(Vector3 offset) => BodyChecks.Position(offset * .5f, nameof(offset));

    /// <summary>Checks how long a sweep is, and where its memory comes from.</summary>
    public static void Length(float maximumT, BufferPool pool)
    {
        BoxMath.RequireLength(maximumT);
        ArgumentNullException.ThrowIfNull(pool);
    }

    /// <summary>Checks how exact a sweep is to be. Infinite times are what some divide by a speed of zero.</summary>
    public static ImpactAccuracy Accuracy(float minimumProgression, float convergenceThreshold, int maximumIterationCount)
    {
        BoxMath.RequireLength(minimumProgression);
        BoxMath.RequireLength(convergenceThreshold);
        if (maximumIterationCount < 1)
        {
            throw new ArgumentOutOfRangeException(
                nameof(maximumIterationCount), maximumIterationCount, "There must be one round at least.");
        }
        return new(minimumProgression, convergenceThreshold, maximumIterationCount);
    }
}
