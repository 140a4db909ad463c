using System;
using BepuPhysics.Constraints;

namespace BepuPhysics;

// Which constraint types there are. What a type says of itself is compared once, here: afterwards columns are copied by those numbers alone.
public sealed unsafe partial class Solver
{
    /// <summary>Makes a constraint type known. Types of the library are known already.</summary>
    /// <exception cref="ArgumentException">Another type has the same id, the id is out of range, the processor stores other numbers than the
    /// description has, or more than there is room for; nothing was changed.</exception>
    public void Register<TDescription>() where TDescription : unmanaged, IConstraintDescription<TDescription>
    {
        using var change = world.Change("Solver.Register");
        EnsureRegistered<TDescription>();
    }

    // What is generic is compiled for each type of constraint, when the first simulation is made: so that is no more than asking the type.
    internal void EnsureRegistered<TDescription>() where TDescription : unmanaged, IConstraintDescription<TDescription>
    {
        if (IsRegistered(TDescription.ConstraintTypeId, typeof(TDescription)))
            return;
        CheckTypeId(TDescription.ConstraintTypeId, typeof(TDescription));
        Register(TDescription.ConstraintTypeId, typeof(TDescription), TDescription.BodyCount, sizeof(TDescription), TDescription.CreateTypeProcessor());
    }

    void CheckTypeId(int typeId, Type description)
    {
        if ((uint)typeId >= MaximumTypeCount)
            throw new ArgumentException($"Constraint type ids are from 0 to {MaximumTypeCount - 1}; {description.Name} has {typeId}.");
        if (processors[typeId] is not null)
            throw new ArgumentException($"Constraint type id {typeId} of {description.Name} is taken by {descriptionTypes[typeId]?.Name ?? "contacts"}.");
    }

    void Register(int typeId, Type description, int bodyCount, int byteCount, TypeProcessor? processor)
    {
        var name = description.Name;
        if (processor is null)
            throw new ArgumentException($"{name} has created no processor.");
        if (processor.IsRegistered && processor.TypeId != typeId)
            throw new ArgumentException($"The processor that {name} has created is that of constraint type {processor.TypeId}.");
        if (processor.BodiesPerConstraint != bodyCount || processor.BodiesPerConstraint is < 1 or > MaximumBodiesPerConstraint)
            throw new ArgumentException(
                $"{name} connects {bodyCount} bodies and its processor {processor.BodiesPerConstraint}; both must be the same, " +
                $"and from 1 to {MaximumBodiesPerConstraint}.");
        if (processor.PrestepFloats * sizeof(float) != byteCount)
            throw new ArgumentException(
                $"{name} has {byteCount} bytes and its wide form {processor.PrestepFloats} vectors: " +
                "it must be the description with each float widened.");
        if (processor.PrestepFloats + processor.ImpulseFloats > MaximumFloatsPerConstraint)
            throw new ArgumentException(
                $"{name} has {processor.PrestepFloats} floats and {processor.ImpulseFloats} impulses; " +
                $"there is room for {MaximumFloatsPerConstraint} of both.");
        RegisterProcessor(typeId, processor);
        descriptionTypes[typeId] = description;
    }

    internal void RegisterProcessor(int typeId, TypeProcessor processor)
    {
        processor.TypeId = typeId;
        processors[typeId] = processor;
    }

    // A type is what it was when it was registered, whatever it says of itself now.
    bool IsRegistered(int typeId, Type description) => (uint)typeId < MaximumTypeCount && descriptionTypes[typeId] == description;
}
