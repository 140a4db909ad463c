using System;
using System.Numerics;

namespace BepuPhysics.CollisionDetection;

/// <summary>Boxes of floats around what is computed in doubles.</summary>
static class SweepBounds
{
    // Beyond anything that has a place, and finite.
    const double Farthest = 1e18;

    /// <summary>Distance that counts as touching by a threshold that is a time.</summary>
    public static double Touching(in ImpactAccuracy accuracy, double maximumT, double speed) =>
        speed > 0 ? Math.Min(Math.Min(accuracy.ConvergenceThreshold, maximumT) * speed, Farthest) : 0;

    /// <summary>A lower corner.</summary>
    public static Vector3 Lower(in DoubleVector3 corner, double pad) =>
        new(Limit(corner.X - pad), Limit(corner.Y - pad), Limit(corner.Z - pad));

    /// <summary>An upper corner.</summary>
    public static Vector3 Upper(in DoubleVector3 corner, double pad) =>
        new(Limit(corner.X + pad), Limit(corner.Y + pad), Limit(corner.Z + pad));

    static float Limit(double coordinate) => (float)Math.Clamp(coordinate, -Farthest, Farthest);
}
