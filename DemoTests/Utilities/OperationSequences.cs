using System;
using System.Collections.Generic;
using FsCheck;
using FsCheck.Fluent;
using Microsoft.FSharp.Core;

namespace DemoTests.Utilities;

/// <summary>One step of a random test: what to do, and a number to do it with.</summary>
public readonly record struct Operation(int Kind, int Value);

/// <summary>Runs a body over random sequences of operations, the same ones each time, and shrinks a sequence that fails.</summary>
static class OperationSequences
{
    public static void Check(int kindCount, int maximumValue, Action<Operation[]> body, int sequenceCount = 200)
    {
        var operation = Gen.Choose(0, kindCount - 1).Zip(Gen.Choose(0, maximumValue), (kind, value) => new Operation(kind, value));
        var sequences = Arb.From(Gen.ArrayOf(operation), Shrink);
        var config = Config.QuickThrowOnFailure
            .WithMaxTest(sequenceCount)
            .WithStartSize(1)
            .WithEndSize(400)
            .WithReplay(FSharpOption<Replay>.Some(new Replay(new Rnd(20_250_731UL, 1_234_567UL), FSharpOption<int>.None)));
        FsCheck.Check.One(config, Prop.ForAll(sequences, body));
    }

    /// <summary>Shorter sequences to try: without each half, quarter and so on, down to single operations.</summary>
    static IEnumerable<Operation[]> Shrink(Operation[] sequence)
    {
        for (int length = sequence.Length / 2; length > 0; length /= 2)
        {
            for (int start = 0; start + length <= sequence.Length; start += length)
                yield return [.. sequence[..start], .. sequence[(start + length)..]];
        }
    }
}
