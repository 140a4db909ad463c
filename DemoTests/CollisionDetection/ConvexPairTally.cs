using System;
using System.Collections.Generic;
using System.Globalization;
using System.Linq;
using BepuPhysics.CollisionDetection;
using Demos.References;
using DemoTests.Support;

namespace DemoTests.CollisionDetection;

/// <summary>Errors of one kind of pairs in one regime; lengths are relative to the outer radius of the smaller shape.</summary>
sealed class ConvexPairTally
{
    // Relative to the larger size: what rounding the input of the test to floats, and a few operations, may change.
    const double Rounding = 2e-6;

    public const double Tolerance = 1e-3;
    public const double WrongMinimum = 0.01;

    readonly List<float> depthErrors = [];
    readonly List<float> excesses = [];
    readonly List<float> angles = [];

    public int PoseCount { get; private set; }

    public int ContactCount { get; private set; }

    /// <summary>Normals whose depth is not near the least one.</summary>
    public int WrongMinimumCount { get; private set; }

    /// <summary>Overlapping pairs without a contact.</summary>
    public int MissedCount { get; private set; }

    /// <summary>Pairs apart by less than the margin without a contact.</summary>
    public int UnseenCount { get; private set; }

    /// <summary>Pairs apart by more than the margin that have a contact.</summary>
    public int GhostCount { get; private set; }

    /// <summary>Contacts farther from a surface than halfway between the two.</summary>
    public int OutsideCount { get; private set; }

    /// <summary>Manifolds with something that is not a finite number, or a normal that is not of unit length.</summary>
    public int BrokenCount { get; private set; }

    /// <summary>How far the worst result is below the reference: above zero the reference itself is wrong.</summary>
    public double BelowReference { get; private set; }

    /// <summary>How far the worst contact is from a surface beyond halfway.</summary>
    public double WorstOutside { get; private set; }

    public string? WorstPose { get; private set; }

    public string? WorstOutsidePose { get; private set; }

    public string? WorstBelowPose { get; private set; }

    double worst;

    /// <param name="pair">Pose and reference.</param>
    /// <param name="manifold">Contacts of the library.</param>
    /// <param name="margin">Speculative margin of the pair, m.</param>
    public void Add(in ConvexCase pair, in ConvexContactManifold manifold, double margin)
    {
        ++PoseCount;
        var (reference, pose, offset, found) = pair;
        var size = reference.Size;
        var depth = found.Depth;
        var tolerance = Tolerance * size + Rounding * reference.LargerSize;
        if (manifold.Count == 0)
        {
            MissedCount += depth > tolerance ? 1 : 0;
            UnseenCount += depth <= tolerance && depth > -margin + tolerance ? 1 : 0;
            return;
        }
        GhostCount += depth < -margin - tolerance ? 1 : 0;
        var toA = ConvexRotation.From(pose.OrientationA);
        var normal = toA.RotateBack(manifold.Normal);
        if (!(Math.Abs(normal.Length - 1) < 1e-5))
        {
            ++BrokenCount;
            return;
        }
        normal *= 1 / normal.Length;
        var along = reference.DepthAlong(normal, offset);
        var excess = (along - depth) / size;
        if (-excess > BelowReference)
        {
            BelowReference = -excess;
            WorstBelowPose = $"{Describe(reference, pose, found)}, found {ConvexGenerator.ToVector(normal)}, along it {along:g9}";
        }
        var deepest = double.MinValue;
        for (int i = 0; i < manifold.Count; ++i)
        {
            var contact = manifold[i];
            deepest = Math.Max(deepest, contact.Depth);
            var place = toA.RotateBack(contact.Offset);
            if (!place.IsFinite || !float.IsFinite(contact.Depth))
            {
                ++BrokenCount;
                return;
            }
            ++ContactCount;
            var outside = Math.Max(reference.A.SignedDistance(place), reference.B.SignedDistance(reference.Rotation.RotateBack(place - offset)))
                - Math.Abs(contact.Depth) * 0.5;
            OutsideCount += outside > tolerance ? 1 : 0;
            if (outside / size > WorstOutside)
            {
                WorstOutside = outside / size;
                WorstOutsidePose = $"{Describe(reference, pose, found)}, contact {i} of {manifold.Count} {contact.Offset} depth {contact.Depth:g9} "
                    + $"normal {contact.Normal}";
            }
        }
        var error = Math.Abs(deepest - depth) / size;
        depthErrors.Add((float)error);
        excesses.Add((float)Math.Max(0, excess));
        angles.Add((float)Angle(reference, found, normal, excess));
        WrongMinimumCount += excess > WrongMinimum ? 1 : 0;
        if (Math.Max(error, excess) > worst)
        {
            worst = Math.Max(error, excess);
            WorstPose = $"{Describe(reference, pose, found)}, found {deepest:g9} {ConvexGenerator.ToVector(normal)}, along it {along:g9}";
        }
    }

    /// <summary>
    /// Angle to the nearest of the normals that are as good as the best one, degrees. Nothing where the depth along the normal is the least
    /// one to within rounding: then a range of normals is as good, as with shapes that touch at corners, or turn around one axis.
    /// </summary>
    static double Angle(ConvexReference reference, in ConvexDepth found, Double3 normal, double excess)
    {
        if (excess * reference.Size <= 1e-6 * reference.LargerSize)
            return 0;
        return found.Normals.Min(n => Math.Atan2(Double3.Cross(n, normal).Length, Double3.Dot(n, normal))) * 180 / Math.PI;
    }

    static string Describe(ConvexReference reference, in ConvexPose pose, in ConvexDepth found) =>
        $"A {Describe(reference.A)} B {Describe(reference.B)} {pose} depth {found.Depth:g9} normal {ConvexGenerator.ToVector(found.Normal)}";

    static string Describe(ConvexShape s) => s.Kind switch
    {
        ConvexKind.Box => $"box {ConvexGenerator.ToVector(s.HalfExtents)}",
        ConvexKind.Triangle or ConvexKind.Hull => $"{s.Kind} {string.Join(' ', s.Points)}",
        _ => $"{s.Kind} {s.Radius:g9} {s.HalfLength:g9}",
    };

    public double DepthError(double share) => At(depthErrors, share);

    public double Excess(double share) => At(excesses, share);

    public double AngleError(double share) => At(angles, share);

    static double At(List<float> values, double share)
    {
        values.Sort();
        return values.Count == 0 ? 0 : values[Math.Min(values.Count - 1, (int)(share * values.Count))];
    }

    public const string Header = "| pair | regime | poses | contacts | depth p50 | p99 | p99.9 | worst | excess worst | normal p95 "
        + "| wrong | missed | unseen | ghosts | outside | farthest outside | broken |\n|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|";

    public string ToRow(string pair, string regime) => string.Create(CultureInfo.InvariantCulture,
        $"| {pair} | {regime} | {PoseCount} | {ContactCount} | {DepthError(.5):e1} | {DepthError(.99):e1} | {DepthError(.999):e1} "
        + $"| {DepthError(1):e1} | {Excess(1):e1} | {AngleError(.95):f2} | {WrongMinimumCount} | {MissedCount} | {UnseenCount} "
        + $"| {GhostCount} | {OutsideCount} | {WorstOutside:e1} | {BrokenCount} |");
}
