using System.Numerics;
using System.Runtime.CompilerServices;
using System.Runtime.Intrinsics;

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
// A new vertex outside of some faces (visible from it) removes these; what is left open is bounded by their horizon, a loop of edges, and closed by
// a fan of faces from the horizon to the vertex, as in Quickhull.
//   FindVisible -> KeepConnected (rounding) -> the horizon -> AddFan, into the places of the faces that went
// The lower bound holds also where the surface is slightly dented, as it may get by the threshold of visibility: a ball about the origin
// that all planes are outside of is inside the surface, and so in the convex hull of the vertices.
// Faces have no order and no links: a new vertex is compared with all their planes, several at once, which for some dozens of faces is less
// work than going from neighbour to neighbour; and the horizon of those that go is what their edges leave when the pairs are taken out.
unsafe struct ExpandingPolytope(PolytopeMemory* memory, double visibility)
{
    // Below this, a normal's length says that its face has no area. Edges are about one unit long.
    const double LeastArea = 1e-12;
    const byte None = byte.MaxValue;
    const int NoFace = -1;

    readonly PolytopeMemory* memory = memory;
    double visibility = visibility;
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

    /// <summary>Forgets everything.</summary>
    public void Restart(double newVisibility) => visibility = newVisibility;

    /// <summary>Makes the first four vertices a tetrahedron.</summary>
    public void Start()
    {
        VertexCount = 4;
        faceCount = 0;
        int b = 1, c = 2;
        if (Volume() > 0)
            (b, c) = (c, b);
        memory->Horizon[0] = (byte)b;
        memory->Horizon[1] = (byte)c;
        AddFan(1, 0);
        memory->Horizon[0] = 0;
        memory->Horizon[1] = (byte)c;
        memory->Horizon[2] = (byte)b;
        memory->Horizon[3] = 0;
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
        var least = Vector256.Create(double.PositiveInfinity);
        for (int i = 0; i < faceCount; i += Vector256<double>.Count)
        {
            var priority = Vector256.Load(memory->Priority + i);
            least = Vector256.ConditionalSelect(Vector256.LessThan(priority, least), priority, least);
        }
        var other = Vector256.Shuffle(least, Vector256.Create(2L, 3, 0, 1));
        least = Vector256.ConditionalSelect(Vector256.LessThan(other, least), other, least);
        other = Vector256.Shuffle(least, Vector256.Create(1L, 0, 3, 2));
        least = Vector256.ConditionalSelect(Vector256.LessThan(other, least), other, least);
        for (int i = 0; ; i += Vector256<double>.Count)
        {
            var bits = Vector256.Equals(Vector256.Load(memory->Priority + i), least).ExtractMostSignificantBits();
            if (bits != 0)
                return i + BitOperations.TrailingZeroCount(bits);
        }
    }

    /// <summary>Takes in the vertex behind the last one, if it is outside.</summary>
    public bool TryExpand()
    {
        var visibleCount = FindVisible(NoFace, this[VertexCount].Point);
        if (visibleCount == 0)
            return false;
        Replace(memory->Removed[0], visibleCount);
        return true;
    }

    /// <summary>Takes in the vertex behind the last one.</summary>
    /// <param name="visible">A face that is visible from it.</param>
    [MethodImpl(MethodImplOptions.NoInlining)]
    public void Expand(int visible) => Replace(visible, FindVisible(visible, this[VertexCount].Point));

    /// <summary>Replaces faces that are visible from the vertex behind the last one by new ones that end in it.</summary>
    void Replace(int visible, int removedCount)
    {
        var vertex = VertexCount++;
        if (!TryFindHorizon(removedCount, out var horizonCount))
        {
            // By rounding: the faces that are visible from a point outside of a convex surface do not enclose any that does not, and are connected.
            removedCount = KeepConnected(visible, removedCount);
            if (!TryFindHorizon(removedCount, out horizonCount))
            {
                // One face alone always has a horizon.
                memory->Removed[0] = (short)visible;
                removedCount = 1;
                TryFindHorizon(removedCount, out horizonCount);
            }
        }
        for (int i = removedCount - 1; i >= 0; --i)
            Move(--faceCount, memory->Removed[i]);
        AddFan(horizonCount, vertex);
    }

    /// <summary>Lists the faces that a point is over, and one of which that is known.</summary>
    readonly int FindVisible(int visible, in DoubleVector3 point)
    {
        var count = 0;
        var x = Vector256.Create(point.X);
        var y = Vector256.Create(point.Y);
        var z = Vector256.Create(point.Z);
        var threshold = Vector256.Create(visibility);
        for (int i = 0; i < faceCount; i += Vector256<double>.Count)
        {
            var height = Vector256.Load(memory->NormalX + i) * x + Vector256.Load(memory->NormalY + i) * y +
                Vector256.Load(memory->NormalZ + i) * z - Vector256.Load(memory->Offset + i);
            var bits = Vector256.GreaterThan(height, threshold).ExtractMostSignificantBits();
            if (visible >= i && visible < i + Vector256<double>.Count)
                bits |= 1u << (visible - i);
            if (faceCount - i < Vector256<double>.Count)
                bits &= (1u << (faceCount - i)) - 1;
            for (; bits != 0; bits &= bits - 1)
                memory->Removed[count++] = (short)(i + BitOperations.TrailingZeroCount(bits));
        }
        return count;
    }

