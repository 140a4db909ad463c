using System.Numerics;
using System.Runtime.CompilerServices;
using System.Runtime.Intrinsics;

namespace BepuPhysics.Collidables;

/// <summary>A line on its way between the sides of the boxes of a mesh's nodes.</summary>
/// <remarks>
/// A side is line l of the grid, at origin + l step before scaling, and the line meets it at ((origin + l step) scale - point) / direction.
/// That is linear in l: for each axis a node has one offset and one slope, and each of the six sides of its eight boxes takes a product and a sum.
/// </remarks>
readonly unsafe struct MeshSlabs
{
    readonly Vector128<float> scale, inverse, scaledInverse, nearPoint, farPoint;
    // All bits of a byte where the greatest sides come first along the line, which are kept as what is left to the last line.
    readonly Vector256<int> flipX, flipY, flipZ;

    /// <param name="scale">Scale of the mesh.</param>
    /// <param name="point">A point of the line, from which places on it are measured.</param>
    /// <param name="inverse">One over the components of the unit direction.</param>
    /// <param name="margin">By how much boxes are widened, m.</param>
    public MeshSlabs(Vector3 scale, Vector3 point, Vector3 inverse, float margin)
    {
        this.scale = scale.AsVector128();
        this.inverse = inverse.AsVector128();
        scaledInverse = (scale * inverse).AsVector128();
        var widening = new Vector3(inverse.X < 0 ? -margin : margin, inverse.Y < 0 ? -margin : margin, inverse.Z < 0 ? -margin : margin);
        nearPoint = (point + widening).AsVector128();
        farPoint = (point - widening).AsVector128();
        flipX = Flip(scale.X * inverse.X);
        flipY = Flip(scale.Y * inverse.Y);
        flipZ = Flip(scale.Z * inverse.Z);
    }

    static Vector256<int> Flip(float slope) => Vector256.Create(slope < 0 ? MeshNode.Lines : 0);

    /// <summary>Which children's boxes the line meets, a bit for each. Where there is no child the bit may be set.</summary>
    /// <remarks>Eight boxes at a time on every CPU, so that nothing depends on the width of vectors.</remarks>
    /// <param name="node">The node.</param>
    /// <param name="start">Where the line begins.</param>
    /// <param name="end">Where it ends.</param>
    /// <param name="slack">Part of itself by which each of two places that are compared may be wrong.</param>
    /// <param name="begins">Receives where it meets them.</param>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public int FindHits(MeshNode* node, float start, float end, float slack, out Vector256<float> begins)
    {
        var origin = Vector128.Load((float*)node) * scale;
        var slopes = MeshNode.Steps(node) * scaledInverse;
        var near = (origin - nearPoint) * inverse;
        var far = (origin - farPoint) * inverse;
        var begin = Vector256.Create(start);
        var last = Vector256.Create(end);
        Meet(MeshNode.AxisLines(node, 0), flipX, near.GetElement(0), far.GetElement(0), slopes.GetElement(0), ref begin, ref last);
        Meet(MeshNode.AxisLines(node, 1), flipY, near.GetElement(1), far.GetElement(1), slopes.GetElement(1), ref begin, ref last);
        Meet(MeshNode.AxisLines(node, 2), flipZ, near.GetElement(2), far.GetElement(2), slopes.GetElement(2), ref begin, ref last);
        begins = begin;
        var share = Vector256.Create(slack);
        return (int)Vector256.LessThanOrEqual(begin - Vector256.Abs(begin) * share, last + Vector256.Abs(last) * share).ExtractMostSignificantBits();
    }

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static void Meet(byte* lines, Vector256<int> flip, float near, float far, float slope, ref Vector256<float> begin, ref Vector256<float> last)
    {
        var greatestFirst = flip[0] != 0 ? MeshNode.Width : 0;
        var steps = Vector256.Create(slope);
        var enters = Vector256.Create(near) + Vector256.ConvertToSingle(MeshNode.Widen(lines + greatestFirst) ^ flip) * steps;
        var leaves = Vector256.Create(far) +
            Vector256.ConvertToSingle(MeshNode.Widen(lines + MeshNode.Width - greatestFirst) ^ flip ^ Vector256.Create(MeshNode.Lines)) * steps;
        begin = Vector256.ConditionalSelect(Vector256.GreaterThan(enters, begin), enters, begin);
        last = Vector256.ConditionalSelect(Vector256.LessThan(leaves, last), leaves, last);
    }
}
