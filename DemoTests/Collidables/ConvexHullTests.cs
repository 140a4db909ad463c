using System;
using System.Linq;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuUtilities;
using BepuUtilities.Memory;
using Demos.References;
using Xunit;

namespace DemoTests.Collidables;

/// <summary>Convex hulls as shapes, against the same in double precision.</summary>
public sealed class ConvexHullTests : IDisposable
{
    readonly BufferPool pool = new();

    public void Dispose()
    {
        pool.AssertEmpty();
        pool.Dispose();
    }

    public static TheoryData<int> Seeds => [.. Enumerable.Range(0, 60)];

    /// <summary>Hulls of 4 to 200 points, thin ones among them, from millimetres to kilometres.</summary>
    ConvexHull Create(Random random)
    {
        var count = random.Next(4) == 0 ? random.Next(4, 9) : random.Next(10, 200);
        var points = new Vector3[count];
        var squeeze = new Vector3(1, random.Next(3) == 0 ? MathF.Pow(10, -2 * random.NextSingle()) : 1, 1);
        for (int i = 0; i < count; ++i)
            points[i] = (random.Next(2) == 0 ? Vector3.Normalize(HullInputs.InCube(random)) : HullInputs.InCube(random)) * squeeze;
        points = HullInputs.Scaled(HullInputs.Turned(points, HullInputs.Turn(random)), new(MathF.Pow(10, random.Next(-3, 4))));
        return new(points, pool, out _);
    }

    [Fact]
    public void AnEmptyBundleHasNoEffect()
    {
        var hull = new ConvexHull(HullInputs.Box(2, 4, 6), pool, out var center);
        Assert.Equal(Vector3.Zero, center);
        default(ConvexHullWide).GetBounds(QuaternionWide.Identity, out var radius, out _, out _, out _);
        Assert.Equal(Vector<float>.Zero, radius);
        hull.ComputeAngularExpansionData(out var maximumRadius, out var expansion);
        Assert.Equal(Math.Sqrt(14), maximumRadius, 1e-6);
        Assert.Equal(Math.Sqrt(14) - 1, expansion, 1e-6);
        hull.Dispose(pool);
        hull.Dispose(pool);
    }

    [Theory, MemberData(nameof(Seeds))]
    public void BoundsAreThoseOfTheVertices(int seed)
    {
        var random = new Random(seed);
        var hull = Create(random);
        var checker = new HullChecker(hull);
        var orientation = HullInputs.Turn(random);
        hull.ComputeBounds(orientation, out var min, out var max);
        var turned = checker.Vertices.Select(((DoubleQuaternion)orientation).Rotate).ToArray();
        var tolerance = 1e-6 * checker.Size;
        Assert.Equal(turned.Min(v => v.X), min.X, tolerance);
        Assert.Equal(turned.Min(v => v.Y), min.Y, tolerance);
        Assert.Equal(turned.Min(v => v.Z), min.Z, tolerance);
        Assert.Equal(turned.Max(v => v.X), max.X, tolerance);
        Assert.Equal(turned.Max(v => v.Y), max.Y, tolerance);
        Assert.Equal(turned.Max(v => v.Z), max.Z, tolerance);
        hull.ComputeAngularExpansionData(out var maximumRadius, out var expansion);
        Assert.Equal(checker.Vertices.Max(v => v.Length), maximumRadius, tolerance);
        Assert.Equal(maximumRadius - checker.Planes.Min(plane => plane.Offset), expansion, tolerance);
        hull.Dispose(pool);
    }

