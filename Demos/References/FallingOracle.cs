using System;

namespace Demos.References;

/// <summary>Closed forms of flight and bounce. SI units.</summary>
public static class FallingOracle
{
    public static Double3 Position(Double3 start, Double3 velocity, Double3 gravity, double time) =>
        start + velocity * time + gravity * (time * time / 2);

    /// <summary>
    /// What velocity-first (semi-implicit) Euler gives in exact arithmetic after n steps of h: gravity counts n (n + 1) h^2 / 2.
    /// The distance of an engine from the nearer of this and <see cref="Position"/> is its round-off.
    /// </summary>
    public static Double3 SemiImplicitEuler(Double3 start, Double3 velocity, Double3 gravity, double step, long count) =>
        start + velocity * (count * step) + gravity * (step * step * count * (count + 1) / 2);

    /// <summary>Height of the first rebound from a height, for a coefficient of restitution.</summary>
    public static double ReboundHeight(double height, double restitution) => restitution * restitution * height;

    /// <summary>When the first rebound peaks.</summary>
    public static double ReboundPeakTime(double gravity, double height, double restitution) =>
        Math.Sqrt(2 * height / gravity) * (1 + restitution);
}
