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

    /// <summary>B's basis is swung the shortest way until the twist axes agree; the twist is where its X axis then points.</summary>
    public static double Twist(DoublePose[] poses, Quaternion localBasisA, Quaternion localBasisB)
    {
        var a = poses[0].Orientation * DoubleRotation.From(localBasisA);
        var b = poses[1].Orientation * DoubleRotation.From(localBasisB);
        var cross = DoubleVector.Cross(b.Z, a.Z);
        var swing = DoubleRotation.From(cross.Length == 0 ? cross : cross * (DoubleVector.Angle(a.Z, b.Z) / cross.Length));
        var x = swing * b.X;
        return Math.Atan2(DoubleVector.Dot(x, a.Y), DoubleVector.Dot(x, a.X));
    }

    /// <summary>Cosine of the angle between two twist axes.</summary>
    public static double TwistAxesDot(DoublePose[] poses, Quaternion localBasisA, Quaternion localBasisB) => DoubleVector.Dot(
        (poses[0].Orientation * DoubleRotation.From(localBasisA)).Z, (poses[1].Orientation * DoubleRotation.From(localBasisB)).Z);

    /// <summary>Cases in which twist axes are against each other, exactly and nearly.</summary>
    public static IEnumerable<(string, T, SampleBody[])> OpposedTwistAxes<T>(
        JointSamples samples, Func<JointSamples, SampleBody[]> newBodies, Func<Quaternion, T> describe)
    {
        for (int i = 0; i < 20; ++i)
        {
            var bodies = newBodies(samples);
            bodies[0].Orientation = bodies[1].Orientation = samples.Rotation();
            var half = samples.Uniform(-3, 3);
            var opposite = new Quaternion(MathF.Cos(half), MathF.Sin(half), 0, 0);
            yield return ("Axes against each other", describe(i % 2 == 0 ? opposite : Exact.Concatenate(opposite, samples.Rotation(0.2f))), bodies);
        }
    }

    /// <summary>Cases in which centres coincide, exactly and nearly.</summary>
    public static IEnumerable<(string, T, SampleBody[])> NearBodies<T>(
        JointSamples samples, Func<JointSamples, SampleBody[]> newBodies, Func<float, T> describe)
    {
        foreach (var gap in new[] { 0, 1e-30f, 1e-18f, 1e-12f, 1e-7f })
        {
            foreach (var distance in new[] { 0, 1e-20f, 1 })
            {
                var bodies = newBodies(samples);
                for (int i = 0; i < bodies.Length; ++i)
                    bodies[i].Position = new(i == 1 ? gap : 0, i == 2 ? gap : 0, i == 3 ? gap : 0);
                yield return ($"{gap} apart, to be {distance}", describe(distance), bodies);
            }
        }
    }
}
