using System.Runtime.CompilerServices;

namespace BepuPhysics.Collidables;

/// <summary>A triangle of a mesh: the numbers of its vertices, and its own.</summary>
/// <param name="A">Vertex of the first corner.</param>
/// <param name="B">Vertex of the second corner.</param>
/// <param name="C">Vertex of the third corner.</param>
/// <param name="Number">The number that the game gave it.</param>
readonly record struct MeshTriangle(int A, int B, int C, int Number);

/// <summary>The triangles of a mesh by their places: in the order of the leaves, and then those that are left out.</summary>
/// <remarks>
/// Numbers take three bytes each where there are no more than those can name, else four. Of three bytes four are read: something follows the last.
/// </remarks>
/// <param name="first">Bytes of the first.</param>
/// <param name="count">Number of what is to be named: of triangles or vertices, whichever are more.</param>
readonly unsafe struct MeshTriangles(byte* first, int count)
{
    const int Members = 4;

    readonly byte* first = first;
    readonly int size = ByteCountOf(count);
    readonly uint mask = uint.MaxValue >> (8 * (sizeof(uint) - ByteCountOf(count)));

    /// <summary>Bytes of a number.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static int ByteCountOf(int count) => count <= 1 << 24 ? 3 : 4;

    /// <summary>Bytes of a triangle.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static int TriangleByteCount(int count) => Members * ByteCountOf(count);

    /// <summary>The triangle at a place.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public MeshTriangle Get(int place)
    {
        var members = first + (nint)place * (Members * size);
        return new(Read(members), Read(members + size), Read(members + 2 * size), Read(members + 3 * size));
    }

    /// <summary>The number of the triangle at a place.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public int GetNumber(int place) => Read(first + (nint)place * (Members * size) + 3 * size);

    /// <summary>Asks the processor to load some triangles, one at least. Changes no result.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public void Prefetch(int place, int count)
    {
        var members = first + (nint)place * (Members * size);
        BepuUtilities.Memory.Prefetch.Read(members);
        BepuUtilities.Memory.Prefetch.Read(members + count * (Members * size) - 1);
    }

    /// <summary>Writes the triangle at a place.</summary>
    public void Set(int place, in MeshTriangle triangle)
    {
        var members = first + (nint)place * (Members * size);
        Write(members, triangle.A);
        Write(members + size, triangle.B);
        Write(members + 2 * size, triangle.C);
        Write(members + 3 * size, triangle.Number);
    }

    /// <summary>A number of an array that begins somewhere else.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public int GetPlace(byte* places, int triangle) => Read(places + (nint)triangle * size);

    /// <summary>Writes a number of an array that begins somewhere else.</summary>
    public void SetPlace(byte* places, int triangle, int place) => Write(places + (nint)triangle * size, place);

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    int Read(byte* number) => (int)(Unsafe.ReadUnaligned<uint>(number) & mask);

    void Write(byte* number, int value)
    {
        for (int i = 0; i < size; ++i)
            number[i] = (byte)(value >> (8 * i));
    }
}
