using System.Numerics;
using System.Runtime.CompilerServices;

namespace BepuUtilities;

// Trigonometry from the four operations and the square root alone, which IEEE 754 rounds the same everywhere; the C runtime's
// functions differ between systems. The polynomials are minimax fits (Remez exchange, in 50 digits, coefficients rounded to floats);
// the errors stated were measured in double precision over dense samples (TrigonometryTests keeps them true).
public static partial class Wide
{
    /// <summary>Largest angle that <see cref="SinCos"/> takes for what it says, in radians.</summary>
    // At this size neighbouring floats are 0.008 radians apart.
    internal const float MaximumAngle = 1e5f;

    /// <summary>
    /// Sine of an angle in radians. Error at most 1e-7 for angles up to 1e5. Larger ones, whose floats are too far apart to mean an
    /// angle, count as zero; infinite and NaN give NaN.
    /// </summary>
    public static Vector<float> Sin(Vector<float> angle)
    {
        SinCos(angle, out var sin, out _);
        return sin;
    }

    /// <summary>Cosine of an angle in radians; error and odd cases as for <see cref="Sin"/>.</summary>
    public static Vector<float> Cos(Vector<float> angle)
    {
        SinCos(angle, out _, out var cos);
        return cos;
    }

    /// <summary>Sine and cosine of an angle in radians, for little more than the price of one; see <see cref="Sin"/>.</summary>
    // What turns in a substep turns by little: then no quarter turns have to be taken off, which would change no bit of such an angle.
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void SinCos(Vector<float> angle, out Vector<float> sin, out Vector<float> cos)
    {
        if (Vector.LessThanAll(Vector.Abs(angle), new Vector<float>(0.75f)))
        {
            SinCosWithinQuarter(angle, out sin, out cos);
            return;
        }
        // The caller's variables need no address then.
        SinCosOfAny(angle, out var anySin, out var anyCos);
        sin = anySin;
        cos = anyCos;
    }

    /// <summary>Square of the angle, rad, up to which <see cref="SinOverAngle"/> is right.</summary>
    public const float SinOverAngleLimit = 0.75f * 0.75f;

    /// <summary>Sine of an angle over the angle, and its cosine, without a root; error at most 1e-7 for angles up to .75.</summary>
    /// <param name="z">Square of the angle, up to <see cref="SinOverAngleLimit"/>; the results mean nothing for others.</param>
    /// <param name="sin">Sine over the angle; one for an angle of zero.</param>
    /// <param name="cos">Cosine.</param>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void SinOverAngle(Vector<float> z, out Vector<float> sin, out Vector<float> cos)
    {
        sin = Vector<float>.One + z * SinPolynomial(z);
        cos = CosOfSquare(z);
    }

    // Of angles up to pi / 4.
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static void SinCosWithinQuarter(Vector<float> r, out Vector<float> sin, out Vector<float> cos)
    {
        SinOverAngle(r * r, out sin, out cos);
        sin *= r;
    }

    // (sin r - r) / r^3 by the square of r.
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static Vector<float> SinPolynomial(Vector<float> z)
    {
        var sin = new Vector<float>(-0.00019495294f);
        sin = sin * z + new Vector<float>(0.0083319759f);
        return sin * z + new Vector<float>(-0.16666651f);
    }

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static Vector<float> CosOfSquare(Vector<float> z)
    {
        var cos = new Vector<float>(2.4438092e-5f);
        cos = cos * z + new Vector<float>(-0.0013887364f);
        cos = cos * z + new Vector<float>(0.041666646f);
        // No square of z: where something hardly turns that has no normal float, and processors take ten times as long for it.
        return Vector<float>.One - z * (new Vector<float>(0.5f) - z * cos);
    }

    [MethodImpl(MethodImplOptions.NoInlining)]
    static void SinCosOfAny(Vector<float> angle, out Vector<float> sin, out Vector<float> cos)
    {
        // Zero times an infinite or NaN angle is NaN.
        var x = Select(Vector.LessThanOrEqual(Vector.Abs(angle), new Vector<float>(MaximumAngle)), angle, angle * 0f);

        // Adding 1.5 * 2^23 rounds to an integer and leaves it in the low bits.
        var rounder = new Vector<float>(12582912f);
        var shifted = x * new Vector<float>(0.63661975f) + rounder;
        var quarterTurns = shifted - rounder;
        var quadrant = Vector.AsVectorInt32(shifted);

        // r = x - quarterTurns * pi / 2, with pi / 2 in three parts (Cody and Waite). The first two have eight bits each, so that
        // their products with a quarterTurns of up to 16 bits are exact; pi / 2 less the sum of all three is 5e-14.
        var r = x - quarterTurns * new Vector<float>(1.5703125f);
        r -= quarterTurns * new Vector<float>(0.0004825592041015625f);
        r -= quarterTurns * new Vector<float>(1.2675908e-6f);
        SinCosWithinQuarter(r, out var sinR, out var cosR);

        // Odd quarter turns exchange the two; the second bit of the (shifted) quadrant is the sign.
        var swap = Vector.Equals(quadrant & Vector<int>.One, Vector<int>.One);
        var two = new Vector<int>(2);
        var sinSign = (quadrant & two) << 30;
        var cosSign = ((quadrant + Vector<int>.One) & two) << 30;
        sin = Vector.AsVectorSingle(Vector.AsVectorInt32(Select(swap, cosR, sinR)) ^ sinSign);
        cos = Vector.AsVectorSingle(Vector.AsVectorInt32(Select(swap, sinR, cosR)) ^ cosSign);
    }

