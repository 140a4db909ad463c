using System;
using System.Numerics;

namespace BepuPhysics.CollisionDetection;

/// <summary>Boxes of floats around what is computed in doubles.</summary>
static class SweepBounds
{
    // Beyond anything that has a place, and finite.
    const double Farthest = 1e18;

    // Of the size of what is swept: beyond what counts as touching.
    const double TouchingPart = 4e-5;
    // Of coordinates: what boxes and directions lose by being floats.
    const double Rounding = 2e-6;

    /// <summary>By how much a box around a part that is swept has to be wider, m.</summary>
    /// <param name="part">The part.</param>
    /// <param name="motion">How it moves, and how exact the sweep is to be.</param>
    /// <param name="coordinate">Greatest distance of a place from the origin, m.</param>
    /// <param name="speed">Of its body, m/s.</param>
    public static double Pad(in ImpactBody part, in SweepMotion motion, double coordinate, double speed) =>
        part.Core.Size * TouchingPart + coordinate * Rounding + Touching(motion, speed + part.SurfaceSpeed);

    // Distance that counts as touching by a threshold that is a time.
    static double Touching(in SweepMotion motion, double speed) =>
        speed > 0 ? Math.Min(Math.Min(motion.Accuracy.ConvergenceThreshold, motion.MaximumT) * speed, Farthest) : 0;

    /// <summary>A lower corner.</summary>
    public static Vector3 Lower(in DoubleVector3 corner, double pad) =>
        new(Limit(corner.X - pad), Limit(corner.Y - pad), Limit(corner.Z - pad));

    /// <summary>An upper corner.</summary>
    public static Vector3 Upper(in DoubleVector3 corner, double pad) =>
        new(Limit(corner.X + pad), Limit(corner.Y + pad), Limit(corner.Z + pad));

    static float Limit(double coordinate) => (float)Math.Clamp(coordinate, -Farthest, Farthest);
}
