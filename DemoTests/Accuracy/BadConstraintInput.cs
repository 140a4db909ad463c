using System;
using System.Collections.Generic;
using System.Linq;
using System.Numerics;
using System.Reflection;
using System.Runtime.CompilerServices;
using BepuPhysics;
using BepuPhysics.Constraints;
using DemoTests.Constraints;

namespace DemoTests.Accuracy;

/// <summary>
/// Bad values in each field of each registered type of joint: what they are follows from the field's type and name, and the refusal names the field.
/// </summary>
static class BadConstraintInput
{
    public static void AddTo(BadInputList list)
    {
        foreach (var type in JointTypes.All)
        {
            var healthy = type.NewColumn();
            var start = 0;
            foreach (var field in type.Description.GetFields(BindingFlags.Instance | BindingFlags.Public | BindingFlags.NonPublic))
            {
                var name = field.Name.StartsWith('<') ? field.Name[1..field.Name.IndexOf('>', StringComparison.Ordinal)] : field.Name;
                var count = FloatsOf(field.FieldType);
                foreach (var bad in BadValues(field.FieldType, name, healthy[start..(start + count)]))
                {
                    float[] column = [.. healthy[..start], .. bad, .. healthy[(start + count)..]];
                    var what = FormattableString.Invariant($"{name} = {string.Join(' ', bad)}");
                    list.Add($"Solver.Add({type.Name}), each field, {what}", [name], w => type.AddTo(w.Solver, BodiesFor(w, type), column));
                    list.Add($"Solver.ApplyDescription({type.Name}), each field, {what}", [name], w =>
                        type.ApplyTo(w.Solver, w.Joint(type.Description), column));
                }
                start += count;
            }
        }
    }

    static int FloatsOf(Type type) =>
        (int)typeof(Unsafe).GetMethod(nameof(Unsafe.SizeOf))!.MakeGenericMethod(type).Invoke(null, null)! / sizeof(float);

    static BodyHandle[] BodiesFor(BadInputWorld world, JointType type)
    {
        var handles = world.Bodies.ActiveSet.IndexToHandle;
        return [.. new[] { world.FreeBody, world.OtherBody, handles[0], handles[1] }.Take(type.BodyCount)];
    }

    static IEnumerable<float[]> BadValues(Type type, string name, float[] healthy)
    {
        if (type == typeof(SpringSettings))
            return [.. With(0, float.NaN, float.PositiveInfinity, -1), .. With(1, float.NaN, float.PositiveInfinity, -1)];
        if (type == typeof(ServoSettings) || type == typeof(MotorSettings))
            return Enumerable.Range(0, healthy.Length).SelectMany(i => With(i, float.NaN, -1));
        if (type == typeof(float))
            return With(0, BadInputList.NotFinite);
        // Unit vectors and rotations that are none, and points that are nowhere.
        var isDirection = type == typeof(Quaternion) || RandomDescriptions.IsDirection(name);
        return isDirection
            ? [.. With(0, float.NaN, float.NegativeInfinity), [.. healthy.Select(x => x * 2)], new float[healthy.Length]]
            : [.. Enumerable.Range(0, healthy.Length).SelectMany(i => With(i, float.NaN, BadInputList.Huge))];

        IEnumerable<float[]> With(int index, params float[] values) =>
            values.Select(value => healthy.Select((x, i) => i == index ? value : x).ToArray());
    }
}
