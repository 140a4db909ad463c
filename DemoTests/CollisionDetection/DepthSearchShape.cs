using System;
using System.Collections.Generic;
using System.Linq;
using System.Numerics;
using System.Runtime.CompilerServices;
using BepuPhysics.Collidables;
using BepuPhysics.CollisionDetection;
using BepuUtilities;
using Demos.References;
using DemoTests.Support;

namespace DemoTests.CollisionDetection;

/// <summary>Counts what a search does, by lane.</summary>
struct LaneCounts : ISearchStatistics
{
    public Vector<int> Evaluations;
    public Vector<int> Caps;
    public Vector<int> Tried;
    public Vector<int> Freed;
    public Vector<int> Expansions;
    public Vector<int> ExpansionEvaluations;
    public Vector<int> Limits;

    public void Evaluated(Vector<int> mask) => Evaluations -= mask;

    public void Capped(Vector<int> mask) => Caps -= mask;

    public void TriedTetrahedron(Vector<int> triedMask, Vector<int> certifiedMask)
    {
        Tried -= triedMask;
        Freed -= certifiedMask;
    }

    public void EvaluatedRing(Vector<int> mask, int count) => ExpansionEvaluations -= mask * count;

    public void Expanded(int lane, int evaluations, ExpansionEnd end)
    {
        ++GatherScatter.Get(ref Expansions, lane);
        GatherScatter.Get(ref ExpansionEvaluations, lane) += evaluations;
        if (end == ExpansionEnd.Limit)
            ++GatherScatter.Get(ref Limits, lane);
    }
}

/// <summary>Where B is in A's frame.</summary>
readonly record struct SearchPlace(Vector3 Offset, Quaternion Orientation)
{
    public static SearchPlace Of(ConvexCase found)
    {
        var toA = (DoubleQuaternion)Quaternion.Conjugate(found.Pose.OrientationA);
        var orientation = DoubleQuaternion.Normalize(toA * found.Pose.OrientationB);
        return new(ConvexGenerator.ToVector(found.LocalOffsetB),
            new((float)orientation.X, (float)orientation.Y, (float)orientation.Z, (float)orientation.W));
    }
}

/// <summary>What a search returned for one pair, and what it took.</summary>
readonly record struct SearchOutcome(Vector3 Normal, float Depth, Vector3 PointOnA, bool Near, int Evaluations, int Caps, int Tried, int Freed,
    int Expansions, int ExpansionEvaluations, int Limits);

/// <summary>A shape for the library and for the reference.</summary>
abstract class DepthSearchShape(ConvexShape reference)
{
    public ConvexShape Reference { get; } = reference;

    /// <summary>Finds the depth of pairs of this as A, in bundles in the order given; shapes of one type on each side.</summary>
    /// <param name="a">Shape of A of each pair.</param>
    /// <param name="b">Shape of B of each pair.</param>
    /// <param name="places">Where B is.</param>
    /// <param name="margins">Speculative margin of each pair.</param>
    /// <param name="states">States of the pairs, kept.</param>
    /// <param name="slots">Place of each pair among lanes of bundles; others hold garbage. Null: in order.</param>
    public static SearchOutcome[] Find(IReadOnlyList<DepthSearchShape> a, IReadOnlyList<DepthSearchShape> b, IReadOnlyList<SearchPlace> places,
        float[] margins, DepthSearchState[]? states = null, int[]? slots = null) =>
        a[0].FindA(b[0], a, b, places, margins, states ?? new DepthSearchState[a.Count], slots ?? [.. Enumerable.Range(0, a.Count)]);

    protected abstract SearchOutcome[] FindA(DepthSearchShape firstB, IReadOnlyList<DepthSearchShape> a, IReadOnlyList<DepthSearchShape> b,
        IReadOnlyList<SearchPlace> places, float[] margins, DepthSearchState[] states, int[] slots);

    protected abstract SearchOutcome[] FindB<TShapeA, TShapeWideA, TSupportA>(IReadOnlyList<DepthSearchShape> a,
        IReadOnlyList<DepthSearchShape> b, IReadOnlyList<SearchPlace> places, float[] margins, DepthSearchState[] states, int[] slots)
        where TShapeA : unmanaged where TShapeWideA : unmanaged, IWide<TShapeA> where TSupportA : struct, ISupport<TShapeWideA>;

