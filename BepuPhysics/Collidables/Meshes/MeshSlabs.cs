using System.Runtime.CompilerServices;
using System.Runtime.Intrinsics;
using System.Runtime.Intrinsics.X86;

namespace BepuPhysics.Collidables;

/// <summary>A line on its way between the sides of the boxes of a mesh's nodes.</summary>
/// <remarks>
/// A side is line l of the grid, at origin + l step before scaling, and the line meets it at ((origin + l step) scale - point) / direction.
/// That is linear in l: for each axis a node has one offset and one slope, and each of the six sides of its eight boxes takes a product and a
/// sum. Greatest sides are kept as what is left to the last line of the grid, so those are counted from there, backward.
/// </remarks>
unsafe struct MeshSlabs
{
    // Scale over direction, and its magnitude; what the point takes from places, of near sides and of far ones.
    Vector128<float> factor, magnitude, near, far;
    // From the side that lines are counted from to the origin: the last line, or none.
    Vector128<float> nearReach, farReach;
    // Where a node has the lines that come first along each axis, and those that come last.
    int nearX, nearY, nearZ, farX, farY, farZ;

    // Of a direction: along an axis with less the line stays in its place, to far less than a rounding, over any distance of use. Nothing that is divided by it
    // overflows.
    const float LeastComponent = 1f / (1L << 60);

    /// <summary>Says which line it is.</summary>
    /// <param name="scale">Scale of the mesh.</param>
    /// <param name="point">A point of the line, from which places on it are measured.</param>
    /// <param name="speed">Unit direction.</param>
    /// <param name="margin">By how much boxes are widened, m.</param>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public void Set(Vector128<float> scale, Vector128<float> point, Vector128<float> speed, float margin)
    {
        var least = Vector128.Create(LeastComponent);
        speed = Vector128.ConditionalSelect(Vector128.LessThan(Vector128.Abs(speed), least),
            Vector128.ConditionalSelect(Vector128.LessThan(speed, Vector128<float>.Zero), -least, least), speed);
        var inverse = Vector128<float>.One / speed;
        factor = scale * inverse;
        magnitude = Vector128.Abs(factor);
        var widening = Vector128.Create(margin) * Vector128.Abs(inverse);
        var place = point * inverse;
        near = -(place + widening);
        far = widening - place;
        var backward = Vector128.LessThan(factor, Vector128<float>.Zero);
        nearReach = backward & Vector128.Create(-(float)MeshNode.Lines);
        farReach = Vector128.AndNot(Vector128.Create((float)MeshNode.Lines), backward);
        MeshNode.FindSides(0, factor[0] < 0, out nearX, out farX);
        MeshNode.FindSides(1, factor[1] < 0, out nearY, out farY);
        MeshNode.FindSides(2, factor[2] < 0, out nearZ, out farZ);
    }

    /// <summary>Which children's boxes the line meets, a bit for each. Where there is no child the bit may be set.</summary>
    /// <remarks>Eight boxes at a time on every CPU, so that nothing depends on the width of vectors.</remarks>
    /// <param name="node">The node.</param>
    /// <param name="start">Where the line begins.</param>
    /// <param name="end">Where it ends.</param>
    /// <param name="begins">Receives where it meets them.</param>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public readonly int FindHits(MeshNode* node, float start, float end, out Vector256<float> begins)
    {
        var slopes = MeshNode.Steps(node) * magnitude;
        var origin = Vector128.Load((float*)node) * factor;
        var enters = origin + near + slopes * nearReach;
        var leaves = origin + far + slopes * farReach;
        begins = Max(
            Max(Enter(node, nearX, enters.GetElement(0), slopes.GetElement(0)), Enter(node, nearY, enters.GetElement(1), slopes.GetElement(1))),
            Max(Enter(node, nearZ, enters.GetElement(2), slopes.GetElement(2)), Vector256.Create(start)));
        var ends = Min(
            Min(Leave(node, farX, leaves.GetElement(0), slopes.GetElement(0)), Leave(node, farY, leaves.GetElement(1), slopes.GetElement(1))),
            Min(Leave(node, farZ, leaves.GetElement(2), slopes.GetElement(2)), Vector256.Create(end)));
        return (int)Vector256.LessThanOrEqual(begins, ends).ExtractMostSignificantBits();
    }

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static Vector256<float> Enter(MeshNode* node, int side, float place, float slope) =>
        Vector256.Create(place) + Vector256.ConvertToSingle(MeshNode.Widen((byte*)node + side)) * Vector256.Create(slope);

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static Vector256<float> Leave(MeshNode* node, int side, float place, float slope) =>
        Vector256.Create(place) - Vector256.ConvertToSingle(MeshNode.Widen((byte*)node + side)) * Vector256.Create(slope);

    // The instruction says the same as the comparison, for zeros and what is no number too, in one step for two.
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static Vector256<float> Max(Vector256<float> a, Vector256<float> b) =>
        Avx.IsSupported ? Avx.Max(a, b) : Vector256.ConditionalSelect(Vector256.GreaterThan(a, b), a, b);

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static Vector256<float> Min(Vector256<float> a, Vector256<float> b) =>
        Avx.IsSupported ? Avx.Min(a, b) : Vector256.ConditionalSelect(Vector256.LessThan(a, b), a, b);
}
