using System;
using System.Collections.Generic;
using System.Linq;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuPhysics.CollisionDetection;
using BepuUtilities.Memory;
using DemoTests.CollisionDetection.References;
using Xunit;

namespace DemoTests.CollisionDetection;

/// <summary>Every convex shape over a plane without an end, against its lowest point in double precision.</summary>
public sealed class HalfSpaceTests : IDisposable
{
    const int CaseCount = 20_000;
    const float Margin = .1f;
    readonly BufferPool pool = new();
    readonly List<ConvexHull> hulls = [];

    public void Dispose()
    {
        foreach (var hull in hulls)
            hull.Dispose(pool);
        pool.AssertEmpty();
        pool.Dispose();
    }

    [Fact]
    public void Spheres() => Measure(random => new Sphere(random.NextLogarithmic(.01, 1)), sphere => new([default], sphere.Radius));

    [Fact]
    public void Capsules() => Measure(
        random => new Capsule(random.NextLogarithmic(.01, 1), random.Next(8) == 0 ? 0 : random.NextLogarithmic(.01, 2)),
        capsule => new([new(0, capsule.HalfLength, 0), new(0, -capsule.HalfLength, 0)], capsule.Radius));

    [Fact]
    public void Boxes() => Measure(
        random => new Box(random.NextLogarithmic(.02, 2), random.NextLogarithmic(.02, 2), random.NextLogarithmic(.02, 2)),
        box => new([.. Enumerable.Range(0, 8).Select(i => new Vector3(
            (i & 1) == 0 ? box.HalfWidth : -box.HalfWidth,
            (i & 2) == 0 ? box.HalfHeight : -box.HalfHeight,
            (i & 4) == 0 ? box.HalfLength : -box.HalfLength))]));

    [Fact]
    public void TwoSidedTriangles() => Measure(
        random => new Triangle(random.NextDirection() * .1f, random.NextDirection(), random.NextDirection() * .5f) { TwoSided = true },
        triangle => new([triangle.A, triangle.B, triangle.C]));

    [Fact]
    public void Cylinders() => Measure(
        random => new Cylinder(random.NextLogarithmic(.01, 1), random.NextLogarithmic(.02, 2)),
        cylinder => new([new(0, cylinder.HalfLength, 0), new(0, -cylinder.HalfLength, 0)], Rim: cylinder.Radius));

    [Fact]
    public void Hulls()
    {
        var points = new Dictionary<ConvexHull, Vector3[]>();
        var random = new PairRandom(5);
        for (int i = 0; i < 100; ++i)
        {
            var cloud = Enumerable.Range(0, 4 + random.Next(30)).Select(_ => random.NextDirection() * random.Next(.2, 1)).ToArray();
            var hull = new ConvexHull(cloud, pool, out var center);
            hulls.Add(hull);
            points[hull] = [.. cloud.Select(point => point - center)];
        }
        var all = hulls.ToArray();
        Measure(r => all[r.Next(all.Length)], hull => new(points[hull]));
    }

    /// <summary>What a shape is made of, in double precision.</summary>
    /// <param name="Corners">The hull of which it is.</param>
    /// <param name="Radius">Of a ball about each of them.</param>
    /// <param name="Rim">Radius of a disc about each of them, whose axis is the local Y.</param>
    sealed record Core(Vector3[] Corners, float Radius = 0, float Rim = 0)
    {
        public double Reach { get; } = Corners.Max(corner => Math.Sqrt((double)corner.LengthSquared() + (double)Rim * Rim)) + Radius;

        public double Lowest(Quaternion orientation, Double3 normal)
        {
            var (x, z) = (Double3.Dot(Double3.RotatedAxis(orientation, 0), normal), Double3.Dot(Double3.RotatedAxis(orientation, 2), normal));
            return Corners.Min(corner => Double3.Dot(Turn(orientation, new(corner)), normal)) - Rim * Math.Sqrt(x * x + z * z) - Radius;
        }
    }

