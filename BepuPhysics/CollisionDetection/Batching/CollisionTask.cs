using System;
using System.Numerics;
using BepuPhysics.Collidables;

namespace BepuPhysics.CollisionDetection;

/// <summary>Tests batches of pairs of two shape types, or expands them into pairs of their children.</summary>
/// <remarks>
/// Tests of one's own are pair testers, in a
/// <see cref="ConvexCollisionTask{TShapeA, TShapeWideA, TShapeB, TShapeWideB, TContacts, TTester}"/>.
/// </remarks>
public abstract unsafe class CollisionTask
{
    private protected CollisionTask(int shapeTypeIndexA, int shapeTypeIndexB, string description, bool keepsHistories, bool expands = false)
    {
        KeepsHistories = keepsHistories;
        Expands = expands;
        ShapeTypeIndexA = shapeTypeIndexA;
        ShapeTypeIndexB = shapeTypeIndexB;
        Description = description;
    }

    // Not in the generic classes, where it would be compiled for each pair of shapes.
    private protected static string Describe(Type shapeA, Type shapeB) => $"{NameOf(shapeA)} and {NameOf(shapeB)}";

    // A shape of a game's own by its own name.
    static string NameOf(Type shape) => shape.IsGenericType && shape.GetGenericTypeDefinition() == typeof(HomogeneousContainer<,,>)
        ? shape.GenericTypeArguments[0].Name
        : shape.Name;

    private protected void CheckOrder(Type shapeA, Type shapeB)
    {
        if (ShapeTypeIndexA > ShapeTypeIndexB)
            throw new InvalidOperationException(
                $"Name {shapeB.Name} (type id {ShapeTypeIndexB}) before {shapeA.Name} (type id {ShapeTypeIndexA}).");
    }

    /// <summary>Type id of the first shape; no greater than that of the second, unless one of the two is a game's own.</summary>
    public int ShapeTypeIndexA { get; }

    /// <summary>Type id of the second shape.</summary>
    public int ShapeTypeIndexB { get; }

    /// <summary>Names of the two shape types.</summary>
    public string Description { get; }

    /// <inheritdoc/>
    public sealed override string ToString() => Description;

    /// <summary>Whether the test of a pair uses what the last one found.</summary>
    internal bool KeepsHistories { get; }

    /// <summary>Whether pairs are expanded into pairs of children, as an <see cref="ExpandingTask"/> does, and not tested.</summary>
    internal bool Expands { get; }

    /// <summary>Size of the memory of a batch, bytes.</summary>
    internal abstract int BatchByteCount { get; }

    // Poses are passed one by one and by reference: they are copied once, by components, and a struct of references has to be cleared first.

    /// <summary>Writes a pair of shapes that are known to exist into the next lane of a batch that has room.</summary>
    /// <param name="batch">The batch.</param>
    /// <param name="shapes">Shapes that the indices refer to.</param>
    /// <param name="shapeIndexA">Shape of the task's first type.</param>
    /// <param name="shapeIndexB">Shape of the task's second type.</param>
    /// <param name="offsetB">Position of the caller's B less that of its A; turned where it is written, if the pair is flipped.</param>
    /// <param name="orientationA">Rotation of the shape of the task's first type.</param>
    /// <param name="orientationB">Rotation of the shape of the task's second type.</param>
    /// <param name="pair">What else there is to the pair.</param>
    internal abstract void Write(ref PairBatch batch, Shapes shapes, int shapeIndexA, int shapeIndexB, in Vector3 offsetB,
        in Quaternion orientationA, in Quaternion orientationB, in PairInput pair);

    /// <summary>As <see cref="Write"/>, unless a shape does not exist.</summary>
    /// <returns>Whether both shapes exist.</returns>
    internal bool TryWrite(ref PairBatch batch, Shapes shapes, int shapeIndexA, int shapeIndexB, in Vector3 offsetB,
        in Quaternion orientationA, in Quaternion orientationB, in PairInput pair)
    {
        if (!shapes.Holds(ShapeTypeIndexA, shapeIndexA) || !shapes.Holds(ShapeTypeIndexB, shapeIndexB))
            return false;
        Write(ref batch, shapes, shapeIndexA, shapeIndexB, offsetB, orientationA, orientationB, pair);
        return true;
    }

    /// <summary>Writes a pair of shapes that are anywhere into the next lane of a batch that has room.</summary>
    internal abstract void WriteDirectly(ref PairBatch batch, void* shapeA, void* shapeB, in Vector3 offsetB, in Quaternion orientationA,
        in Quaternion orientationB, in PairInput pair);

    /// <summary>Tests all pairs of a batch, hands the results to the callbacks and empties the batch.</summary>
    /// <param name="batch">The pairs.</param>
    /// <param name="histories">Histories that the pairs' indices refer to.</param>
    /// <param name="callbacks">Receives the results.</param>
    internal abstract void Execute<TCallbacks>(ref PairBatch batch, PairHistory* histories, ref TCallbacks callbacks)
        where TCallbacks : struct, ICollisionCallbacks;
}
