using System.Collections.Generic;
using System.Numerics;
using BepuPhysics;
using Demos.Accuracy;

namespace Demos.Trade.Cases;

/// <summary>The gaps of joints that hold two points together, over all joints and steps: rigid ones have none.</summary>
sealed class JointGaps(AccuracyWorld world)
{
    readonly List<(BodyHandle A, BodyHandle B, Vector3 OffsetA, Vector3 OffsetB)> joints = [];
    double sum;
    long count;

    /// <summary>Mean of all that was observed, m.</summary>
    public double Mean => sum / count;

    public void Add(BodyHandle a, BodyHandle b, Vector3 offsetA, Vector3 offsetB) => joints.Add((a, b, offsetA, offsetB));

    public void Observe()
    {
        foreach ((BodyHandle a, BodyHandle b, Vector3 offsetA, Vector3 offsetB) in joints)
        {
            var pointA = world.Position(a) + world.Orientation(a).Rotate(offsetA);
            var pointB = world.Position(b) + world.Orientation(b).Rotate(offsetB);
            sum += (pointA - pointB).Length;
            ++count;
        }
    }
}
