using System;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuUtilities;
using BepuUtilities.Memory;
using Demos.References;
using DemoTests.CollisionDetection;
using Xunit;

namespace DemoTests.Collidables;

/// <summary>Triangles against double precision: bounds, rays, inertia.</summary>
public sealed class TriangleTests
{
    static RigidPose NextPose(ref PairRandom random, float spread) => new(random.NextDirection() * random.Next(0, spread), random.NextOrientation());

    static Double3[] Corners(in Triangle triangle, in RigidPose pose)
    {
        var rotation = DoubleQuaternion.Normalize(pose.Orientation);
        return [rotation.Rotate(triangle.A) + pose.Position, rotation.Rotate(triangle.B) + pose.Position, rotation.Rotate(triangle.C) + pose.Position];
    }

    [Fact]
    public void BoundsAreThoseOfTheCorners()
    {
        var random = new PairRandom(1);
        for (int i = 0; i < 2000; ++i)
        {
            var triangle = TrianglePairCases.CreateTriangle(ref random);
            var pose = new RigidPose(default, random.NextOrientation());
            triangle.ComputeBounds(pose.Orientation, out var min, out var max);
            triangle.ComputeAngularExpansionData(out var radius, out var expansion);
            var corners = Corners(triangle, pose);
            double farthest = Math.Max(corners[0].Length, Math.Max(corners[1].Length, corners[2].Length));
            Assert.Equal(farthest, radius, 1e-6 * farthest);
            var tolerance = 1e-6 * farthest;
            for (int axis = 0; axis < 3; ++axis)
            {
                double Get(Double3 v) => axis == 0 ? v.X : axis == 1 ? v.Y : v.Z;
                Assert.Equal(Math.Min(Get(corners[0]), Math.Min(Get(corners[1]), Get(corners[2]))), min[axis], tolerance);
                Assert.Equal(Math.Max(Get(corners[0]), Math.Max(Get(corners[1]), Get(corners[2]))), max[axis], tolerance);
            }
            // No other attitude leaves the bounds by more than the expansion.
            triangle.ComputeBounds(random.NextOrientation(), out var otherMin, out var otherMax);
            var grown = new Vector3(expansion + (float)tolerance);
            Assert.True(BoundingBox.Contains(new(min - grown, max + grown), new(otherMin, otherMax)));
        }
    }

    [Fact]
    public void ACentredTriangleExpandsByItsRadiusAndOneBesideItsOriginByMore()
    {
        new Triangle(new(1, 0, 0), new(-1, 0, 1), new(0, 0, -1)).ComputeAngularExpansionData(out var radius, out var expansion);
        Assert.Equal(radius, expansion, 1e-6f);
        new Triangle(new(10, 0, 0), new(10, 0, 1), new(10, 1, -1)).ComputeAngularExpansionData(out radius, out expansion);
        Assert.InRange(expansion, 20, 2 * radius);
    }

    [Fact]
    public void RaysMeetTheFrontOnlyUnlessThereAreTwoSides()
    {
        var triangle = new Triangle(new(-1, 0, -1), new(1, 0, -1), new(0, 0, 1));
        Assert.True(triangle.RayTest(RigidPose.Identity, new(0, 3, 0), new(0, -2, 0), out var t, out var normal));
        Assert.Equal((1.5f, Vector3.UnitY), (t, normal));
        AssertMiss(triangle, new(0, -3, 0), new(0, 2, 0));
        AssertMiss(triangle, new(0, 3, 0), new(0, 2, 0));
        AssertMiss(triangle, new(3, 0, 0), new(-1, 0, 0));
        triangle.TwoSided = true;
        Assert.True(triangle.TwoSided);
        Assert.True(triangle.RayTest(RigidPose.Identity, new(0, -3, 0), new(0, 2, 0), out t, out normal));
        Assert.Equal((1.5f, -Vector3.UnitY), (t, normal));
        Assert.True(triangle.RayTest(RigidPose.Identity, new(0, 3, 0), new(0, -2, 0), out _, out normal));
        Assert.Equal(Vector3.UnitY, normal);
        AssertMiss(triangle, new(3, 0, 0), new(-1, 0, 0));
        AssertMiss(triangle, default, default);
        AssertMiss(triangle, new(0, 1, 0), new(0, float.NaN, 0));
        AssertMiss(triangle, new(float.PositiveInfinity, 1, 0), new(0, -1, 0));
        AssertMiss(triangle, new(3e38f, 2e38f, 0), new(0, -1, 0));
    }

