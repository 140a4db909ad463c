namespace BepuPhysics;

// What becomes of the constraints of bodies that had to be stopped.
public sealed unsafe partial class Solver
{
    /// <summary>Whether the last step changed velocities after it had moved the bodies for the last time.</summary>
    internal bool EndsWithVelocities => relaxationIterationCount > 0 || endsWithVelocities;

    /// <summary>Sets the accumulated impulses of a constraint that exists to zero.</summary>
    // Two workers may do so at once, for the two bodies of the constraint: both write zeros.
    internal void ForgetImpulses(ConstraintHandle handle)
    {
        ref var location = ref HandleToConstraint[handle.Value];
        ref var batch = ref TypeBatchAt(location);
        var processor = Processor(location.TypeId);
        for (int i = 0; i < processor.ImpulseFloats; ++i)
            processor.Impulse(ref batch, location.IndexInTypeBatch, i) = 0;
    }
}
