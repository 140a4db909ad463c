namespace BepuPhysics;

/// <summary>The bodies of a contact constraint, which are awake: one, or two.</summary>
/// <param name="SlotA">Slot of the first body's handle.</param>
/// <param name="ReferenceA">How the constraint refers to it (<see cref="Constraints.EncodedBody"/>).</param>
/// <param name="SlotB">Slot of the second body's handle; means nothing where there is none.</param>
/// <param name="ReferenceB">How the constraint refers to it; negative where there is none.</param>
readonly record struct ContactEnds(int SlotA, int ReferenceA, int SlotB, int ReferenceB)
{
    /// <summary>Number of bodies.</summary>
    public int Count => ReferenceB < 0 ? 1 : 2;
}
