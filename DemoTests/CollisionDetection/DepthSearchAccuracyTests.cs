using System;
using System.Collections.Generic;
using System.Linq;
using System.Numerics;
using BepuUtilities.Memory;
using Demos.References;
using DemoTests.Support;
using Xunit;
using Xunit.Abstractions;

namespace DemoTests.CollisionDetection;

/// <summary>Depth, normal and witnesses of single searches against the reference. PHYSICS_FULL_TESTS: many more pairs, of another seed.</summary>
public class DepthSearchAccuracyTests(ITestOutputHelper output)
{
    // Parts of the smaller size: what a result may be above the least depth, and a contact point off the surface by.
    const double Excess = 2.5e-4;
    const double LimitExcess = 1e-3;
    const double StopTolerance = 2.1e-5;
    // Part of the larger size that is lost to rounding.
    const double Rounding = 2e-6;

    static bool IsFull => Environment.GetEnvironmentVariable("PHYSICS_FULL_TESTS") is { Length: > 0 };

    static ulong Seed => IsFull ? ConvexPoses.VerificationSeed : ConvexPoses.DevelopmentSeed;

    public static TheoryData<ConvexKind, ConvexKind> Pairs
    {
        get
        {
            var data = new TheoryData<ConvexKind, ConvexKind>();
            foreach (var a in Enum.GetValues<ConvexKind>())
            {
                foreach (var b in Enum.GetValues<ConvexKind>().Where(b => b >= a))
                    data.Add(a, b);
            }
            return data;
        }
    }

    [Theory, MemberData(nameof(Pairs))]
    public void Depth_is_the_least_of_all_directions(ConvexKind kindA, ConvexKind kindB)
    {
        foreach (var regime in Enum.GetValues<ConvexRegime>())
        {
            using var pool = new BufferPool();
            var random = new ConvexRandom(Seed, (ulong)(((int)kindA * 6 + (int)kindB) * 6 + (int)regime));
            List<DepthSearchShape> a = [], b = [];
            List<ConvexCase> cases = [];
            for (int i = 0; i < (IsFull ? 1000 : 30); ++i)
            {
                var (sizeA, sizeB) = ConvexPoses.NextSizes(random);
                a.Add(DepthSearchShapes.Create(kindA, ConvexGenerator.NextForm(random), sizeA, random, pool));
                b.Add(DepthSearchShapes.Create(kindB, ConvexGenerator.NextForm(random), sizeB, random, pool));
                cases.Add(ConvexPoses.Create(a[i].Reference, b[i].Reference, regime, random));
            }
            Check($"{kindA} {kindB} {regime}", a, b, cases);
        }
    }

    // Around the larger cylinder's side, all ways out are nearly as short, and far more of them differ by a part of the smaller shape than a polytope
    // of the two has room for.
    [Theory]
    [InlineData(0.683455f, 0.16448f, 56.7085f, 64.4052f, -0.00025990984f, -7.004363E-05f, -0.00011547682f, 0.9459051f, -0.3129194f, -0.08529084f, 0.008397264f)]
    [InlineData(27.576f, 40.2435f, 0.791274f, 0.0128215f, -8e-8f, -4.5e-7f, 1.9e-7f, -0.9623395f, -0.08902566f, -0.24247198f, 0.08476069f)]
    [InlineData(0.141951f, 0.238886f, 0.00265397f, 0.00226726f, 2.7e-9f, -1.1e-9f, -4.2e-9f, -0.9781452f, 0.048878934f, 0.20071477f, -0.023587916f)]
    [InlineData(0.5f, 0.25f, 30, 50, 0, 0, 0, 0, 0, 0, 1)]
    [InlineData(0.5f, 0.25f, 50, 50, 0, 0, 0, 0, 0, 0.1f, 0.99498744f)]
    public void Small_cylinders_inside_of_large_ones_find_the_least_depth(float radiusA, float halfLengthA, float radiusB, float halfLengthB,
        float offsetX, float offsetY, float offsetZ, float x, float y, float z, float w)
    {
        using var pool = new BufferPool();
        var a = DepthSearchShapes.Create(ConvexShape.Cylinder(radiusA, 2 * halfLengthA), pool);
        var b = DepthSearchShapes.Create(ConvexShape.Cylinder(radiusB, 2 * halfLengthB), pool);
        var pose = new ConvexPose(new(offsetX, offsetY, offsetZ), Quaternion.Identity, new(x, y, z, w));
        Check("Cylinder Cylinder", [a], [b], [ConvexPoses.Measure(a.Reference, b.Reference, pose)]);
    }

