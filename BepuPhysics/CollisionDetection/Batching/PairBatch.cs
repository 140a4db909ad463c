using System.Numerics;
using BepuUtilities.Memory;

namespace BepuPhysics.CollisionDetection;

/// <summary>Pairs of one ordered pair of shape types that wait to be tested.</summary>
struct PairBatch
{
    /// <summary>Bundles in the layout of the task; taken from the pool with the first pair.</summary>
    public Buffer<byte> Bundles;
    /// <summary>Number of pairs.</summary>
    public int Count;

    /// <summary>Bundles of a batch: enough that dispatching it costs little, few enough to stay in the first cache level.</summary>
    public const int BundleCapacity = 4;

    /// <summary>Pairs that a batch holds.</summary>
    public static int Capacity => BundleCapacity * Vector<float>.Count;
}

/// <summary>What is written to a lane for a pair, besides its shapes and poses.</summary>
struct PairInput(float speculativeMargin, int pairId, bool flipped, int history)
{
    public float SpeculativeMargin = speculativeMargin;
    public int PairId = pairId;
    /// <summary>All bits set where the caller's A is B here, because the task has the types in the other order.</summary>
    public int FlipMask = flipped ? -1 : 0;
    /// <summary>Reference to the pair's history (<see cref="PairHistory.GetReference"/>); <see cref="NoHistory"/> where it has none.</summary>
    public int History = history;

    /// <summary>Reference that no history has.</summary>
    public const int NoHistory = -1;
}

/// <summary>A bundle of pairs of a batch.</summary>
struct PairBundle<TShapeWideA, TShapeWideB> where TShapeWideA : unmanaged where TShapeWideB : unmanaged
{
    public TShapeWideA A;
    public TShapeWideB B;
    public PairPoseWide Pose;
    public Vector<float> SpeculativeMargin;
    public Vector<int> PairIds;
    /// <summary>All bits set where the caller's A is B here.</summary>
    public Vector<int> FlipMask;
}
