using System.Numerics;
using System.Runtime.CompilerServices;
using System.Runtime.Intrinsics;
using BepuUtilities;

namespace BepuPhysics.CollisionDetection;

/// <summary>A vertex of the polytope: a point of the Minkowski difference, and the points of the shapes that it came from.</summary>
struct PolytopeVertex
{
    public DoubleVector3 Point;
    public Vector3 OnA;
    public Vector3 OnB;
}

/// <summary>
/// A closed surface of triangles with its vertices on the Minkowski difference, which grows towards it. The least height of its planes over
/// the origin is a lower bound of the depth in any direction.
/// </summary>
// Also where the surface is slightly dented, as it may get by the threshold of visibility: a ball about the origin that all planes are
// outside of is inside the surface, and so in the convex hull of the vertices.
// Faces have no order and no links: a new vertex is compared with all their planes, several at once, which for some dozens of faces is less
// work than going from neighbour to neighbour; and the rim of those that go is what their edges leave when the pairs are taken out.
unsafe struct ExpandingPolytope(PolytopeMemory* memory, double visibility)
{
    // Below this, a normal's length says that its face has no area. Edges are about one unit long.
    const double LeastArea = 1e-12;
    const byte None = byte.MaxValue;

    readonly PolytopeMemory* memory = memory;
    readonly double visibility = visibility;
    public int VertexCount;
    int faceCount;

    public readonly ref PolytopeVertex this[int vertex]
    {
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        get => ref Unsafe.Add(ref Unsafe.As<PolytopeMemory.VertexArray, PolytopeVertex>(ref memory->Vertices), vertex);
    }

    /// <summary>Outward unit normal of a face; zero where it has no area.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public readonly DoubleVector3 Normal(int face) => new(memory->NormalX[face], memory->NormalY[face], memory->NormalZ[face]);

    /// <summary>Height of a face's plane over the origin, or infinity for one that need not be looked at any more.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public readonly double Priority(int face) => memory->Priority[face];

    /// <summary>Says that a face need not be looked at any more.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public readonly void Settle(int face) => memory->Priority[face] = double.PositiveInfinity;

    /// <summary>Vertices of a face.</summary>
    public readonly void GetCorners(int face, out int a, out int b, out int c)
    {
        var corners = memory->Corners[face];
        a = (byte)corners;
        b = (byte)(corners >> 8);
        c = (byte)(corners >> 16);
    }

    /// <summary>Makes the first four vertices a tetrahedron.</summary>
    public void Start()
    {
        VertexCount = 4;
        faceCount = 0;
        int b = 1, c = 2;
        if (Volume() > 0)
            (b, c) = (c, b);
        memory->Rim[0] = (byte)b;
        memory->Rim[1] = (byte)c;
        AddFan(1, 0);
        memory->Rim[0] = 0;
        memory->Rim[1] = (byte)c;
        memory->Rim[2] = (byte)b;
        memory->Rim[3] = 0;
        AddFan(3, 3);
    }

    /// <summary>Six times the volume of the first four vertices; positive where the first three are counterclockwise seen from the fourth.</summary>
    public readonly double Volume()
    {
        var origin = this[0].Point;
        return DoubleVector3.Dot(DoubleVector3.Cross(this[1].Point - origin, this[2].Point - origin), this[3].Point - origin);
    }

    /// <summary>The face that is nearest to the origin, or that the origin is farthest outside of.</summary>
    [MethodImpl(MethodImplOptions.NoInlining)]
    public readonly int FindLeast()
    {
        var least = new Vector<double>(double.PositiveInfinity);
        for (int i = 0; i < faceCount; i += Vector<double>.Count)
        {
            var priority = Unsafe.ReadUnaligned<Vector<double>>(memory->Priority + i);
            least = Vector.ConditionalSelect(Vector.LessThan(priority, least), priority, least);
        }
        var smallest = least[0];
        for (int i = 1; i < Vector<double>.Count; ++i)
            smallest = least[i] < smallest ? least[i] : smallest;
        least = new(smallest);
        for (int i = 0; ; i += Vector<double>.Count)
        {
            var bits = LanesOf(Vector.Equals(Unsafe.ReadUnaligned<Vector<double>>(memory->Priority + i), least));
            if (bits != 0)
                return i + BitOperations.TrailingZeroCount(bits);
        }
    }

