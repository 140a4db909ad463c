using System;
using System.Numerics;
using System.Runtime.CompilerServices;
using BepuPhysics.Collidables;
using BepuUtilities;

namespace BepuPhysics.CollisionDetection;

/// <summary>How two bodies move against each other, in world axes and double precision, and what is asked about it.</summary>
struct SweepMotion
{
    /// <summary>Orientations at the time zero.</summary>
    public DoubleMatrix3x3 OrientationA, OrientationB;
    /// <summary>Velocities, m/s and rad/s.</summary>
    public DoubleVector3 LinearA, LinearB, AngularA, AngularB;
    /// <summary>Position of B less that of A at the time zero, m.</summary>
    public DoubleVector3 OffsetB;
    /// <summary>Length of the time that is of interest, s; may be infinite.</summary>
    public double MaximumT;
    /// <summary>How exactly the time is sought.</summary>
    public ImpactAccuracy Accuracy;
    /// <summary>Part of its inner radius by which each convex part is thinner than its shape; of triangles and half-spaces nothing is taken.</summary>
    public double ThinnerPart;
    /// <summary>Inner radius, m, of which that part is the most that is taken: nothing that is thick loses more than what is small has.</summary>
    public double MostThinnerOf;
    /// <summary>How far B reaches from its centre, m; zero where nobody has said so.</summary>
    public double ReachOfB;

    // Arms are rounded to floats.
    const double ArcSlack = 1 + 1e-6;

    /// <summary>A convex part.</summary>
    /// <param name="typeId">Type of its shape.</param>
    /// <param name="shape">The shape, which stays where it is.</param>
    /// <param name="shapes">Shapes that there are.</param>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public readonly unsafe ImpactCore CoreOf(int typeId, void* shape, Shapes shapes)
    {
        var core = ImpactCore.Of(typeId, shape, shapes);
        if (ThinnerPart > 0)
            core.Thin(ThinnerPart, MostThinnerOf);
        return core;
    }

    /// <summary>
    /// Whether a part of A may meet a part of B in time, as far as balls about them tell; before there is a body for the part of B.
    /// </summary>
    /// <param name="part">The part of A.</param>
    /// <param name="core">The part of B.</param>
    /// <param name="local">Where it is in B.</param>
    /// <param name="maximumT">The time.</param>
    public readonly bool BallsMeet(in ImpactBody part, in ImpactCore core, Vector3 local, double maximumT)
    {
        if (core.IsPlane || part.Core.IsPlane)
            return true;
        var arm = part.Arm.Length;
        var arcA = Arc(arm, AngularA, maximumT);
        // What turns by much is nearer to the middle of its body.
        var isTurned = arcA > arm;
        var center = OffsetB + OrientationB.Turn(new(local)) - (isTurned ? part.BallCenter : part.Arm);
        var radius = (isTurned ? part.BallRadius : part.Core.Margin + part.Core.Reach + arcA) + core.Margin + core.Reach + TouchingIn(part, core, local);
        if (local != default)
            radius += Arc(Exact.Length(local), AngularB, maximumT);
        return ImpactBalls.FirstMeeting(center, LinearA - LinearB, radius) <= maximumT;
    }

    /// <summary>What turns goes along an arc: away from where it would be by no more than its length, nor than the diameter of the circle, m.</summary>
    /// <param name="arm">Distance from the centre, m.</param>
    /// <param name="angular">Angular velocity, rad/s.</param>
    /// <param name="time">The time, s; may be infinite.</param>
    internal static double Arc(double arm, in DoubleVector3 angular, double time)
    {
        var speed = angular.Length;
        return arm > 0 && speed > 0 ? arm * Math.Min(2, speed * time) * ArcSlack : 0;
    }

    // As far as parts may be from each other and still count as touching.
    readonly double TouchingIn(in ImpactBody part, in ImpactCore core, Vector3 local)
    {
        var threshold = Accuracy.ConvergenceThreshold;
        if (threshold == 0)
            return Accuracy.TouchingDistance;
        var speed = (LinearA - LinearB).Length + part.SurfaceSpeed + AngularB.Length * (Exact.Length(local) + core.Reach);
        return Math.Max(Accuracy.TouchingDistance, speed > 0 ? threshold * speed : 0);
    }
}

/// <summary>The first impact that was found so far between any parts of two bodies.</summary>
struct SweepHit
{
    /// <summary>Whether there is one.</summary>
    public bool Exists;
    /// <summary>When it is, s; zero where the bodies overlap from the start.</summary>
    public double T;
    /// <summary>Whether the bodies overlap from the start: then there is neither normal nor place.</summary>
    public bool Overlaps;
    /// <summary>Unit normal from B to A, in world axes.</summary>
    public DoubleVector3 Normal;
    /// <summary>Place in world axes, from the position of A at the time zero, m.</summary>
    public DoubleVector3 Place;
    /// <summary>Whether the rounds of two parts ran out, so that nothing is known of them.</summary>
    public bool RanOut;
    /// <summary>Rounds that all parts took together.</summary>
    public int RoundCount;
    // The parts that touch; of several at once, those with the lowest numbers count, so that no order of tests shows.
    int childA, childB;

    /// <summary>The latest time that is still of interest. What is asked about without an end has that of the greatest float.</summary>
    public readonly double LatestT(in SweepMotion motion) => Exists ? T : Math.Min(motion.MaximumT, float.MaxValue);

    /// <summary>The time as a float, which is not later.</summary>
    public readonly float EarliestT => Rounded.Down(T);

    /// <summary>Tests two parts, and takes their impact if it is the first.</summary>
    /// <param name="motion">How the bodies move.</param>
    /// <param name="a">Part of A, at the time zero.</param>
    /// <param name="b">Part of B, at the time zero.</param>
    /// <param name="partA">Number of the part of A.</param>
    /// <param name="partB">Number of the part of B.</param>
    public void Test(in SweepMotion motion, ref ImpactBody a, ref ImpactBody b, int partA, int partB)
    {
        var maximumT = LatestT(motion);
        var isFlipped = a.Core.IsPlane;
        if (isFlipped && b.Core.IsPlane)
            return;
        var relative = motion.LinearA - motion.LinearB;
        var found = isFlipped
            ? ImpactPair.Find(ref b, ref a, -motion.OffsetB, -relative, maximumT, motion.Accuracy, out var impact)
            : ImpactPair.Find(ref a, ref b, motion.OffsetB, relative, maximumT, motion.Accuracy, out impact);
        RoundCount += impact.RoundCount;
        RanOut |= impact.RanOut;
        if (!found || (Exists && impact.T == T && (partA > childA || (partA == childA && partB > childB))))
            return;
        Exists = true;
        (childA, childB) = (partA, partB);
        T = impact.T;
        Overlaps = impact.Overlaps;
        if (Overlaps)
            return;
        // The impact is told from where the first body begins, as if the second did not move on.
        Normal = isFlipped ? -impact.Normal : impact.Normal;
        Place = isFlipped ? impact.Place + motion.OffsetB + motion.LinearA * T : impact.Place + motion.LinearB * T;
    }

    /// <summary>Takes it that the bodies overlap from the start.</summary>
    public void Overlap()
    {
        this = default;
        Exists = Overlaps = true;
    }
}
