using BepuPhysics.Constraints;

namespace BepuPhysics;

// Joints that are added with a gap close it slowly (JointGap.cs). Bits of their first reference say so, all of them of one that is new; the first substep of
// a step keeps there how small a gap has been, and clears them where there is none, or another one.
public sealed unsafe partial class Solver
{
    /// <summary>Notes of a joint of the active set that it may have a gap.</summary>
    void MarkGap(in ConstraintLocation location)
    {
        var processor = Processor(location.TypeId);
        if (processor.ClosesGaps)
            processor.BodyReference(ref TypeBatchAt(location), location.IndexInTypeBatch, 0) |= EncodedBody.GapMask;
    }

    /// <summary>Whether a joint that is swept over may have one.</summary>
    bool HasGap(in ConstraintLocation location)
    {
        var processor = Processor(location.TypeId);
        return processor.ClosesGaps && (processor.BodyReference(ref TypeBatchAt(location), location.IndexInTypeBatch, 0) & EncodedBody.GapMask) != 0;
    }
}