    static void Measure<TShape>(Func<PairRandom, TShape> create, Func<TShape, Core> coreOf)
        where TShape : unmanaged, IConvexShape
    {
        var random = new PairRandom(77);
        var cases = new List<PairCase<TShape, HalfSpace>>();
        var depths = new List<(double Depth, double Size, double Tolerance)>();
        while (cases.Count < CaseCount)
        {
            var shape = create(new(random.NextBits()));
            var plane = new HalfSpace(random.NextDirection());
            var orientationB = random.Next(4) == 0 ? Quaternion.Identity : random.NextOrientation();
            // A quarter rests on a face, an edge or a rim.
            var normal = Turn(orientationB, new(plane.Normal));
            var orientationA = random.NextOrientation();
            if (random.Next(4) == 0)
                (orientationA, orientationB, plane) = (random.NextAligned(random.Next(2) * 1e-4), Quaternion.Identity, new HalfSpace(Vector3.UnitY));
            normal = Turn(orientationB, new(plane.Normal));
            var core = coreOf(shape);
            var reach = core.Reach;
            var lowest = core.Lowest(orientationA, normal);
            var wanted = random.Next(3) == 0 ? random.Next(-.2, .2) : random.Next(-.02, .02) * reach;
            // Anywhere along the plane, up to a thousand times its size away.
            var aside = new Double3(random.NextDirection()) * (reach * random.NextLogarithmic(1e-3, 1e3));
            aside -= normal * Double3.Dot(aside, normal);
            var offset = aside + normal * (lowest + wanted);
            var offsetB = new Vector3((float)offset.X, (float)offset.Y, (float)offset.Z);
            var depth = Double3.Dot(new(offsetB), normal) - lowest;
            cases.Add(new(shape, plane, offsetB, orientationA, orientationB));
            depths.Add((depth, reach, 2e-6 * reach + 4e-7 * offset.Length));
        }
        var manifolds = PairProperties.CheckPurity(cases, Margin);
        var swapped = PairHarness.Run([.. cases.Select(pair => pair.Swap())], Margin);
        int missed = 0, touching = 0;
        for (int i = 0; i < cases.Count; ++i)
        {
            var (depth, size, tolerance) = depths[i];
            var manifold = manifolds[i];
            missed += manifold.Count == 0 && depth > -Margin + tolerance ? 1 : 0;
            Assert.Equal(manifold.Count, swapped[i].Count);
            if (manifold.Count == 0)
                continue;
            ++touching;
            var normal = Turn(cases[i].OrientationB, new(cases[i].B.Normal));
            Assert.InRange((new Double3(manifold.Normal) - normal).Length, 0, 2e-6);
            Assert.InRange((new Double3(swapped[i].Normal) + normal).Length, 0, 2e-6);
            Assert.InRange(manifold.Deepest() - depth, -tolerance - 2e-4 * size, tolerance);
            var core = coreOf(cases[i].A);
            for (int j = 0; j < manifold.Count; ++j)
            {
                var place = new Double3(manifold.GetOffset(j));
                // Halfway from the plane to the surface.
                var overPlane = Double3.Dot(place - new Double3(cases[i].OffsetB), normal);
                Assert.InRange(overPlane + manifold.GetDepth(j) / 2.0, -tolerance, tolerance);
                // On the surface: as near to a corner, an edge or a face as its support function says.
                var surface = place - normal * (manifold.GetDepth(j) / 2.0);
                Assert.InRange(Double3.Dot(surface, normal) - core.Lowest(cases[i].OrientationA, normal), -tolerance, double.MaxValue);
                Assert.InRange(surface.Length, 0, size + tolerance);
            }
        }
        Assert.Equal(0, missed);
        Assert.True(touching > CaseCount / 4, $"{touching} of {CaseCount} touch");
    }

    static Double3 Turn(Quaternion q, Double3 v) =>
        Double3.RotatedAxis(q, 0) * v.X + Double3.RotatedAxis(q, 1) * v.Y + Double3.RotatedAxis(q, 2) * v.Z;

    [Fact]
    public void A_shape_that_lies_flat_has_the_contacts_of_its_face()
    {
        var plane = new HalfSpace(Vector3.UnitY);
        Assert.Equal(4, Flat(new Box(1, 2, 3), 1).Count);
        Assert.Equal(4, Flat(new Cylinder(1, 2), 1).Count);
        Assert.Equal(1, Flat(new Capsule(1, 2), 2).Count);
        Assert.Equal(1, Flat(new Capsule(1, 0), 1).Count);
        Assert.Equal(1, Flat(new Sphere(1), 1).Count);
        var lying = Quaternion.CreateFromAxisAngle(Vector3.UnitX, MathF.PI / 2);
        Assert.Equal(2, Flat(new Capsule(1, 2), 1, lying).Count);
        Assert.Equal(2, Flat(new Cylinder(1, 2), 1, lying).Count);

        ConvexContactManifold Flat<TShape>(TShape shape, float height, Quaternion? orientation = null) where TShape : unmanaged, IConvexShape =>
            PairHarness.Run(new PairCase<TShape, HalfSpace>(
                shape, plane, new(3, -height + .001f, 7), orientation ?? Quaternion.Identity, Quaternion.Identity));
    }

