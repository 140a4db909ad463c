using System;

namespace Demos.References;

/// <summary>A frictionless pendulum: closed form of its period, and its equation of motion integrated in double precision.</summary>
public static class PendulumOracle
{
    /// <summary>
    /// Length of the point pendulum that swings like a solid sphere held rigidly at this distance:
    /// (m L^2 + 2/5 m r^2) / (m L).
    /// </summary>
    public static double EffectiveLength(double length, double sphereRadius) => length + .4 * sphereRadius * sphereRadius / length;

    /// <summary>Exact period: 2 pi sqrt(L / g) / agm(1, cos(amplitude / 2)), amplitude in radians from the lowest point.</summary>
    public static double Period(double effectiveLength, double gravity, double amplitude) =>
        2 * Math.PI * Math.Sqrt(effectiveLength / gravity) / ArithmeticGeometricMean(1, Math.Cos(amplitude / 2));

    public static double ArithmeticGeometricMean(double a, double b)
    {
        // Converges quadratically: six rounds are exact for any ratio in use, the cap only bounds the loop.
        for (int i = 0; i < 64 && Math.Abs(a - b) > 1e-16 * a; ++i)
            (a, b) = ((a + b) / 2, Math.Sqrt(a * b));
        return a;
    }

    /// <summary>Period by Runge-Kutta integration from rest: four times the time to the lowest point.</summary>
    public static double IntegratedPeriod(double effectiveLength, double gravity, double amplitude, double step)
    {
        double k = gravity / effectiveLength, angle = amplitude, speed = 0, time = 0;
        while (true)
        {
            double a1 = speed, s1 = -k * Math.Sin(angle);
            double a2 = speed + s1 * step / 2, s2 = -k * Math.Sin(angle + a1 * step / 2);
            double a3 = speed + s2 * step / 2, s3 = -k * Math.Sin(angle + a2 * step / 2);
            double a4 = speed + s3 * step, s4 = -k * Math.Sin(angle + a3 * step);
            double next = angle + (a1 + 2 * a2 + 2 * a3 + a4) * step / 6;
            if (next <= 0)
                // At the lowest point the speed is stationary, so the crossing is linear to third order.
                return 4 * (time + step * angle / (angle - next));
            (angle, speed, time) = (next, speed + (s1 + 2 * s2 + 2 * s3 + s4) * step / 6, time + step);
        }
    }
}
