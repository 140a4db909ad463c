using System;
using System.Collections.Generic;
using System.Linq;
using System.Reflection;

namespace DemoTests.Support;

/// <summary>The public numbers of a struct, however deep inside of it, each by the fields that lead to it.</summary>
static class FloatFields
{
    public static IEnumerable<FieldInfo[]> Of(Type type)
    {
        foreach (var field in type.GetFields(BindingFlags.Instance | BindingFlags.Public))
        {
            if (field.FieldType == typeof(float))
                yield return [field];
            else if (field.FieldType is { IsValueType: true, IsPrimitive: false, IsEnum: false })
            {
                foreach (var path in Of(field.FieldType))
                    yield return [field, .. path];
            }
        }
    }

    public static string Name(FieldInfo[] path) => string.Join('.', path.Select(field => field.Name));

    /// <summary>A copy with another value in one place.</summary>
    public static T With<T>(T original, FieldInfo[] path, float value) where T : struct => (T)Changed(original, path, value);

    static object Changed(object box, ReadOnlySpan<FieldInfo> path, float value)
    {
        var inner = path.Length == 1 ? value : Changed(path[0].GetValue(box)!, path[1..], value);
        path[0].SetValue(box, inner);
        return box;
    }
}
