using System;
using BepuUtilities.Diagnostics;
using BepuUtilities.Memory;

namespace BepuPhysics.Collidables;

/// <summary>Builds a convex hull of triangles around points of a grid.</summary>
/// <remarks>
/// Quickhull (Barber, Dobkin and Huhdanpaa, "The Quickhull Algorithm for Convex Hulls", 1996): each triangle lists points above it; the
/// farthest one is joined to the border of all that it sees, and what it sees goes. Points that are above no triangle by more than a
/// tolerance are left out.
/// What makes this safe is that a point sees a triangle when it is on or above its plane exactly, decided in whole numbers. For a convex
/// surface this is what a point a little farther out sees, in general position; so the part seen is always one piece without holes, its
/// border one loop, and no new triangle lies in the plane of the old one next to it, none has no area. The surface stays closed and convex
/// for any input. All tolerances only decide which points are left out.
/// A pass over the triangles in the order of their creation ends when the last one has nothing above it; each insertion uses up a point.
/// No point that sees a triangle is forgotten before the end. Far beyond a razor-sharp edge a point may be next to the planes of both
/// sides; once another point is joined to that edge, the new triangle that blunts it faces the first one, which is as far above that as
/// it is from the edge.
/// </remarks>
unsafe partial struct HullBuilder
{
    const int None = -1;
    /// <summary>Height below which a point is on a triangle, cells: what a height is rounded by, and no more, because near a sharp edge
    /// the hull may be a hundred thousand times as far.</summary>
    const double Negligible = 1.0 / 256;

    readonly BufferPool pool;
    readonly HullGrid grid;
    readonly double coarseness;
    /// <summary>The triangles, dead ones among them.</summary>
    public Buffer<HullTriangle> Triangles;
    /// <summary>Number of triangles, dead ones included.</summary>
    public int TriangleCount;
    /// <summary>How far points may be outside, cells.</summary>
    public double Tolerance;

    int deadCount, stamp, current;
    // For each point: the one after it in the list of its triangle; for each corner of a border: the new triangle that begins there.
    Buffer<int> nextOutside, triangleAtStart;
    // For each point in the list of a triangle: its height over that, in units of the normal's length.
    Buffer<double> heights;
    // Triangles that the new point sees, and the border: outer triangles and the edges by which they touch what is seen.
    Buffer<int> seen, border;
    int seenCount, borderCount;

    HullBuilder(in HullGrid grid, double coarseness, BufferPool pool)
    {
        this.grid = grid;
        this.coarseness = coarseness;
        this.pool = pool;
        pool.Take(grid.Points.Length, out nextOutside);
        pool.Take(grid.Points.Length, out triangleAtStart);
        pool.Take(grid.Points.Length, out heights);
        pool.TakeAtLeast(64, out Triangles);
        pool.TakeAtLeast(64, out seen);
        pool.TakeAtLeast(64, out border);
    }

    /// <summary>Builds the hull; there is something to dispose even when there is none.</summary>
    /// <param name="grid">The points.</param>
    /// <param name="coarseness">Factor on the tolerance.</param>
    /// <param name="pool">Source of memory.</param>
    /// <param name="builder">The hull, as triangles.</param>
    public static HullFailure TryBuild(in HullGrid grid, double coarseness, BufferPool pool, out HullBuilder builder)
    {
        builder = new(grid, coarseness, pool);
        var failure = builder.TryStart();
        if (failure != HullFailure.None)
            return failure;
        do
        {
            while (builder.current < builder.TriangleCount)
            {
                // A triangle whose point was inserted is dead.
                if (builder.Triangles[builder.current].Dead || !builder.TryInsertFarthest())
                    ++builder.current;
                // A closed surface of triangles has half as many vertices as triangles, and two.
                if (builder.TriangleCount - builder.deadCount > 2 * ConvexHull.MaximumVertexCount)
                    return HullFailure.TooManyVertices;
            }
            builder.RemoveDead();
        }
        while (builder.FindHidden());
        return HullFailure.None;
    }

    public void Dispose()
    {
        pool.Return(ref nextOutside);
        pool.Return(ref triangleAtStart);
        pool.Return(ref heights);
        pool.Return(ref Triangles);
        pool.Return(ref seen);
        pool.Return(ref border);
    }