    [Theory, MemberData(nameof(Seeds))]
    public void InertiaIsThatOfTheSolid(int seed)
    {
        var random = new Random(seed);
        var hull = Create(random);
        const float mass = 3;
        var inertia = hull.ComputeInertia(mass);
        var tensor = inertia.InverseInertiaTensor;
        var checker = new HullChecker(hull);
        var m = checker.SecondMoments.Select(moment => mass * moment / checker.Volume).ToArray();
        // The tensor, times the inverse that was answered, row by row.
        double[,] forward = { { m[1] + m[2], -m[3], -m[4] }, { -m[3], m[0] + m[2], -m[5] }, { -m[4], -m[5], m[0] + m[1] } };
        double[,] inverse = { { tensor.XX, tensor.YX, tensor.ZX }, { tensor.YX, tensor.YY, tensor.ZY }, { tensor.ZX, tensor.ZY, tensor.ZZ } };
        var condition = (forward[0, 0] + forward[1, 1] + forward[2, 2]) * (inverse[0, 0] + inverse[1, 1] + inverse[2, 2]);
        for (int i = 0; i < 3; ++i)
        {
            for (int j = 0; j < 3; ++j)
            {
                var sum = Enumerable.Range(0, 3).Sum(k => forward[i, k] * inverse[k, j]);
                Assert.Equal(i == j ? 1 : 0, sum, 2e-7 * condition);
            }
        }
        Assert.Equal(1 / mass, inertia.InverseMass);
        hull.Dispose(pool);
    }

    [Fact]
    public void InertiaAndVolumeOfSolidsWithClosedForms()
    {
        // Regular tetrahedron with edge a, octahedron, box: m a^2 / 20, m a^2 / 10, m (b^2 + c^2) / 12.
        Vector3[] tetrahedron = [new(1, 1, 1), new(1, -1, -1), new(-1, 1, -1), new(-1, -1, 1)];
        Vector3[] octahedron = [new(2, 0, 0), new(-2, 0, 0), new(0, 2, 0), new(0, -2, 0), new(0, 0, 2), new(0, 0, -2)];
        var golden = (float)((1 + Math.Sqrt(5)) / 2);
        Vector3[] icosahedron = [.. from sign in Enumerable.Range(0, 4)
            let one = (sign & 1) == 0 ? 1 : -1
            let phi = (sign & 2) == 0 ? golden : -golden
            from turn in Enumerable.Range(0, 3)
            select turn == 0 ? new Vector3(0, one, phi) : turn == 1 ? new(one, phi, 0) : new(phi, 0, one)];
        var onFaces =
            from sign in Enumerable.Range(0, 4)
            let one = ((sign & 1) == 0 ? 1 : -1) / golden
            let phi = (sign & 2) == 0 ? golden : -golden
            from turn in Enumerable.Range(0, 3)
            select turn == 0 ? new Vector3(0, one, phi) : turn == 1 ? new(one, phi, 0) : new(phi, 0, one);
        var dodecahedron = HullInputs.Box(2, 2, 2).Concat(onFaces).ToArray();
        AssertSolid(tetrahedron, 4, 4, 8 / 3.0, new Double3(1, 1, 1) * (8 / 20.0));
        AssertSolid(octahedron, 6, 8, 32 / 3.0, new Double3(1, 1, 1) * (8 / 10.0));
        // Edge 2: volume 5 (3 + sqrt 5) / 12 a^3, moment phi^2 a^2 / 10.
        AssertSolid(icosahedron, 12, 20, 5 * (3 + Math.Sqrt(5)) / 12 * 8, new Double3(1, 1, 1) * (golden * golden * 4 / 10.0));
        // Edge a = 2 / phi: volume (15 + 7 sqrt 5) / 4 a^3, moment (39 phi + 28) / 150 a^2.
        AssertSolid(dodecahedron, 20, 12, (15 + 7 * Math.Sqrt(5)) / 4 * Math.Pow(2 / golden, 3),
            new Double3(1, 1, 1) * ((39 * golden + 28) / 150.0 * 4 / (golden * golden)));
        AssertSolid(HullInputs.Moved(HullInputs.Box(1, 2, 3), new(10, 20, 30)), 8, 6, 6, new Double3(13, 10, 5) * (1 / 12.0));
        // Cylinder of radius 1 and height 2, but for the 400 corners.
        AssertSolid(HullInputs.Prism(400, 2), 800, 402, 2 * Math.PI, new(0.25 + 1 / 3.0, 0.5, 0.25 + 1 / 3.0), 2e-4);
        AssertSolid(HullInputs.Sphere(20_000), null, null, 4 * Math.PI / 3, new(0.4, 0.4, 0.4), 1e-3);
    }

