using System;

namespace Demos.References;

/// <summary>
/// Closed forms of dry friction after Coulomb: blocks on slopes, spheres that slide and roll. SI units, angles in radians.
/// </summary>
public static class SlidingOracle
{
    /// <summary>Distance that a block slides down a slope from rest. Zero where friction holds it.</summary>
    public static double SlopeDistance(double gravity, double angle, double friction, double time) =>
        Math.Max(0, gravity * (Math.Sin(angle) - friction * Math.Cos(angle))) * time * time / 2;

    /// <summary>The coefficient that explains a slid distance.</summary>
    public static double EffectiveFriction(double gravity, double angle, double distance, double time) =>
        (Math.Sin(angle) - 2 * distance / (gravity * time * time)) / Math.Cos(angle);

    /// <summary>Distance that a solid sphere rolls down a slope from rest: acceleration 5/7 g sin(angle).</summary>
    public static double RollingDistance(double gravity, double angle, double time) => 5d / 7 * gravity * Math.Sin(angle) * time * time / 2;

    /// <summary>When a solid sphere that starts sliding without spin begins to roll: 2 v / (7 mu g).</summary>
    public static double RollingStart(double gravity, double friction, double startSpeed) => 2 * startSpeed / (7 * friction * gravity);

    /// <summary>Speed of a solid sphere that starts sliding without spin: falls by mu g until 5/7 of the start, then stays.</summary>
    public static double SlidingSphereSpeed(double gravity, double friction, double startSpeed, double time) =>
        startSpeed - friction * gravity * Math.Min(time, RollingStart(gravity, friction, startSpeed));

    /// <summary>Way of a solid sphere that starts sliding without spin.</summary>
    public static double SlidingSphereDistance(double gravity, double friction, double startSpeed, double time)
    {
        double sliding = Math.Min(time, RollingStart(gravity, friction, startSpeed));
        return startSpeed * time - friction * gravity * sliding * (time - sliding / 2);
    }
}
