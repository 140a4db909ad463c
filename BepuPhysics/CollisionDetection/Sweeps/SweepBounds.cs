using System;
using System.Numerics;
using BepuPhysics.Trees;
using BepuUtilities;
using BepuUtilities.Memory;

namespace BepuPhysics.CollisionDetection;

/// <summary>Boxes of floats around what is computed in doubles.</summary>
static class SweepBounds
{
    // Beyond anything that has a place, and finite.
    const double Farthest = 1e18;

    // As a box without an end: its squares are finite.
    const float WithoutEnd = 1e15f;

    // Of the size of what is swept: beyond what counts as touching.
    const double TouchingPart = 4e-5;
    // Of coordinates: what boxes and directions lose by being floats.
    const double Rounding = 2e-6;

    // By how much a box around a part has to be wider, m: for a coordinate of the greatest size there is, m, and a speed of its body, m/s.
    static double Pad(in ImpactBody part, in SweepMotion motion, double coordinate, double speed) =>
        part.Core.Size * TouchingPart + coordinate * Rounding + motion.Accuracy.TouchingDistance + Touching(motion, speed + part.SurfaceSpeed);

    /// <summary>A box around a part of A on its way, where it starts, in the frame that a container B has at first.</summary>
    /// <remarks>
    /// Where B turns, a point of its own is, in that frame, away from where it is in B by an arc at most, or by a diameter. What touches a child of B does so
    /// at a point of it: so the box is wider by the arc of the farthest point that a child has.
    /// </remarks>
    /// <param name="motion">How the bodies move.</param>
    /// <param name="part">The part.</param>
    /// <param name="root">Boxes around all children of B, in its frame.</param>
    /// <param name="count">Number of these boxes.</param>
    /// <param name="speed">Of A against B, m/s.</param>
    /// <param name="min">Lower corner, m.</param>
    /// <param name="max">Upper corner, m.</param>
    public static void InContainer(
        in SweepMotion motion, in ImpactBody part, Buffer<NodeChild> root, int count, double speed, out Vector3 min, out Vector3 max)
    {
        var farthest = Vector3.Zero;
        for (int i = 0; i < count; ++i)
            farthest = Exact.Max(farthest, Exact.Max(Vector3.Abs(root[i].Min), Vector3.Abs(root[i].Max)));
        part.GetBounds(motion.OrientationB, motion.MaximumT, out var lower, out var upper);
        var place = motion.OrientationB.TurnBack(-motion.OffsetB);
        double radius = Exact.Length(farthest);
        var pad = Pad(part, motion, place.Length + radius, speed + motion.AngularB.Length * radius) +
            SweepMotion.Arc(radius, motion.AngularB, motion.MaximumT);
        min = Lower(place + lower, pad);
        max = Upper(place + upper, pad);
    }

    /// <summary>
    /// A box around all places where B gets to within the time, in the frame that a container A has at first: of its children only those in it may be met.
    /// </summary>
    /// <param name="motion">How the bodies move.</param>
    /// <param name="min">Lower corner, m.</param>
    /// <param name="max">Upper corner, m.</param>
    public static void AroundB(in SweepMotion motion, out Vector3 min, out Vector3 max)
    {
        (min, max) = (new(-WithoutEnd), new(WithoutEnd));
        if (!(motion.ReachOfB > 0 && motion.MaximumT < WithoutEnd))
            return;
        var relative = motion.LinearB - motion.LinearA;
        DoubleVector3 start = motion.OrientationA.TurnBack(motion.OffsetB), end = motion.OrientationA.TurnBack(motion.OffsetB + relative * motion.MaximumT);
        // No point of B is farther from the centre of A.
        var farthest = Math.Max(start.Length, end.Length) + motion.ReachOfB;
        var pad = motion.ReachOfB + farthest * Rounding + SweepMotion.Arc(farthest, motion.AngularA, motion.MaximumT) + motion.Accuracy.TouchingDistance +
            Touching(motion, relative.Length + motion.AngularA.Length * farthest + motion.AngularB.Length * motion.ReachOfB);
        min = Lower(new(Math.Min(start.X, end.X), Math.Min(start.Y, end.Y), Math.Min(start.Z, end.Z)), pad);
        max = Upper(new(Math.Max(start.X, end.X), Math.Max(start.Y, end.Y), Math.Max(start.Z, end.Z)), pad);
    }

    /// <summary>A box around a body A that is alone and moves, where it starts, in the world.</summary>
    /// <param name="motion">How it moves.</param>
    /// <param name="body">The body.</param>
    /// <param name="position">Its position, m.</param>
    /// <param name="min">Lower corner, m.</param>
    /// <param name="max">Upper corner, m.</param>
    public static void InWorld(in SweepMotion motion, in ImpactBody body, in DoubleVector3 position, out Vector3 min, out Vector3 max)
    {
        var axes = new DoubleMatrix3x3 { X = new(1, 0, 0), Y = new(0, 1, 0), Z = new(0, 0, 1) };
        body.GetBounds(axes, motion.MaximumT, out var lower, out var upper);
        var pad = Pad(body, motion, position.Length, motion.LinearA.Length);
        min = Lower(position + lower, pad);
        max = Upper(position + upper, pad);
    }

    // Distance that counts as touching by a threshold that is a time.
    static double Touching(in SweepMotion motion, double speed) =>
        speed > 0 ? Math.Min(Math.Min(motion.Accuracy.ConvergenceThreshold, motion.MaximumT) * speed, Farthest) : 0;

    static Vector3 Lower(in DoubleVector3 corner, double pad) =>
        new(Limit(corner.X - pad), Limit(corner.Y - pad), Limit(corner.Z - pad));

    static Vector3 Upper(in DoubleVector3 corner, double pad) =>
        new(Limit(corner.X + pad), Limit(corner.Y + pad), Limit(corner.Z + pad));

    static float Limit(double coordinate) => (float)Math.Clamp(coordinate, -Farthest, Farthest);
}
