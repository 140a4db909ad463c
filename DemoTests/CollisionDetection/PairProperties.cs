using System;
using System.Collections.Generic;
using System.Linq;
using System.Numerics;
using System.Runtime.InteropServices;
using BepuPhysics.Collidables;
using BepuPhysics.CollisionDetection;
using Xunit;
using Xunit.Abstractions;

namespace DemoTests.CollisionDetection;

/// <summary>What must not change the contacts of a pair, whatever its shapes are.</summary>
static class PairProperties
{
    /// <summary>By what <see cref="RunTurned"/> turns pairs.</summary>
    public static readonly Quaternion Turn = Quaternion.Normalize(new(0.1f, -0.3f, 0.2f, 0.9f));

    public static float Deepest(this ConvexContactManifold manifold) => Enumerable.Range(0, manifold.Count).Max(manifold.GetDepth);

    /// <summary>Manifolds of pairs, and of the same pairs turned as a whole; those that have contacts both times.</summary>
    public static List<(ConvexContactManifold Before, ConvexContactManifold After)> RunTurned<TShapeA, TShapeB>(
        IReadOnlyList<PairCase<TShapeA, TShapeB>> cases, float margin)
        where TShapeA : unmanaged, IConvexShape where TShapeB : unmanaged, IConvexShape
    {
        var turned = cases.Select(x => x with
        {
            OffsetB = Vector3.Transform(x.OffsetB, Turn),
            OrientationA = Quaternion.Normalize(Turn * x.OrientationA),
            OrientationB = Quaternion.Normalize(Turn * x.OrientationB),
        }).ToArray();
        return [.. PairHarness.Run(cases, margin).Zip(PairHarness.Run(turned, margin)).Where(x => x.First.Count > 0 && x.Second.Count > 0)];
    }

    /// <summary>The same bits in any order, and whatever else is in the bundle. Returns the manifolds.</summary>
    public static ConvexContactManifold[] CheckPurity<TShapeA, TShapeB>(IReadOnlyList<PairCase<TShapeA, TShapeB>> cases, float margin)
        where TShapeA : unmanaged, IConvexShape where TShapeB : unmanaged, IConvexShape
    {
        var expected = PairHarness.Run(cases, margin);
        var random = new PairRandom(3);
        int[] order = [.. Enumerable.Range(0, cases.Count).OrderBy(_ => random.Next())];
        foreach (var flushInterval in new[] { int.MaxValue, 1, 5, 11 })
        {
            var actual = PairHarness.Run(cases, margin, order, flushInterval);
            for (int i = 0; i < cases.Count; ++i)
                Assert.Equal(Bits(expected[i]), Bits(actual[i]));
        }
        return expected;
    }

    // Contacts beyond the count mean nothing.
    static byte[] Bits(ConvexContactManifold manifold) =>
        MemoryMarshal.AsBytes(new ReadOnlySpan<ConvexContactManifold>(in manifold))[..(28 + manifold.Count * 20)].ToArray();

    /// <summary>Writes the median, the 99.9th percentile and the greatest of some errors, and leaves them sorted.</summary>
    public static void WriteErrors(this ITestOutputHelper output, string name, List<double> errors)
    {
        errors.Sort();
        output.WriteLine($"  {name,-30} {errors[errors.Count / 2],10:e1} {errors[(int)(errors.Count * 0.999)],10:e1} {errors[^1],10:e1}");
    }
}
