using System;
using System.Collections.Generic;
using System.Linq;
using System.Numerics;
using System.Runtime.CompilerServices;
using BepuPhysics.CollisionDetection;
using BepuUtilities;
using DemoTests.CollisionDetection.References;

namespace DemoTests.CollisionDetection;

/// <summary>A pair, in A's frame, and what a search would have found.</summary>
record struct FacePair<TShapeA, TShapeB>(TShapeA A, TShapeB B, Vector3 LocalOffsetB, Quaternion LocalOrientationB, Quaternion OrientationA,
    Vector3 Normal, float Depth, Vector3 PointOnA, float SpeculativeMargin);

/// <summary>A contact in A's frame.</summary>
record struct FaceContact(Double3 Offset, double Depth, int FeatureId);

/// <summary>The contacts of a pair in A's frame.</summary>
sealed record FaceContacts(Double3 Normal, FaceContact[] Contacts)
{
    public double Deepest => Contacts.Max(contact => contact.Depth);

    public bool SameBits(FaceContacts other) => Contacts.SequenceEqual(other.Contacts) && (Contacts.Length == 0 || Normal == other.Normal);
}

/// <summary>Runs pairs through the manifold builder.</summary>
static class FaceHarness<TShapeA, TShapeWideA, TFeatureA, TShapeB, TShapeWideB, TFeatureB>
    where TShapeA : unmanaged where TShapeWideA : unmanaged, IWide<TShapeA> where TFeatureA : unmanaged, IContactFeature<TShapeWideA>
    where TShapeB : unmanaged where TShapeWideB : unmanaged, IWide<TShapeB> where TFeatureB : unmanaged, IContactFeature<TShapeWideB>
{
    public static FaceContacts Run(in FacePair<TShapeA, TShapeB> pair) => Run([pair])[0];

    /// <summary>Tests a pair as one that is known.</summary>
    public static FaceContacts Run(in FacePair<TShapeA, TShapeB> pair, ref int remembered)
    {
        int[] memory = [remembered];
        var contacts = Run([pair], remembered: memory)[0];
        remembered = memory[0];
        return contacts;
    }

    /// <summary>Tests pairs in a given order; lanes without a pair hold what fill says. What is remembered of each pair is changed.</summary>
    public static FaceContacts[] Run(IReadOnlyList<FacePair<TShapeA, TShapeB>> pairs, int[]? order = null, float fill = float.NaN,
        int[]? remembered = null)
    {
        remembered ??= new int[pairs.Count];
        order ??= [.. Enumerable.Range(0, pairs.Count)];
        var results = new FaceContacts[pairs.Count];
        for (int start = 0; start < order.Length; start += Vector<float>.Count)
        {
            var count = Math.Min(Vector<float>.Count, order.Length - start);
            RunBundle(pairs, order.AsSpan(start, count), remembered, results, fill);
        }
        return results;
    }

    static void RunBundle(IReadOnlyList<FacePair<TShapeA, TShapeB>> pairs, ReadOnlySpan<int> order, int[] remembered,
        FaceContacts[] results, float fill)
    {
        var a = default(TShapeWideA);
        var b = default(TShapeWideB);
        // Hulls have pointers, and no lane of theirs may hold anything else.
        if (typeof(TShapeB) != typeof(BepuPhysics.Collidables.ConvexHull))
            Fill(ref b, fill);
        if (typeof(TShapeA) != typeof(BepuPhysics.Collidables.ConvexHull))
            Fill(ref a, fill);
        Vector3Wide offset = new(new Vector<float>(fill)), normal = offset, point = offset;
        Matrix3x3Wide orientationA = new(offset, offset, offset), orientationB = orientationA;
        Vector<float> depth = new(fill), margin = depth;
        var near = Vector<int>.Zero;
        var memory = Vector.AsVectorInt32(new Vector<float>(fill));
        for (int lane = 0; lane < order.Length; ++lane)
        {
            var pair = pairs[order[lane]];
            Lanes.Write(pair.A, ref a, lane);
            Lanes.Write(pair.B, ref b, lane);
            Lanes.Write(pair.LocalOffsetB, ref offset, lane);
            Lanes.Write(pair.Normal, ref normal, lane);
            Lanes.Write(pair.PointOnA, ref point, lane);
            Lanes.Write(Axes(pair.OrientationA), ref orientationA, lane);
            Lanes.Write(Axes(pair.LocalOrientationB), ref orientationB, lane);
            GatherScatter.Get(ref depth, lane) = pair.Depth;
            GatherScatter.Get(ref margin, lane) = pair.SpeculativeMargin;
            GatherScatter.Get(ref near, lane) = -1;
            GatherScatter.Get(ref memory, lane) = remembered[order[lane]];
        }
        FaceManifold<TShapeWideA, TFeatureA, TShapeWideB, TFeatureB>.Build(
            a, b, offset, orientationB, normal, depth, point, near, margin, orientationA, ref memory, out var manifold);
        for (int lane = 0; lane < order.Length; ++lane)
        {
            results[order[lane]] = Read(ref manifold, lane, pairs[order[lane]].OrientationA);
            remembered[order[lane]] = memory[lane];
        }
    }

    static FaceContacts Read(ref ConvexManifoldWide<Few4<ContactWide>> manifold, int lane, Quaternion orientationA)
    {
        List<FaceContact> contacts = [];
        for (int i = 0; i < 4; ++i)
        {
            ref var contact = ref manifold.Contacts[i];
            if (contact.Exists[lane] != 0)
                contacts.Add(new(ToLocal(Lanes.Read<Vector3, Vector3Wide>(ref contact.OffsetA, lane)), contact.Depth[lane], contact.FeatureId[lane]));
        }
        return new(ToLocal(Lanes.Read<Vector3, Vector3Wide>(ref manifold.Normal, lane)), [.. contacts]);

        Double3 ToLocal(Vector3 v) => new(
            Double3.Dot(Double3.RotatedAxis(orientationA, 0), new(v)), Double3.Dot(Double3.RotatedAxis(orientationA, 1), new(v)),
            Double3.Dot(Double3.RotatedAxis(orientationA, 2), new(v)));
    }

    static Matrix3x3 Axes(Quaternion q)
    {
        var wide = Matrix3x3Wide.FromQuaternion(Lanes.Broadcast<Quaternion, QuaternionWide>(q));
        return Lanes.Read<Matrix3x3, Matrix3x3Wide>(ref wide, 0);
    }

    static void Fill<T>(ref T target, float value) where T : unmanaged
    {
        for (int i = 0; i < Unsafe.SizeOf<T>() / sizeof(float); ++i)
            Unsafe.Add(ref Unsafe.As<T, float>(ref target), i) = value;
    }
}
