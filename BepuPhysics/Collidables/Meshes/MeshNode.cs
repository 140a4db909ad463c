using System;
using System.Numerics;
using System.Runtime.CompilerServices;
using System.Runtime.InteropServices;
using System.Runtime.Intrinsics;
using System.Runtime.Intrinsics.X86;
using BepuPhysics.Trees;

namespace BepuPhysics.Collidables;

/// <summary>Up to eight children of a mesh's tree, with their boxes in bytes.</summary>
/// <remarks>
/// On each axis the boxes are rounded outward to a grid whose step is a power of two and whose lines are floats: from
/// <see cref="Origin"/> on, 256 of them. So rounding to the grid is exact, a box of bytes stands for one of floats, and which boxes a query
/// meets is decided by integers: the same on every CPU.
/// <para>Children are nodes or leaves of one to four triangles. The nodes among them have successive numbers, the triangles of the leaves
/// successive places; both in the order of the children.</para>
/// </remarks>
[StructLayout(LayoutKind.Sequential, Pack = 4, Size = ByteCount)]
unsafe struct MeshNode
{
    /// <summary>Size of a node.</summary>
    public const int ByteCount = 80;
    /// <summary>Greatest number of children.</summary>
    public const int Width = 8;
    /// <summary>Greatest number of triangles of a leaf.</summary>
    public const int LeafSize = 4;

    /// <summary>Number of the last line of a grid.</summary>
    public const int Lines = 255;

    // Bits of a float's mantissa, and of its exponent for 1.
    const int MantissaBits = 23, Bias = 127;
    const int DoubleMantissaBits = 52, DoubleBias = 1023;
    const int LineOffset = 24;
    // A power of two above the number of triangles of a leaf.
    const int LeafRoom = 8;
    const ulong EachByte = 0x0101010101010101;

    /// <summary>Least corner of the grid.</summary>
    public Vector3 Origin;
    // Exponents of the steps, as floats have them, and in the last byte a bit for each child that is a node.
    uint exponents;
    /// <summary>Number of the first child that is a node.</summary>
    public int FirstNode;
    /// <summary>Place of the first triangle of a child that is a leaf.</summary>
    public int FirstPlace;
    // For each axis least lines of eight children, then 255 less greatest lines: all are at most what a query reaches to.
    fixed byte lines[3 * 2 * Width];
    // Numbers of triangles of the children that are leaves, a byte each; zero for nodes, and where there is no child.
    ulong counts;

    /// <summary>A bit for each child that is a node.</summary>
    public readonly int NodeMask
    {
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        get => (int)(exponents >> 24);
    }

    /// <summary>Number of triangles of a child; zero for a node, and where there is no child.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public readonly int TriangleCount(int child) => (int)(counts >> (8 * child)) & 255;

    /// <summary>Number of triangles of all leaves.</summary>
    public readonly int TotalTriangleCount => (int)(counts * EachByte >> 56);

    /// <summary>Whether every leaf has a number of triangles that a leaf can have, and no node has any.</summary>
    public readonly bool HasValidCounts
    {
        get
        {
            for (int child = 0; child < Width; ++child)
            {
                if (TriangleCount(child) > ((NodeMask >> child & 1) != 0 ? 0 : LeafSize))
                    return false;
            }
            return true;
        }
    }

    /// <summary>Place of the first triangle of a leaf.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    // The product's highest byte but the child's own: the sum of the counts before it.
    public readonly int Place(int child) => FirstPlace + ((int)((counts * EachByte << 8) >> (8 * child)) & 255);

    /// <summary>Number of the node that a child is.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public readonly int Node(int child) => FirstNode + BitOperations.PopCount((uint)(NodeMask & ((1 << child) - 1)));

    /// <summary>Whether the grid is one of floats. Only a damaged node's is not.</summary>
    public readonly bool HasValidGrid
    {
        get
        {
            for (int axis = 0; axis < 3; ++axis)
            {
                var last = Origin[axis] + (double)Lines * Step(axis);
                if ((exponents >> (8 * axis) & 255) is 0 or > 2 * Bias - 1 || !float.IsFinite(Origin[axis]) || (float)last != last ||
                    !float.IsFinite((float)last))
                    return false;
            }
            return true;
        }
    }

