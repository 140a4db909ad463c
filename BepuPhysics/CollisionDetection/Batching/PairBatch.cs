using System.Numerics;
using System.Runtime.CompilerServices;
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

/// <summary>What is written to a lane for a pair, besides its shapes.</summary>
/// <remarks>
/// Refers to the poses wherever they are: an argument that a caller passed in registers is in memory by halves, and to copy it as a whole
/// would wait for these.
/// </remarks>
readonly ref struct PairInput
{
    public readonly ref readonly Quaternion OrientationA;
    public readonly ref readonly Quaternion OrientationB;
    /// <summary>Position of the caller's B less that of its A.</summary>
    public readonly ref readonly Vector3 OffsetB;
    public readonly float SpeculativeMargin;
    public readonly int PairId;
    /// <summary>Whether the caller's A is B here, because the task has the types in the other order.</summary>
    public readonly bool Flipped;
    /// <summary>Reference to the pair's history (<see cref="PairHistory.GetReference"/>); <see cref="NoHistory"/> where it has none.</summary>
    public readonly int History;

    /// <summary>Index that no history has.</summary>
    public const int NoHistory = -1;

    /// <summary>Brings the poses into the order of the task; the offset is turned where it is written.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public PairInput(in Vector3 offsetB, in Quaternion orientationA, in Quaternion orientationB, float speculativeMargin, int pairId,
        bool flipped, int history)
    {
        OffsetB = ref offsetB;
        OrientationA = ref flipped ? ref orientationB : ref orientationA;
        OrientationB = ref flipped ? ref orientationA : ref orientationB;
        SpeculativeMargin = speculativeMargin;
        PairId = pairId;
        Flipped = flipped;
        History = history;
    }
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
