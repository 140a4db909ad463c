using System;
using System.Collections.Generic;
using System.Linq;
using System.Reflection;
using BepuPhysics;
using BepuPhysics.Constraints;

namespace Demos.Pages;

/// <summary>What a type of joint says of itself.</summary>
/// <param name="Description">Struct that describes it.</param>
/// <param name="TypeId">Its id.</param>
/// <param name="BodyCount">Number of bodies that it connects.</param>
/// <param name="RowCount">Number of rows: velocities that it decides on.</param>
/// <param name="Kind">How the rows are held.</param>
sealed record JointFacts(Type Description, int TypeId, int BodyCount, int RowCount, RowKind Kind)
{
    /// <summary>All types of joints that the library has, by name.</summary>
    public static IReadOnlyList<JointFacts> All { get; } =
    [
        .. typeof(Solver).Assembly.GetTypes()
            // What characters register for themselves is no joint.
            .Where(type => type.IsValueType && type.Namespace == typeof(Hinge).Namespace && type.GetInterfaces().Any(IsDescription))
            .OrderBy(type => type.Name, StringComparer.Ordinal).Select(Of),
    ];

    /// <summary>Name of the type.</summary>
    public string Name => Description.Name;

    /// <summary>The settings, in order.</summary>
    public FieldInfo[] Fields => Description.GetFields(BindingFlags.Instance | BindingFlags.Public);

    static bool IsDescription(Type type) => type.IsGenericType && type.GetGenericTypeDefinition() == typeof(IConstraintDescription<>);

    static JointFacts Of(Type description)
    {
        var processor = (TypeProcessor)description.GetMethod(nameof(Hinge.CreateTypeProcessor))!.Invoke(null, null)!;
        // TypeProcessor<bodies, prestep, impulses, JointConstraint<bodies, prestep, geometry, rows, mass, joint>>
        var parts = processor.GetType().GetGenericArguments()[^1].GetGenericArguments();
        var kind = (RowKind)typeof(JointFacts).GetMethod(nameof(KindOf), BindingFlags.NonPublic | BindingFlags.Static)!.MakeGenericMethod(parts)
            .Invoke(null, null)!;
        var typeId = (int)description.GetProperty(nameof(Hinge.ConstraintTypeId))!.GetValue(null)!;
        return new(description, typeId, processor.BodiesPerConstraint, processor.ImpulseFloats, kind);
    }

    static RowKind KindOf<TBodies, TPrestep, TGeometry, TRows, TMass, TJoint>()
        where TBodies : unmanaged, IBodySlots where TPrestep : unmanaged where TGeometry : unmanaged
        where TRows : unmanaged, IRows<TRows> where TMass : unmanaged, IRowMatrix<TMass, TRows>
        where TJoint : IJoint<TBodies, TPrestep, TGeometry, TRows, TMass> => TJoint.Kind;
}
