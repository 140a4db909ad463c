using System;
using System.Collections.Generic;
using System.Numerics;
using BepuPhysics.Collidables;
using BepuUtilities.Memory;
using Demos.References;
using DemoTests.Support;
using Xunit;
using Xunit.Abstractions;

namespace DemoTests.CollisionDetection.Sweeps;

/// <summary>Times of impact of all convex pairs against the reference.</summary>
/// <remarks>
/// PHYSICS_FULL_TESTS takes 480 motions per pair in place of 12, PHYSICS_SWEEP_MOTIONS as many as it says; PHYSICS_SWEEP_SEED others.
/// </remarks>
public sealed class PairSweepTests(ITestOutputHelper output) : IDisposable
{
    // What the library calls touching, by the size of the smaller shape.
    const double Touching = 1e-5;

    static readonly int motionCount = int.TryParse(Environment.GetEnvironmentVariable("PHYSICS_SWEEP_MOTIONS"), out var count) ? count
        : Environment.GetEnvironmentVariable("PHYSICS_FULL_TESTS") is { Length: > 0 } ? 480 : 12;

    static readonly ulong seed = ulong.TryParse(Environment.GetEnvironmentVariable("PHYSICS_SWEEP_SEED"), out var value) ? value : 71;

    readonly ConvexPairLibrary library = new();
    readonly BufferPool pool = new();
    readonly List<string> failures = [];
    readonly List<double> earliness = [];
    int hits, overlaps, misses;

    public void Dispose()
    {
        library.Dispose();
        pool.AssertEmpty();
        pool.Clear();
    }

    public static TheoryData<ConvexKind, ConvexKind> Pairs()
    {
        var data = new TheoryData<ConvexKind, ConvexKind>();
        foreach (var a in Enum.GetValues<ConvexKind>())
        {
            foreach (var b in Enum.GetValues<ConvexKind>())
            {
                if (a <= b)
                    data.Add(a, b);
            }
        }
        return data;
    }

    [Theory]
    [MemberData(nameof(Pairs))]
    public void No_impact_is_missed_late_or_false(ConvexKind a, ConvexKind b)
    {
        using var shapes = new DisposableShapes(pool);
        var kinds = Enum.GetValues<SweepMotionKind>();
        for (int i = 0; i < motionCount; ++i)
        {
            var random = new ConvexRandom(seed, (ulong)(((int)a * 6 + (int)b) << 20 | i));
            var (sizeA, sizeB) = ConvexPoses.NextSizes(random);
            var shapeA = library.Create(ConvexGenerator.Create(a, ConvexGenerator.NextForm(random), sizeA, random));
            var shapeB = library.Create(ConvexGenerator.Create(b, ConvexGenerator.NextForm(random), sizeB, random));
            var kind = kinds[i % kinds.Length];
            Check(MovingPairs.Create(shapeA, shapeB, kind, random), $"{i} {kind}", shapes.Shapes);
        }
        earliness.Sort();
        output.WriteLine($"{a}-{b}: {hits} hits, {overlaps} overlaps, {misses} misses; early by {Quantile(.5):e1} median, {Quantile(.99):e1} p99, " +
            $"{Quantile(1):e1} at most, of the way at the greatest speed over the size");
        foreach (var failure in failures)
            output.WriteLine(failure);
        Assert.Empty(failures);
    }

    double Quantile(double part) => earliness.Count == 0 ? 0 : earliness[(int)(part * (earliness.Count - 1))];

    void Check(MovingPair pair, string name, Shapes shapes)
    {
        var reference = new SweepReference(pair);
        var sweep = MovingPairs.Sweep(pair, shapes, pool);
        var least = reference.Size * 1e-5;
        var deepest = -reference.Size * 1e-7;
        if (sweep is { IsHit: true, Normal: var n } && n == Vector3.Zero)
        {
            ++overlaps;
            if (sweep.T != 0 || reference.Distance(0) > reference.Size * 1e-9)
                failures.Add($"{name}: an overlap at {reference.Distance(0) / reference.Size:e2} of the size");
            return;
        }
        var end = sweep.IsHit ? sweep.T : 1;
        if (reference.FirstWithin(0, end, deepest, least) is { } first)
            failures.Add($"{name}: {(sweep.IsHit ? "late" : "missed")}: {reference.Distance(first) / reference.Size:e2} at {first}, told at {end}");
        if (!sweep.IsHit)
        {
            ++misses;
            return;
        }
        ++hits;
        // A float is earlier than the double by no more than a unit in its last place.
        var rounding = reference.GreatestSpeed * (sweep.T - MathF.BitDecrement(sweep.T)) + reference.Size * 1e-9;
        var distance = reference.Distance(sweep.T);
        if (distance > reference.Size * Touching + rounding)
            failures.Add($"{name}: false: {distance / reference.Size:e2} of the size apart at {sweep.T}");
        if (reference.FirstWithin(sweep.T, 1, 0, least) is { } touch)
            earliness.Add((touch - sweep.T) * reference.GreatestSpeed / reference.Size);
        CheckNormal(pair, reference, sweep, name);
    }

    // A normal along which the shapes are nearly as far apart as they are: the gap along it tells.
    void CheckNormal(MovingPair pair, SweepReference reference, PairSweep sweep, string name)
    {
        if (MathF.Abs(sweep.Normal.LengthSquared() - 1) > 1e-5f)
            failures.Add($"{name}: a normal of length {sweep.Normal.Length()}");
        var gap = reference.GapAlong(sweep.Normal, sweep.T);
        var distance = reference.Distance(sweep.T);
        // What a unit in the last place of the time and of the normal make of it.
        var rounding = reference.GreatestSpeed * 2 * (sweep.T - MathF.BitDecrement(sweep.T)) + reference.Reach * 2e-7;
        if (gap < distance - reference.Size * 2e-6 - rounding)
            failures.Add($"{name}: along the normal the gap is {gap / reference.Size:e2} of the size, not {distance / reference.Size:e2}");
        var onB = reference.DistanceFromB(sweep.Place, sweep.T);
        var onA = reference.DistanceFromA(sweep.Place, sweep.T);
        var tolerance = reference.Size * 2e-5 + ((Double3)sweep.Place).Length * 1e-6 + reference.GreatestSpeed * sweep.T * 1e-6;
        if (Math.Abs(onB) > tolerance || Math.Abs(onA) > tolerance)
            failures.Add($"{name}: the place is {onA / reference.Size:e2} of the size off A, {onB / reference.Size:e2} off B");
    }
}
