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

    void EnsureRegistered<TDescription>() where TDescription : unmanaged, IConstraintDescription<TDescription>
    {
        if (IsRegistered<TDescription>())
            return;
        var typeId = TDescription.ConstraintTypeId;
        var name = typeof(TDescription).Name;
        if ((uint)typeId >= MaximumTypeCount)
            throw new ArgumentException($"Constraint type ids are from 0 to {MaximumTypeCount - 1}; {name} has {typeId}.");
        if (processors[typeId] is not null)
            throw new ArgumentException($"Constraint type id {typeId} of {name} is taken by {descriptionTypes[typeId]?.Name ?? "contacts"}.");
        var processor = TDescription.CreateTypeProcessor() ?? throw new ArgumentException($"{name} has created no processor.");
        if (processor.IsRegistered && processor.TypeId != typeId)
            throw new ArgumentException($"The processor that {name} has created is that of constraint type {processor.TypeId}.");
        if (processor.BodiesPerConstraint != TDescription.BodyCount || processor.BodiesPerConstraint is < 1 or > MaximumBodiesPerConstraint)
            throw new ArgumentException(
                $"{name} connects {TDescription.BodyCount} bodies and its processor {processor.BodiesPerConstraint}; both must be the same, " +
                $"and from 1 to {MaximumBodiesPerConstraint}.");
        if (processor.PrestepFloats * sizeof(float) != sizeof(TDescription))
            throw new ArgumentException(
                $"{name} has {sizeof(TDescription)} bytes and its wide form {processor.PrestepFloats} vectors: " +
                "it must be the description with each float widened.");
        if (processor.PrestepFloats + processor.ImpulseFloats > MaximumFloatsPerConstraint)
            throw new ArgumentException(
                $"{name} has {processor.PrestepFloats} floats and {processor.ImpulseFloats} impulses; " +
                $"there is room for {MaximumFloatsPerConstraint} of both.");
        RegisterProcessor(typeId, processor);
        descriptionTypes[typeId] = typeof(TDescription);
    }

    internal void RegisterProcessor(int typeId, TypeProcessor processor)
    {
        processor.TypeId = typeId;
        processors[typeId] = processor;
    }

    // A type is what it was when it was registered, whatever it says of itself now.
    bool IsRegistered<TDescription>() where TDescription : unmanaged, IConstraintDescription<TDescription>
    {
        var typeId = TDescription.ConstraintTypeId;
        return (uint)typeId < MaximumTypeCount && descriptionTypes[typeId] == typeof(TDescription);
    }
}
