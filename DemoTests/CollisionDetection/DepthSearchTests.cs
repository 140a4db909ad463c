using System;
using System.Collections.Generic;
using System.Linq;
using System.Numerics;
using BepuPhysics.CollisionDetection;
using BepuUtilities.Memory;
using Demos.References;
using DemoTests.Support;
using Xunit;
using Xunit.Abstractions;

namespace DemoTests.CollisionDetection;

/// <summary>What a depth search keeps, what it may depend on, and what it answers where there is no one answer.</summary>
public class DepthSearchTests(ITestOutputHelper output)
{
    static readonly (ConvexKind A, ConvexKind B)[] mixedPairs =
    [
        (ConvexKind.Box, ConvexKind.Box), (ConvexKind.Box, ConvexKind.Hull), (ConvexKind.Hull, ConvexKind.Hull),
        (ConvexKind.Cylinder, ConvexKind.Hull), (ConvexKind.Capsule, ConvexKind.Cylinder), (ConvexKind.Triangle, ConvexKind.Cylinder),
        (ConvexKind.Sphere, ConvexKind.Triangle), (ConvexKind.Capsule, ConvexKind.Triangle),
    ];

    // Where the rim of a cylinder rolls, the simplex is left behind every few frames.
    [Theory]
    [InlineData(ConvexKind.Box, ConvexKind.Hull, ConvexForm.Fat, 1.1)]
    [InlineData(ConvexKind.Hull, ConvexKind.Hull, ConvexForm.Fat, 1.1)]
    [InlineData(ConvexKind.Box, ConvexKind.Box, ConvexForm.Flat, 1.1)]
    [InlineData(ConvexKind.Hull, ConvexKind.Hull, ConvexForm.Slender, 1.2)]
    [InlineData(ConvexKind.Cylinder, ConvexKind.Box, ConvexForm.Fat, 2)]
    [InlineData(ConvexKind.Cylinder, ConvexKind.Cylinder, ConvexForm.Fat, 2)]
    [InlineData(ConvexKind.Triangle, ConvexKind.Hull, ConvexForm.Fat, 1.1)]
    public void Slow_pairs_take_one_evaluation_and_keep_their_normal(ConvexKind kindA, ConvexKind kindB, ConvexForm form, double evaluations)
    {
        using var pool = new BufferPool();
        var tally = new ConvexSequenceTally();
        List<int> counts = [];
        var expansions = 0;
        for (int i = 0; i < 9; ++i)
        {
            var random = new ConvexRandom(ConvexPoses.DevelopmentSeed, (ulong)(1000 + i));
            var a = DepthSearchShapes.Create(kindA, form, 1, random, pool);
            var b = DepthSearchShapes.Create(kindB, form, 1, random, pool);
            var start = (ConvexRegime[])[ConvexRegime.Shallow, ConvexRegime.Touching, ConvexRegime.Deep];
            var states = new DepthSearchState[1];
            tally.Restart();
            foreach (var frame in ConvexSequence.Create(a.Reference, b.Reference, start[i % 3], random))
            {
                var isFirst = states[0].Direction == default;
                var outcome = DepthSearchShape.Find([a], [b], [SearchPlace.Of(frame)], [0.1f], states)[0];
                Double3 normal = ConvexRotation.From(frame.Pose.OrientationA).Rotate(outcome.Normal);
                tally.Add(frame, outcome.Near ? normal : null, outcome.Depth);
                if (isFirst)
                    continue;
                counts.Add(outcome.Evaluations);
                expansions += outcome.Expansions;
            }
        }
        output.WriteLine($"{kindA} {kindB} {form}: evaluations mean {counts.Average():F3} max {counts.Max()}, expansions {expansions}; {tally}");
        Assert.InRange(counts.Average(), 1, evaluations);
        Assert.InRange(tally.FlipCount, 0, tally.ReferenceFlipCount + 1);
        Assert.Equal(0, tally.MissedCount);
        Assert.InRange(tally.SuboptimalCount, 0, tally.FrameCount / (form == ConvexForm.Slender ? 20 : 100));
    }

