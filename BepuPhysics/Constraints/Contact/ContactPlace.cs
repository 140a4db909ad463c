using System.Runtime.CompilerServices;

namespace BepuPhysics.Constraints.Contact;

/// <summary>Where the numbers of a contact constraint are, and which bodies it connects: as long as no constraint comes or goes.</summary>
readonly unsafe struct ContactPlace
{
    /// <summary>The first float of the description; what follows lies a vector apart.</summary>
    internal readonly float* Prestep;
    /// <summary>The first of the impulses; what follows lies a vector apart.</summary>
    internal readonly float* Impulses;
    /// <summary>Index of A in the active set.</summary>
    internal readonly int A;
    /// <summary>Index of B; -1 for a static.</summary>
    internal readonly int B;
    /// <summary>Whether nothing moves B.</summary>
    internal readonly bool IsFixedB;

    internal ContactPlace(Solver solver, ConstraintHandle constraint)
        : this(solver, ref solver.TypeBatchAt(solver.Locations[constraint.Slot]), solver.Locations[constraint.Slot].IndexInTypeBatch)
    { }

    internal ContactPlace(Solver solver, ref TypeBatch typeBatch, int indexInTypeBatch)
    {
        var processor = solver.Processor(typeBatch.TypeId);
        Prestep = (float*)Unsafe.AsPointer(ref processor.PrestepFloat(ref typeBatch, indexInTypeBatch, 0));
        Impulses = (float*)Unsafe.AsPointer(ref processor.Impulse(ref typeBatch, indexInTypeBatch, 0));
        A = processor.BodyReference(ref typeBatch, indexInTypeBatch, 0) & EncodedBody.IndexMask;
        B = -1;
        IsFixedB = true;
        if (processor.BodiesPerConstraint > 1)
        {
            var reference = processor.BodyReference(ref typeBatch, indexInTypeBatch, 1);
            B = reference & EncodedBody.IndexMask;
            IsFixedB = (reference & EncodedBody.KinematicFlag) != 0;
        }
    }
}