    public sealed class Typed<TShape, TShapeWide, TSupport>(TShape shape, ConvexShape reference)
        : DepthSearchShape(reference)
        where TShape : unmanaged where TShapeWide : unmanaged, IWide<TShape> where TSupport : struct, ISupport<TShapeWide>
    {
        public TShape Shape { get; } = shape;

        protected override SearchOutcome[] FindA(DepthSearchShape firstB, IReadOnlyList<DepthSearchShape> a, IReadOnlyList<DepthSearchShape> b,
            IReadOnlyList<SearchPlace> places, float[] margins, DepthSearchState[] states, int[] slots) =>
            firstB.FindB<TShape, TShapeWide, TSupport>(a, b, places, margins, states, slots);

        protected override SearchOutcome[] FindB<TShapeA, TShapeWideA, TSupportA>(IReadOnlyList<DepthSearchShape> a,
            IReadOnlyList<DepthSearchShape> b, IReadOnlyList<SearchPlace> places, float[] margins, DepthSearchState[] states, int[] slots)
        {
            var outcomes = new SearchOutcome[a.Count];
            var bySlot = new int[(slots.Max() / Vector<float>.Count + 1) * Vector<float>.Count];
            Array.Fill(bySlot, -1);
            for (int i = 0; i < slots.Length; ++i)
                bySlot[slots[i]] = i;
            for (int start = 0; start < bySlot.Length; start += Vector<float>.Count)
                FindBundle<TShapeA, TShapeWideA, TSupportA>(bySlot.AsSpan(start, Vector<float>.Count), a, b, places, margins, states, outcomes);
            return outcomes;
        }

        static void FindBundle<TShapeA, TShapeWideA, TSupportA>(ReadOnlySpan<int> pairs, IReadOnlyList<DepthSearchShape> a,
            IReadOnlyList<DepthSearchShape> b, IReadOnlyList<SearchPlace> places, float[] margins, DepthSearchState[] states,
            SearchOutcome[] outcomes)
            where TShapeA : unmanaged where TShapeWideA : unmanaged, IWide<TShapeA> where TSupportA : struct, ISupport<TShapeWideA>
        {
            // Hulls are addresses: a lane without a hull is empty. All else may be anything.
            TShapeWideA wideA = default;
            TShapeWide wideB = default;
            if (typeof(TShapeWideA) != typeof(ConvexHullWide))
                Pollute(ref wideA);
            if (typeof(TShapeWide) != typeof(ConvexHullWide))
                Pollute(ref wideB);
            DepthSearchStateWide state = default;
            Vector3Wide offset = default;
            QuaternionWide orientation = default;
            Pollute(ref state);
            Pollute(ref offset);
            Pollute(ref orientation);
            var margin = Vector<float>.Zero;
            for (int lane = 0; lane < pairs.Length; ++lane)
            {
                if (pairs[lane] < 0)
                    continue;
                var pair = pairs[lane];
                Lanes.Write(((Typed<TShapeA, TShapeWideA, TSupportA>)a[pair]).Shape, ref wideA, lane);
                Lanes.Write(((Typed<TShape, TShapeWide, TSupport>)b[pair]).Shape, ref wideB, lane);
                Lanes.Write(places[pair].Offset, ref offset, lane);
                Lanes.Write(places[pair].Orientation, ref orientation, lane);
                Lanes.Write(states[pair], ref state, lane);
                GatherScatter.Get(ref margin, lane) = margins[pair];
            }
            LaneCounts counts = default;
            DepthSearch<TShapeWideA, TSupportA, TShapeWide, TSupport>.Find(wideA, wideB, offset, Matrix3x3Wide.FromQuaternion(orientation),
                margin, ref state, ref counts, out var result);
            for (int lane = 0; lane < pairs.Length; ++lane)
            {
                if (pairs[lane] < 0)
                    continue;
                states[pairs[lane]] = Lanes.Read<DepthSearchState, DepthSearchStateWide>(ref state, lane);
                outcomes[pairs[lane]] = new(
                    Lanes.Read<Vector3, Vector3Wide>(ref result.Normal, lane), result.Depth[lane],
                    Lanes.Read<Vector3, Vector3Wide>(ref result.PointOnA, lane), result.Near[lane] != 0,
                    counts.Evaluations[lane], counts.Caps[lane], counts.Tried[lane], counts.Freed[lane], counts.Expansions[lane],
                    counts.ExpansionEvaluations[lane], counts.Limits[lane]);
            }
        }

        // Every third lane NaN, every third zero, every third some bits.
        static void Pollute<T>(ref T wide) where T : unmanaged
        {
            ref var words = ref Unsafe.As<T, int>(ref wide);
            for (int i = 0; i < Unsafe.SizeOf<T>() / sizeof(int); ++i)
            {
                Unsafe.Add(ref words, i) = (i % Vector<int>.Count % 3) switch
                {
                    0 => BitConverter.SingleToInt32Bits(float.NaN),
                    1 => 0,
                    _ => BitConverter.SingleToInt32Bits(1.5f - i * 0.25f),
                };
            }
        }
    }
}
