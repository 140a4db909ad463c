using System;
using System.Collections.Generic;
using System.Linq;
using BepuPhysics.CollisionDetection;
using Demos.References;
using DemoTests.Support;
using Xunit;

namespace DemoTests.CollisionDetection;

/// <summary>The polytope against all planes through three of its points.</summary>
public class ExpandingPolytopeTests
{
    [Theory]
    [InlineData(1, false)]
    [InlineData(2, false)]
    [InlineData(3, true)]
    [InlineData(4, true)]
    public unsafe void The_nearest_face_is_that_of_the_convex_hull(ulong seed, bool isFlat)
    {
        PolytopeMemory memory = default;
        var polytope = new ExpandingPolytope(&memory, 1e-9);
        var random = new ConvexRandom(seed);
        List<Double3> points = [];
        for (int i = 0; i < 40; ++i)
        {
            var point = random.NextDirection() * random.Next(0.9, 1.3);
            // Many points in one plane, and on one line.
            points.Add(isFlat && i > 4 ? new(point.X, 0.5, i % 3 == 0 ? 0.25 : point.Z) : point);
            Set(ref polytope, polytope.VertexCount > 0 ? polytope.VertexCount : i, points[i]);
            if (i == 3)
                polytope.Start();
            else if (i > 3)
                polytope.TryExpand();
            if (i >= 3)
                Assert.Equal(LeastHeight(points), polytope.Priority(polytope.FindLeast()), 1e-7);
        }
    }

    [Fact]
    public unsafe void There_is_room_for_all_vertices()
    {
        PolytopeMemory memory = default;
        var polytope = new ExpandingPolytope(&memory, 1e-9);
        var random = new ConvexRandom(5);
        for (int i = 0; i < 4; ++i)
            Set(ref polytope, i, random.NextDirection());
        polytope.Start();
        while (polytope.VertexCount < PolytopeMemory.VertexCapacity)
        {
            Set(ref polytope, polytope.VertexCount, random.NextDirection());
            Assert.True(polytope.TryExpand());
        }
        var least = polytope.FindLeast();
        Assert.InRange(polytope.Priority(least), 0.5, 1);
        polytope.Settle(least);
        Assert.NotEqual(least, polytope.FindLeast());
    }

    static void Set(ref ExpandingPolytope polytope, int vertex, Double3 point) =>
        polytope[vertex].Point = new DoubleVector3(point.X, point.Y, point.Z);

    /// <summary>Least height over the origin of the planes that have all points on one side.</summary>
    static double LeastHeight(List<Double3> points)
    {
        var least = double.MaxValue;
        for (int i = 0; i < points.Count; ++i)
        {
            for (int j = i + 1; j < points.Count; ++j)
            {
                for (int k = j + 1; k < points.Count; ++k)
                {
                    var normal = Double3.Cross(points[j] - points[i], points[k] - points[i]);
                    if (normal.Length < 1e-9)
                        continue;
                    normal *= 1 / normal.Length;
                    var height = Double3.Dot(normal, points[i]);
                    if (points.All(point => Double3.Dot(normal, point) <= height + 1e-9))
                        least = Math.Min(least, height);
                    if (points.All(point => Double3.Dot(normal, point) >= height - 1e-9))
                        least = Math.Min(least, -height);
                }
            }
        }
        return least;
    }
}
