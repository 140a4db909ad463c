using System;
using System.Numerics;

namespace BepuPhysics.CollisionDetection;

/// <summary>A vertex of the polytope: a point of the Minkowski difference, and the points of the shapes that it came from.</summary>
struct PolytopeVertex
{
    public DoubleVector3 Point;
    public Vector3 OnA;
    public Vector3 OnB;
    /// <summary>During an expansion: the new faces whose rim edges begin and end here; negative where there is none.</summary>
    public int FaceFrom, FaceTo;
}

/// <summary>A triangle of the polytope's surface, counterclockwise seen from outside.</summary>
struct PolytopeFace
{
    public DoubleVector3 Normal;
    /// <summary>Height of its plane over the origin; negative where the origin is outside.</summary>
    public double Offset;
    /// <summary>The same, or infinite for a face that need not be looked at any more.</summary>
    public double Priority;
    /// <summary>Vertices; neighbour I is beyond the edge from vertex I to the next one.</summary>
    public int Vertex0, Vertex1, Vertex2, Neighbor0, Neighbor1, Neighbor2;
    public bool Removed;
}

/// <summary>
/// A closed surface of triangles with its vertices on the Minkowski difference, which grows towards it. The least height of its planes over
/// the origin is a lower bound of the depth in any direction.
/// </summary>
// Also where the surface is slightly dented, as it may get by the threshold of visibility: a ball about the origin that all planes are
// outside of is inside the surface, and so in the convex hull of the vertices.
ref struct ExpandingPolytope(
    Span<PolytopeVertex> vertices, Span<PolytopeFace> faces, Span<int> removed, Span<int> free, double visibility)
{
    /// <summary>Vertices that may be added to the four of the start.</summary>
    public const int MaximumExpansions = 64;
    /// <summary>Greatest number of vertices.</summary>
    public const int MaximumVertexCount = 4 + MaximumExpansions;
    // A closed surface of triangles has two faces for each vertex, less four. While it is expanded, the faces that go are still there.
    public const int MaximumFaceCount = 4 * MaximumVertexCount;

    // Below this, a normal's length says that its face has no area. Edges are about one unit long.
    const double LeastArea = 1e-12;

    public readonly Span<PolytopeVertex> Vertices = vertices;
    public readonly Span<PolytopeFace> Faces = faces;
    readonly Span<int> removed = removed;
    readonly Span<int> free = free;
    readonly double visibility = visibility;
    public int VertexCount;
    int faceCount;
    int freeCount;

    /// <summary>Makes the first four vertices a tetrahedron.</summary>
    public void Start()
    {
        faceCount = 4;
        freeCount = 0;
        int b = 1, c = 2;
        if (Volume(Vertices) > 0)
            (b, c) = (c, b);
        SetFace(0, 0, b, c, 3, 2, 1);
        SetFace(1, 0, c, 3, 0, 2, 3);
        SetFace(2, c, b, 3, 0, 3, 1);
        SetFace(3, b, 0, 3, 0, 1, 2);
    }

    /// <summary>Six times the volume of the first four vertices; positive where the first three are counterclockwise seen from the fourth.</summary>
    public static double Volume(ReadOnlySpan<PolytopeVertex> vertices)
    {
        var origin = vertices[0].Point;
        return DoubleVector3.Dot(
            DoubleVector3.Cross(vertices[1].Point - origin, vertices[2].Point - origin), vertices[3].Point - origin);
    }

    /// <summary>The face that is nearest to the origin, or that the origin is farthest outside of.</summary>
    public readonly int FindLeast()
    {
        var least = 0;
        var priority = double.PositiveInfinity;
        for (int i = 0; i < faceCount; ++i)
        {
            if (Faces[i].Priority < priority)
            {
                priority = Faces[i].Priority;
                least = i;
            }
        }
        return least;
    }

    /// <summary>Replaces the faces that see the last vertex by new ones that end in it.</summary>
    /// <param name="seen">A face that sees it. Others are replaced as well where they are connected to it.</param>
    /// <returns>Whether there was room.</returns>
    public bool Expand(int seen)
    {
        var vertex = VertexCount - 1;
        var point = Vertices[vertex].Point;
        Faces[seen].Removed = true;
        removed[0] = seen;
        var removedCount = 1;
        for (int i = 0; i < removedCount; ++i)
        {
            ref var face = ref Faces[removed[i]];
            Look(face.Neighbor0, point, ref removedCount);
            Look(face.Neighbor1, point, ref removedCount);
            Look(face.Neighbor2, point, ref removedCount);
        }
        if (!TryMarkRim(removedCount, out var rimCount))
        {
            // The rim touches itself: by rounding, as the faces that see a point of a convex surface do not enclose any that does not.
            // One face alone always has a rim.
            for (int i = 1; i < removedCount; ++i)
                Faces[removed[i]].Removed = false;
            removedCount = 1;
            TryMarkRim(removedCount, out rimCount);
        }
        if (MaximumFaceCount - faceCount + freeCount < rimCount)
            return false;
        AddRim(removedCount, vertex);
        return true;
    }

    readonly void Look(int face, in DoubleVector3 point, ref int removedCount)
    {
        ref var other = ref Faces[face];
        if (other.Removed)
            return;
        // Faces without an area have a normal of zero and see everything: they go as soon as one beside them goes.
        if (DoubleVector3.Dot(other.Normal, point) - other.Offset > visibility)
        {
            other.Removed = true;
            removed[removedCount++] = face;
        }
    }

    /// <summary>Counts the edges between removed faces and others; false where two of them begin at one vertex.</summary>
    readonly bool TryMarkRim(int removedCount, out int rimCount)
    {
        for (int i = 0; i < VertexCount; ++i)
            Vertices[i].FaceFrom = Vertices[i].FaceTo = -1;
        rimCount = 0;
        var simple = true;
        for (int i = 0; i < removedCount; ++i)
        {
            ref var face = ref Faces[removed[i]];
            simple &= TryMark(face.Vertex0, face.Neighbor0, ref rimCount);
            simple &= TryMark(face.Vertex1, face.Neighbor1, ref rimCount);
            simple &= TryMark(face.Vertex2, face.Neighbor2, ref rimCount);
        }
        return simple;
    }

    readonly bool TryMark(int from, int neighbor, ref int rimCount)
    {
        if (Faces[neighbor].Removed)
            return true;
        ++rimCount;
        ref var mark = ref Vertices[from].FaceFrom;
        var isFirst = mark < 0;
        mark = 0;
        return isFirst;
    }

    void AddRim(int removedCount, int vertex)
    {
        // The places of removed faces are free only after their edges have been read.
        for (int i = 0; i < removedCount; ++i)
        {
            var face = Faces[removed[i]];
            AddFace(face.Vertex0, face.Vertex1, vertex, face.Neighbor0);
            AddFace(face.Vertex1, face.Vertex2, vertex, face.Neighbor1);
            AddFace(face.Vertex2, face.Vertex0, vertex, face.Neighbor2);
        }
        for (int i = 0; i < removedCount; ++i)
        {
            Faces[removed[i]].Priority = double.PositiveInfinity;
            free[freeCount++] = removed[i];
        }
        for (int i = 0; i < vertex; ++i)
        {
            var from = Vertices[i].FaceFrom;
            if (from < 0)
                continue;
            Faces[from].Neighbor2 = Vertices[i].FaceTo;
            Faces[Vertices[i].FaceTo].Neighbor1 = from;
        }
    }

    void AddFace(int from, int to, int vertex, int neighbor)
    {
        ref var beyond = ref Faces[neighbor];
        if (beyond.Removed)
            return;
        var face = freeCount > 0 ? free[--freeCount] : faceCount++;
        SetFace(face, from, to, vertex, neighbor, -1, -1);
        Vertices[from].FaceFrom = face;
        Vertices[to].FaceTo = face;
        if (beyond.Vertex0 == to)
            beyond.Neighbor0 = face;
        else if (beyond.Vertex1 == to)
            beyond.Neighbor1 = face;
        else
            beyond.Neighbor2 = face;
    }

    readonly void SetFace(int index, int a, int b, int c, int neighbor0, int neighbor1, int neighbor2)
    {
        ref var face = ref Faces[index];
        face.Vertex0 = a;
        face.Vertex1 = b;
        face.Vertex2 = c;
        face.Neighbor0 = neighbor0;
        face.Neighbor1 = neighbor1;
        face.Neighbor2 = neighbor2;
        face.Removed = false;
        var origin = Vertices[a].Point;
        var normal = DoubleVector3.Cross(Vertices[b].Point - origin, Vertices[c].Point - origin);
        var length = normal.Length;
        if (length > LeastArea)
        {
            face.Normal = normal * (1 / length);
            face.Offset = DoubleVector3.Dot(face.Normal, origin);
            face.Priority = face.Offset;
        }
        else
        {
            face.Normal = default;
            face.Offset = double.NegativeInfinity;
            face.Priority = double.PositiveInfinity;
        }
    }
}
