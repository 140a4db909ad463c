using System;

namespace BepuPhysics.Collidables;

// Which points are above which triangles.
unsafe partial struct HullBuilder
{
    /// <summary>Puts a point into the list of the first of some triangles that it is well above, or else above, if there is one.</summary>
    readonly void AddOutside(int point, int firstTriangle, int endTriangle)
    {
        var position = grid.Points[point];
        var chosen = None;
        var chosenHeight = 0.0;
        for (int i = firstTriangle; i < endTriangle; ++i)
        {
            ref var triangle = ref Triangles[i];
            var scaledHeight = HeightOver(triangle, position);
            var height = scaledHeight * triangle.InverseLength;
            if (height > Negligible && (chosen == None || height > Tolerance))
                (chosen, chosenHeight) = (i, scaledHeight);
            if (height > Tolerance)
                break;
        }
        if (chosen != None)
            Prepend(point, chosenHeight, ref Triangles[chosen]);
    }

    readonly void Prepend(int point, double scaledHeight, ref HullTriangle triangle)
    {
        nextOutside[point] = triangle.FirstOutside;
        heights[point] = scaledHeight;
        triangle.FirstOutside = point;
        triangle.GreatestHeight = Math.Max(triangle.GreatestHeight, scaledHeight);
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
            Triangles[i].GreatestHeight = 0;
            while (point != None)
            {
                var next = nextOutside[point];
                var position = grid.Points[point];
                var highest = FindHighest(i, position);
                if (highest == None)
                    highest = i;
                else
                    current = Math.Min(current, highest);
                // Those that no triangle is far below stay: a triangle that blunts a sharp edge may be farther below than both sides were.
                Prepend(point, HeightOver(Triangles[highest], position), ref Triangles[highest]);
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
        // The first one too: a point may have been moved there from an earlier triangle's list a moment ago.
        var firstHeight = HeightOver(Triangles[first], point) * Triangles[first].InverseLength;
        var highest = firstHeight > Tolerance ? first : None;
        var greatest = Math.Max(firstHeight, Tolerance);
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
        if (triangle.GreatestHeight * triangle.InverseLength <= Tolerance)
            return None;
        var enough = triangle.GreatestHeight - 0.5 * Tolerance / triangle.InverseLength;
        int farthest = None, beforeFarthest = None, before = None;
        var greatestDistance = -1.0;
        for (int point = triangle.FirstOutside; point != None; before = point, point = nextOutside[point])
        {
            if (heights[point] < enough)
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
