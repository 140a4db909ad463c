using System;
using System.Collections.Generic;
using System.Linq;
using System.Runtime.CompilerServices;
using BepuPhysics;
using BepuPhysics.Constraints;

namespace DemoTests.Constraints;

/// <summary>A registered type of joint, for suites that go over all of them in a simulation.</summary>
/// <param name="Description">Type of its description.</param>
/// <param name="BodyCount">Number of bodies that it connects.</param>
/// <param name="AddTo">Adds one, given as a column of floats, to bodies of a solver.</param>
/// <param name="ApplyTo">Changes one.</param>
sealed record JointType(
    Type Description, int BodyCount, Func<Solver, BodyHandle[], float[], ConstraintHandle> AddTo, Action<Solver, ConstraintHandle, float[]> ApplyTo)
{
    /// <summary>Name of the type.</summary>
    public string Name => Description.Name;

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
        typeof(T), T.BodyCount, (solver, bodies, column) => solver.Add(bodies, Read<T>(column)),
        (solver, joint, column) => solver.ApplyDescription(joint, Read<T>(column)));

    static T Read<T>(float[] column) where T : unmanaged => Unsafe.ReadUnaligned<T>(ref Unsafe.As<float, byte>(ref column[0]));
}