    /// <summary>Replaces the faces that see the last vertex by new ones that end in it.</summary>
    /// <param name="seen">A face that sees it.</param>
    [MethodImpl(MethodImplOptions.NoInlining)]
    public void Expand(int seen)
    {
        var vertex = VertexCount - 1;
        var removedCount = FindSeeing(seen, this[vertex].Point);
        if (!TryFindRim(removedCount, out var rimCount))
        {
            // By rounding: the faces that see a point of a convex surface do not enclose any that does not, and are connected.
            removedCount = KeepConnected(seen, removedCount);
            if (!TryFindRim(removedCount, out rimCount))
            {
                // One face alone always has a rim.
                memory->Removed[0] = (short)seen;
                removedCount = 1;
                TryFindRim(removedCount, out rimCount);
            }
        }
        for (int i = removedCount - 1; i >= 0; --i)
            Move(--faceCount, memory->Removed[i]);
        AddFan(rimCount, vertex);
    }

    /// <summary>Lists the faces that a point is over, and one of which that is known.</summary>
    readonly int FindSeeing(int seen, in DoubleVector3 point)
    {
        var count = 0;
        var x = new Vector<double>(point.X);
        var y = new Vector<double>(point.Y);
        var z = new Vector<double>(point.Z);
        var threshold = new Vector<double>(visibility);
        for (int i = 0; i < faceCount; i += Vector<double>.Count)
        {
            var height = Unsafe.ReadUnaligned<Vector<double>>(memory->NormalX + i) * x +
                Unsafe.ReadUnaligned<Vector<double>>(memory->NormalY + i) * y +
                Unsafe.ReadUnaligned<Vector<double>>(memory->NormalZ + i) * z - Unsafe.ReadUnaligned<Vector<double>>(memory->Offset + i);
            var bits = LanesOf(Vector.GreaterThan(height, threshold));
            if (seen >= i && seen < i + Vector<double>.Count)
                bits |= 1u << (seen - i);
            if (faceCount - i < Vector<double>.Count)
                bits &= (1u << (faceCount - i)) - 1;
            for (; bits != 0; bits &= bits - 1)
                memory->Removed[count++] = (short)(i + BitOperations.TrailingZeroCount(bits));
        }
        return count;
    }

    /// <summary>Lists the vertices around the removed faces; false where that is not one ring.</summary>
    readonly bool TryFindRim(int removedCount, out int rimCount)
    {
        for (int i = 0; i < removedCount; ++i)
        {
            GetCorners(memory->Removed[i], out var a, out var b, out var c);
            Clear(a);
            Clear(b);
            Clear(c);
        }
        for (int i = 0; i < removedCount; ++i)
        {
            GetCorners(memory->Removed[i], out var a, out var b, out var c);
            memory->Edges[2 * a + (b >> 6)] |= 1UL << b;
            memory->Edges[2 * b + (c >> 6)] |= 1UL << c;
            memory->Edges[2 * c + (a >> 6)] |= 1UL << a;
        }
        var start = 0;
        var isSimple = true;
        rimCount = 0;
        for (int i = 0; i < removedCount; ++i)
        {
            GetCorners(memory->Removed[i], out var a, out var b, out var c);
            AddEdge(a, b, ref start, ref rimCount, ref isSimple);
            AddEdge(b, c, ref start, ref rimCount, ref isSimple);
            AddEdge(c, a, ref start, ref rimCount, ref isSimple);
        }
        if (!isSimple)
            return false;
        var vertex = start;
        for (int i = 0; i < rimCount; ++i)
        {
            memory->Rim[i] = (byte)vertex;
            vertex = memory->NextOnRim[vertex];
            if (vertex == start && i != rimCount - 1)
                return false;
        }
        memory->Rim[rimCount] = (byte)start;
        return rimCount > 0;
    }

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    readonly void Clear(int vertex)
    {
        memory->Edges[2 * vertex] = 0;
        memory->Edges[2 * vertex + 1] = 0;
        memory->NextOnRim[vertex] = None;
    }

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    readonly void AddEdge(int from, int to, ref int start, ref int rimCount, ref bool isSimple)
    {
        if ((memory->Edges[2 * to + (from >> 6)] >> from & 1) != 0)
            return;
        isSimple &= memory->NextOnRim[from] == None;
        memory->NextOnRim[from] = (byte)to;
        start = from;
        ++rimCount;
    }

    /// <summary>Leaves those of the removed faces that are connected to one of them by edges.</summary>
    readonly int KeepConnected(int seen, int removedCount)
    {
        // Connected ones to the front.
        var connectedCount = 0;
        for (int i = 0; i < removedCount; ++i)
        {
            if (memory->Removed[i] == seen)
                Swap(i, connectedCount++);
        }
        for (int i = 0; i < connectedCount; ++i)
        {
            for (int j = connectedCount; j < removedCount; ++j)
            {
                if (ShareEdge(memory->Removed[i], memory->Removed[j]))
                    Swap(j, connectedCount++);
            }
        }
        // Ascending again.
        for (int i = 1; i < connectedCount; ++i)
        {
            for (int j = i; j > 0 && memory->Removed[j] < memory->Removed[j - 1]; --j)
                Swap(j, j - 1);
        }
        return connectedCount;
    }