    [Fact]
    public void Round_shapes_that_overlap_a_little_seldom_need_a_polytope()
    {
        const int Count = 96;
        using var pool = new BufferPool();
        var random = new ConvexRandom(Seed, 1);
        List<DepthSearchShape> a = [], b = [];
        List<ConvexCase> cases = [];
        for (int i = 0; i < Count; ++i)
        {
            a.Add(DepthSearchShapes.Create(ConvexKind.Cylinder, ConvexForm.Fat, 1, random, pool));
            b.Add(DepthSearchShapes.Create(ConvexKind.Cylinder, ConvexForm.Fat, 1, random, pool));
            cases.Add(ConvexPoses.Create(a[i].Reference, b[i].Reference, ConvexRegime.Shallow, random));
        }
        var outcomes = DepthSearchShape.Find(a, b, [.. cases.Select(SearchPlace.Of)], [.. cases.Select(_ => 0.1f)]);
        output.WriteLine($"{outcomes.Sum(o => o.Freed)} by tetrahedra, {outcomes.Sum(o => o.Expansions)} by polytopes, of {Count}");
        Assert.InRange(outcomes.Sum(o => o.Expansions), 0, Count / 3);
    }

    void Check(string name, List<DepthSearchShape> a, List<DepthSearchShape> b, List<ConvexCase> cases)
    {
        var margins = cases.Select(c => (float)(ConvexPoses.Margin * c.Reference.Size)).ToArray();
        var outcomes = DepthSearchShape.Find(a, b, [.. cases.Select(SearchPlace.Of)], margins);
        var excesses = new List<double>();
        for (int i = 0; i < cases.Count; ++i)
        {
            var (reference, _, offset, expected) = cases[i];
            var outcome = outcomes[i];
            var reach = Math.Max(reference.LargerSize, Math.Max(offset.Length, Math.Max(reference.A.Middle.Length, reference.B.Middle.Length)));
            var rounding = Rounding * reach;
            var label = $"{name} {i}: {outcome}, expected {expected.Depth} along {expected.Normal}, size {reference.Size}";
            if (Math.Abs(expected.Depth + margins[i]) > rounding)
                Assert.True(outcome.Near == expected.Depth > -margins[i], label);
            if (!outcome.Near)
                continue;
            Double3 normal = outcome.Normal;
            Assert.True(Math.Abs(normal.Length - 1) < 1e-6, label);
            normal *= 1 / normal.Length;
            var along = reference.DepthAlong(normal, offset);
            Assert.True(Math.Abs(outcome.Depth - along) < rounding, label);
            var excess = along - expected.Depth;
            excesses.Add((excess - rounding) / reference.Size);
            // Where a search came to its limit: still far from what is wrong.
            var allowed = outcome.Limits > 0 ? LimitExcess : Excess;
            Assert.True(excess < allowed * reference.Size + rounding, $"{label}: {excess} too deep");
            CheckWitness(reference, offset, outcome, normal, rounding, label);
        }
        excesses.Sort();
        if (excesses.Count == 0)
            return;
        output.WriteLine($"{name,-32} n {excesses.Count,5}  excess p50 {excesses[excesses.Count / 2]:E1} " +
            $"p99 {excesses[(int)(excesses.Count * 0.99)]:E1} max {excesses[^1]:E1}  " +
            $"evaluations mean {outcomes.Average(o => o.Evaluations):F1} max {outcomes.Max(o => o.Evaluations)} " +
            $"caps {outcomes.Sum(o => o.Caps)}  tetrahedra {outcomes.Sum(o => o.Freed)} of {outcomes.Sum(o => o.Tried)}  " +
            $"expansions {outcomes.Sum(o => o.Expansions)} of {outcomes.Sum(o => o.ExpansionEvaluations)} evaluations, " +
            $"limits {outcomes.Sum(o => o.Limits)}");
    }

    // The descent stops at a distance from its target. Where the cores are apart, a target is that close at an angle, too.
    static void CheckWitness(ConvexReference reference, Double3 offset, in SearchOutcome outcome, Double3 normal, double rounding, string label)
    {
        // One descent in a hundred of deep cylinders ends at its limit: a little farther away.
        var tolerance = (outcome.Caps > 0 ? Excess : StopTolerance) * reference.Size + rounding;
        Double3 onA = outcome.PointOnA;
        CheckOn(reference.A, onA, tolerance, label);
        var onB = reference.Rotation.RotateBack(onA + normal * outcome.Depth - offset);
        var apart = Math.Max(0, reference.A.Rounding + reference.B.Rounding - outcome.Depth);
        tolerance += Math.Sqrt(2 * tolerance * apart);
        CheckOn(reference.B, onB, tolerance, label);
    }

    static void CheckOn(ConvexShape shape, Double3 point, double tolerance, string label)
    {
        var distance = shape.SignedDistance(point);
        Assert.True(Math.Abs(distance) < tolerance, $"{label}: {point} is {distance} off the {shape.Kind}, allowed {tolerance}");
    }
}
