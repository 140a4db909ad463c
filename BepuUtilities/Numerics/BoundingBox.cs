using System;
using System.Numerics;
using System.Runtime.CompilerServices;

namespace BepuUtilities;

/// <summary>An axis-aligned box. Boxes that share a boundary point overlap.</summary>
public struct BoundingBox
{
    /// <summary>Corner with the least coordinates.</summary>
    public Vector3 Min;
    /// <summary>Corner with the greatest coordinates.</summary>
    public Vector3 Max;

    /// <summary>Builds from corners.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public BoundingBox(Vector3 min, Vector3 max)
    {
        Min = min;
        Max = max;
    }

    /// <summary>A box that holds nothing: merged with another it gives the other.</summary>
    public static BoundingBox Empty => new(new Vector3(float.MaxValue), new Vector3(float.MinValue));

    /// <summary>Whether two boxes overlap.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static bool Intersects(in BoundingBox a, in BoundingBox b) => IntersectsUnsafe(a.Min, a.Max, b.Min, b.Max);

    /// <summary>Whether two boxes given by their corners overlap.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static bool IntersectsUnsafe(in Vector3 minA, in Vector3 maxA, in Vector3 minB, in Vector3 maxB) =>
        minA.X <= maxB.X && minA.Y <= maxB.Y && minA.Z <= maxB.Z && minB.X <= maxA.X && minB.Y <= maxA.Y && minB.Z <= maxA.Z;

    /// <summary>Whether another box overlaps this one.</summary>
    public readonly bool Intersects(in BoundingBox other) => Intersects(this, other);

    /// <summary>Whether a sphere overlaps this box.</summary>
    public readonly bool Intersects(in BoundingSphere sphere)
    {
        var closest = Exact.Min(Exact.Max(sphere.Center, Min), Max);
        return Exact.DistanceSquared(sphere.Center, closest) <= sphere.Radius * sphere.Radius;
    }

    /// <summary>Whether <paramref name="inner"/> lies wholly inside <paramref name="outer"/>, boundary included.</summary>
    public static bool Contains(in BoundingBox outer, in BoundingBox inner) =>
        outer.Min.X <= inner.Min.X && outer.Min.Y <= inner.Min.Y && outer.Min.Z <= inner.Min.Z &&
        outer.Max.X >= inner.Max.X && outer.Max.Y >= inner.Max.Y && outer.Max.Z >= inner.Max.Z;

    /// <summary>Product of the three extents.</summary>
    public static float ComputeVolume(in BoundingBox box)
    {
        var size = box.Max - box.Min;
        return size.X * size.Y * size.Z;
    }

    /// <summary>Smallest box around two boxes.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static BoundingBox CreateMerged(in BoundingBox a, in BoundingBox b) => new(Exact.Min(a.Min, b.Min), Exact.Max(a.Max, b.Max));

    /// <summary>Smallest box around two boxes.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void CreateMerged(in BoundingBox a, in BoundingBox b, out BoundingBox merged) => merged = CreateMerged(a, b);

    /// <summary>Smallest box around two boxes given by their corners.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void CreateMerged(Vector3 minA, Vector3 maxA, Vector3 minB, Vector3 maxB, out Vector3 min, out Vector3 max)
    {
        min = Exact.Min(minA, minB);
        max = Exact.Max(maxA, maxB);
    }

    /// <summary>Smallest box around points; <see cref="Empty"/> for none.</summary>
    public static BoundingBox CreateFromPoints(ReadOnlySpan<Vector3> points)
    {
        var box = Empty;
        foreach (ref readonly var point in points)
            box = new(Exact.Min(box.Min, point), Exact.Max(box.Max, point));
        return box;
    }

    /// <summary>Smallest box around a sphere.</summary>
    public static BoundingBox CreateFromSphere(in BoundingSphere sphere) =>
        new(sphere.Center - new Vector3(sphere.Radius), sphere.Center + new Vector3(sphere.Radius));

    /// <inheritdoc/>
    public override readonly string ToString() => $"({Min}, {Max})";
}
