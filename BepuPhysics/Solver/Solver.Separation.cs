using System;
using System.Numerics;
using BepuPhysics.Constraints;
using BepuUtilities;

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
        // Of bodies in whatever sets, so the constraint is shown copies of their poses and inertias, its own in all lanes.
        const int Alignment = 64;
        var memory = stackalloc byte[MaximumBodiesPerConstraint * (sizeof(MotionState) + sizeof(BodyInertia)) + Alignment];
        var motions = (MotionState*)(((nuint)memory + Alignment - 1) & ~(nuint)(Alignment - 1));
        var inertias = (BodyInertia*)(motions + MaximumBodiesPerConstraint);
        var references = stackalloc Vector<int>[MaximumBodiesPerConstraint];
        for (int i = 0; i < processor.BodiesPerConstraint; ++i)
        {
            ref var body = ref bodies.Locations[BodySlotOf(location, i)];
            ref var set = ref bodies.SetOf(body);
            motions[i] = set.MotionStates[body.Index];
            ref var inertia = ref set.LocalInertias[body.Index];
            inertias[i].InverseMass = inertia.InverseMass;
            inertias[i].InverseInertiaTensor = Symmetric3x3.RotateInverseInertia(inertia.InverseInertiaTensor, motions[i].Pose.Orientation);
            references[i] = new Vector<int>(i);
        }
        var shown = new SolverBodies(motions, inertias, null, null, null);
        return processor.Separation(ref TypeBatchAt(location), shown, references, location.IndexInTypeBatch);
    }
}