    static void AssertMiss(Triangle shape, Vector3 origin, Vector3 direction)
    {
        Assert.False(shape.RayTest(RigidPose.Identity, origin, direction, out var t, out var normal));
        Assert.Equal((0, Vector3.Zero), (t, normal));
    }

    [Fact]
    public void RandomRaysAgreeWithDoublePrecision()
    {
        var random = new PairRandom(2);
        int hits = 0, misses = 0;
        for (int i = 0; i < 50_000; ++i)
        {
            var triangle = TrianglePairCases.CreateTriangle(ref random);
            var pose = NextPose(ref random, 5);
            var corners = Corners(triangle, pose);
            double u = random.Next(-0.5, 1.2), v = random.Next(-0.5, 1.2);
            var target = corners[0] + (corners[1] - corners[0]) * u + (corners[2] - corners[0]) * v;
            var distance = random.NextLogarithmic(0.01, 100);
            var away = random.NextDirection();
            var origin = new Vector3((float)target.X, (float)target.Y, (float)target.Z) + away * distance;
            var direction = away * -random.NextLogarithmic(1e-10, 1e10);
            var hit = triangle.RayTest(pose, origin, direction, out var t, out var normal);

            // Where the ray meets the plane, and how far that is inside the nearest edge.
            var front = Double3.Cross(corners[2] - corners[0], corners[1] - corners[0]);
            front *= 1 / front.Length;
            var length = ((Double3)direction).Length;
            var d = (Double3)direction * (1 / length);
            var facing = -Double3.Dot(front, d);
            var along = Double3.Dot((Double3)origin - corners[0], front) / facing;
            var point = (Double3)origin + d * along;
            var inside = double.MaxValue;
            for (int j = 0; j < 3; ++j)
            {
                var edge = corners[(j + 1) % 3] - corners[j];
                inside = Math.Min(inside, Double3.Dot(Double3.Cross(edge, point - corners[j]), front) * -1 / edge.Length);
            }
            // Roundings of the places shift the ray across itself; on the plane that is more by the angle between them.
            var reach = Math.Max(((Double3)triangle.A).Length, Math.Max(((Double3)triangle.B).Length, ((Double3)triangle.C).Length));
            var tolerance = 2e-6 * (reach + pose.Position.Length() + distance) / Math.Max(1e-9, Math.Abs(facing));
            var isFacing = triangle.TwoSided || facing > 0;
            if (isFacing && inside > tolerance && along > tolerance)
                Assert.True(hit, $"{i} missed");
            if (!isFacing || inside < -tolerance || along < -tolerance)
                Assert.False(hit, $"{i} hit");
            if (!hit)
            {
                ++misses;
                continue;
            }
            ++hits;
            var expected = facing > 0 ? front : -front;
            Assert.True(((Double3)normal - expected).Length < 1e-4);
            if (inside > tolerance)
                Assert.True(Math.Abs(t * length - along) < 3 * tolerance, $"{t * length} for {along}");
        }
        Assert.True(hits > 5000 && misses > 5000);
    }

    [Fact]
    public void NoRayPassesBetweenTrianglesThatShareAnEdge()
    {
        var random = new PairRandom(3);
        for (int i = 0; i < 20_000; ++i)
        {
            // A fan around a point; rays at its inner edges and at the point itself, from anywhere in front.
            var center = new Vector3(random.Next(-1, 1), random.Next(-0.2, 0.2), random.Next(-1, 1));
            var pose = NextPose(ref random, 100);
            const int Count = 5;
            var ring = new Vector3[Count];
            for (int j = 0; j < Count; ++j)
                ring[j] = center + new Vector3(MathF.Cos(j * 1.2566f), random.Next(-0.3, 0.3), MathF.Sin(j * 1.2566f)) * random.Next(0.5, 3);
            var target = Vector3.Lerp(center, ring[random.Next(Count)], i % 3 == 0 ? 0 : random.Next(0, 0.9));
            var direction = Vector3.Normalize(new(random.Next(-0.3, 0.3), -1, random.Next(-0.3, 0.3)));
            var origin = Vector3.Transform(target - direction * random.NextLogarithmic(1, 1000), pose.Orientation) + pose.Position;
            var worldDirection = Vector3.Transform(direction, pose.Orientation);
            var hit = false;
            for (int j = 0; j < Count; ++j)
            {
                var triangle = new Triangle(center, ring[j], ring[(j + 1) % Count]) { TwoSided = true };
                hit |= triangle.RayTest(pose, origin, worldDirection, out _, out _);
            }
            Assert.True(hit, $"{i}");
        }
    }

