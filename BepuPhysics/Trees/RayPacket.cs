using System.Numerics;
using System.Runtime.CompilerServices;
using System.Runtime.Intrinsics;

namespace BepuPhysics.Trees;

/// <summary>Up to eight rays that go through trees together.</summary>
// Always eight, however wide the vectors of the processor are: who is told of first depends on it. A node is brought to eight numbers an axis, by the same
// operations in the same order as for a ray alone (SlabTest), so a ray meets the same boxes.
unsafe struct RayPacket
{
    /// <summary>Most rays.</summary>
    internal const int Capacity = 8;

    [InlineArray(Capacity)]
    internal struct Rays
    {
        RayData first;
    }

    /// <summary>Number of rays.</summary>
    internal int Count;
    /// <summary>Origins, directions and the caller's numbers.</summary>
    internal Rays Data;
    /// <summary>Lengths, in units of the directions; shortened by who is told of hits.</summary>
    internal Vector256<float> MaximumT;
    Vector256<float> originX, originY, originZ, inverseX, inverseY, inverseZ;

    /// <summary>Adds a ray that was checked.</summary>
    internal void Add(in RayData ray, float maximumT)
    {
        var lane = Count++;
        Data[lane] = ray;
        Set(ref MaximumT, lane, maximumT);
        Set(ref originX, lane, ray.Origin.X);
        Set(ref originY, lane, ray.Origin.Y);
        Set(ref originZ, lane, ray.Origin.Z);
        Set(ref inverseX, lane, SlabTest.Invert(ray.Direction.X));
        Set(ref inverseY, lane, SlabTest.Invert(ray.Direction.Y));
        Set(ref inverseZ, lane, SlabTest.Invert(ray.Direction.Z));
    }

    static void Set(ref Vector256<float> vector, int lane, float value) => Unsafe.Add(ref Unsafe.As<Vector256<float>, float>(ref vector), lane) = value;

    /// <summary>Which rays touch a child's box within their lengths, a bit for each, and when first.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    internal readonly uint FindMeeting(NodeChild* child, out Vector256<float> t)
    {
        FindTimes(child->Min.X, child->Max.X, originX, inverseX, out var beginX, out var endX);
        FindTimes(child->Min.Y, child->Max.Y, originY, inverseY, out var beginY, out var endY);
        FindTimes(child->Min.Z, child->Max.Z, originZ, inverseZ, out var beginZ, out var endZ);
        t = BoxMath.Max(BoxMath.Max(beginX, beginY), beginZ);
        var last = BoxMath.Min(BoxMath.Min(endX, endY), endZ) * Vector256.Create(SlabTest.Slack);
        var meets = Vector256.LessThanOrEqual(t, last) & Vector256.GreaterThanOrEqual(last, Vector256<float>.Zero) &
            Vector256.LessThanOrEqual(t, MaximumT);
        return meets.ExtractMostSignificantBits();
    }

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static void FindTimes(
        float min, float max, Vector256<float> origin, Vector256<float> inverse, out Vector256<float> begin, out Vector256<float> end)
    {
        var toMin = (Vector256.Create(min) - origin) * inverse;
        var toMax = (Vector256.Create(max) - origin) * inverse;
        var isBackward = Vector256.LessThan(inverse, Vector256<float>.Zero);
        begin = Vector256.ConditionalSelect(isBackward, toMax, toMin);
        end = Vector256.ConditionalSelect(isBackward, toMin, toMax);
    }
}
