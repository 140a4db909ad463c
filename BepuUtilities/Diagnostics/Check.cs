using System.Diagnostics;
using System.Diagnostics.CodeAnalysis;
using System.Numerics;
using System.Runtime.CompilerServices;

namespace BepuUtilities.Diagnostics;

/// <summary>Invariant checks. Compiled in when DEBUG or PHYSICS_VALIDATE is defined, otherwise gone without a trace.</summary>
public static class Check
{
    /// <summary>Whether checks are compiled in.</summary>
    public static bool IsEnabled
    {
        get
        {
            bool isEnabled = false;
            Enable(ref isEnabled);
            return isEnabled;
        }
    }

    [Conditional("DEBUG"), Conditional("PHYSICS_VALIDATE")]
    static void Enable(ref bool isEnabled) => isEnabled = true;

    /// <summary>Fails unless the condition holds.</summary>
    [Conditional("DEBUG"), Conditional("PHYSICS_VALIDATE")]
    public static void That([DoesNotReturnIf(false)] bool condition, [CallerArgumentExpression(nameof(condition))] string expression = "")
    {
        if (!condition)
            Fail(expression);
    }

    /// <summary>Fails when the value is NaN or infinite.</summary>
    [Conditional("DEBUG"), Conditional("PHYSICS_VALIDATE")]
    public static void Finite(float value, [CallerArgumentExpression(nameof(value))] string expression = "")
    {
        if (!float.IsFinite(value))
            Fail($"{expression} is not finite: {value}");
    }

    /// <summary>Fails when any component is NaN or infinite.</summary>
    [Conditional("DEBUG"), Conditional("PHYSICS_VALIDATE")]
    public static void Finite(in Vector3 v, [CallerArgumentExpression(nameof(v))] string expression = "")
    {
        if (!float.IsFinite(v.X) || !float.IsFinite(v.Y) || !float.IsFinite(v.Z))
            Fail($"{expression} is not finite: {v}");
    }

    /// <summary>Fails when any component is NaN or infinite.</summary>
    [Conditional("DEBUG"), Conditional("PHYSICS_VALIDATE")]
    public static void Finite(in Quaternion q, [CallerArgumentExpression(nameof(q))] string expression = "")
    {
        if (!float.IsFinite(q.X) || !float.IsFinite(q.Y) || !float.IsFinite(q.Z) || !float.IsFinite(q.W))
            Fail($"{expression} is not finite: {q}");
    }

    /// <summary>Fails when any lane is NaN or infinite.</summary>
    [Conditional("DEBUG"), Conditional("PHYSICS_VALIDATE")]
    public static void Finite(Vector<float> value, [CallerArgumentExpression(nameof(value))] string expression = "")
    {
        // Infinity less itself is NaN, and NaN equals nothing.
        if (!Vector.EqualsAll(value - value, Vector<float>.Zero))
            Fail($"{expression} is not finite: {value}");
    }

    /// <summary>Fails when any component of any lane is NaN or infinite.</summary>
    [Conditional("DEBUG"), Conditional("PHYSICS_VALIDATE")]
    public static void Finite(in Vector3Wide v, [CallerArgumentExpression(nameof(v))] string expression = "")
    {
        if (!Vector.EqualsAll((v.X - v.X) + (v.Y - v.Y) + (v.Z - v.Z), Vector<float>.Zero))
            Fail($"{expression} is not finite: {v.X}, {v.Y}, {v.Z}");
    }

    [DoesNotReturn]
    static void Fail(string message) => throw new PhysicsInvariantException(message);
}
