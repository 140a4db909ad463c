using System;
using System.Collections.Generic;
using System.Numerics;
using BepuUtilities;

namespace DemoTests.Constraints;

/// <summary>Moves the second of two bodies to where a joint has no error.</summary>
static class Rotations
{
    public static void JoinAnchors(SampleBody[] bodies, Vector3 localA, Vector3 localB) =>
        bodies[1].Position = bodies[0].Position + (Exact.Rotate(localA, bodies[0].Orientation) - Exact.Rotate(localB, bodies[1].Orientation));

    public static void Align(SampleBody[] bodies, Vector3 localA, Vector3 localB)
    {
        // Half way between the axes, twice: a rotation by the angle between them. Two rounds remove the rounding of the first.
        for (int i = 0; i < 2; ++i)
        {
            var a = Exact.Rotate(localA, bodies[0].Orientation);
            var b = Exact.Rotate(localB, bodies[1].Orientation);
            var turn = Exact.Normalize(new Quaternion(Exact.Cross(b, a), 1 + Exact.Dot(a, b)));
            bodies[1].Orientation = Exact.Normalize(Exact.Concatenate(bodies[1].Orientation, turn));
        }
    }

    /// <summary>The directions at right angles to a unit vector that the library builds its rows along: which ones is its choice.</summary>
    public static (Vector3 X, Vector3 Y) Tangents(Vector3 direction)
    {
        Vector3Wide.BuildOrthonormalBasis(Lanes.Broadcast<Vector3, Vector3Wide>(direction), out var x, out var y);
        return (Lanes.Read<Vector3, Vector3Wide>(ref x, 0), Lanes.Read<Vector3, Vector3Wide>(ref y, 0));
    }

    /// <summary>The rotation vector that turns an axis of B to one of A the shortest way, along the tangents of A's.</summary>
    public static double[] TurnToAlign(DoublePose[] poses, Vector3 localA, Vector3 localB)
    {
        var a = poses[0].ToWorld(localA);
        var b = poses[1].ToWorld(localB);
        var cross = DoubleVector.Cross(b, a);
        var rotation = cross.Length == 0 ? cross : cross * (DoubleVector.Angle(a, b) / cross.Length);
        var (x, y) = Tangents(localA);
        return [DoubleVector.Dot(poses[0].ToWorld(x), rotation), DoubleVector.Dot(poses[0].ToWorld(y), rotation)];
    }

    /// <summary>Cases in which an axis of A and one of B are parallel, either way.</summary>
    public static IEnumerable<(string, T, SampleBody[])> ParallelAxes<T>(
        JointSamples samples, Func<JointSamples, SampleBody[]> newBodies, Func<Vector3, Vector3, T> describe)
    {
        foreach (var axis in new Vector3[] { new(1, 0, 0), new(0, 1, 0), new(0, 0, 1), new(0, 0, -1), samples.Direction() })
        {
            var bodies = newBodies(samples);
            bodies[0].Orientation = bodies[1].Orientation = Quaternion.Identity;
            yield return ($"Same axis {axis}", describe(axis, axis), bodies);
            yield return ($"Opposite axes {axis}", describe(axis, -axis), bodies);
        }
    }
}
