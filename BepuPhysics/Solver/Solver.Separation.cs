using System;
using System.Numerics;
using BepuPhysics.Constraints;

namespace BepuPhysics;

// What constraints say of where they hold their bodies, without a step.
public sealed unsafe partial class Solver
{
    /// <summary>How far the bodies of a constraint are from where it holds them, where they are now. Zero of motors, which hold no place.</summary>
    /// <exception cref="ArgumentException">There is no such constraint, or its type does not say: contacts, and types of a game's own that are no
    /// joints.</exception>
    public ConstraintSeparation GetSeparation(ConstraintHandle handle)
    {
        using var reading = world.Read("Solver.GetSeparation");
        CheckHandle(handle);
        ref var location = ref Locations[handle.Slot];
        var processor = Processor(location.TypeId);
        if (!processor.HasSeparation)
            throw new ArgumentException($"{handle} is of a type that does not say where it holds its bodies.", nameof(handle));
        // Of bodies in whatever sets, so the constraint is shown copies of their poses, its own in all lanes.
        const int Alignment = 64;
        var memory = stackalloc byte[MaximumBodiesPerConstraint * sizeof(MotionState) + Alignment];
        var motions = (MotionState*)(((nuint)memory + Alignment - 1) & ~(nuint)(Alignment - 1));
        var references = stackalloc Vector<int>[MaximumBodiesPerConstraint];
        for (int i = 0; i < processor.BodiesPerConstraint; ++i)
        {
            ref var body = ref bodies.Locations[BodySlotOf(location, i)];
            motions[i] = bodies.SetOf(body).MotionStates[body.Index];
            references[i] = new Vector<int>(i);
        }
        return processor.Separation(ref TypeBatchAt(location), new SolverBodies(motions, null, null, null, null), references, location.IndexInTypeBatch);
    }
}