    [Fact]
    public void A_one_sided_triangle_meets_it_with_its_front()
    {
        var plane = new HalfSpace(Vector3.UnitY);
        // Clockwise from above: the front looks up, away from the plane.
        var up = new Triangle(new(0, 0, 0), new(0, 0, 1), new(1, 0, 0));
        var front = Vector3.Cross(up.C - up.A, up.B - up.A);
        if (front.Y < 0)
            (up.B, up.C) = (up.C, up.B);
        var down = new Triangle(up.A, up.C, up.B);
        Assert.Equal(0, PairHarness.Run(new PairCase<Triangle, HalfSpace>(up, plane, new(0, .01f, 0), Quaternion.Identity, Quaternion.Identity)).Count);
        Assert.Equal(3, PairHarness.Run(new PairCase<Triangle, HalfSpace>(down, plane, new(0, .01f, 0), Quaternion.Identity, Quaternion.Identity)).Count);
    }

    [Fact]
    public void Rays_meet_the_plane()
    {
        var random = new PairRandom(9);
        int hits = 0;
        for (int i = 0; i < 20_000; ++i)
        {
            var shape = new HalfSpace(random.NextDirection() * 5);
            var pose = new RigidPose(random.NextDirection() * 10, random.NextOrientation());
            var origin = random.NextDirection() * 20;
            var direction = random.NextDirection() * random.NextLogarithmic(.01, 100);
            var normal = Turn(pose.Orientation, new(shape.Normal));
            var height = Double3.Dot(new Double3(origin) - new Double3(pose.Position), normal);
            var fall = -Double3.Dot(new(direction), normal);
            if (Math.Abs(height) < 1e-4 || Math.Abs(fall) < 1e-3 * direction.Length())
                continue;
            var hit = shape.RayTest(pose, origin, direction, out var t, out var found);
            Assert.Equal(height < 0 || fall > 0, hit);
            hits += hit ? 1 : 0;
            // Heights of tens of metres are rounded to micrometres.
            var exact = !hit || height < 0 ? 0 : height / fall;
            Assert.InRange(t, exact - Math.Abs(2e-5 / fall) - 2e-6 * exact * direction.Length() / Math.Abs(fall), exact + Math.Abs(2e-5 / fall) +
                2e-6 * exact * direction.Length() / Math.Abs(fall));
            Assert.InRange((new Double3(found) - (hit ? normal : default)).Length, 0, 2e-6);
        }
        Assert.True(hits > 5000);
        foreach (var direction in (ReadOnlySpan<Vector3>)[default, new(0, float.NaN, 0), new(0, float.NegativeInfinity, 0)])
            Assert.False(new HalfSpace(Vector3.UnitY).RayTest(RigidPose.Identity, -Vector3.UnitY, direction, out _, out _));
    }

    [Fact]
    public void The_box_around_it_ends_at_a_level_plane_and_holds_any_other()
    {
        new HalfSpace(Vector3.UnitY).ComputeBounds(Quaternion.Identity, out var min, out var max);
        Assert.Equal((new(-HalfSpace.Extent), new(HalfSpace.Extent, 0, HalfSpace.Extent)), (min, max));
        var random = new PairRandom(4);
        for (int i = 0; i < 10_000; ++i)
        {
            var shape = new HalfSpace(random.NextDirection());
            var orientation = random.NextOrientation();
            shape.ComputeBounds(orientation, out min, out max);
            var normal = Turn(orientation, new(shape.Normal));
            // A point of the solid within the extent is in the box.
            var point = new Double3(random.Next(-1, 1), random.Next(-1, 1), random.Next(-1, 1)) * HalfSpace.Extent;
            if (Double3.Dot(point, normal) > 0)
                point -= normal * Double3.Dot(point, normal);
            for (int axis = 0; axis < 3; ++axis)
            {
                if (Math.Abs(point.X) <= HalfSpace.Extent && Math.Abs(point.Y) <= HalfSpace.Extent && Math.Abs(point.Z) <= HalfSpace.Extent)
                    Assert.InRange(point[axis], min[axis] - 4, max[axis] + 4);
            }
        }
    }

