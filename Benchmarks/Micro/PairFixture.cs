using System;
using System.Numerics;
using System.Runtime.InteropServices;
using BepuPhysics.Collidables;
using BepuPhysics.CollisionDetection;
using BepuUtilities;

namespace Benchmarks.Micro;

/// <summary>Pairs of two shape types in lanes, ready to be tested.</summary>
public abstract class PairFixture : IDisposable
{
    /// <summary>Pairs that one call tests, whatever the width of a vector; few enough to stay in the first-level cache.</summary>
    public const int Pairs = 256;

    /// <summary>Tests all pairs once.</summary>
    public abstract void Test();

    /// <inheritdoc/>
    public abstract void Dispose();

    /// <summary>Creates pairs of random sizes and poses whose bounding boxes overlap: what a broad phase hands over.</summary>
    public static PairFixture Create<TShapeA, TWideA, TShapeB, TWideB, TContacts, TTester>(
        Func<Random, TShapeA> createA, Func<Random, TShapeB> createB)
        where TShapeA : unmanaged, IConvexShape where TWideA : unmanaged, IShapeWide<TShapeA>
        where TShapeB : unmanaged, IConvexShape where TWideB : unmanaged, IShapeWide<TShapeB>
        where TContacts : unmanaged, IFew<ContactWide> where TTester : struct, IPairTester<TWideA, TWideB, TContacts>
    {
        var bundles = new PairFixture<TWideA, TWideB, TContacts, TTester>();
        var random = new Random(1);
        for (int i = 0; i < Pairs; ++i)
        {
            TShapeA a = createA(random);
            TShapeB b = createB(random);
            Quaternion orientationA = NextOrientation(random), orientationB = NextOrientation(random);
            a.ComputeBounds(orientationA, out Vector3 minA, out Vector3 maxA);
            b.ComputeBounds(orientationB, out Vector3 minB, out Vector3 maxB);
            // Everywhere where the boxes overlap, each place as likely as the other.
            Vector3 least = minA - maxB, greatest = maxA - minB;
            Vector3 offset = least + (greatest - least) * new Vector3(random.NextSingle(), random.NextSingle(), random.NextSingle());
            ref var bundle = ref bundles.Bundles[i / Vector<float>.Count];
            int lane = i % Vector<float>.Count;
            Lanes.Write(a, ref bundle.A, lane);
            Lanes.Write(b, ref bundle.B, lane);
            Lanes.Write(offset, ref bundle.Pose.OffsetB, lane);
            Lanes.Write(orientationA, ref bundle.Pose.OrientationA, lane);
            Lanes.Write(orientationB, ref bundle.Pose.OrientationB, lane);
        }
        return bundles;
    }

    static Quaternion NextOrientation(Random random)
    {
        // Four numbers of a bell-shaped distribution point everywhere alike; a sum of four is bell enough.
        float Next() => random.NextSingle() + random.NextSingle() + random.NextSingle() + random.NextSingle() - 2;
        return Exact.Normalize(new Quaternion(Next(), Next(), Next(), Next()));
    }
}

/// <summary>Bundles of pairs and the tester that they are for.</summary>
sealed unsafe class PairFixture<TWideA, TWideB, TContacts, TTester> : PairFixture
    where TWideA : unmanaged where TWideB : unmanaged
    where TContacts : unmanaged, IFew<ContactWide> where TTester : struct, IPairTester<TWideA, TWideB, TContacts>
{
    /// <summary>As in the batcher, but all of them full.</summary>
    public struct Bundle
    {
        public TWideA A;
        public TWideB B;
        public PairPoseWide Pose;
    }

    // In aligned memory, as the batcher has them. The manifold has a place too, or the JIT might drop the work of a tester that it inlines.
    readonly Bundle* bundles = (Bundle*)NativeMemory.AlignedAlloc((nuint)(Pairs / Vector<float>.Count * sizeof(Bundle)), 64);
    readonly ConvexManifoldWide<TContacts>* manifold =
        (ConvexManifoldWide<TContacts>*)NativeMemory.AlignedAlloc((nuint)sizeof(ConvexManifoldWide<TContacts>), 64);

    /// <summary>The pairs.</summary>
    public Span<Bundle> Bundles => new(bundles, Pairs / Vector<float>.Count);

    /// <inheritdoc/>
    public override void Test()
    {
        var margin = new Vector<float>(0.1f);
        foreach (ref Bundle bundle in Bundles)
            TTester.Test(bundle.A, bundle.B, bundle.Pose, margin, out *manifold);
    }

    /// <inheritdoc/>
    public override void Dispose()
    {
        NativeMemory.AlignedFree(bundles);
        NativeMemory.AlignedFree(manifold);
    }
}
