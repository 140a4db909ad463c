using System;
using System.Collections.Generic;
using System.Numerics;
using BepuPhysics;

namespace Demos.Accuracy;

/// <summary>The gaps of joints that keep two points together, or at a distance, over all joints and looks: rigid ones have none.</summary>
sealed class JointGaps(AccuracyWorld world)
{
    readonly List<(BodyHandle A, BodyHandle B, Vector3 OffsetA, Vector3 OffsetB, float Distance)> joints = [];
    double sum;
    long count;

    /// <summary>Mean of all that was observed, m.</summary>
    public double Mean => sum / count;

    /// <summary>Greatest of all that was observed, m.</summary>
    public double Worst { get; private set; }

    public void Add(BodyHandle a, BodyHandle b, Vector3 offsetA, Vector3 offsetB, float distance = 0) => joints.Add((a, b, offsetA, offsetB, distance));

    public void Observe()
    {
        foreach ((BodyHandle a, BodyHandle b, Vector3 offsetA, Vector3 offsetB, float distance) in joints)
        {
            double gap = (world.Point(a, offsetA) - world.Point(b, offsetB)).Length;
            gap = distance > 0 ? Math.Abs(gap - distance) : gap;
            sum += gap;
            Worst = Tally.Most(Worst, gap);
            ++count;
        }
    }
}
