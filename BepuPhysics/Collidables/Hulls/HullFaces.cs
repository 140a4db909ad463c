using System;
using System.Runtime.CompilerServices;
using BepuUtilities.Diagnostics;
using BepuUtilities.Memory;

namespace BepuPhysics.Collidables;

/// <summary>Joins the triangles of a hull into convex polygons where they lie in one plane, within the tolerance.</summary>
/// <remarks>
/// From the largest triangle that is left, a face grows across its edges as long as each new corner is near its plane, the face stays one
/// piece without holes and its outline convex, in that plane and within the tolerance. As the plane of one triangle is a poor guess for
/// the plane of a face of a thousand, it is fitted to what was found and the face grown again. Triangles are only ever put together, so
/// the surface stays closed whatever the tolerance does.
/// Then corners that only two faces have, in the middle of an edge, are left out.
/// An outline is a ring of half-edges: number 3 t + i is edge i of triangle t and stands for the corner where it begins.
/// </remarks>
unsafe struct HullFaces
{
    const int None = -1;
    const int MaximumFitCount = 3;

    readonly BufferPool pool;
    readonly Buffer<HullPoint> points;
    readonly Buffer<HullTriangle> triangles;
    readonly int triangleCount;
    readonly double tolerance;

    // For each triangle its face; for each half-edge its neighbors on the outline; for each point the growth that last reached it.
    Buffer<int> faceOfTriangle, next, previous, reached;
    // For each half-edge the point where it begins, and the half-edge the other way: what is asked most, in less memory than triangles.
    Buffer<int> corners, twins;
    // Triangles of the face that is growing.
    Buffer<int> members;
    int memberCount, growth;

    /// <summary>A half-edge of the outline of each face.</summary>
    public Buffer<int> Outlines;
    /// <summary>Number of corners of each face.</summary>
    public Buffer<int> CornerCounts;
    /// <summary>Unit normal of each face.</summary>
    public Buffer<HullPoint> Normals;
    /// <summary>Number of faces.</summary>
    public int Count;

    struct Plane
    {
        public HullPoint Normal, Point;
    }

    // Sorts from large to small; equal ones by number.
    readonly struct BySize(double size, int triangle) : IComparable<BySize>
    {
        public readonly int Triangle = triangle;
        readonly double size = size;

        public int CompareTo(BySize other) => size != other.size ? other.size.CompareTo(size) : Triangle.CompareTo(other.Triangle);
    }

    HullFaces(in HullGrid grid, in HullBuilder hull, BufferPool pool)
    {
        this.pool = pool;
        points = grid.Points;
        triangles = hull.Triangles;
        triangleCount = hull.TriangleCount;
        tolerance = hull.Tolerance;
        pool.Take(triangleCount, out faceOfTriangle);
        pool.Take(triangleCount * 3, out next);
        pool.Take(triangleCount * 3, out previous);
        pool.Take(triangleCount * 3, out corners);
        pool.Take(triangleCount * 3, out twins);
        pool.Take(triangleCount, out members);
        pool.Take(points.Length, out reached);
        pool.Take(triangleCount, out Outlines);
        pool.Take(triangleCount, out CornerCounts);
        pool.Take(triangleCount, out Normals);
        faceOfTriangle.AsSpan().Fill(None);
        reached.AsSpan().Clear();
        for (int i = 0; i < triangleCount; ++i)
        {
            ref var triangle = ref triangles[i];
            for (int edge = 0; edge < 3; ++edge)
            {
                var neighbor = triangle.Neighbors[edge];
                corners[3 * i + edge] = triangle.Corners[edge];
                twins[3 * i + edge] = 3 * neighbor + triangles[neighbor].EdgeTo(i);
            }
        }
    }

    /// <summary>Makes faces of the triangles of a hull.</summary>
    public static HullFaces Create(in HullGrid grid, in HullBuilder hull, BufferPool pool)
    {
        var faces = new HullFaces(grid, hull, pool);
        pool.Take<BySize>(faces.triangleCount, out var order);
        for (int i = 0; i < faces.triangleCount; ++i)
            order[i] = new(HullPoint.Dot(hull.Triangles[i].Normal, hull.Triangles[i].Normal), i);
        order.AsSpan().Sort();
        for (int i = 0; i < faces.triangleCount; ++i)
        {
            if (faces.faceOfTriangle[order[i].Triangle] == None)
                faces.AddFace(order[i].Triangle);
        }
        pool.Return(ref order);
        faces.DropBends();
        return faces;
    }