    /// <summary>Says what the children are; the boxes are to be written.</summary>
    public void SetChildren(int nodeMask, ulong triangleCounts)
    {
        exponents = exponents & 0xFFFFFF | (uint)nodeMask << 24;
        counts = triangleCounts;
    }

    readonly float Step(int axis) => BitConverter.UInt32BitsToSingle((exponents >> (8 * axis) & 255) << MantissaBits);

    /// <summary>Box of a child as it is kept.</summary>
    public readonly void GetBounds(int child, out Vector3 min, out Vector3 max)
    {
        min = default;
        max = default;
        for (int axis = 0; axis < 3; ++axis)
        {
            min[axis] = Origin[axis] + lines[2 * Width * axis + child] * Step(axis);
            max[axis] = Origin[axis] + (Lines - lines[2 * Width * axis + Width + child]) * Step(axis);
        }
    }

    /// <summary>Steps of the grid along the axes, in the first three lanes.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Vector128<float> Steps(MeshNode* node) => Vector128.ShiftLeft(Exponents(node), MantissaBits).AsSingle();

    // As floats have them; the fourth is the mask of nodes.
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static Vector128<uint> Exponents(MeshNode* node) =>
        Vector128.WidenLower(Vector128.WidenLower(Vector128.CreateScalarUnsafe(node->exponents).AsByte()));

    /// <summary>Where in a node the sides are which come first along an axis, of all children, and where those that come last.</summary>
    /// <param name="axis">The axis.</param>
    /// <param name="backward">Whether greatest sides come first.</param>
    /// <param name="near">Bytes from the node to the first sides.</param>
    /// <param name="far">Bytes from the node to the last sides.</param>
    public static void FindSides(int axis, bool backward, out int near, out int far)
    {
        var least = LineOffset + 2 * Width * axis;
        var greatest = least + Width;
        near = backward ? greatest : least;
        far = backward ? least : greatest;
    }

    /// <summary>A child as one number: that of a node as it is, and a negative one for a leaf, or where there is no child.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public readonly int Pack(int child) => (NodeMask >> child & 1) != 0 ? Node(child) : ~(Place(child) * LeafRoom | TriangleCount(child));

    /// <summary>Place and number of triangles of a leaf that was packed; none where there is no child.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void UnpackLeaf(int packed, out int place, out int count)
    {
        place = ~packed / LeafRoom;
        count = ~packed & (LeafRoom - 1);
    }

    /// <summary>Eight lines as integers.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Vector256<int> Widen(byte* lines)
    {
        if (Avx2.IsSupported)
            return Avx2.ConvertToVector256Int32(lines);
        var words = Vector128.WidenLower(Vector128.CreateScalarUnsafe(Unsafe.ReadUnaligned<ulong>(lines)).AsByte());
        return Vector256.Create(Vector128.WidenLower(words), Vector128.WidenUpper(words)).AsInt32();
    }

    /// <summary>Makes the grid of boxes and writes them; where there is no child the box is to be empty, least above greatest.</summary>
    public void SetBounds(ReadOnlySpan<Vector3> mins, ReadOnlySpan<Vector3> maxes)
    {
        for (int axis = 0; axis < 3; ++axis)
        {
            var low = float.MaxValue;
            var high = -float.MaxValue;
            for (int child = 0; child < mins.Length; ++child)
            {
                low = mins[child][axis] < low ? mins[child][axis] : low;
                high = maxes[child][axis] > high ? maxes[child][axis] : high;
            }
            var exponent = FindExponent(low, high);
            exponents = exponents & ~(255u << (8 * axis)) | (uint)exponent << (8 * axis);
            var inverseStep = InverseStep(exponent);
            var first = Math.Floor(low * inverseStep);
            Origin[axis] = (float)(first / inverseStep);
            for (int child = 0; child < Width; ++child)
            {
                var exists = child < mins.Length;
                lines[2 * Width * axis + child] = exists ? (byte)(Math.Floor(mins[child][axis] * inverseStep) - first) : (byte)Lines;
                lines[2 * Width * axis + Width + child] = exists ? (byte)(Lines - (Math.Ceiling(maxes[child][axis] * inverseStep) - first)) : (byte)Lines;
            }
        }
    }

