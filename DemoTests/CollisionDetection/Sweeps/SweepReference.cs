using System;
using System.Numerics;
using BepuPhysics;
using Demos.References;
using DemoTests.Support;

namespace DemoTests.CollisionDetection.Sweeps;

/// <summary>Two convex shapes that move and turn, for the reference and for the library.</summary>
/// <param name="A">First shape.</param>
/// <param name="B">Second shape.</param>
/// <param name="OffsetB">Position of B less that of A at the start.</param>
/// <param name="OrientationA">Orientation of A at the start.</param>
/// <param name="OrientationB">Orientation of B at the start.</param>
/// <param name="VelocityA">Velocity of A.</param>
/// <param name="VelocityB">Velocity of B.</param>
sealed record MovingPair(ConvexPairShape A, ConvexPairShape B, Vector3 OffsetB, Quaternion OrientationA, Quaternion OrientationB,
    BodyVelocity VelocityA, BodyVelocity VelocityB);

/// <summary>How far two moving shapes are from each other at any time, by enumeration of their features, in double precision.</summary>
sealed class SweepReference
{
    readonly MovingPair pair;
    readonly bool turns;
    ConvexReference? still;

    public SweepReference(MovingPair pair)
    {
        this.pair = pair;
        turns = pair.VelocityA.Angular != Vector3.Zero || pair.VelocityB.Angular != Vector3.Zero;
        Reach = ReachOf(pair.A.Shape) + ReachOf(pair.B.Shape) + ((Double3)pair.OffsetB).Length;
        Size = Math.Min(SizeOf(pair.A.Shape), SizeOf(pair.B.Shape));
        GreatestSpeed = ((Double3)pair.VelocityA.Linear - pair.VelocityB.Linear).Length +
            ((Double3)pair.VelocityA.Angular).Length * ReachOf(pair.A.Shape) + ((Double3)pair.VelocityB.Angular).Length * ReachOf(pair.B.Shape);
    }

    /// <summary>Size of the smaller shape: how far its surface reaches from its centre.</summary>
    public double Size { get; }

    /// <summary>All lengths there are, together.</summary>
    public double Reach { get; }

    /// <summary>No point of one shape moves faster than this, seen from the other without its turning.</summary>
    public double GreatestSpeed { get; }

    /// <summary>Number of distances that were asked for.</summary>
    public int Count { get; private set; }

    /// <summary>Distance at a time; negative: depth.</summary>
    public double Distance(double t) => -Find(t, out _, out _).Depth;

    /// <summary>Width of the gap at a time along a unit direction from B to A in world axes.</summary>
    public double GapAlong(Double3 normal, double t)
    {
        var a = Orientation(pair.OrientationA, pair.VelocityA.Angular, t);
        var b = Orientation(pair.OrientationB, pair.VelocityB.Angular, t);
        var offset = (Double3)pair.OffsetB + ((Double3)pair.VelocityB.Linear - pair.VelocityA.Linear) * t;
        return -(pair.A.Shape.CoreExtent(a.RotateBack(-normal)) + pair.B.Shape.CoreExtent(b.RotateBack(normal)) + Double3.Dot(normal, offset) +
            pair.A.Shape.Rounding + pair.B.Shape.Rounding);
    }

    /// <summary>Distance of a point, which is given from the first position of A, from A at a time; negative inside.</summary>
    public double DistanceFromA(Double3 place, double t)
    {
        var orientation = Orientation(pair.OrientationA, pair.VelocityA.Angular, t);
        return pair.A.Shape.SignedDistance(orientation.RotateBack(place - (Double3)pair.VelocityA.Linear * t));
    }

    /// <summary>Distance of a point, which is given from the first position of A, from B at a time; negative inside.</summary>
    public double DistanceFromB(Double3 place, double t)
    {
        var orientation = Orientation(pair.OrientationB, pair.VelocityB.Angular, t);
        return pair.B.Shape.SignedDistance(orientation.RotateBack(place - pair.OffsetB - (Double3)pair.VelocityB.Linear * t));
    }

    ConvexDepth Find(double t, out DoubleQuaternion orientationA, out DoubleQuaternion orientationB, double ambiguity = 1e-4)
    {
        ++Count;
        var a = orientationA = Orientation(pair.OrientationA, pair.VelocityA.Angular, t);
        var b = orientationB = Orientation(pair.OrientationB, pair.VelocityB.Angular, t);
        var offset = (Double3)pair.OffsetB + ((Double3)pair.VelocityB.Linear - pair.VelocityA.Linear) * t;
        var reference = still;
        if (reference is null)
        {
            Double3 Axis(double x, double y, double z) => a.RotateBack(b.Rotate(new(x, y, z)));
            reference = new(pair.A.Shape, pair.B.Shape, new(Axis(1, 0, 0), Axis(0, 1, 0), Axis(0, 0, 1)));
            if (!turns)
                still = reference;
        }
        return reference.Find(a.RotateBack(offset), ambiguity);
    }

    static DoubleQuaternion Orientation(Quaternion start, Vector3 angular, double t)
    {
        var first = DoubleQuaternion.Normalize(start);
        var speed = ((Double3)angular).Length;
        return speed == 0 ? first : DoubleQuaternion.FromAxisAngle((Double3)angular * (1 / speed), speed * t) * first;
    }

    /// <summary>
    /// Finds a time from which on the shapes are nearer than a distance, by steps that cannot jump over a depth of half of that distance.
    /// </summary>
    /// <param name="from">First time.</param>
    /// <param name="to">Last time.</param>
    /// <param name="near">The distance; negative: a depth.</param>
    /// <param name="least">The distance that steps may jump over.</param>
    /// <returns>A time, or null where there is none.</returns>
    public double? FirstWithin(double from, double to, double near, double least)
    {
        for (var t = from; ;)
        {
            var distance = Distance(t);
            if (distance <= near)
                return t;
            if (t >= to || GreatestSpeed == 0)
                return null;
            t = Math.Min(to, t + Math.Max(distance - near, least) / GreatestSpeed);
        }
    }

    static double ReachOf(ConvexShape shape) => shape.Middle.Length + shape.OuterRadius;

    // A triangle may be far from its origin.
    static double SizeOf(ConvexShape shape)
    {
        if (shape.Kind == ConvexKind.Triangle || shape.IsCylinder)
            return shape.OuterRadius;
        var size = 0.0;
        foreach (var vertex in shape.Vertices)
            size = Math.Max(size, vertex.Length);
        return size + shape.Rounding;
    }
}