    /// <summary>Point at the corner where a half-edge begins.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public readonly int Corner(int halfEdge) => corners[halfEdge];

    /// <summary>Half-edge of the next corner of the face.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public readonly int Next(int halfEdge) => next[halfEdge];

    public void Dispose()
    {
        pool.Return(ref faceOfTriangle);
        pool.Return(ref next);
        pool.Return(ref previous);
        pool.Return(ref corners);
        pool.Return(ref twins);
        pool.Return(ref members);
        pool.Return(ref reached);
        pool.Return(ref Outlines);
        pool.Return(ref CornerCounts);
        pool.Return(ref Normals);
    }

    void AddFace(int seed)
    {
        ref var triangle = ref triangles[seed];
        Plane plane;
        plane.Normal = triangle.Normal * triangle.InverseLength;
        plane.Point = points[triangle.Corners[0]];
        Grow(seed, plane);
        for (int i = 0; i < MaximumFitCount && memberCount > 1; ++i)
        {
            var count = memberCount;
            var fitted = Fit();
            Forget();
            Grow(seed, fitted);
            if (memberCount < count)
            {
                Forget();
                Grow(seed, plane);
                break;
            }
            plane = fitted;
            if (memberCount == count)
                break;
        }
        Normals[Count++] = plane.Normal;
    }

    /// <summary>Plane of the face that has grown: mean normal, weighted by area, halfway between the highest corner and the lowest.</summary>
    readonly Plane Fit()
    {
        var normal = default(HullPoint);
        for (int i = 0; i < memberCount; ++i)
            normal += triangles[members[i]].Normal;
        normal *= 1 / HullPoint.Length(normal);
        var origin = points[Corner(Outlines[Count])];
        double low = 0, high = 0;
        var halfEdge = Outlines[Count];
        for (int i = 0; i < CornerCounts[Count]; ++i, halfEdge = next[halfEdge])
        {
            var height = HullPoint.Dot(normal, points[Corner(halfEdge)] - origin);
            low = Math.Min(low, height);
            high = Math.Max(high, height);
        }
        return new() { Normal = normal, Point = origin + normal * (0.5 * (low + high)) };
    }

    readonly void Forget()
    {
        for (int i = 0; i < memberCount; ++i)
            faceOfTriangle[members[i]] = None;
    }

    void Grow(int seed, in Plane plane)
    {
        ++growth;
        memberCount = 0;
        AddMember(seed);
        var first = seed * 3;
        for (int i = 0; i < 3; ++i)
        {
            next[first + i] = first + HullTriangle.Next(i);
            previous[first + i] = first + HullTriangle.Previous(i);
            reached[Corner(first + i)] = growth;
        }
        CornerCounts[Count] = 3;
        var halfEdge = first;
        // Until once around the outline nothing could be added.
        for (int failureCount = 0; failureCount < CornerCounts[Count];)
        {
            if (TryAdd(halfEdge, plane, out var added))
            {
                failureCount = 0;
                halfEdge = added;
            }
            else
            {
                ++failureCount;
                halfEdge = next[halfEdge];
            }
        }
        Outlines[Count] = halfEdge;
    }

    void AddMember(int triangle)
    {
        faceOfTriangle[triangle] = Count;
        members[memberCount++] = triangle;
    }

