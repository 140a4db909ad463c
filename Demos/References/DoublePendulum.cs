using System;

namespace Demos.References;

/// <summary>
/// Two equal bars that hang end to end in a plane: Lagrange's equations in their angles, integrated by the classical Runge-Kutta scheme in double precision.
/// L = (I + m l^2/4 + m l^2) a'^2 / 2 + (I + m l^2/4) b'^2 / 2 + m l^2/2 a' b' cos(a - b) + m g l (3/2 cos a + 1/2 cos b).
/// </summary>
/// <param name="length">From pin to pin, m.</param>
/// <param name="moment">Of a bar about its middle, over its mass, m2.</param>
/// <param name="gravity">Downwards, m/s2.</param>
/// <param name="upper">Angle of the upper bar from hanging down, towards +x, rad.</param>
/// <param name="lower">Angle of the lower bar.</param>
public sealed class DoublePendulum(double length, double moment, double gravity, double upper, double lower)
{
    double a = upper, b = lower, u, v;

    /// <summary>Where the lower end is, from the upper one, m.</summary>
    public (double X, double Y) Tip => (length * (Math.Sin(a) + Math.Sin(b)), -length * (Math.Cos(a) + Math.Cos(b)));

    /// <summary>Over the mass of a bar, J/kg; zero at the height of the pivot.</summary>
    public double Energy => (FirstMoment * u * u + SecondMoment * v * v) / 2 + Coupling * u * v * Math.Cos(a - b)
        - gravity * length * (1.5 * Math.Cos(a) + .5 * Math.Cos(b));

    double SecondMoment => moment + length * length / 4;

    double FirstMoment => SecondMoment + length * length;

    double Coupling => length * length / 2;

    /// <summary>Goes on by a duration, in seconds, in steps of at most another.</summary>
    public void Advance(double duration, double step)
    {
        int count = (int)Math.Ceiling(duration / step - 1e-9);
        double h = duration / count;
        for (int i = 0; i < count; ++i)
        {
            var k1 = Rates(a, b, u, v);
            var k2 = Rates(a + k1.A * h / 2, b + k1.B * h / 2, u + k1.U * h / 2, v + k1.V * h / 2);
            var k3 = Rates(a + k2.A * h / 2, b + k2.B * h / 2, u + k2.U * h / 2, v + k2.V * h / 2);
            var k4 = Rates(a + k3.A * h, b + k3.B * h, u + k3.U * h, v + k3.V * h);
            a += (k1.A + 2 * k2.A + 2 * k3.A + k4.A) * h / 6;
            b += (k1.B + 2 * k2.B + 2 * k3.B + k4.B) * h / 6;
            u += (k1.U + 2 * k2.U + 2 * k3.U + k4.U) * h / 6;
            v += (k1.V + 2 * k2.V + 2 * k3.V + k4.V) * h / 6;
        }
    }

    (double A, double B, double U, double V) Rates(double a, double b, double u, double v)
    {
        double coupling = Coupling * Math.Cos(a - b), turning = Coupling * Math.Sin(a - b);
        double first = -turning * v * v - 1.5 * gravity * length * Math.Sin(a), second = turning * u * u - .5 * gravity * length * Math.Sin(b);
        double determinant = FirstMoment * SecondMoment - coupling * coupling;
        return (u, v, (SecondMoment * first - coupling * second) / determinant, (FirstMoment * second - coupling * first) / determinant);
    }
}
