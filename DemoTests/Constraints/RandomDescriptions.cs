using System;
using System.Collections.Generic;
using System.Linq;
using System.Numerics;
using System.Reflection;
using System.Runtime.CompilerServices;
using BepuPhysics;
using BepuPhysics.Constraints;
using BepuPhysics.Constraints.Contact;
using BepuUtilities.Memory;

namespace DemoTests.Constraints;

/// <summary>
/// Descriptions of every constraint type that is registered by default, as columns of floats: random ones that its own check accepts. Joints need nothing for
/// that: what a field is can be told from its type and its name. So a new type is in all suites that go over the types as soon as it is registered.
/// </summary>
static class RandomDescriptions
{
    const int Attempts = 1000;

    /// <summary>Ids of all registered types, contacts included.</summary>
    public static IReadOnlyList<int> TypeIds { get; } = ReadTypeIds();

    /// <summary>Descriptions that the library has, by id, registered or not; contacts have none.</summary>
    public static IReadOnlyDictionary<int, Type> Descriptions { get; } = typeof(Solver).Assembly.GetTypes()
        .Where(type => type.Namespace == typeof(ConstraintTypeIds).Namespace)
        .Where(type => type.IsValueType && type.GetInterfaces().Any(i => i.IsGenericType && i.GetGenericTypeDefinition() == typeof(IConstraintDescription<>)))
        .ToDictionary(type => (int)type.GetProperty(nameof(BallSocket.ConstraintTypeId))!.GetValue(null)!);

    /// <summary>A solver that knows the types, and nothing else.</summary>
    public static Solver CreateSolver(BufferPool pool)
    {
        var solver = new Solver(null!, pool, new SolveDescription(1, 1), 16);
        DefaultTypes.RegisterDefaults(solver);
        return solver;
    }

    public static string NameOf(int typeId) => Descriptions.TryGetValue(typeId, out var type) ? type.Name : $"contact {typeId}";

    /// <summary>Random values of a type that can be simulated.</summary>
    public static float[] Column(int typeId, JointSamples samples) =>
        Descriptions.TryGetValue(typeId, out var type) ? Joint(type, samples) : Contact(typeId, samples);

    /// <summary>Random values of a description that its check accepts.</summary>
    public static float[] Joint(Type description, JointSamples samples)
    {
        for (int i = 0; i < Attempts; ++i)
        {
            var column = Fields(description, "").SelectMany(field => Values(field.Type, field.Name, samples)).ToArray();
            if (Accepts(description, column))
                return column;
        }
        throw new InvalidOperationException($"None of {Attempts} random descriptions of {description.Name} was accepted: say here what its fields are.");
    }

    /// <summary>Whether a description passes its own check.</summary>
    public static bool Accepts(Type description, float[] column) =>
        (bool)typeof(RandomDescriptions).GetMethod(nameof(AcceptsTyped), BindingFlags.NonPublic | BindingFlags.Static)!
            .MakeGenericMethod(description).Invoke(null, [column])!;

    static bool AcceptsTyped<T>(float[] column) where T : unmanaged, IConstraintDescription<T>
    {
        try
        {
            T.Validate(Unsafe.ReadUnaligned<T>(ref Unsafe.As<float, byte>(ref column[0])));
            return true;
        }
        catch (ArgumentException)
        {
            return false;
        }
    }

    // The structs of floats that a description consists of, in order.
    static IEnumerable<(Type Type, string Name)> Fields(Type type, string name)
    {
        if (type == typeof(float) || type == typeof(Vector3) || type == typeof(Quaternion) ||
            (name.Length > 0 && type.Namespace == typeof(SpringSettings).Namespace))
            return [(type, name)];
        return type.GetFields(BindingFlags.Instance | BindingFlags.Public | BindingFlags.NonPublic).SelectMany(field => Fields(field.FieldType, field.Name));
    }

    static float[] Values(Type type, string name, JointSamples samples)
    {
        // Points that are to be in one place have no direction, and so no derivative, where they are.
        if (type == typeof(float))
            return [name switch
            {
                "TargetDistance" => samples.Uniform(0.3f, 2),
                "Teeth" or "TeethA" or "TeethB" => MathF.Floor(samples.Uniform(1, 20)) * (samples.Coin() ? 1 : -1),
                "Radius" => samples.Uniform(0.5f, 2) * (samples.Coin() ? 1 : -1),
                _ => samples.Uniform(-1, 2),
            }];
        if (type == typeof(Vector3))
            return Floats(IsDirection(name) ? samples.Direction() : samples.Vector(1));
        if (type == typeof(Quaternion))
            return Floats(samples.Rotation());
        if (type == typeof(SpringSettings))
            return Floats(samples.Spring());
        if (type == typeof(ServoSettings))
            return Floats(samples.Coin() ? ServoSettings.Default : new ServoSettings(samples.Uniform(1, 5), samples.Uniform(0, 1), samples.Uniform(1, 100)));
        if (type == typeof(MotorSettings))
            return Floats(samples.Coin() ? new MotorSettings(float.MaxValue, 0) : new MotorSettings(samples.Uniform(1, 100), samples.Uniform(0, 1)));
        throw new InvalidOperationException($"No random values for {name} of type {type.Name}: say here what they are.");
    }

    /// <summary>Whether a vector of that name is a unit vector.</summary>
    public static bool IsDirection(string name) => name.Contains("Axis", StringComparison.Ordinal) ||
        name.Contains("Direction", StringComparison.Ordinal) || name.Contains("Normal", StringComparison.Ordinal);

    static float[] Floats<T>(T value) where T : unmanaged
    {
        var floats = new float[Unsafe.SizeOf<T>() / sizeof(float)];
        Unsafe.WriteUnaligned(ref Unsafe.As<float, byte>(ref floats[0]), value);
        return floats;
    }

    // A patch with touching and separate contacts, as the narrow phase writes it.
    static float[] Contact(int typeId, JointSamples samples)
    {
        if (typeId >= 8)
            throw new InvalidOperationException($"No random values for contacts of type {typeId}: say here what they are.");
        var column = new List<float>();
        for (int i = 0; i <= typeId % 4; ++i)
            column.AddRange([.. Floats(samples.Vector(1)), samples.Uniform(-0.01f, 0.05f)]);
        column.AddRange([.. Floats(samples.Vector(2)), .. Floats(samples.Direction()), samples.Uniform(0, 1), .. Floats(samples.Spring())]);
        // Every other one is no single face.
        var recovery = samples.Uniform(0.1f, 3);
        column.Add(FaceLever.Write(recovery, samples.Coin() ? FaceLever.Code(recovery) : FaceLever.OfOneFace));
        return [.. column];
    }

    static int[] ReadTypeIds()
    {
        using var pool = new BufferPool();
        return [.. CreateSolver(pool).TypeProcessors.Where(p => p is not null).Select(p => p!.TypeId)];
    }
}
