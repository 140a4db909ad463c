using System.Numerics;
using BepuUtilities.Memory;

namespace BepuPhysics.Constraints;

/// <summary>Constraints of one type in one batch, as an array of bundles of structs of vectors.</summary>
/// <remarks>
/// Number f of constraint i is float number (bundle * floats + f) * lanes + lane of its buffer, with bundle = i / lanes and
/// lane = i % lanes: the law by which every wide struct repeats its scalar one.
/// </remarks>
public struct TypeBatch
{
    /// <summary>Id of the constraint type.</summary>
    public int TypeId;
    /// <summary>Number of constraints.</summary>
    public int ConstraintCount;
    /// <summary>Encoded references to the bodies of each constraint (<see cref="BodyReferences"/>).</summary>
    public Buffer<int> BodyReferences;
    /// <summary>Descriptions.</summary>
    public Buffer<float> Prestep;
    /// <summary>Accumulated impulses.</summary>
    public Buffer<float> AccumulatedImpulses;
    /// <summary>Handle of each constraint.</summary>
    public Buffer<ConstraintHandle> IndexToHandle;
    /// <summary>What is left to be done to descriptions and impulses, while that is deferred (Solver.Deferral.cs).</summary>
    internal PendingColumns Pending;

    /// <summary>Number of bundles in use.</summary>
    public readonly int BundleCount => (ConstraintCount + Vector<float>.Count - 1) / Vector<float>.Count;
}

/// <summary>How constraints refer to bodies: the index in the active set, with flags.</summary>
static class EncodedBody
{
    /// <summary>An unused lane.</summary>
    internal const int Empty = -1;
    /// <summary>Set for a kinematic body: it is read by many constraints of a batch at once and written by none.</summary>
    internal const int KinematicFlag = 1 << 30;
    /// <summary>Set, in joints that make hubs, for a body that is one (Solver.Hubs.cs).</summary>
    internal const int HubFlag = 1 << 29;
    /// <summary>Set, in the first reference of a joint that holds points, where its correction may turn a body far (JointTurn.cs); anew in each step.</summary>
    internal const int TurnFlag = 1 << 28;
    /// <summary>Least size yet, in the first reference of a joint that holds points, of a gap that it was added with and closes (JointGap.cs).</summary>
    internal const int GapMask = TurnFlag - (1 << GapShift);
    /// <summary>Lowest bit of that.</summary>
    internal const int GapShift = HandleLayout.SlotBits;
    /// <summary>Bits of the body index.</summary>
    internal const int IndexMask = (1 << HandleLayout.SlotBits) - 1;
}