    /// <summary>
    /// Angle in [0, pi] radians whose cosine is given. Error at most 4e-7. Cosines beyond [-1, 1] count as the nearer end; NaN gives NaN.
    /// </summary>
    public static Vector<float> Acos(Vector<float> cosine)
    {
        var one = Vector<float>.One;
        var half = new Vector<float>(0.5f);
        var magnitude = Min(one, Vector.Abs(cosine));

        // asin by polynomial up to one half; beyond, acos(x) = 2 asin(sqrt((1 - x) / 2)) maps back into that interval.
        var isSmall = Vector.LessThanOrEqual(magnitude, half);
        var z = Select(isSmall, magnitude * magnitude, (one - magnitude) * half);
        var s = Select(isSmall, magnitude, Vector.SquareRoot(z));
        var asin = s + s * z * AsinPolynomial(z);

        var isNegative = Vector.LessThan(cosine, Vector<float>.Zero);
        var small = new Vector<float>(MathHelper.PiOver2) - CopySign(asin, cosine);
        var twice = asin + asin;
        var large = Select(isNegative, new Vector<float>(MathHelper.Pi) - twice, twice);
        return Select(isSmall, small, large);
    }

    /// <summary>Square of the sine up to which <see cref="AsinOverSine"/> is right.</summary>
    public const float AsinOverSineLimit = 0.25f;

    /// <summary>Angle of a sine over the sine, without a root or a division; relative error at most 1.5e-7 up to a twelfth of a turn.</summary>
    /// <param name="z">Square of the sine, up to <see cref="AsinOverSineLimit"/>; the result means nothing for others.</param>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Vector<float> AsinOverSine(Vector<float> z) => Vector<float>.One + z * AsinPolynomial(z);

    // (asin s - s) / s^3 by the square of s.
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static Vector<float> AsinPolynomial(Vector<float> z)
    {
        var p = new Vector<float>(0.043763131f);
        p = p * z + new Vector<float>(0.023142228f);
        p = p * z + new Vector<float>(0.045707799f);
        p = p * z + new Vector<float>(0.074930772f);
        return p * z + new Vector<float>(0.16666822f);
    }

    /// <summary>
    /// Angle in [-pi, pi] radians from the X axis to a point. Error at most 4e-7 at any scale of finite coordinates. Zero (with the
    /// sign of <paramref name="y"/>) for the origin; NaN where a coordinate is NaN or both are infinite.
    /// </summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Vector<float> Atan2(Vector<float> y, Vector<float> x)
    {
        var angle = AtanOfQuarter(Vector.Abs(y), Vector.Abs(x));
        angle = Select(Vector.LessThan(x, Vector<float>.Zero), new Vector<float>(MathHelper.Pi) - angle, angle);
        return CopySign(angle, y);
    }

    /// <summary>As <see cref="Atan2"/>, for coordinates without signs: an angle from 0 to a quarter turn.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Vector<float> AtanOfQuarter(Vector<float> y, Vector<float> x)
    {
        var isSteep = Vector.GreaterThan(y, x);
        var larger = Select(isSteep, y, x);
        var smaller = Select(isSteep, x, y);

        // atan on [0, 1]. A coordinate that is NaN makes the comparison false and stays in one of the two operands.
        var a = Select(Vector.Equals(x + y, Vector<float>.Zero), Vector<float>.Zero, smaller / larger);
        var z = a * a;
        var p = new Vector<float>(0.0026222244f);
        p = p * z + new Vector<float>(-0.015132463f);
        p = p * z + new Vector<float>(0.041121759f);
        p = p * z + new Vector<float>(-0.073666997f);
        p = p * z + new Vector<float>(0.1057393f);
        p = p * z + new Vector<float>(-0.14185975f);
        p = p * z + new Vector<float>(0.19990396f);
        p = p * z + new Vector<float>(-0.33332986f);
        var angle = a + a * z * p;

        return Select(isSteep, new Vector<float>(MathHelper.PiOver2) - angle, angle);
    }
}