    [Fact]
    public void Lanes_do_not_depend_on_their_neighbours()
    {
        foreach (var (kindA, kindB) in mixedPairs)
        {
            using var pool = new BufferPool();
            var random = new ConvexRandom(7, (ulong)kindA * 8 + (ulong)kindB);
            var (a, b, places, margins) = CreateMixed(kindA, kindB, 40, random, pool);
            var states = new DepthSearchState[a.Count];
            var expected = DepthSearchShape.Find(a, b, places, margins, states);
            for (int round = 0; round < 3; ++round)
            {
                // Among garbage, in another order.
                var slots = Enumerable.Range(0, a.Count * 3).OrderBy(_ => random.Next()).Take(a.Count).ToArray();
                var otherStates = new DepthSearchState[a.Count];
                var outcomes = DepthSearchShape.Find(a, b, places, margins, otherStates, slots);
                Assert.Equal(expected, outcomes);
                Assert.Equal(Bits(expected), Bits(outcomes));
                Assert.Equal(states, otherStates);
            }
            // And with states.
            var again = DepthSearchShape.Find(a, b, places, margins, [.. states]);
            var shuffled = Enumerable.Range(0, a.Count).OrderBy(_ => random.Next()).ToArray();
            Assert.Equal(again, DepthSearchShape.Find(a, b, places, margins, [.. states], shuffled));
        }
    }

    // Equal numbers may be zeros of different signs.
    static int[] Bits(SearchOutcome[] outcomes) => [.. outcomes.Where(outcome => outcome.Near).SelectMany<SearchOutcome, float>(outcome =>
    [
        outcome.Depth, outcome.Normal.X, outcome.Normal.Y, outcome.Normal.Z, outcome.PointOnA.X, outcome.PointOnA.Y, outcome.PointOnA.Z,
    ]).Select(BitConverter.SingleToInt32Bits)];

    [Fact]
    public void Remembered_pairs_keep_their_simplex_beside_new_ones()
    {
        foreach (var (kindA, kindB) in mixedPairs.Append((ConvexKind.Cylinder, ConvexKind.Cylinder)).Append((ConvexKind.Box, ConvexKind.Cylinder)))
        {
            using var pool = new BufferPool();
            var random = new ConvexRandom(13, (ulong)kindA * 8 + (ulong)kindB);
            var (a, b, places, margins) = CreateMixed(kindA, kindB, 64, random, pool);
            var states = new DepthSearchState[a.Count];
            DepthSearchShape.Find(a, b, places, margins, states);
            for (int i = 0; i < states.Length; i += 2)
                states[i] = default;
            // Each in a bundle of its own.
            DepthSearchState[] aloneStates = [.. states];
            int[] slots = [.. Enumerable.Range(0, a.Count).Select(i => i * Vector<float>.Count)];
            var alone = DepthSearchShape.Find(a, b, places, margins, aloneStates, slots);
            var together = DepthSearchShape.Find(a, b, places, margins, states);
            Assert.Equal(alone, together);
            Assert.Equal(Bits(alone), Bits(together));
            Assert.Equal(aloneStates, states);
        }
    }

    [Fact]
    public void A_remembered_simplex_is_sound_wherever_the_shapes_go()
    {
        foreach (var (kindA, kindB) in mixedPairs)
        {
            using var pool = new BufferPool();
            var random = new ConvexRandom(11, (ulong)kindA * 8 + (ulong)kindB);
            var (a, b, places, margins) = CreateMixed(kindA, kindB, 32, random, pool);
            var states = new DepthSearchState[a.Count];
            DepthSearchShape.Find(a, b, places, margins, states);
            // Each shape finds itself where another pair was; what it remembers helps little, and must not harm.
            for (int i = 0; i < a.Count; ++i)
            {
                var found = ConvexPoses.Create(a[i].Reference, b[i].Reference, ConvexRegime.Shallow, random);
                var state = states.AsSpan(i, 1).ToArray();
                state[0].CertifiedDepth = 0;
                var outcome = DepthSearchShape.Find([a[i]], [b[i]], [SearchPlace.Of(found)], [margins[i]], state)[0];
                Assert.True(outcome.Near);
                var excess = outcome.Depth - found.Depth.Depth;
                // 5 % of the depth, and the slack, for a minimum that is kept.
                Assert.InRange(excess, -1e-5 * found.Reference.LargerSize,
                    0.06 * Math.Max(0, found.Depth.Depth) + 3e-4 * found.Reference.Size);
            }
        }
    }

