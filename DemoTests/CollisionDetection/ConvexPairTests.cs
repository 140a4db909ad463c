using System;
using System.Collections.Generic;
using System.Linq;
using System.Threading.Tasks;
using DemoTests.Support;
using Xunit;
using Xunit.Abstractions;

namespace DemoTests.CollisionDetection;

/// <summary>All convex pairs that the library tests, in all regimes, against the reference.</summary>
/// <remarks>
/// PHYSICS_FULL_TESTS takes 100,000 poses per pair in place of 1,800, PHYSICS_CONVEX_POSES as many as it says.
/// PHYSICS_CONVEX_SEEDS=verification takes the seeds that are kept for the final check.
/// </remarks>
public class ConvexPairTests(ITestOutputHelper output)
{
    const int ShapesPerBlock = 12;
    const int PosesPerShapes = 5;
    const int BlockSize = ShapesPerBlock * PosesPerShapes;

    static readonly bool isFull = Environment.GetEnvironmentVariable("PHYSICS_FULL_TESTS") is { Length: > 0 };

    internal static ulong Seed => Environment.GetEnvironmentVariable("PHYSICS_CONVEX_SEEDS") == "verification"
        ? ConvexPoses.VerificationSeed
        : ConvexPoses.DevelopmentSeed;

    static int BlocksPerRegime => PoseCount / 6 / BlockSize + (isFull ? 1 : 0);

    static int PoseCount =>
        int.TryParse(Environment.GetEnvironmentVariable("PHYSICS_CONVEX_POSES"), out var count) ? count : isFull ? 100_000 : 1_800;

    public static TheoryData<ConvexKind, ConvexKind> RegisteredPairs()
    {
        var data = new TheoryData<ConvexKind, ConvexKind>();
        foreach (var a in Enum.GetValues<ConvexKind>())
        {
            foreach (var b in Enum.GetValues<ConvexKind>())
            {
                if (a <= b && ConvexPairLibrary.Supports(a, b))
                    data.Add(a, b);
            }
        }
        return data;
    }

    [Theory]
    [MemberData(nameof(RegisteredPairs))]
    public void Contacts_agree_with_the_reference(ConvexKind a, ConvexKind b)
    {
        var rows = new List<string>();
        var effortRows = new List<string>();
        var failures = new List<string>();
        foreach (var regime in Enum.GetValues<ConvexRegime>())
        {
            var (tally, effort) = Measure(a, b, regime);
            rows.Add(tally.ToRow($"{a}-{b}", regime.ToString()));
            if (effort.SearchCount > 0)
                effortRows.Add($"| {a}-{b} | {regime} | {effort}");
            failures.AddRange(Failures(tally).Select(failure => $"{regime}: {failure}; worst: {tally.WorstPose}"));
        }
        output.WriteLine($"{ConvexPairTally.Header}\n{string.Join('\n', rows)}\n{string.Join('\n', effortRows)}");
        ConvexPairReport.Add(ConvexPairTable.Errors, $"{(int)a}{(int)b}", string.Join('\n', rows));
        if (effortRows.Count > 0)
            ConvexPairReport.Add(ConvexPairTable.Effort, $"{(int)a}{(int)b}", string.Join('\n', effortRows));
        foreach (var failure in failures)
            output.WriteLine(failure);
        Assert.Empty(failures);
    }

    static IEnumerable<string> Failures(ConvexPairTally tally)
    {
        if (tally.WrongMinimumCount > 0)
            yield return $"{tally.WrongMinimumCount} wrong minima";
        if (tally.MissedCount > 0)
            yield return $"{tally.MissedCount} missed";
        if (tally.UnseenCount > 0)
            yield return $"{tally.UnseenCount} within the margin without a contact";
        if (tally.GhostCount > 0)
            yield return $"{tally.GhostCount} ghosts";
        if (tally.BrokenCount > 0)
            yield return $"{tally.BrokenCount} broken manifolds";
        if (tally.OutsideCount > 0)
            yield return $"{tally.OutsideCount} contacts outside: {tally.WorstOutsidePose}";
        if (tally.DepthError(.99) > ConvexPairTally.Tolerance)
            yield return $"depth p99 {tally.DepthError(.99):e1}";
        if (tally.Excess(.99) > ConvexPairTally.Tolerance)
            yield return $"excess p99 {tally.Excess(.99):e1}";
        if (tally.AngleError(.95) > 5)
            yield return $"normal p95 {tally.AngleError(.95):f1} degrees";
        if (tally.BelowReference > 1e-6)
            yield return $"the reference is too large by {tally.BelowReference:e1}: {tally.WorstBelowPose}";
    }

    static (ConvexPairTally Tally, ConvexPairEffort Effort) Measure(ConvexKind a, ConvexKind b, ConvexRegime regime)
    {
        var tally = new ConvexPairTally();
        var effort = new ConvexPairEffort();
        for (int block = 0; block < BlocksPerRegime; ++block)
        {
            // Everything of a block comes from its own stream of random numbers, so threads cannot change it.
            var stream = (ulong)(((int)a * 6 + (int)b) * 6 + (int)regime) << 32 | (uint)block << 8;
            using var library = new ConvexPairLibrary();
            var random = new ConvexRandom(Seed, stream);
            var shapes = new (ConvexPairShape A, ConvexPairShape B)[ShapesPerBlock];
            for (int i = 0; i < shapes.Length; ++i)
            {
                var (sizeA, sizeB) = ConvexPoses.NextSizes(random);
                var shapeA = library.Create(ConvexGenerator.Create(a, ConvexGenerator.NextForm(random), sizeA, random));
                shapes[i] = (shapeA, library.Create(ConvexGenerator.Create(b, ConvexGenerator.NextForm(random), sizeB, random)));
            }
            var cases = new ConvexCase[BlockSize];
            Parallel.For(0, BlockSize, i =>
            {
                var (shapeA, shapeB) = shapes[i / PosesPerShapes];
                cases[i] = ConvexPoses.Create(shapeA.Shape, shapeB.Shape, regime, new(Seed, stream + (uint)i + 1));
            });
            var pairs = cases.Select((pair, i) =>
            {
                var (shapeA, shapeB) = shapes[i / PosesPerShapes];
                return (shapeA, shapeB, pair.Pose, Margin(pair));
            }).ToArray();
            var manifolds = library.Run(pairs);
            for (int i = 0; i < BlockSize; ++i)
                tally.Add(cases[i], manifolds[i], Margin(cases[i]));
            if (!ConvexPairLibrary.Searches(a, b))
                continue;
            var searched = DepthSearchShape.Find([.. pairs.Select(pair => pair.shapeA.Search)], [.. pairs.Select(pair => pair.shapeB.Search)],
                [.. cases.Select(SearchPlace.Of)], [.. cases.Select(Margin)]);
            foreach (var outcome in searched)
                effort.Add(outcome);
        }
        return (tally, effort);
    }

    static float Margin(ConvexCase pair) => (float)(ConvexPoses.Margin * pair.Reference.Size);
}