    [Fact]
    public void LanesAreIndependent()
    {
        var random = new PairRandom(4);
        for (int round = 0; round < 200; ++round)
        {
            var lanes = Vector<float>.Count;
            var shapes = new Triangle[lanes];
            var poses = new RigidPose[lanes];
            var rays = new (Vector3 Origin, Vector3 Direction)[lanes];
            TriangleWide bundle = default;
            RigidPoseWide wides = default;
            RayWide ray = default;
            for (int i = 0; i < lanes; ++i)
            {
                shapes[i] = TrianglePairCases.CreateTriangle(ref random);
                poses[i] = NextPose(ref random, 2);
                var target = Vector3.Transform((shapes[i].A + shapes[i].B + shapes[i].C) / 3, poses[i].Orientation) + poses[i].Position;
                var away = random.NextDirection();
                rays[i] = (target + away * random.Next(0, 4) + random.NextDirection() * random.Next(0, 0.2), -away);
                Lanes.Write(shapes[i], ref bundle, i);
                Lanes.Write(poses[i].Position, ref wides.Position, i);
                Lanes.Write(poses[i].Orientation, ref wides.Orientation, i);
                Lanes.Write(rays[i].Origin, ref ray.Origin, i);
                Lanes.Write(rays[i].Direction, ref ray.Direction, i);
            }
            bundle.GetBounds(wides.Orientation, out var radius, out var expansion, out var min, out var max);
            bundle.RayTest(wides, ray, out var hitMask, out var t, out var normal);
            for (int i = 0; i < lanes; ++i)
            {
                shapes[i].ComputeBounds(poses[i].Orientation, out var expectedMin, out var expectedMax);
                shapes[i].ComputeAngularExpansionData(out var expectedRadius, out var expectedExpansion);
                Assert.Equal((expectedRadius, expectedExpansion), (radius[i], expansion[i]));
                Assert.Equal((expectedMin, expectedMax), (Lanes.Read<Vector3, Vector3Wide>(ref min, i), Lanes.Read<Vector3, Vector3Wide>(ref max, i)));
                var hit = shapes[i].RayTest(poses[i], rays[i].Origin, rays[i].Direction, out var expectedT, out var expectedNormal);
                Assert.Equal((hit ? -1 : 0, expectedT, expectedNormal), (hitMask[i], t[i], Lanes.Read<Vector3, Vector3Wide>(ref normal, i)));
            }
        }
    }

