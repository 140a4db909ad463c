using System;
using System.Linq;
using System.Numerics;
using BepuPhysics.Collidables;
using BepuPhysics.CollisionDetection;
using BepuUtilities.Memory;
using Xunit;

namespace DemoTests.CollisionDetection;

/// <summary>Features lie on their shapes, turn the right way around and are those that face the direction.</summary>
public class FaceFeatureTests
{
    static void AssertPolygon(FaceFeature feature, Vector3 direction, float size)
    {
        var normal = Vector3.Zero;
        for (int i = 0; i < feature.Vertices.Length; ++i)
        {
            var next = feature.Vertices[(i + 1) % feature.Vertices.Length];
            normal += Vector3.Cross(feature.Vertices[i], next);
            Assert.Equal(0, Vector3.Dot(feature.Vertices[i] - feature.Vertices[0], feature.PlaneNormal), 2e-5f * size);
        }
        Assert.True(Vector3.Dot(Vector3.Normalize(normal), feature.PlaneNormal) > 0.9999f);
        Assert.True(Vector3.Dot(feature.PlaneNormal, direction) >= 0);
        // Only what the bundle's greatest count asks for has to be written; here that is the lane's own.
        Assert.InRange(feature.Size, size * 0.999f, size * 1.001f);
    }

    [Fact]
    public void BoxesShowTheFaceNearestToTheDirection()
    {
        var random = new PairRandom(1);
        var ids = Enumerable.Range(0, 200).Select(_ =>
        {
            var box = new Box(random.Next(0.1, 3), random.Next(0.1, 3), random.Next(0.1, 3));
            var direction = random.NextDirection();
            var feature = FaceFeature.Find<Box, BoxWide, BoxFeature>(box, direction, random.Next(Vector<float>.Count));
            AssertPolygon(feature, direction, new Vector3(box.HalfWidth, box.HalfHeight, box.HalfLength).Length());
            Assert.All(feature.Vertices, v => Assert.Equal(new(box.HalfWidth, box.HalfHeight, box.HalfLength), Vector3.Abs(v)));
            Assert.Equal(4, feature.Vertices.Distinct().Count());
            var largest = Math.Max(Math.Abs(direction.X), Math.Max(Math.Abs(direction.Y), Math.Abs(direction.Z)));
            Assert.Equal(largest, Vector3.Dot(feature.PlaneNormal, direction));
            return feature.Id;
        }).Distinct();
        Assert.Equal(6, ids.Count());
    }

    [Fact]
    public void TrianglesShowTheSideThatFacesTheDirection()
    {
        var random = new PairRandom(2);
        for (int i = 0; i < 200; ++i)
        {
            var triangle = new Triangle(random.NextDirection(), random.NextDirection() * 2, random.NextDirection());
            var direction = random.NextDirection();
            var feature = FaceFeature.Find<Triangle, TriangleWide, TriangleFeature>(triangle, direction);
            AssertPolygon(feature, direction, 2);
            var front = Vector3.Cross(triangle.C - triangle.A, triangle.B - triangle.A);
            Assert.Equal(Vector3.Dot(front, direction) >= 0 ? 0 : 1, feature.Id);
        }
    }

    [Fact]
    public void CylindersShowAnEndOrTheLineOfTheirSide()
    {
        var random = new PairRandom(3);
        for (int i = 0; i < 400; ++i)
        {
            var cylinder = new Cylinder(random.Next(0.1, 2), random.Next(0.1, 2));
            var direction = random.NextDirection();
            var feature = FaceFeature.Find<Cylinder, CylinderWide, CylinderFeature>(cylinder, direction, random.Next(Vector<float>.Count));
            var across = new Vector3(direction.X, 0, direction.Z);
            Assert.All(feature.Vertices, v => Assert.Equal(cylinder.Radius, new Vector3(v.X, 0, v.Z).Length(), 1e-6f * cylinder.Radius));
            if (Math.Abs(direction.Y) >= across.Length())
            {
                AssertPolygon(feature, direction, MathF.Sqrt(cylinder.Radius * cylinder.Radius + cylinder.HalfLength * cylinder.HalfLength));
                Assert.Equal(FaceFeature.DiscVertexCount, feature.Vertices.Length);
                Assert.All(feature.Vertices, v => Assert.Equal(MathF.CopySign(cylinder.HalfLength, direction.Y), v.Y));
            }
            else
            {
                Assert.Equal(2, feature.Vertices.Length);
                Assert.Equal((-cylinder.HalfLength, cylinder.HalfLength), (feature.Vertices[0].Y, feature.Vertices[1].Y));
                // The line that reaches farthest.
                Assert.All(feature.Vertices, v => Assert.Equal(cylinder.Radius * across.Length(), Vector3.Dot(across, v), 1e-5f));
                Assert.Equal(across, feature.PlaneNormal);
                Assert.Equal(cylinder.Radius, feature.Roundness);
            }
        }
    }

