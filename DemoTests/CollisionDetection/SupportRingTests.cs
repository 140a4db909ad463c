using System;
using System.Numerics;
using BepuPhysics.CollisionDetection;
using BepuUtilities;
using Xunit;

namespace DemoTests.CollisionDetection;

/// <summary>
/// The ring of support points around a minimum. Differences are the hull of a ball and of two tips above it, that may be one, or inside the ball.
/// </summary>
public class SupportRingTests
{
    const float Depth = 2e-3f;
    // What the search asks for: two parts in ten thousand of the smaller shape less.
    const float Bound = Depth - 2e-4f;

    /// <summary>
    /// A difference whose highest points above the origin are as high as the depth. A round one is highest there, and deepest nowhere: the depth is
    /// the least. A pointed or an edged one is less deep to the side.
    /// </summary>
    /// <param name="Normal">Unit; upwards.</param>
    /// <param name="Side">Unit, across the normal; along the edge.</param>
    /// <param name="Radius">Of the ball, whose top is at the depth where it is round, and at the origin elsewhere.</param>
    /// <param name="IsRound">Whether there are no tips.</param>
    /// <param name="HalfEdge">Half the distance of the tips.</param>
    sealed record Difference(Vector3 Normal, Vector3 Side, float Radius, bool IsRound, float HalfEdge)
    {
        public Vector3 Center => Normal * ((IsRound ? Depth : 0) - Radius);

        public Vector3 Tip(float side) => Normal * Depth + Side * (side * HalfEdge);

        public Vector3 Support(Vector3 direction)
        {
            var tip = Tip(Vector3.Dot(Side, direction) > 0 ? 1 : -1);
            var onBall = Center + direction * Radius;
            return !IsRound && Vector3.Dot(tip, direction) > Vector3.Dot(onBall, direction) ? tip : onBall;
        }

        /// <summary>Least depth over the directions across the edge, in double precision.</summary>
        public double LeastDepth()
        {
            const int count = 100_000;
            double center = (IsRound ? Depth : 0.0) - Radius, least = double.MaxValue;
            for (int i = 0; i <= count; ++i)
            {
                double cosine = Math.Cos(Math.PI * i / count), depth = center * cosine + Radius;
                least = Math.Min(least, IsRound ? depth : Math.Max(depth, Depth * cosine));
            }
            return least;
        }
    }

    [Fact]
    public void A_ring_around_a_round_minimum_certifies_it()
    {
        var certified = Run(lane => Create(lane, isRound: true, halfEdge: 0), out var ring);
        for (int lane = 0; lane < Vector<float>.Count; ++lane)
        {
            Assert.True(Create(lane, isRound: true, halfEdge: 0).LeastDepth() > Bound);
            Assert.True(Distance(ring.Vertex0, ring.Vertex2, lane) > .5f && Distance(ring.Vertex1, ring.Vertex3, lane) > .5f);
            Assert.Equal(-1, certified[lane]);
        }
    }

    /// <summary>All four support points are the tip: what is around it is unknown, and less deep.</summary>
    [Fact]
    public void A_ring_that_is_one_point_certifies_nothing()
    {
        var certified = Run(lane => Create(lane, isRound: false, halfEdge: 0), out var ring);
        for (int lane = 0; lane < Vector<float>.Count; ++lane)
        {
            foreach (var other in new[] { ring.Vertex1, ring.Vertex2, ring.Vertex3 })
                Assert.Equal(0, Distance(ring.Vertex0, other, lane));
            Assert.True(Create(lane, isRound: false, halfEdge: 0).LeastDepth() < .5 * Bound);
            Assert.Equal(0, certified[lane]);
        }
    }

    [Fact]
    public void A_ring_that_is_two_points_certifies_nothing()
    {
        var certified = Run(lane => Create(lane, isRound: false, halfEdge: .3f), out var ring);
        for (int lane = 0; lane < Vector<float>.Count; ++lane)
        {
            Assert.True(Distance(ring.Vertex0, ring.Vertex2, lane) > .5f);
            Assert.True(Distance(ring.Vertex1, ring.Vertex0, lane) == 0 || Distance(ring.Vertex1, ring.Vertex2, lane) == 0);
            Assert.True(Create(lane, isRound: false, halfEdge: .3f).LeastDepth() < .5 * Bound);
            Assert.Equal(0, certified[lane]);
        }
    }

    [Fact]
    public void A_ring_that_is_one_point_does_not_change_other_lanes()
    {
        var certified = Run(lane => Create(lane, isRound: lane % 2 == 0, halfEdge: 0), out _);
        for (int lane = 0; lane < Vector<float>.Count; ++lane)
            Assert.Equal(lane % 2 == 0 ? -1 : 0, certified[lane]);
    }

    static Difference Create(int lane, bool isRound, float halfEdge)
    {
        var random = new PairRandom(17 + (ulong)lane);
        var normal = random.NextDirection();
        var side = Vector3.Normalize(Vector3.Cross(normal, random.NextDirection()));
        // A small ball under a tip: the sides of what they span are steep.
        return new Difference(normal, side, isRound ? 1 : Depth / 2, isRound, halfEdge);
    }

    static float Distance(SearchVertex a, SearchVertex b, int lane) =>
        Vector3.Distance(Lanes.Read<Vector3, Vector3Wide>(ref a.Point, lane), Lanes.Read<Vector3, Vector3Wide>(ref b.Point, lane));

    // The steps of DepthSearch.CertifyByRing, with differences in place of shapes.
    static Vector<int> Run(Func<int, Difference> create, out SupportRing ring)
    {
        var differences = new Difference[Vector<float>.Count];
        SearchDescent descent = default;
        SearchFrame frame = default;
        for (int lane = 0; lane < differences.Length; ++lane)
        {
            var difference = differences[lane] = create(lane);
            Lanes.Write(difference.Normal, ref descent.Direction, lane);
            Lanes.Write(difference.Tip(-1), ref descent.Simplex.A.Point, lane);
            Lanes.Write(difference.Tip(1), ref descent.Simplex.B.Point, lane);
            Lanes.Write(difference.Tip(1), ref descent.Simplex.C.Point, lane);
            Lanes.Write(difference.Center, ref frame.Center, lane);
            frame.Inner = frame.Inner.WithElement(lane, difference.Radius);
        }
        descent.Depth = new Vector<float>(Depth);
        frame.Smaller = Vector<float>.One;

        ring = default;
        ring.Start(descent, frame, new Vector<float>(Bound), Vector<int>.AllBitsSet);
        Assert.Equal(Vector<int>.AllBitsSet, ring.Mask);
        Support(differences, ring.Tilt(ring.Along), ref ring.Vertex0);
        Support(differences, ring.Tilt(-ring.Along), ref ring.Vertex2);
        var across = ring.Across(descent.Direction);
        Support(differences, ring.Tilt(across), ref ring.Vertex1);
        Support(differences, ring.Tilt(-across), ref ring.Vertex3);
        return ring.Certifies();
    }

    static void Support(Difference[] differences, Vector3Wide directions, ref SearchVertex vertex)
    {
        for (int lane = 0; lane < differences.Length; ++lane)
        {
            var direction = Lanes.Read<Vector3, Vector3Wide>(ref directions, lane);
            Assert.Equal(1, direction.Length(), 1e-5f);
            Lanes.Write(differences[lane].Support(direction), ref vertex.Point, lane);
        }
    }
}
