using System;
using System.Linq;
using System.Threading.Tasks;
using BepuPhysics.CollisionDetection;
using Demos.References;
using DemoTests.Support;
using Xunit;
using Xunit.Abstractions;

namespace DemoTests.CollisionDetection;

/// <summary>Pairs that move slowly: normals jump no more than the reference's own (case N2), even when nothing is known from before.</summary>
public class ConvexPairSequenceTests(ITestOutputHelper output)
{
    static readonly bool isFull = Environment.GetEnvironmentVariable("PHYSICS_FULL_TESTS") is { Length: > 0 };

    [Theory]
    [MemberData(nameof(ConvexPairTests.RegisteredPairs), MemberType = typeof(ConvexPairTests))]
    public void Normals_of_slow_pairs_do_not_flip(ConvexKind a, ConvexKind b)
    {
        var sequenceCount = isFull ? 200 : 6;
        using var library = new ConvexPairLibrary();
        var random = new ConvexRandom(ConvexPairTests.Seed, (ulong)((int)a * 6 + (int)b) << 40);
        var shapes = new (ConvexPairShape A, ConvexPairShape B)[sequenceCount];
        for (int i = 0; i < sequenceCount; ++i)
        {
            var shapeA = library.Create(ConvexGenerator.Create(a, ConvexGenerator.NextForm(random), 1, random));
            shapes[i] = (shapeA, library.Create(ConvexGenerator.Create(b, ConvexGenerator.NextForm(random), 1, random)));
        }
        var sequences = new ConvexCase[sequenceCount][];
        Parallel.For(0, sequenceCount, i => sequences[i] = ConvexSequence.Create(shapes[i].A.Shape, shapes[i].B.Shape,
            i % 2 == 0 ? ConvexRegime.Shallow : ConvexRegime.Deep, new(ConvexPairTests.Seed + 1, (ulong)i)));

        var found = new ConvexSequenceTally();
        for (int i = 0; i < sequenceCount; ++i)
        {
            var pairs = sequences[i].Select(frame => (shapes[i].A, shapes[i].B, frame.Pose, Margin(frame))).ToArray();
            var manifolds = library.Run(pairs);
            found.Restart();
            for (int j = 0; j < manifolds.Length; ++j)
            {
                if (manifolds[j].Count > 0)
                    found.Add(sequences[i][j], manifolds[j].Normal, Enumerable.Range(0, manifolds[j].Count).Max(manifolds[j].GetDepth));
                else
                    found.Add(sequences[i][j], null, 0);
            }
        }
        Report(ConvexPairTable.Sequences, a, b, $"| {a}-{b} | contacts | none | {found.ToRow()}");
        Assert.Equal((0, 0, 0), (found.MissedCount, found.SuboptimalCount, found.JumpCount));
        // A tie may fall a frame earlier or later, and then be told twice.
        Assert.True(found.FlipCount <= found.ReferenceFlipCount + found.FrameCount / 1000, found.ToString());

        if (ConvexPairLibrary.Searches(a, b))
            Search(a, b, shapes, sequences);
    }

    /// <summary>The same with states that are kept, as a simulation does.</summary>
    void Search(ConvexKind a, ConvexKind b, (ConvexPairShape A, ConvexPairShape B)[] shapes, ConvexCase[][] sequences)
    {
        ConvexPairEffort cold = new(), warm = new();
        var states = new DepthSearchState[shapes.Length];
        DepthSearchShape[] shapesA = [.. shapes.Select(pair => pair.A.Search)], shapesB = [.. shapes.Select(pair => pair.B.Search)];
        var outcomes = new SearchOutcome[ConvexSequence.FrameCount][];
        for (int j = 0; j < outcomes.Length; ++j)
        {
            SearchPlace[] places = [.. sequences.Select(sequence => SearchPlace.Of(sequence[j]))];
            float[] margins = [.. sequences.Select(sequence => Margin(sequence[j]))];
            outcomes[j] = DepthSearchShape.Find(shapesA, shapesB, places, margins, states);
            foreach (var outcome in DepthSearchShape.Find(shapesA, shapesB, places, margins))
                cold.Add(outcome);
            // Nothing is kept from before the first frame.
            foreach (var outcome in j > 0 ? outcomes[j] : [])
                warm.Add(outcome);
        }
        var tally = new ConvexSequenceTally();
        for (int i = 0; i < sequences.Length; ++i)
        {
            tally.Restart();
            for (int j = 0; j < outcomes.Length; ++j)
            {
                var outcome = outcomes[j][i];
                Double3 normal = ConvexRotation.From(sequences[i][j].Pose.OrientationA).Rotate(outcome.Normal);
                tally.Add(sequences[i][j], outcome.Near ? normal : null, outcome.Depth);
            }
        }
        Report(ConvexPairTable.SequenceEffort, a, b, $"| {a}-{b} | none | {cold}\n| {a}-{b} | kept | {warm}");
        Report(ConvexPairTable.Sequences, a, b, $"| {a}-{b} | searches | kept | {tally.ToRow()}", "kept");
        Assert.Equal(0, tally.MissedCount);
        // What is kept is left only for what is better by a twentieth, so that normals flip less often than the best one; a pair that has
        // become deeper by a quarter at once leaves it.
        Assert.True(tally.FlipCount <= tally.ReferenceFlipCount + tally.FrameCount / 1000, tally.ToString());
        Assert.True(warm.Mean < cold.Mean, $"{warm.Mean} evaluations, {cold.Mean} without states");
    }

    static float Margin(ConvexCase frame) => (float)(ConvexPoses.Margin * frame.Reference.Size);

    void Report(ConvexPairTable table, ConvexKind a, ConvexKind b, string rows, string suffix = "")
    {
        output.WriteLine(rows);
        ConvexPairReport.Add(table, $"{(int)a}{(int)b}{suffix}", rows);
    }
}