    /// <summary>Four points that are far from each other, their triangles, and all other points above one of these.</summary>
    HullFailure TryStart()
    {
        var points = grid.Points;
        var a = FindFarthest(grid.Middle);
        var b = FindFarthest(points[a]);
        var axis = points[b] - points[a];
        var length = HullPoint.Length(axis);
        if (length < grid.FlatThickness)
            return HullFailure.AllPointsCoincide;

        double width = 0, thickness = 0;
        int c = 0, d = 0;
        for (int i = 0; i < points.Length; ++i)
        {
            var distance = HullPoint.Length(HullPoint.Cross(axis, points[i] - points[a])) / length;
            if (distance > width)
                (width, c) = (distance, i);
        }
        if (width < grid.FlatThickness)
            return HullFailure.AllPointsOnALine;

        var normal = HullPoint.Normal(points[a], points[b], points[c]);
        var normalLength = HullPoint.Length(normal);
        var isAbove = false;
        for (int i = 0; i < points.Length; ++i)
        {
            var height = HullPoint.Dot(normal, points[i] - points[a]) / normalLength;
            if (Math.Abs(height) > thickness)
                (thickness, d, isAbove) = (Math.Abs(height), i, height > 0);
        }
        if (thickness < grid.FlatThickness)
            return HullFailure.AllPointsInAPlane;

        Tolerance = grid.Tolerance(thickness) * coarseness;
        if (isAbove)
            (b, c) = (c, b);
        // d is below a, b, c.
        Link(AddTriangle(a, b, c), 3, 2, 1);
        Link(AddTriangle(a, c, d), 0, 2, 3);
        Link(AddTriangle(c, b, d), 0, 3, 1);
        Link(AddTriangle(b, a, d), 0, 1, 2);
        for (int i = 0; i < points.Length; ++i)
            AddOutside(i, 0, 4);
        return HullFailure.None;
    }

    readonly int FindFarthest(in HullPoint from)
    {
        var farthest = 0;
        var greatest = -1.0;
        for (int i = 0; i < grid.Points.Length; ++i)
        {
            var offset = grid.Points[i] - from;
            var distance = HullPoint.Dot(offset, offset);
            if (distance > greatest)
                (greatest, farthest) = (distance, i);
        }
        return farthest;
    }

    readonly double HeightOver(in HullTriangle triangle, in HullPoint point) =>
        HullPoint.Dot(triangle.Normal, point - grid.Points[triangle.Corners[0]]);

    readonly bool Sees(in HullPoint eye, in HullTriangle triangle)
    {
        var height = HeightOver(triangle, eye);
        if (Math.Abs(height) > triangle.Uncertainty)
            return height > 0;
        return HullPoint.Side(grid.Points[triangle.Corners[0]], grid.Points[triangle.Corners[1]], grid.Points[triangle.Corners[2]], eye) >= 0;
    }

    /// <summary>Inserts the farthest point above the current triangle, if there is one above it by more than the tolerance.</summary>
    bool TryInsertFarthest()
    {
        var eye = TakeFarthest(ref Triangles[current]);
        if (eye == None || !Sees(grid.Points[eye], Triangles[current]))
            return false;
        FindSeen(eye);
        var firstNew = TriangleCount;
        JoinBorder(eye);
        for (int i = 0; i < seenCount; ++i)
        {
            var point = Triangles[seen[i]].FirstOutside;
            while (point != None)
            {
                var next = nextOutside[point];
                AddOutside(point, firstNew, TriangleCount);
                point = next;
            }
            Triangles[seen[i]].Dead = true;
        }
        deadCount += seenCount;
        if (deadCount > 1024 && deadCount > TriangleCount / 2)
            RemoveDead();
        return true;
    }