    [Theory]
    [InlineData(1e-2f)]
    [InlineData(1f)]
    [InlineData(1e4f)]
    public void InertiaAgreesWithADoubleIntegral(float scale)
    {
        const float Mass = 2.5f;
        var random = new PairRandom(5);
        for (int i = 0; i < 30; ++i)
        {
            var triangle = TrianglePairCases.CreateTriangle(ref random);
            triangle = new(triangle.A * scale, triangle.B * scale, triangle.C * scale);
            var inverse = triangle.ComputeInertia(Mass).InverseInertiaTensor;
            // Squares of the parameters' lattice, those of the diagonal by half. The sum is wrong by the square of its step.
            const int Steps = 400;
            double xx = 0, yy = 0, zz = 0, yx = 0, zx = 0, zy = 0, area = 0;
            Double3 a = triangle.A, ab = (Double3)triangle.B - triangle.A, ac = (Double3)triangle.C - triangle.A;
            for (int j = 0; j < Steps; ++j)
            {
                for (int k = 0; k + j < Steps; ++k)
                {
                    var onDiagonal = j + k == Steps - 1;
                    var center = onDiagonal ? 1 / 3.0 : 0.5;
                    var weight = onDiagonal ? 0.5 : 1;
                    var p = a + ab * ((j + center) / Steps) + ac * ((k + center) / Steps);
                    (xx, yy, zz) = (xx + weight * p.X * p.X, yy + weight * p.Y * p.Y, zz + weight * p.Z * p.Z);
                    (yx, zx, zy) = (yx + weight * p.Y * p.X, zx + weight * p.Z * p.X, zy + weight * p.Z * p.Y);
                    area += weight;
                }
            }
            var perMass = Mass / area;
            // The inverse times the integral is one.
            Double3[] rows = [new(yy + zz, -yx, -zx), new(-yx, xx + zz, -zy), new(-zx, -zy, xx + yy)];
            Double3[] columns =
                [new(inverse.XX, inverse.YX, inverse.ZX), new(inverse.YX, inverse.YY, inverse.ZY), new(inverse.ZX, inverse.ZY, inverse.ZZ)];
            for (int j = 0; j < 3; ++j)
            {
                for (int k = 0; k < 3; ++k)
                    Assert.Equal(j == k ? 1 : 0, Double3.Dot(rows[j], columns[k]) * perMass, 0.02);
            }
        }
    }

    [Fact]
    public void InertiaOfATriangleInAPlaneIsKnown()
    {
        // About its centroid: (sum of squares) / 12 per axis within the plane, and their sum across it.
        var triangle = new Triangle(new(-1, 0, -1), new(1, 0, -1), new(0, 0, 2));
        var inertia = triangle.ComputeInertia(3);
        Assert.Equal(1 / 3f, inertia.InverseMass, 1e-7f);
        Assert.Equal(1 / (3 * (6 / 12f)), inertia.InverseInertiaTensor.XX, 1e-6f);
        Assert.Equal(1 / (3 * (8 / 12f)), inertia.InverseInertiaTensor.YY, 1e-6f);
        Assert.Equal(1 / (3 * (2 / 12f)), inertia.InverseInertiaTensor.ZZ, 1e-6f);
        Assert.Throws<ArgumentOutOfRangeException>(() => triangle.ComputeInertia(0));
        Assert.Throws<ArgumentOutOfRangeException>(() => triangle.ComputeInertia(float.NaN));
    }

    [Fact]
    public void BadTrianglesAreRefused()
    {
        using var pool = new BufferPool();
        var shapes = new Shapes(pool, 1);
        Vector3 a = new(0, 0, 0), b = new(1, 0, 0), c = new(0, 1, 0);
        foreach (var bad in (ReadOnlySpan<float>)[float.NaN, float.PositiveInfinity, float.NegativeInfinity, 1e8f])
        {
            Assert.Equal("A", Assert.Throws<ArgumentOutOfRangeException>(() => shapes.Add(new Triangle(new(bad, 0, 0), b, c))).ParamName);
            Assert.Equal("B", Assert.Throws<ArgumentOutOfRangeException>(() => shapes.Add(new Triangle(a, new(0, bad, 0), c))).ParamName);
            Assert.Equal("C", Assert.Throws<ArgumentOutOfRangeException>(() => shapes.Add(new Triangle(a, b, new(0, 0, bad)))).ParamName);
        }
        Triangle[] thin = [default, new(a, a, a), new(a, b, b), new(a, b, a), new(a, b, b * 2), new(a, b, new(0.5f, 5e-6f, 0)), new(a, b * 1e-7f, c * 1e-7f)];
        foreach (var triangle in thin)
        {
            Assert.Throws<ArgumentException>(() => shapes.Add(triangle));
            Assert.Throws<ArgumentException>(() => triangle.ComputeInertia(1));
        }
        Assert.Equal(0, shapes.RegisteredTypeSpan);
        shapes.Add(new Triangle(a, b, new(0.5f, 2e-5f, 0)));
        shapes.Add(new Triangle(a, b * 2e-6f, c * 2e-6f));
        shapes.Add(new Triangle(a, b * 1e7f, c * 1e7f));
        shapes.Dispose();
    }
}