    void AssertSolid(Vector3[] points, int? vertexCount, int? faceCount, double volume, Double3 moments, double tolerance = 1e-6)
    {
        var hull = new ConvexHull(points, pool, out _);
        var checker = new HullChecker(hull);
        Assert.Null(checker.FindFault());
        Assert.Equal(vertexCount ?? hull.VertexCount, hull.VertexCount);
        Assert.Equal(faceCount ?? hull.FaceCount, hull.FaceCount);
        Assert.Equal(1, checker.Volume / volume, tolerance);
        var inverse = hull.ComputeInertia(2).InverseInertiaTensor;
        Assert.Equal(1, 2 * moments.X * inverse.XX, tolerance);
        Assert.Equal(1, 2 * moments.Y * inverse.YY, tolerance);
        Assert.Equal(1, 2 * moments.Z * inverse.ZZ, tolerance);
        Assert.Equal(0, inverse.YX * moments.X, tolerance);
        Assert.Equal(0, inverse.ZX * moments.X, tolerance);
        Assert.Equal(0, inverse.ZY * moments.X, tolerance);
        hull.Dispose(pool);
    }

    [Theory, MemberData(nameof(Seeds))]
    public void RaysAgreeWithClippingInDoublePrecision(int seed)
    {
        var random = new Random(seed);
        var hull = Create(random);
        var checker = new HullChecker(hull);
        int hits = 0, insides = 0;
        for (int i = 0; i < 300; ++i)
        {
            RigidPose pose = new(HullInputs.InCube(random) * (float)checker.Size * 3, HullInputs.Turn(random));
            DoubleQuaternion turn = pose.Orientation;
            // Towards a point in or around the hull; every third starts in or near it.
            var target = checker.Vertices[random.Next(checker.Vertices.Count)].ToVector3() * 1.1f * random.NextSingle();
            var start = i % 3 == 0
                ? checker.Vertices[random.Next(checker.Vertices.Count)].ToVector3() * random.NextSingle() * 1.05f
                : target + HullInputs.InCube(random) * (float)checker.Size * 10;
            var origin = (turn.Rotate(start) + pose.Position).ToVector3();
            var direction = turn.Rotate(target - start).ToVector3() * MathF.Pow(10, random.Next(-3, 4));
            var hit = hull.RayTest(pose, origin, direction, out var t, out var normal);

            var localOrigin = turn.RotateBack((Double3)origin - pose.Position);
            var localDirection = turn.RotateBack(direction);
            double entry = 0, exit = double.MaxValue;
            foreach (var (outward, offset) in checker.Planes)
            {
                var speed = Double3.Dot(outward, localDirection);
                var crossing = (offset - Double3.Dot(outward, localOrigin)) / speed;
                if (speed < 0)
                    entry = Math.Max(entry, crossing);
                else
                    exit = Math.Min(exit, crossing);
            }
            var tolerance = 3e-6 * (checker.Size + localOrigin.Length);
            var chord = (exit - entry) * localDirection.Length;
            if (!hit)
            {
                Assert.True(chord <= Graze(tolerance), $"Ray {i} passes {chord} m inside and was missed.");
                Assert.Equal((0, Vector3.Zero), (t, normal));
                continue;
            }
            Assert.True(chord >= -Graze(tolerance), $"Ray {i} misses by {chord} m and was hit.");
            Assert.Equal(1, normal.Length(), 1e-5f);
            var point = localOrigin + localDirection * t;
            var localNormal = turn.RotateBack(normal);
            // Whatever face was hit, the point is on its plane and under the others.
            var heights = checker.Planes.Select(plane => Double3.Dot(plane.Normal, point) - plane.Offset).ToArray();
            var nearest = heights.Max();
            Assert.True(nearest <= tolerance, $"Ray {i} was hit {nearest} m outside.");
            var facing = Enumerable.Range(0, heights.Length).Where(f => (checker.Planes[f].Normal - localNormal).Length < 1e-5).ToArray();
            Assert.NotEmpty(facing);
            Assert.True(facing.Max(f => heights[f]) >= nearest - 2 * tolerance, $"Ray {i} has the normal of another face.");
            ++hits;
            if (t == 0)
                ++insides;
            else
                Assert.True(Math.Abs(nearest) <= tolerance && Double3.Dot(localNormal, localDirection) <= 0);
        }
        Assert.True(hits > 50 && insides > 10, $"{hits} hits, {insides} from inside.");
        hull.Dispose(pool);

        // A ray that is nearly parallel to a face enters or leaves far from where it should, by roundings.
        double Graze(double tolerance) => 1000 * tolerance;
    }