    /// <summary>Finds all triangles that a point sees, beginning with the current one, and the border around them.</summary>
    void FindSeen(int eye)
    {
        var position = grid.Points[eye];
        ++stamp;
        seenCount = borderCount = 0;
        MarkSeen(current);
        for (int i = 0; i < seenCount; ++i)
        {
            for (int edge = 0; edge < 3; ++edge)
            {
                var neighbor = Triangles[seen[i]].Neighbors[edge];
                ref var other = ref Triangles[neighbor];
                if (other.Stamp != stamp)
                {
                    if (Sees(position, other))
                    {
                        MarkSeen(neighbor);
                    }
                    else
                    {
                        other.Stamp = stamp;
                        other.Visible = false;
                    }
                }
                if (!other.Visible)
                {
                    if (borderCount + 2 > border.Length)
                        pool.ResizeToAtLeast(ref border, borderCount * 2, borderCount);
                    border[borderCount++] = neighbor;
                    border[borderCount++] = other.EdgeTo(seen[i]);
                }
            }
        }
    }

    void MarkSeen(int triangle)
    {
        Triangles[triangle].Stamp = stamp;
        Triangles[triangle].Visible = true;
        if (seenCount == seen.Length)
            pool.ResizeToAtLeast(ref seen, seenCount * 2, seenCount);
        seen[seenCount++] = triangle;
    }

    /// <summary>Makes a triangle from each edge of the border to a point.</summary>
    void JoinBorder(int eye)
    {
        var firstNew = TriangleCount;
        for (int i = 0; i < borderCount; i += 2)
        {
            // An edge of the outer triangle runs against the border.
            var outer = border[i];
            var outerEdge = border[i + 1];
            var start = Triangles[outer].Corners[HullTriangle.Next(outerEdge)];
            var end = Triangles[outer].Corners[outerEdge];
            var triangle = AddTriangle(start, end, eye);
            Triangles[triangle].Neighbors[0] = outer;
            Triangles[outer].Neighbors[outerEdge] = triangle;
            triangleAtStart[start] = triangle;
        }
        for (int i = firstNew; i < TriangleCount; ++i)
        {
            var following = triangleAtStart[Triangles[i].Corners[1]];
            Check.That(following >= firstNew && Triangles[following].Corners[0] == Triangles[i].Corners[1]);
            Triangles[i].Neighbors[1] = following;
            Triangles[following].Neighbors[2] = i;
        }
    }

    int AddTriangle(int a, int b, int c)
    {
        if (TriangleCount == Triangles.Length)
            pool.ResizeToAtLeast(ref Triangles, TriangleCount * 2, TriangleCount);
        ref var triangle = ref Triangles[TriangleCount];
        triangle = default;
        triangle.Corners[0] = a;
        triangle.Corners[1] = b;
        triangle.Corners[2] = c;
        triangle.Normal = HullPoint.Normal(grid.Points[a], grid.Points[b], grid.Points[c]);
        triangle.InverseLength = 1 / HullPoint.Length(triangle.Normal);
        // Each component is rounded once, and each product and sum: less than eight roundings of 2^-53 of terms below 2^41 times it.
        triangle.Uncertainty = (Math.Abs(triangle.Normal.X) + Math.Abs(triangle.Normal.Y) + Math.Abs(triangle.Normal.Z)) * (1.0 / 512);
        triangle.FirstOutside = None;
        return TriangleCount++;
    }

    readonly void Link(int triangle, int neighbor0, int neighbor1, int neighbor2)
    {
        Triangles[triangle].Neighbors[0] = neighbor0;
        Triangles[triangle].Neighbors[1] = neighbor1;
        Triangles[triangle].Neighbors[2] = neighbor2;
    }

    /// <summary>Closes the gaps that dead triangles leave; the others stay in order.</summary>
    void RemoveDead()
    {
        pool.Take<int>(TriangleCount, out var newIndices);
        var count = 0;
        var newCurrent = 0;
        for (int i = 0; i < TriangleCount; ++i)
        {
            if (i == current)
                newCurrent = count;
            newIndices[i] = count;
            if (!Triangles[i].Dead)
                Triangles[count++] = Triangles[i];
        }
        for (int i = 0; i < count; ++i)
        {
            for (int edge = 0; edge < 3; ++edge)
                Triangles[i].Neighbors[edge] = newIndices[Triangles[i].Neighbors[edge]];
        }
        pool.Return(ref newIndices);
        current = current >= TriangleCount ? count : newCurrent;
        TriangleCount = count;
        deadCount = 0;
    }
}