    /// <summary>Adds the triangle across an edge of the outline, if it belongs to the face.</summary>
    bool TryAdd(int halfEdge, in Plane plane, out int added)
    {
        added = None;
        var twin = twins[halfEdge];
        var triangle = twin / 3;
        if (faceOfTriangle[triangle] != None)
            return false;
        int toApex = triangle * 3 + HullTriangle.Next(twin % 3), fromApex = triangle * 3 + HullTriangle.Previous(twin % 3);
        var apex = Corner(fromApex);
        if (HullPoint.Dot(triangles[triangle].Normal, plane.Normal) <= 0 ||
            Math.Abs(HullPoint.Dot(points[apex] - plane.Point, plane.Normal)) > tolerance)
            return false;

        int before = previous[halfEdge], after = next[halfEdge];
        bool closesBefore = twins[before] == toApex, closesAfter = twins[after] == fromApex;
        // A corner that the outline has elsewhere would pinch the face.
        if (closesBefore ? closesAfter : !closesAfter && reached[apex] == growth)
            return false;
        int start = Corner(halfEdge), end = Corner(after);
        if (closesBefore)
        {
            before = previous[before];
            if (!IsConvex(Corner(before), apex, end, plane) || !IsConvex(apex, end, Corner(next[after]), plane))
                return false;
            Connect(before, fromApex);
            Connect(fromApex, after);
            added = fromApex;
        }
        else if (closesAfter)
        {
            after = next[after];
            if (!IsConvex(Corner(before), start, apex, plane) || !IsConvex(start, apex, Corner(next[after]), plane))
                return false;
            Connect(before, toApex);
            Connect(toApex, after);
            added = toApex;
        }
        else
        {
            if (!IsConvex(Corner(before), start, apex, plane) || !IsConvex(start, apex, end, plane) ||
                !IsConvex(apex, end, Corner(next[after]), plane))
                return false;
            Connect(before, toApex);
            Connect(toApex, fromApex);
            Connect(fromApex, after);
            reached[apex] = growth;
            added = toApex;
        }
        CornerCounts[Count] += closesBefore || closesAfter ? -1 : 1;
        AddMember(triangle);
        return true;
    }

    readonly void Connect(int first, int second)
    {
        next[first] = second;
        previous[second] = first;
    }

    /// <summary>Whether a corner is not inside of the line between its neighbors, within the tolerance.</summary>
    readonly bool IsConvex(int before, int corner, int after, in Plane plane)
    {
        var line = points[after] - points[before];
        var inward = HullPoint.Dot(HullPoint.Cross(line, points[corner] - points[before]), plane.Normal);
        return inward <= tolerance * HullPoint.Length(line);
    }

    /// <summary>Leaves out the corners that only two faces have, as long as each keeps three.</summary>
    void DropBends()
    {
        // Half-edges that begin at each point: the first two of them, and how many.
        pool.Take<int>(points.Length, out var first);
        pool.Take<int>(points.Length, out var second);
        var counts = reached;
        counts.AsSpan().Clear();
        for (int face = 0; face < Count; ++face)
        {
            var halfEdge = Outlines[face];
            for (int i = 0; i < CornerCounts[face]; ++i, halfEdge = next[halfEdge])
            {
                var corner = Corner(halfEdge);
                if (counts[corner]++ == 0)
                    first[corner] = halfEdge;
                else
                    second[corner] = halfEdge;
            }
        }
        for (int face = 0; face < Count; ++face)
        {
            var halfEdge = Outlines[face];
            var cornerCount = CornerCounts[face];
            for (int i = 0; i < cornerCount; ++i, halfEdge = next[halfEdge])
            {
                var corner = Corner(halfEdge);
                Check.That(counts[corner] != 1);
                if (counts[corner] != 2 || first[corner] != halfEdge)
                    continue;
                int other = second[corner], otherFace = faceOfTriangle[other / 3];
                if (CornerCounts[face] == 3 || CornerCounts[otherFace] == 3 || !IsStraight(halfEdge))
                    continue;
                Drop(halfEdge, face);
                Drop(other, otherFace);
            }
        }
        pool.Return(ref first);
        pool.Return(ref second);
    }

    // Two faces that are nearly one may share an edge that is bent, within their planes.
    readonly bool IsStraight(int halfEdge)
    {
        var before = points[Corner(previous[halfEdge])];
        var line = points[Corner(next[halfEdge])] - before;
        return HullPoint.Length(HullPoint.Cross(line, points[Corner(halfEdge)] - before)) <= tolerance * HullPoint.Length(line);
    }

    // The half-edge itself still knows the one after it.
    readonly void Drop(int halfEdge, int face)
    {
        Connect(previous[halfEdge], next[halfEdge]);
        if (Outlines[face] == halfEdge)
            Outlines[face] = next[halfEdge];
        --CornerCounts[face];
    }
}
