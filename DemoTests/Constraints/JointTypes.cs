using System;
using System.Collections.Generic;
using System.Linq;
using System.Reflection;
using System.Runtime.CompilerServices;
using BepuPhysics;
using BepuPhysics.Constraints;

namespace DemoTests.Constraints;

/// <summary>A registered type of joint, for suites that go over all of them in a simulation.</summary>
/// <param name="Id">Its id.</param>
/// <param name="Description">Type of its description.</param>
/// <param name="BodyCount">Number of bodies that it connects.</param>
/// <param name="AddTo">Adds one, given as a column of floats, to bodies of a solver.</param>
/// <param name="ApplyTo">Changes one.</param>
sealed record JointType(
    int Id, Type Description, int BodyCount, Func<Solver, BodyHandle[], float[], ConstraintHandle> AddTo, Action<Solver, ConstraintHandle, float[]> ApplyTo)
{
    /// <summary>Name of the type.</summary>
    public string Name => Description.Name;

    /// <summary>Place of settings of a type in the columns; below zero where the description has none.</summary>
    public int PlaceOf<TSettings>() => PlaceOf(field => field.FieldType == typeof(TSettings), out _);

    /// <summary>Place and number of floats of a field in the columns; below zero where the description does not have it.</summary>
    public int PlaceOf(string name, out int length) => PlaceOf(field => field.Name == name, out length);

    int PlaceOf(Predicate<FieldInfo> isIt, out int length)
    {
        var place = 0;
        foreach (var field in Description.GetFields(BindingFlags.Instance | BindingFlags.Public | BindingFlags.NonPublic))
        {
            length = (int)typeof(Unsafe).GetMethod(nameof(Unsafe.SizeOf))!.MakeGenericMethod(field.FieldType).Invoke(null, null)! / sizeof(float);
            if (isIt(field))
                return place;
            place += length;
        }
        length = 0;
        return -1;
    }

    /// <summary>Random values that its own check accepts, the same in every run.</summary>
    public float[] NewColumn() => RandomDescriptions.Joint(Description, new JointSamples(1));
}

/// <summary>All registered types of joints, by id.</summary>
static class JointTypes
{
    public static IReadOnlyList<JointType> All { get; } =
    [
        .. RandomDescriptions.TypeIds.Where(RandomDescriptions.Descriptions.ContainsKey).Select(id => (JointType)typeof(JointTypes)
            .GetMethod(nameof(Of))!.MakeGenericMethod(RandomDescriptions.Descriptions[id]).Invoke(null, null)!),
    ];

    public static JointType Of<T>() where T : unmanaged, IConstraintDescription<T> => new(
        T.ConstraintTypeId, typeof(T), T.BodyCount, (solver, bodies, column) => solver.Add(bodies, Read<T>(column)),
        (solver, joint, column) => solver.ApplyDescription(joint, Read<T>(column)));

    static T Read<T>(float[] column) where T : unmanaged => Unsafe.ReadUnaligned<T>(ref Unsafe.As<float, byte>(ref column[0]));
}
