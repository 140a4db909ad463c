using System;
using BepuUtilities;

namespace BepuPhysics.Constraints;

/// <summary>What a user says of a constraint when adding it or changing it.</summary>
/// <remarks>
/// The wide struct in which the solver keeps constraints is the description with each float widened, in the same order, so
/// descriptions are written and read lane by lane without code of their own (<see cref="Lanes"/>).
/// </remarks>
public interface IConstraintDescription<TDescription> where TDescription : unmanaged, IConstraintDescription<TDescription>
{
    /// <summary>Id of the constraint type; unique among the types of a solver.</summary>
    static abstract int ConstraintTypeId { get; }
    /// <summary>Number of bodies that the constraint connects.</summary>
    static abstract int BodyCount { get; }
    /// <summary>Creates the processor that stores and solves constraints of this type.</summary>
    static abstract TypeProcessor CreateTypeProcessor();
    /// <summary>Throws where a value of a description cannot be simulated. A type that does not have this is added as it is.</summary>
    /// <exception cref="ArgumentException">Names the field and the value.</exception>
    // Static, because an instance method with a body boxes the descriptions that do not have it.
    static virtual void Validate(in TDescription description) { }
}

/// <summary>A constraint on one body.</summary>
public interface IOneBodyConstraintDescription<TDescription> : IConstraintDescription<TDescription>
    where TDescription : unmanaged, IOneBodyConstraintDescription<TDescription>
{
    static int IConstraintDescription<TDescription>.BodyCount => 1;
}

/// <summary>A constraint between two bodies.</summary>
public interface ITwoBodyConstraintDescription<TDescription> : IConstraintDescription<TDescription>
    where TDescription : unmanaged, ITwoBodyConstraintDescription<TDescription>
{
    static int IConstraintDescription<TDescription>.BodyCount => 2;
}

/// <summary>A constraint between three bodies.</summary>
public interface IThreeBodyConstraintDescription<TDescription> : IConstraintDescription<TDescription>
    where TDescription : unmanaged, IThreeBodyConstraintDescription<TDescription>
{
    static int IConstraintDescription<TDescription>.BodyCount => 3;
}

/// <summary>A constraint between four bodies.</summary>
public interface IFourBodyConstraintDescription<TDescription> : IConstraintDescription<TDescription>
    where TDescription : unmanaged, IFourBodyConstraintDescription<TDescription>
{
    static int IConstraintDescription<TDescription>.BodyCount => 4;
}