    [Theory]
    [InlineData(0, 0, 0)]
    [InlineData(float.NaN, 0, 0)]
    [InlineData(0, float.PositiveInfinity, 0)]
    public void A_normal_without_a_direction_is_refused(float x, float y, float z)
    {
        var shapes = new Shapes(pool, 4);
        Assert.Contains("normal", Assert.Throws<ArgumentException>(() => shapes.Add(new HalfSpace(new(x, y, z)))).Message, StringComparison.Ordinal);
        Assert.Throws<ArgumentException>(() => shapes.Add(new HalfSpace { Normal = new(0, 1.1f, 0) }));
        shapes.Dispose();
    }

    [Fact]
    public void No_body_is_a_half_space()
    {
        using var simulation = Simulation.Create(pool, new DefaultNarrowPhaseCallbacks(), new DefaultPoseIntegratorCallbacks(), new SolveDescription(1, 4));
        var plane = simulation.Shapes.Add(new HalfSpace(Vector3.UnitY));
        var sphere = simulation.Shapes.Add(new Sphere(1));
        Assert.Throws<ArgumentException>(() => simulation.Bodies.Add(BodyDescription.CreateKinematic(RigidPose.Identity, plane, .01f)));
        var body = simulation.Bodies.Add(BodyDescription.CreateKinematic(RigidPose.Identity, sphere, .01f));
        Assert.Throws<ArgumentException>(() => simulation.Bodies.SetShape(body, plane));
        Assert.Throws<InvalidOperationException>(() => new HalfSpace(Vector3.UnitY).ComputeInertia(1));
        Assert.Equal(1, simulation.Bodies.ActiveSet.Count);
        simulation.Statics.Add(new StaticDescription(RigidPose.Identity, plane));
        simulation.Timestep(1 / 60f);
    }

    /// <summary>As on a box of two hundred metres: the same sinking under its load at first, the same speed, and nothing on the way.</summary>
    [Theory]
    [InlineData(0)]
    [InlineData(10_000)]
    public void A_ball_rolls_far_without_a_bump(float from)
    {
        using var plane = new Rolling(pool, from, new HalfSpace(Vector3.UnitY), default);
        using var box = new Rolling(pool, from, new Box(200, 2, 20), new(from + 50, -1, 0));
        for (int i = 0; i < 600; ++i)
        {
            plane.Simulation.Timestep(1 / 60f);
            box.Simulation.Timestep(1 / 60f);
            Assert.InRange(plane.Ball.Pose.Position.Y, .4997f, .5f);
            Assert.InRange(plane.Ball.Pose.Position.Y - box.Ball.Pose.Position.Y, -1e-6f, 1e-6f);
        }
        Assert.InRange(plane.Ball.Velocity.Linear.X, 9.99f, 10.01f);
        Assert.InRange(plane.Ball.Pose.Position.X - from, 99.9f, 100.1f);
    }

    sealed class Rolling : IDisposable
    {
        readonly BodyHandle ball;

        public Rolling(BufferPool pool, float from, HalfSpace floor, Vector3 position) : this(pool, from) =>
            Simulation.Statics.Add(new StaticDescription(position, Simulation.Shapes.Add(floor)));

        public Rolling(BufferPool pool, float from, Box floor, Vector3 position) : this(pool, from) =>
            Simulation.Statics.Add(new StaticDescription(position, Simulation.Shapes.Add(floor)));

        Rolling(BufferPool pool, float from)
        {
            Simulation = Simulation.Create(pool, new DefaultNarrowPhaseCallbacks(), new DefaultPoseIntegratorCallbacks(), new SolveDescription(1, 4));
            var sphere = new Sphere(.5f);
            ball = Simulation.Bodies.Add(BodyDescription.CreateDynamic(new Vector3(from, .5f, 0), new BodyVelocity(new(10, 0, 0), new(0, 0, -20)),
                sphere.ComputeInertia(1), Simulation.Shapes.Add(sphere), -1));
        }

        public Simulation Simulation { get; }

        public BodyReference Ball => Simulation.Bodies[ball];

        public void Dispose() => Simulation.Dispose();
    }
}