    /// <summary>Lists the vertices around the removed faces; false where that is not one ring.</summary>
    readonly bool TryFindHorizon(int removedCount, out int horizonCount)
    {
        if (removedCount == 1)
        {
            GetCorners(memory->Removed[0], out var a, out var b, out var c);
            memory->Horizon[0] = memory->Horizon[3] = (byte)a;
            memory->Horizon[1] = (byte)b;
            memory->Horizon[2] = (byte)c;
            horizonCount = 3;
            return true;
        }
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
        horizonCount = 0;
        for (int i = 0; i < removedCount; ++i)
        {
            GetCorners(memory->Removed[i], out var a, out var b, out var c);
            AddEdge(a, b, ref start, ref horizonCount, ref isSimple);
            AddEdge(b, c, ref start, ref horizonCount, ref isSimple);
            AddEdge(c, a, ref start, ref horizonCount, ref isSimple);
        }
        if (!isSimple)
            return false;
        var vertex = start;
        for (int i = 0; i < horizonCount; ++i)
        {
            memory->Horizon[i] = (byte)vertex;
            vertex = memory->NextOnHorizon[vertex];
            if (vertex == start && i != horizonCount - 1)
                return false;
        }
        memory->Horizon[horizonCount] = (byte)start;
        return horizonCount > 0;
    }

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    readonly void Clear(int vertex)
    {
        memory->Edges[2 * vertex] = 0;
        memory->Edges[2 * vertex + 1] = 0;
        memory->NextOnHorizon[vertex] = None;
    }

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    readonly void AddEdge(int from, int to, ref int start, ref int horizonCount, ref bool isSimple)
    {
        if ((memory->Edges[2 * to + (from >> 6)] >> from & 1) != 0)
            return;
        isSimple &= memory->NextOnHorizon[from] == None;
        memory->NextOnHorizon[from] = (byte)to;
        start = from;
        ++horizonCount;
    }

    /// <summary>Leaves those of the removed faces that are connected to one of them by edges.</summary>
    readonly int KeepConnected(int visible, int removedCount)
    {
        // Connected ones to the front.
        var connectedCount = 0;
        for (int i = 0; i < removedCount; ++i)
        {
            if (memory->Removed[i] == visible)
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

    /// <summary>Adds a face from each edge of the horizon to a vertex.</summary>
    void AddFan(int edgeCount, int vertex)
    {
        ref var tip = ref this[vertex].Point;
        var tipX = Vector256.Create(tip.X);
        var tipY = Vector256.Create(tip.Y);
        var tipZ = Vector256.Create(tip.Z);
        var infinity = Vector256.Create(double.PositiveInfinity);
        for (int i = 0; i < edgeCount; i += Vector256<double>.Count)
        {
            // Beyond the last edge, where the horizon holds anything, the last one once more.
            int i0 = memory->Horizon[i], i1 = memory->Horizon[i + 1];
            int i2 = i + 2 <= edgeCount ? memory->Horizon[i + 2] : i1;
            int i3 = i + 3 <= edgeCount ? memory->Horizon[i + 3] : i2;
            int i4 = i + 4 <= edgeCount ? memory->Horizon[i + 4] : i3;
            ref var p0 = ref this[i0].Point;
            ref var p1 = ref this[i1].Point;
            ref var p2 = ref this[i2].Point;
            ref var p3 = ref this[i3].Point;
            ref var p4 = ref this[i4].Point;
            memory->Corners[faceCount + i] = (uint)(i0 | i1 << 8 | vertex << 16);
            memory->Corners[faceCount + i + 1] = (uint)(i1 | i2 << 8 | vertex << 16);
            memory->Corners[faceCount + i + 2] = (uint)(i2 | i3 << 8 | vertex << 16);
            memory->Corners[faceCount + i + 3] = (uint)(i3 | i4 << 8 | vertex << 16);
            var fromX = Vector256.Create(p0.X, p1.X, p2.X, p3.X) - tipX;
            var fromY = Vector256.Create(p0.Y, p1.Y, p2.Y, p3.Y) - tipY;
            var fromZ = Vector256.Create(p0.Z, p1.Z, p2.Z, p3.Z) - tipZ;
            var toX = Vector256.Create(p1.X, p2.X, p3.X, p4.X) - tipX;
            var toY = Vector256.Create(p1.Y, p2.Y, p3.Y, p4.Y) - tipY;
            var toZ = Vector256.Create(p1.Z, p2.Z, p3.Z, p4.Z) - tipZ;
            var x = fromY * toZ - fromZ * toY;
            var y = fromZ * toX - fromX * toZ;
            var z = fromX * toY - fromY * toX;
            var length = Vector256.Sqrt(x * x + y * y + z * z);
            var hasArea = Vector256.GreaterThan(length, Vector256.Create(LeastArea));
            var inverse = Vector256<double>.One / length & hasArea;
            x *= inverse;
            y *= inverse;
            z *= inverse;
            var offset = Vector256.ConditionalSelect(hasArea, x * tipX + y * tipY + z * tipZ, infinity);
            x.Store(memory->NormalX + faceCount + i);
            y.Store(memory->NormalY + faceCount + i);
            z.Store(memory->NormalZ + faceCount + i);
            offset.Store(memory->Offset + faceCount + i);
            offset.Store(memory->Priority + faceCount + i);
        }
        faceCount += edgeCount;
        // So that vectors which reach beyond the last face find nothing there.
        infinity.Store(memory->Priority + faceCount);
    }
}