    readonly void Swap(int i, int j) => (memory->Removed[i], memory->Removed[j]) = (memory->Removed[j], memory->Removed[i]);

    readonly bool ShareEdge(int face, int other)
    {
        GetCorners(face, out var a, out var b, out var c);
        return HasEdge(other, b, a) || HasEdge(other, c, b) || HasEdge(other, a, c);
    }

    readonly bool HasEdge(int face, int from, int to)
    {
        GetCorners(face, out var a, out var b, out var c);
        return (a == from && b == to) || (b == from && c == to) || (c == from && a == to);
    }

    readonly void Move(int from, int to)
    {
        memory->NormalX[to] = memory->NormalX[from];
        memory->NormalY[to] = memory->NormalY[from];
        memory->NormalZ[to] = memory->NormalZ[from];
        memory->Offset[to] = memory->Offset[from];
        memory->Priority[to] = memory->Priority[from];
        memory->Corners[to] = memory->Corners[from];
    }

    /// <summary>Adds a face from each edge of the rim to a vertex.</summary>
    void AddFan(int edgeCount, int vertex)
    {
        for (int i = 0; i < edgeCount; ++i)
        {
            ref var point = ref this[memory->Rim[i]].Point;
            memory->RimX[i] = point.X;
            memory->RimY[i] = point.Y;
            memory->RimZ[i] = point.Z;
            memory->Corners[faceCount + i] = memory->Rim[i] | (uint)memory->Rim[i + 1] << 8 | (uint)vertex << 16;
        }
        ref var last = ref this[memory->Rim[edgeCount]].Point;
        memory->RimX[edgeCount] = last.X;
        memory->RimY[edgeCount] = last.Y;
        memory->RimZ[edgeCount] = last.Z;
        ref var tip = ref this[vertex].Point;
        var tipX = new Vector<double>(tip.X);
        var tipY = new Vector<double>(tip.Y);
        var tipZ = new Vector<double>(tip.Z);
        var infinity = new Vector<double>(double.PositiveInfinity);
        for (int i = 0; i < edgeCount; i += Vector<double>.Count)
        {
            var fromX = Unsafe.ReadUnaligned<Vector<double>>(memory->RimX + i) - tipX;
            var fromY = Unsafe.ReadUnaligned<Vector<double>>(memory->RimY + i) - tipY;
            var fromZ = Unsafe.ReadUnaligned<Vector<double>>(memory->RimZ + i) - tipZ;
            var toX = Unsafe.ReadUnaligned<Vector<double>>(memory->RimX + i + 1) - tipX;
            var toY = Unsafe.ReadUnaligned<Vector<double>>(memory->RimY + i + 1) - tipY;
            var toZ = Unsafe.ReadUnaligned<Vector<double>>(memory->RimZ + i + 1) - tipZ;
            var x = fromY * toZ - fromZ * toY;
            var y = fromZ * toX - fromX * toZ;
            var z = fromX * toY - fromY * toX;
            var length = Vector.SquareRoot(x * x + y * y + z * z);
            var hasArea = Vector.GreaterThan(length, new Vector<double>(LeastArea));
            var inverse = Vector.ConditionalSelect(hasArea, Vector<double>.One / length, Vector<double>.Zero);
            x *= inverse;
            y *= inverse;
            z *= inverse;
            var offset = Vector.ConditionalSelect(hasArea, x * tipX + y * tipY + z * tipZ, infinity);
            Unsafe.WriteUnaligned(memory->NormalX + faceCount + i, x);
            Unsafe.WriteUnaligned(memory->NormalY + faceCount + i, y);
            Unsafe.WriteUnaligned(memory->NormalZ + faceCount + i, z);
            Unsafe.WriteUnaligned(memory->Offset + faceCount + i, offset);
            Unsafe.WriteUnaligned(memory->Priority + faceCount + i, offset);
        }
        faceCount += edgeCount;
        // So that vectors which reach beyond the last face find nothing there.
        Unsafe.WriteUnaligned(memory->Priority + faceCount, infinity);
    }

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static uint LanesOf(Vector<long> mask)
    {
        if (Vector<long>.Count == 4)
            return mask.AsVector256().ExtractMostSignificantBits();
        if (Vector<long>.Count == 2)
            return mask.AsVector128().ExtractMostSignificantBits();
        return (uint)mask.AsVector512().ExtractMostSignificantBits();
    }
}