    [Fact]
    public void Points_and_segments_have_a_direction_where_they_meet()
    {
        using var pool = new BufferPool();
        var sphere = DepthSearchShapes.Create(ConvexShape.Sphere(0.5f), pool);
        var capsule = DepthSearchShapes.Create(ConvexShape.Capsule(0.25f, 2), pool);
        var flat = DepthSearchShapes.Create(ConvexShape.Triangle(new(-1, 0, -1), new(2, 0, 0), new(-1, 0, 1)), pool);
        var quarter = new Quaternion(0, 0, MathF.Sqrt(0.5f), MathF.Sqrt(0.5f));
        // Coincident centres; a point on a segment, in its middle and off it; crossing, coincident and collinear segments; coplanar triangles.
        Check(sphere, sphere, default, Quaternion.Identity, 1);
        Check(sphere, capsule, default, Quaternion.Identity, 0.75f);
        Check(sphere, capsule, new(0, 0.5f, 0), Quaternion.Identity, 0.75f);
        Check(capsule, sphere, new(0, -0.9f, 0), quarter, 0.75f);
        Check(capsule, capsule, default, quarter, 0.5f);
        Check(capsule, capsule, default, Quaternion.Identity, 0.5f);
        Check(capsule, capsule, new(0, 0.5f, 0), Quaternion.Identity, 0.5f);
        Check(flat, flat, default, Quaternion.Identity, 0);
        Check(flat, flat, new(0.3f, 0, 0.2f), Quaternion.Identity, 0);
        Check(sphere, flat, default, Quaternion.Identity, 0.5f);
        Check(capsule, flat, default, quarter, 0.25f);
    }

    static void Check(DepthSearchShape a, DepthSearchShape b, Vector3 offset, Quaternion orientation, float depth)
    {
        var outcome = DepthSearchShape.Find([a], [b], [new(offset, orientation)], [0.1f])[0];
        Assert.True(outcome.Near);
        Assert.InRange(outcome.Depth, depth - 1e-6f, depth + 2e-5f);
        Assert.InRange(outcome.Normal.Length(), 0.999999f, 1.000001f);
        Assert.InRange(Math.Abs(a.Reference.SignedDistance(outcome.PointOnA)), 0, 1e-6);
    }

    static (List<DepthSearchShape> A, List<DepthSearchShape> B, List<SearchPlace> Places, float[] Margins) CreateMixed(
        ConvexKind kindA, ConvexKind kindB, int count, ConvexRandom random, BufferPool pool)
    {
        List<DepthSearchShape> a = [], b = [];
        List<SearchPlace> places = [];
        var margins = new float[count];
        var regimes = Enum.GetValues<ConvexRegime>();
        for (int i = 0; i < count; ++i)
        {
            a.Add(DepthSearchShapes.Create(kindA, ConvexGenerator.NextForm(random), 1, random, pool));
            b.Add(DepthSearchShapes.Create(kindB, ConvexGenerator.NextForm(random), 1, random, pool));
            var found = ConvexPoses.Create(a[i].Reference, b[i].Reference, regimes[i % regimes.Length], random);
            places.Add(SearchPlace.Of(found));
            margins[i] = (float)(ConvexPoses.Margin * found.Reference.Size);
        }
        return (a, b, places, margins);
    }
}
