using System;
using System.Numerics;
using System.Runtime.CompilerServices;

namespace BepuUtilities;

/// <summary>Scalar helpers and constants; trigonometry with the same bits on every machine and as the wide form.</summary>
public static class MathHelper
{
    /// <summary>Half a turn in radians.</summary>
    public const float Pi = 3.141592653589793239f;
    /// <summary>A turn in radians.</summary>
    public const float TwoPi = 6.283185307179586477f;
    /// <summary>A quarter turn in radians.</summary>
    public const float PiOver2 = 1.570796326794896619f;
    /// <summary>An eighth of a turn in radians.</summary>
    public const float PiOver4 = 0.785398163397448310f;

    /// <summary>Sine of an angle in radians; see <see cref="Wide.Sin"/> for its error and odd cases.</summary>
    // The scalar functions are one lane of the wide ones: one source, hence the same bits, for three times the time of the C runtime's.
    public static float Sin(float angle) => Wide.Sin(new Vector<float>(angle)).ToScalar();

    /// <summary>Cosine of an angle in radians; see <see cref="Wide.Sin"/> for its error and odd cases.</summary>
    public static float Cos(float angle) => Wide.Cos(new Vector<float>(angle)).ToScalar();

    /// <summary>Sine and cosine of an angle in radians.</summary>
    public static void SinCos(float angle, out float sin, out float cos)
    {
        Wide.SinCos(new Vector<float>(angle), out var wideSin, out var wideCos);
        sin = wideSin.ToScalar();
        cos = wideCos.ToScalar();
    }

    /// <summary>Angle in [0, pi] radians whose cosine is given; see <see cref="Wide.Acos"/>.</summary>
    public static float Acos(float cosine) => Wide.Acos(new Vector<float>(cosine)).ToScalar();

    /// <summary>Angle in [-pi, pi] radians from the X axis to a point; see <see cref="Wide.Atan2"/>.</summary>
    public static float Atan2(float y, float x) => Wide.Atan2(new Vector<float>(y), new Vector<float>(x)).ToScalar();

    /// <inheritdoc cref="Wide.Sin"/>
    public static Vector<float> Sin(Vector<float> angle) => Wide.Sin(angle);

    /// <inheritdoc cref="Wide.Cos"/>
    public static Vector<float> Cos(Vector<float> angle) => Wide.Cos(angle);

    /// <inheritdoc cref="Wide.Acos"/>
    public static Vector<float> Acos(Vector<float> cosine) => Wide.Acos(cosine);

    /// <summary>The angle from a to b in radians, as the nearest of its equivalents: in [-pi, pi] for finite angles.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void GetSignedAngleDifference(Vector<float> a, Vector<float> b, out Vector<float> difference)
    {
        var turns = (b - a) * new Vector<float>(1 / TwoPi) + new Vector<float>(0.5f);
        difference = (turns - Vector.Floor(turns) - new Vector<float>(0.5f)) * new Vector<float>(TwoPi);
    }

    /// <summary>Degrees in radians.</summary>
    public static float ToRadians(float degrees) => degrees * (Pi / 180f);

    /// <summary>Radians in degrees.</summary>
    public static float ToDegrees(float radians) => radians * (180f / Pi);

    /// <summary>Limits a value to an interval; NaN stays NaN.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static float Clamp(float value, float min, float max) => value < min ? min : value > max ? max : value;

    /// <summary>Limits a value to an interval.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static int Clamp(int value, int min, int max) => value < min ? min : value > max ? max : value;

    /// <summary>Larger value; <paramref name="b"/> when either is NaN.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static float Max(float a, float b) => a > b ? a : b;

    /// <summary>Smaller value; <paramref name="b"/> when either is NaN.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static float Min(float a, float b) => a < b ? a : b;

    /// <summary>Larger value.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static int Max(int a, int b) => Math.Max(a, b);

    /// <summary>Smaller value.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static int Min(int a, int b) => Math.Min(a, b);

    /// <summary>1 for a positive or zero value, -1 for a negative one.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static float BinarySign(float value) => value < 0 ? -1 : 1;

    /// <summary>1 over the value, by division: exact to rounding in spite of the name, which existing callers use.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Vector<float> FastReciprocal(Vector<float> value) => Vector<float>.One / value;

    /// <summary>1 over the square root of the value, exact to two roundings in spite of the name, which existing callers use.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Vector<float> FastReciprocalSquareRoot(Vector<float> value) => Vector<float>.One / Vector.SquareRoot(value);
}
