using System;
using System.Collections.Generic;
using System.Linq;
using System.Numerics;
using System.Reflection;
using BepuUtilities;
using Xunit;

namespace DemoTests.Numerics;

/// <summary>Every wide struct repeats the fields of its scalar struct, in order and place. <see cref="Lanes"/> depends on it.</summary>
public class WideLayoutTests
{
    static readonly Type[] ScalarLeaves = [typeof(float), typeof(int), typeof(uint)];

    public static TheoryData<Type> WideTypes => new(
        from assembly in new[] { typeof(Lanes).Assembly, Assembly.Load("BepuPhysics") }
        from type in assembly.GetTypes()
        where type.IsValueType && !type.ContainsGenericParameters && Scalar(type) is not null
        select type);

    [Theory, MemberData(nameof(WideTypes))]
    public void FieldsMatchTheScalarForm(Type wide) => Assert.Equal(Flatten(Scalar(wide)!, isWide: false), Flatten(wide, isWide: true));

    [Theory, MemberData(nameof(WideTypes))]
    public void SizesMatchTheScalarForm(Type wide)
    {
        var sizeOf = typeof(System.Runtime.CompilerServices.Unsafe).GetMethod("SizeOf")!;
        int Size(Type type) => (int)sizeOf.MakeGenericMethod(type).Invoke(null, null)!;
        Assert.Equal(Size(Scalar(wide)!) * Vector<float>.Count, Size(wide));
    }

    static Type? Scalar(Type wide) =>
        wide.GetInterfaces().FirstOrDefault(i => i.IsGenericType && i.GetGenericTypeDefinition() == typeof(IWide<>))?.GetGenericArguments()[0];

    /// <summary>Paths of the four-byte fields and their types; in wide structs, of their vectors.</summary>
    static IEnumerable<string> Flatten(Type type, bool isWide, string path = "")
    {
        foreach (var field in type.GetFields(BindingFlags.Instance | BindingFlags.Public | BindingFlags.NonPublic))
        {
            var leaf = isWide && field.FieldType.IsGenericType && field.FieldType.GetGenericTypeDefinition() == typeof(Vector<>)
                ? field.FieldType.GetGenericArguments()[0]
                : isWide ? null : ScalarLeaves.FirstOrDefault(t => t == field.FieldType);
            if (leaf is not null)
                yield return $"{path}.{field.Name} {(leaf == typeof(float) ? "float" : "integer")}";
            else if (field.FieldType.IsPrimitive)
                yield return $"{path}.{field.Name} has no wide form: {field.FieldType}";
            else
                foreach (var name in Flatten(field.FieldType, isWide, $"{path}.{field.Name}"))
                    yield return name;
        }
    }
}