    [Fact]
    public void HullsShowTheFaceNearestToTheDirectionOrTheNearerOneOfAnEdge()
    {
        using var pool = new BufferPool();
        var random = new PairRandom(4);
        for (int i = 0; i < 50; ++i)
        {
            var points = new Vector3[8 + random.Next(40)];
            for (int k = 0; k < points.Length; ++k)
                points[k] = random.NextDirection() * random.Next(0.8, 1);
            var hull = new ConvexHull(points, pool, out _);
            for (int k = 0; k < 20; ++k)
            {
                var direction = random.NextDirection();
                var feature = FaceFeature.Find<ConvexHull, ConvexHullWide, StandingHullFeature>(hull, direction, k % Vector<float>.Count);
                var farthest = Enumerable.Range(0, hull.VertexCount).Max(v => { hull.GetPoint(v, out var p); return p.Length(); });
                AssertPolygon(feature, direction, farthest);
                var normals = Enumerable.Range(0, hull.FaceCount).Select(face => NormalOf(hull, face)).ToArray();
                var faces = Enumerable.Range(0, hull.FaceCount);
                if (FindEdgeBelow(hull, direction) is var (first, second))
                    faces = faces.Where(face => Holds(hull, face, first) && Holds(hull, face, second));
                Assert.Equal(faces.Max(face => Vector3.Dot(normals[face], direction)), Vector3.Dot(normals[feature.Id], direction), 1e-6f);
                hull.GetVertexIndicesForFace(feature.Id, out var indices);
                Assert.Equal(indices.Length, feature.Vertices.Length);
                for (int v = 0; v < indices.Length; ++v)
                {
                    hull.GetPoint(indices[v], out var point);
                    Assert.Equal(point, feature.Vertices[v]);
                }
            }
            hull.Dispose(pool);
        }
    }

    // The ends of the edge on which a hull stands that lies on no face: those of its two foremost vertices, where the edge slopes by less than a tenth.
    static (int First, int Second)? FindEdgeBelow(ConvexHull hull, Vector3 direction)
    {
        if (Enumerable.Range(0, hull.FaceCount).Max(face => Vector3.Dot(NormalOf(hull, face), direction)) > .9999f)
            return null;
        var foremost = Enumerable.Range(0, hull.VertexCount).OrderByDescending(v => Vector3.Dot(PointOf(hull, v), direction)).ToArray();
        var edge = PointOf(hull, foremost[1]) - PointOf(hull, foremost[0]);
        return MathF.Abs(Vector3.Dot(edge, direction)) < .1f * edge.Length() ? (foremost[0], foremost[1]) : null;
    }

    static Vector3 PointOf(in ConvexHull hull, int vertex)
    {
        hull.GetPoint(vertex, out var point);
        return point;
    }

    static bool Holds(in ConvexHull hull, int face, int vertex)
    {
        hull.GetVertexIndicesForFace(face, out var indices);
        for (int i = 0; i < indices.Length; ++i)
        {
            hull.GetPoint(indices[i], out var point);
            if (point == PointOf(hull, vertex))
                return true;
        }
        return false;
    }

    static Vector3 NormalOf(in ConvexHull hull, int face)
    {
        var plane = hull.BoundingPlanes[face / Vector<float>.Count].Normal;
        var lane = face % Vector<float>.Count;
        return new(plane.X[lane], plane.Y[lane], plane.Z[lane]);
    }

    // A keel's ends look more nearly down than its sides, and hold only one end of its edge.
    [Theory]
    [InlineData(-.05f)]
    [InlineData(-.001f)]
    [InlineData(0)]
    [InlineData(.001f)]
    [InlineData(.05f)]
    public void AHullOnAnEdgeShowsBothOfItsEndsHoweverItTilts(float tilt)
    {
        using var pool = new BufferPool();
        Vector3[] points =
        [
            new(-.3f, -.3f, 0), new(.3f, -.3f, 0), new(-.9f, .3f, -.2f), new(-.9f, .3f, .2f), new(.9f, .3f, -.2f), new(.9f, .3f, .2f),
        ];
        var hull = new ConvexHull(points, pool, out var center);
        var feature = FaceFeature.Find<ConvexHull, ConvexHullWide, StandingHullFeature>(hull, Vector3.Normalize(new Vector3(tilt, -1, 0)));
        for (int end = 0; end < 2; ++end)
            Assert.Contains(feature.Vertices, vertex => Vector3.Distance(vertex, points[end] - center) < 1e-6f);
        hull.Dispose(pool);
    }

    [Fact]
    public void FacesWithMoreThan64VerticesAreThinnedOutEvenly()
    {
        using var pool = new BufferPool();
        const int Count = 100;
        var points = new Vector3[Count * 2];
        for (int i = 0; i < Count; ++i)
        {
            points[i] = new(MathF.Cos(i * MathF.Tau / Count), -0.2f, MathF.Sin(i * MathF.Tau / Count));
            points[i + Count] = points[i] with { Y = 0.2f };
        }
        var hull = new ConvexHull(points, pool, out _);
        var feature = FaceFeature.Find<ConvexHull, ConvexHullWide, ConvexHullFeature>(hull, Vector3.UnitY);
        Assert.Equal(64, feature.Vertices.Length);
        Assert.Equal(64, feature.Vertices.Distinct().Count());
        AssertPolygon(feature, Vector3.UnitY, new Vector2(1, 0.2f).Length());
        for (int i = 0; i < 64; ++i)
        {
            var side = (feature.Vertices[(i + 1) % 64] - feature.Vertices[i]).Length();
            Assert.InRange(side, 0.9 * Math.Tau / Count, 2.1 * Math.Tau / Count);
        }
        hull.Dispose(pool);
    }

    [Fact]
    public void CapsulesAndSpheresShowTheirCores()
    {
        var direction = Vector3.Normalize(new(1, 2, 3));
        var capsule = FaceFeature.Find<Capsule, CapsuleWide, CapsuleFeature>(new Capsule(0.2f, 1), direction);
        Assert.Equal([new(0, -0.5f, 0), new(0, 0.5f, 0)], capsule.Vertices);
        Assert.Equal((direction with { Y = 0 }, 0.2f, 0.2f, 0.7f), (capsule.PlaneNormal, capsule.Margin, capsule.Roundness, capsule.Size));
        var sphere = FaceFeature.Find<Sphere, SphereWide, SphereFeature>(new Sphere(0.3f), direction);
        Assert.Equal([Vector3.Zero], sphere.Vertices);
        Assert.Equal((0.3f, 0.3f), (sphere.Margin, sphere.Size));
    }
}