    [Fact]
    public void LanesAreIndependent()
    {
        var random = new Random(5);
        for (int round = 0; round < 50; ++round)
        {
            var hulls = new ConvexHull[Vector<float>.Count];
            var bundle = default(ConvexHullWide);
            RigidPoseWide poses = default;
            RayWide rays = default;
            var inputs = new (RigidPose Pose, Vector3 Origin, Vector3 Direction)[hulls.Length];
            for (int lane = 0; lane < hulls.Length; ++lane)
            {
                hulls[lane] = random.Next(5) == 0 ? default : Create(random);
                var origin = HullInputs.InCube(random) * 3;
                inputs[lane] = (new(HullInputs.InCube(random), HullInputs.Turn(random)), origin, HullInputs.InCube(random) - origin);
                Lanes.Write(hulls[lane], ref bundle, lane);
                Lanes.Write(inputs[lane].Pose.Position, ref poses.Position, lane);
                Lanes.Write(inputs[lane].Pose.Orientation, ref poses.Orientation, lane);
                Lanes.Write(inputs[lane].Origin, ref rays.Origin, lane);
                Lanes.Write(inputs[lane].Direction, ref rays.Direction, lane);
            }
            bundle.GetBounds(poses.Orientation, out var radius, out var expansion, out var min, out var max);
            bundle.RayTest(poses, rays, out var hitMask, out var t, out var normal);
            for (int lane = 0; lane < hulls.Length; ++lane)
            {
                if (!hulls[lane].Data.Allocated)
                {
                    Assert.Equal(0, hitMask[lane]);
                    continue;
                }
                hulls[lane].ComputeBounds(inputs[lane].Pose.Orientation, out var oneMin, out var oneMax);
                hulls[lane].ComputeAngularExpansionData(out var oneRadius, out var oneExpansion);
                Assert.Equal((oneMin, oneMax, oneRadius, oneExpansion),
                    (Lanes.Read<Vector3, Vector3Wide>(ref min, lane), Lanes.Read<Vector3, Vector3Wide>(ref max, lane), radius[lane], expansion[lane]));
                var hit = hulls[lane].RayTest(inputs[lane].Pose, inputs[lane].Origin, inputs[lane].Direction, out var oneT, out var oneNormal);
                Assert.Equal((hit, oneT, oneNormal), (hitMask[lane] != 0, t[lane], Lanes.Read<Vector3, Vector3Wide>(ref normal, lane)));
                hulls[lane].Dispose(pool);
            }
        }
    }

    [Fact]
    public void BadRaysHitNothing()
    {
        var hull = new ConvexHull(HullInputs.Box(2, 2, 2), pool, out _);
        foreach (var direction in (ReadOnlySpan<Vector3>)[default, new(float.NaN, 0, 0), new(0, float.PositiveInfinity, 0)])
        {
            Assert.False(hull.RayTest(RigidPose.Identity, new(0, 5, 0), direction, out var t, out var normal));
            Assert.False(hull.RayTest(RigidPose.Identity, Vector3.Zero, direction, out t, out normal));
            Assert.Equal((0, Vector3.Zero), (t, normal));
        }
        Assert.False(hull.RayTest(RigidPose.Identity, new(float.NaN, 0, 0), Vector3.UnitX, out _, out _));
        Assert.False(hull.RayTest(RigidPose.Identity, new(3e38f, 2e38f, 0), Vector3.UnitY, out _, out _));
        Assert.True(hull.RayTest(RigidPose.Identity, new(0.2f, -0.9f, 0.3f), new(1, 5, 1), out var start, out var nearest));
        Assert.Equal((0, -Vector3.UnitY), (start, nearest));
        foreach (var length in (ReadOnlySpan<float>)[1e-25f, 1e25f])
        {
            Assert.True(hull.RayTest(RigidPose.Identity, new(5, 0.5f, 0), new(-length, 0, 0), out var far, out nearest));
            Assert.Equal(1, far * length / 4, 1e-6f);
            Assert.Equal(Vector3.UnitX, nearest);
        }
        hull.Dispose(pool);
    }
}
