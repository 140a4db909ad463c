using System;
using System.Collections.Generic;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.CollisionDetection;
using BepuUtilities.Memory;
using Demos.References;
using DemoTests.Support;
using Xunit;
using Xunit.Abstractions;

namespace DemoTests.CollisionDetection.Sweeps;

/// <summary>Distances of all convex pairs against the reference, which enumerates features in double precision.</summary>
/// <remarks>PHYSICS_FULL_TESTS takes 2,000 placements per pair in place of 40.</remarks>
public sealed class PairDistanceTests(ITestOutputHelper output) : IDisposable
{
    const ulong Seed = 83;

    static readonly int placementCount = Environment.GetEnvironmentVariable("PHYSICS_FULL_TESTS") is { Length: > 0 } ? 2_000 : 40;

    readonly ConvexPairLibrary library = new();
    readonly BufferPool pool = new();
    readonly List<string> failures = [];
    double worst;
    int apartCount, overlapCount;

    public void Dispose()
    {
        library.Dispose();
        pool.AssertEmpty();
        pool.Clear();
    }

    public static TheoryData<ConvexKind, ConvexKind> Pairs() => PairSweepTests.Pairs();

    [Theory]
    [MemberData(nameof(Pairs))]
    public void Distances_normals_and_places_are_those_of_the_reference(ConvexKind a, ConvexKind b)
    {
        for (int i = 0; i < placementCount; ++i)
        {
            var random = new ConvexRandom(Seed, (ulong)(((int)a * 6 + (int)b) << 20 | i));
            var (sizeA, sizeB) = ConvexPoses.NextSizes(random);
            var shapeA = library.Create(ConvexGenerator.Create(a, ConvexGenerator.NextForm(random), sizeA, random));
            var shapeB = library.Create(ConvexGenerator.Create(b, ConvexGenerator.NextForm(random), sizeB, random));
            var reach = shapeA.Shape.OuterRadius + shapeA.Shape.Middle.Length + shapeB.Shape.OuterRadius + shapeB.Shape.Middle.Length;
            var offset = random.NextDirection() * (reach * random.NextLogarithmic(0.1, 10));
            var pair = new MovingPair(
                shapeA, shapeB, ConvexGenerator.ToVector(offset), random.NextOrientation(), random.NextOrientation(), default, default);
            Check(pair, $"{i}");
        }
        output.WriteLine($"{a}-{b}: {apartCount} apart, {overlapCount} overlap; distances off by {worst:e1} of the smaller size at most");
        foreach (var failure in failures)
            output.WriteLine(failure);
        Assert.Empty(failures);
    }

    void Check(MovingPair pair, string name)
    {
        var reference = new SweepReference(pair);
        var expected = reference.Distance(0);
        // By how much a plane may leave less, what lengths lose in double precision, and the vertices of a hull, which are floats about its middle.
        var isHull = pair.A.Shape.Kind == ConvexKind.Hull || pair.B.Shape.Kind == ConvexKind.Hull;
        var rounding = reference.Size * 1e-9 + expected * 2e-10 + reference.Reach * (isHull ? 2e-7 : 1e-11);
        var exists = Find(pair, double.PositiveInfinity, out var found);
        if (!exists)
        {
            failures.Add($"{name}: nothing, where the distance is {expected}");
            return;
        }
        if (found.Overlaps)
        {
            ++overlapCount;
            if (expected > rounding)
                failures.Add($"{name}: an overlap at {expected / reference.Size:e2} of the size");
            return;
        }
        ++apartCount;
        var error = Math.Abs(found.Distance - expected);
        worst = Math.Max(worst, error / reference.Size);
        if (error > rounding)
            failures.Add($"{name}: {found.Distance} in place of {expected}");
        CheckNormal(reference, found, expected, rounding, name);
        if (Find(pair, expected - 2 * rounding, out _) || !Find(pair, expected + 2 * rounding, out _))
            failures.Add($"{name}: a greatest distance next to {expected} does not decide");
    }

    // The gap along the normal is the distance, as nearly as the direction is right; and the place is on B, as far from A as that.
    void CheckNormal(SweepReference reference, in ShapeDistance found, double expected, double rounding, string name)
    {
        var normal = new Double3(found.Normal.X, found.Normal.Y, found.Normal.Z);
        var place = new Double3(found.Place.X, found.Place.Y, found.Place.Z);
        var gap = reference.GapAlong(normal, 0);
        if (Math.Abs(normal.Length - 1) > 1e-12 || gap < expected - rounding - 1e-9 * expected)
            failures.Add($"{name}: along the normal the gap is {gap}, not {expected}");
        // Where both are round, the place is off by the root of what the distance may be off.
        var tolerance = reference.Reach * 1e-6;
        var onB = reference.DistanceFromB(place, 0);
        var fromA = reference.DistanceFromA(place, 0) - expected;
        if (Math.Abs(onB) > tolerance || Math.Abs(fromA) > tolerance)
            failures.Add($"{name}: the place is {onB} off B, and {fromA} farther from A than B is");
    }

    static unsafe bool Find(MovingPair pair, double maximum, out ShapeDistance found)
    {
        fixed (byte* bytesA = pair.A.Bytes, bytesB = pair.B.Bytes)
        {
            var a = Body(pair.A, bytesA, pair.OrientationA);
            var b = Body(pair.B, bytesB, pair.OrientationB);
            return ImpactPair.FindDistance(ref a, ref b, new(pair.OffsetB), maximum, out found);
        }

        static ImpactBody Body(ConvexPairShape shape, byte* bytes, Quaternion orientation) =>
            new(ImpactCore.Of((int)shape.Shape.Kind, bytes), RigidPose.Identity, DoubleMatrix3x3.FromQuaternion(orientation), default);
    }
}