    // The least step with which the lines reach from one end to the other and are floats: multiples of the step below 2^24 of them are.
    static int FindExponent(float low, float high)
    {
        var largest = Math.Max(Math.Abs((double)low), Math.Abs((double)high));
        var exponent = Math.Max(1, Math.Max(Exponent(((double)high - low) / Lines), Exponent(largest) - MantissaBits + 1));
        while (true)
        {
            var inverseStep = InverseStep(exponent);
            if (Math.Ceiling(high * inverseStep) - Math.Floor(low * inverseStep) <= Lines)
                return exponent;
            ++exponent;
        }
    }

    // Two to the power of the bias less the exponent, of a float: well within what a double has.
    static double InverseStep(int exponent) => BitConverter.Int64BitsToDouble((long)(DoubleBias + Bias - exponent) << DoubleMantissaBits);

    // Of the greatest power of two that is not above a value, as floats have it; zero for less than the least normal float.
    static int Exponent(double value) => Math.Max(0, (int)(BitConverter.DoubleToInt64Bits(value) >> DoubleMantissaBits) - DoubleBias + Bias);

    /// <summary>Which children's boxes a box meets, a bit for each. Boxes that only touch do.</summary>
    /// <remarks>
    /// The box is turned into lines of the grid, its least corner rounded up and its greatest down: between two lines there is no side of a
    /// child. Subtracting the origin may round; what rounds to a line was beyond it or on it, so nothing is lost.
    /// </remarks>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static int FindOverlaps(MeshNode* node, Vector128<float> min, Vector128<float> max)
    {
        var origin = Vector128.Load((float*)node);
        // The exponent of one over the step. What the fourth lane gets from the mask of nodes is left out at the end.
        var inverseStep = Vector128.ShiftLeft(Vector128.Create(2u * Bias) - Exponents(node), MantissaBits).AsSingle();
        // Beyond the grid all is alike, and integers have no room for more: only that a box ends before the first line or begins behind the last is left.
        var least = Vector128.Create(Lines) - Vector128.ConvertToInt32Native(Vector128.Ceiling(Clamp((min - origin) * inverseStep, 0, Lines + 1)));
        var greatest = Vector128.ConvertToInt32Native(Vector128.Floor(Clamp((max - origin) * inverseStep, -1, Lines)));
        // A negative number of lines is left.
        if (((least | greatest).ExtractMostSignificantBits() & 7) != 0)
            return 0;
        var words = Vector128.Narrow(greatest, least);
        var reach = Vector128.Narrow(words, words).AsByte();
        var lines = (byte*)node + LineOffset;
        // Greatest lines are bytes 0 to 2 of it, least ones 4 to 6. Written out: only what is known to the compiler is one instruction.
        var met = Vector128.LessThanOrEqual(Vector128.Load(lines),
            Vector128.Shuffle(reach, Vector128.Create((byte)0, 0, 0, 0, 0, 0, 0, 0, 4, 4, 4, 4, 4, 4, 4, 4))) &
            Vector128.LessThanOrEqual(Vector128.Load(lines + 2 * Width),
                Vector128.Shuffle(reach, Vector128.Create((byte)1, 1, 1, 1, 1, 1, 1, 1, 5, 5, 5, 5, 5, 5, 5, 5))) &
            Vector128.LessThanOrEqual(Vector128.Load(lines + 4 * Width),
                Vector128.Shuffle(reach, Vector128.Create((byte)2, 2, 2, 2, 2, 2, 2, 2, 6, 6, 6, 6, 6, 6, 6, 6)));
        var sides = met.ExtractMostSignificantBits();
        return (int)(sides & sides >> 8 & 255);
    }

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static Vector128<float> Clamp(Vector128<float> line, float first, float last) =>
        BoxMath.Min(BoxMath.Max(line, Vector128.Create(first)), Vector128.Create(last));
}
