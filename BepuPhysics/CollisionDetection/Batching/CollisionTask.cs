using BepuPhysics.Collidables;

namespace BepuPhysics.CollisionDetection;

/// <summary>Tests batches of pairs of two shape types. Add one to a registry as <see cref="ConvexCollisionTask{TShapeA, TShapeWideA, TShapeB, TShapeWideB, TContacts, TTester}"/>.</summary>
public abstract unsafe class CollisionTask
{
    private protected CollisionTask(int shapeTypeIndexA, int shapeTypeIndexB, string description)
    {
        ShapeTypeIndexA = shapeTypeIndexA;
        ShapeTypeIndexB = shapeTypeIndexB;
        Description = description;
    }

    /// <summary>Type id of the first shape, no greater than that of the second.</summary>
    public int ShapeTypeIndexA { get; }

    /// <summary>Type id of the second shape.</summary>
    public int ShapeTypeIndexB { get; }

    /// <summary>Names of the two shape types.</summary>
    public string Description { get; }

    /// <inheritdoc/>
    public sealed override string ToString() => Description;

    /// <summary>Size of the memory of a batch, bytes.</summary>
    internal abstract int BatchByteCount { get; }

    /// <summary>Writes a pair of shapes that are known to exist into the next lane of a batch that has room.</summary>
    internal abstract void Write(ref PairBatch batch, Shapes shapes, int shapeIndexA, int shapeIndexB, in PairInput pair);

    /// <summary>Writes a pair of shapes into the next lane of a batch that has room.</summary>
    internal abstract void Write(ref PairBatch batch, void* shapeA, void* shapeB, in PairInput pair);

    /// <summary>Tests all pairs of a batch, hands the results to the callbacks and empties the batch.</summary>
    internal abstract void Execute<TCallbacks>(ref PairBatch batch, ref TCallbacks callbacks) where TCallbacks : struct, ICollisionCallbacks;
}
