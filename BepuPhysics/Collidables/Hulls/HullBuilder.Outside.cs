using System;

namespace BepuPhysics.Collidables;

// Which points are above which triangles.
unsafe partial struct HullBuilder
{
    /// <summary>Puts a point into the list of the first of some triangles that it is well above, or else above, if there is one.</summary>
    readonly void AddOutside(int point, int firstTriangle, int endTriangle)
    {
        var position = grid.Points[point];
        var nothing = Math.Min(Negligible, 0.5 * Tolerance);
        var chosen = None;
        for (int i = firstTriangle; i < endTriangle; ++i)
        {
            ref var triangle = ref Triangles[i];
            var height = HeightOver(triangle, position) * triangle.InverseLength;
            if (height > Tolerance)
            {
                chosen = i;
                break;
            }
            if (height > nothing && chosen == None)
                chosen = i;
        }
        if (chosen != None)
            Prepend(point, ref Triangles[chosen]);
    }

    readonly void Prepend(int point, ref HullTriangle triangle)
    {
        nextOutside[point] = triangle.FirstOutside;
        triangle.FirstOutside = point;
    }

    /// <summary>
    /// Looks among all triangles that each remaining point sees for one that it is above by more than the tolerance, moves it there, and
    /// makes the first such triangle the current one.
    /// </summary>
    bool FindHidden()
    {
        current = TriangleCount;
        for (int i = 0; i < TriangleCount; ++i)
        {
            var point = Triangles[i].FirstOutside;
            Triangles[i].FirstOutside = None;
            while (point != None)
            {
                var next = nextOutside[point];
                var highest = FindHighest(i, grid.Points[point]);
                // Those that no triangle is far below are inside for good.
                if (highest != None)
                {
                    Prepend(point, ref Triangles[highest]);
                    current = Math.Min(current, highest);
                }
                point = next;
            }
        }
        return current < TriangleCount;
    }

    /// <summary>The triangle that a point is farthest above, by more than the tolerance, of all that it sees around one of them.</summary>
    int FindHighest(int first, in HullPoint point)
    {
        ++stamp;
        seenCount = 0;
        MarkSeen(first);
        var highest = None;
        var greatest = Tolerance;
        for (int i = 0; i < seenCount; ++i)
        {
            for (int edge = 0; edge < 3; ++edge)
            {
                var neighbor = Triangles[seen[i]].Neighbors[edge];
                ref var other = ref Triangles[neighbor];
                if (other.Stamp == stamp)
                    continue;
                other.Stamp = stamp;
                var height = HeightOver(other, point) * other.InverseLength;
                if (height <= 0)
                    continue;
                MarkSeen(neighbor);
                if (height > greatest)
                    (greatest, highest) = (height, neighbor);
            }
        }
        return highest;
    }

    /// <summary>Takes the farthest point out of the list of a triangle, if it is above it by more than the tolerance.</summary>
    // Of points as far but for the tolerance, such as those along an edge parallel to the triangle, the one farthest from the middle: the
    // end of the edge, which stays a vertex, and none between, which would end up as a bend of nothing in the edge.
    readonly int TakeFarthest(ref HullTriangle triangle)
    {
        var greatest = 0.0;
        for (int point = triangle.FirstOutside; point != None; point = nextOutside[point])
            greatest = Math.Max(greatest, HeightOver(triangle, grid.Points[point]));
        if (greatest * triangle.InverseLength <= Tolerance)
            return None;
        var enough = greatest - 0.5 * Tolerance / triangle.InverseLength;
        int farthest = None, beforeFarthest = None, before = None;
        var greatestDistance = -1.0;
        for (int point = triangle.FirstOutside; point != None; before = point, point = nextOutside[point])
        {
            if (HeightOver(triangle, grid.Points[point]) < enough)
                continue;
            var offset = grid.Points[point] - grid.Middle;
            var distance = HullPoint.Dot(offset, offset);
            if (distance > greatestDistance)
                (greatestDistance, farthest, beforeFarthest) = (distance, point, before);
        }
        if (beforeFarthest == None)
            triangle.FirstOutside = nextOutside[farthest];
        else
            nextOutside[beforeFarthest] = nextOutside[farthest];
        return farthest;
    }
}
