using System;
using System.Collections.Generic;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuPhysics.CollisionDetection;
using BepuUtilities.Memory;
using DemoTests.Quality;
using DemoTests.Queries;
using DemoTests.Scenes;
using DemoTests.Support;
using Xunit;
using static DemoTests.Quality.DocSamples;

namespace DemoTests.OwnShapes;

/// <summary>Convex shapes of a game's own: the cone of the guide, and an ellipsoid.</summary>
public sealed class OwnConvexTests
{
    static TestWorld Create(int threads = 1)
    {
        var world = new TestWorld(threads: threads);
        Register(world.Simulation.NarrowPhase.CollisionTaskRegistry);
        return world;
    }

    static void Register(CollisionTaskRegistry registry)
    {
        registry.RegisterConvex<Cone, ConeWide, ConeSupport, ConeFeature>();
        registry.RegisterConvex<Ellipsoid, EllipsoidWide, EllipsoidSupport, PointFeature<EllipsoidWide, EllipsoidSupport>>();
        registry.RegisterHomogeneousCompound<Voxels, Box, BoxWide>();
    }

    [Theory, InlineData("box"), InlineData("plane"), InlineData("triangle"), InlineData("voxels"), InlineData("compound")]
    public void A_cone_stands_on_its_base(string ground)
    {
        using var world = Create();
        var cone = new Cone(.4f, 1);
        var shapes = world.Simulation.Shapes;
        switch (ground)
        {
            case "box":
                world.AddStatic(new Box(10, 2, 10), new Vector3(0, -1, 0));
                break;
            case "plane":
                world.AddStatic(new HalfSpace(Vector3.UnitY), RigidPose.Identity);
                break;
            case "triangle":
                world.AddStatic(new Triangle(new(-9, 0, -9), new(9, 0, -9), new(0, 0, 9)), RigidPose.Identity);
                break;
            case "voxels":
                var voxels = new Voxels(1, 1, 1, 4, new(-2, -4, -2), world.Pool);
                voxels.Cells[0] = true;
                world.Statics.Add(new StaticDescription(RigidPose.Identity, shapes.Add(voxels)));
                break;
            default:
                world.Pool.Take(1, out Buffer<CompoundChild> children);
                children[0] = new(new RigidPose(new Vector3(0, -1, 0)), shapes.Add(new Box(10, 2, 10)));
                world.Statics.Add(new StaticDescription(RigidPose.Identity, shapes.Add(new Compound(children))));
                break;
        }
        var body = world.Bodies[world.AddDynamic(cone, 2, new RigidPose(new Vector3(.1f, .35f, .2f)))];
        world.Step(240);
        Assert.Equal(.25f, body.Pose.Position.Y, 1e-3f);
        Assert.InRange(body.Velocity.Linear.Length() + body.Velocity.Angular.Length(), 0, 1e-3f);
        Assert.InRange(Vector3.Transform(Vector3.UnitY, body.Pose.Orientation).Y, 1 - 1e-6f, 1);
        var statics = world.Statics.StaticsBuffer[0].Shape;
        world.Statics.Clear();
        world.Simulation.Shapes.RemoveAndDispose(statics, world.Pool);
    }

    /// <summary>
    /// It rolls about its side without slipping, so that its tip stays where it is and its axis goes round: by the tangent of its half angle as fast as
    /// it turns.
    /// </summary>
    [Fact]
    public void A_cone_rolls_around_its_tip()
    {
        using var world = Create();
        var cone = new Cone(.4f, 1);
        world.AddStatic(new Box(20, 2, 20), new Vector3(0, -1, 0));
        var angle = MathF.Atan2(cone.Radius, cone.Height);
        var way = cone.Height * .75f;
        const float Turn = 2;
        // The tip is at the origin and the side along X; the base is up to the right.
        var pose = new RigidPose(new Vector3(MathF.Cos(angle), MathF.Sin(angle), 0) * way, Quaternion.CreateFromAxisAngle(Vector3.UnitZ, angle + MathF.PI / 2));
        var velocity = new BodyVelocity(new Vector3(0, 0, Turn * way * MathF.Sin(angle)), new Vector3(Turn, 0, 0));
        var body = world.Bodies[world.AddDynamic(cone, 1, pose, velocity)];
        const int StepCount = 240;
        for (int i = 0; i < StepCount; ++i)
        {
            world.Step();
            Assert.Equal(way * MathF.Sin(angle), body.Pose.Position.Y, 2e-3f);
            Assert.Equal(velocity.Linear.Length(), body.Velocity.Linear.Length(), .02f * velocity.Linear.Length());
        }
        // A turn about +Y takes +Z to +X.
        var expected = new Vector3(MathF.Cos(Turn * MathF.Tan(angle) * StepCount / 60), 0, MathF.Sin(Turn * MathF.Tan(angle) * StepCount / 60)) *
            (way * MathF.Cos(angle));
        Assert.Equal(0, (body.Pose.Position - expected - new Vector3(0, body.Pose.Position.Y, 0)).Length(), .02f);
        var tip = body.Pose.Position + Vector3.Transform(Vector3.UnitY, body.Pose.Orientation) * way;
        Assert.Equal(0, tip.Length(), .02f);
    }

    [Fact]
    public void An_ellipsoid_comes_to_rest_on_its_flat_side()
    {
        using var world = Create();
        world.AddStatic(new Box(20, 2, 20), new Vector3(0, -1, 0));
        var body = world.Bodies[world.AddDynamic(new Ellipsoid(.5f, .2f, .4f), 1, new RigidPose(new Vector3(0, .25f, 0)))];
        world.Step(300);
        Assert.Equal(.2f, body.Pose.Position.Y, 1e-3f);
    }

    [Theory, InlineData(1), InlineData(2), InlineData(3)]
    public void Any_number_of_threads_gives_the_same_bits(int threads)
    {
        using var expected = CreateHeap(1);
        using var actual = CreateHeap(threads);
        Assert.Equal(expected.HashSteps(90), actual.HashSteps(90));
        var before = GC.GetAllocatedBytesForCurrentThread();
        expected.Step(20);
        Assert.Equal(0, GC.GetAllocatedBytesForCurrentThread() - before);
    }

    static TestWorld CreateHeap(int threads)
    {
        var world = Create(threads);
        world.AddStatic(new Box(20, 2, 20), new Vector3(0, -1, 0));
        for (int i = 0; i < 30; ++i)
        {
            var pose = new RigidPose(new Vector3(i % 3 * .4f, .6f + i * .3f, i % 2 * .3f), Quaternion.CreateFromYawPitchRoll(i, .4f * i, .2f));
            switch (i % 5)
            {
                case 0: world.AddDynamic(new Cone(.3f, .8f), 1, pose); break;
                case 1: world.AddDynamic(new Ellipsoid(.4f, .2f, .3f), 1, pose); break;
                case 2: world.AddDynamic(new Box(.5f, .4f, .6f), 1, pose); break;
                case 3: world.AddDynamic(new Capsule(.2f, .4f), 1, pose); break;
                default: world.AddDynamic(new Cylinder(.25f, .4f), 1, pose); break;
            }
        }
        return world;
    }

    static Vector3 Next(Random random, float extent) =>
        (new Vector3(random.NextSingle(), random.NextSingle(), random.NextSingle()) - new Vector3(.5f)) * extent;

    /// <summary>A hit lies on the surface, and no point before it is inside; a ray that misses meets no point inside.</summary>
    [Theory, InlineData(true), InlineData(false)]
    public void Rays_hit_the_surface_where_they_first_come_to_it(bool isCone)
    {
        var random = new Random(LevelSeeds.Of(3));
        var cone = new Cone(.4f, 1);
        var ellipsoid = new Ellipsoid(.5f, .2f, .4f);
        // How far a point is outside, about, m.
        double Outside(Vector3 point)
        {
            double x = point.X, y = point.Y, z = point.Z;
            if (!isCone)
                return (Math.Sqrt(x * x / .25 + y * y / .04 + z * z / .16) - 1) * .2;
            var across = Math.Sqrt(x * x + z * z);
            return Math.Max(-.25 - y, (across * 1 + (y - .75) * .4) / Math.Sqrt(1.16));
        }
        var (hits, inside) = (0, 0);
        for (int i = 0; i < 2000; ++i)
        {
            var pose = new RigidPose(Next(random, 4), Quaternion.Normalize(new(Next(random, 2), 1)));
            var origin = pose.Position + Next(random, i % 4 == 0 ? .6f : 4);
            var direction = i % 3 == 0 ? pose.Position + Next(random, .6f) - origin : Next(random, 3);
            var isHit = isCone
                ? cone.RayTest(pose, origin, direction, out var t, out var normal)
                : ellipsoid.RayTest(pose, origin, direction, out t, out normal);
            Vector3 Local(float time) =>
                Vector3.Transform(origin + direction * time - pose.Position, Quaternion.Conjugate(pose.Orientation));
            var end = isHit ? t : 4;
            for (int step = 0; step < 40; ++step)
                Assert.True(Outside(Local(end * step / 40f)) > -1e-5 || (isHit && t == 0), $"ray {i} passes through");
            if (!isHit)
            {
                Assert.Equal((0f, Vector3.Zero), (t, normal));
                continue;
            }
            ++hits;
            Assert.Equal(1, normal.Length(), 1e-5f);
            if (t == 0)
            {
                ++inside;
                Assert.True(Outside(Local(0)) < 1e-5);
                continue;
            }
            Assert.InRange(Outside(Local(t)), -2e-5, 2e-5);
            Assert.True(Vector3.Dot(normal, direction) < 0);
        }
        Assert.True(hits > 700 && inside > 100, $"{hits} hits, {inside} from inside");
    }

    [Fact]
    public void They_are_swept_and_met_by_what_is_swept_and_by_rays()
    {
        using var world = Create();
        // Its tip is at y = 3.75.
        world.AddStatic(new Cone(.4f, 1), new Vector3(0, 3, 0));
        List<SweptHit> found = [];
        var hits = new SweepHits(found);
        world.Simulation.Sweep(new Sphere(.5f), new RigidPose(new Vector3(0, 10, 0)), new BodyVelocity(new Vector3(0, -1, 0)), 20, world.Pool, ref hits);
        var hit = Assert.Single(found);
        Assert.Equal(5.75f, hit.T, 1e-4f);
        Assert.Equal(0, (hit.Place - new Vector3(0, 3.75f, 0)).Length(), 1e-3f);
        found.Clear();
        // An ellipsoid that comes up from below, to the base at y = 2.75.
        hits = new SweepHits(found);
        world.Simulation.Shapes.Add(new Ellipsoid(1, 1, 1));
        world.Simulation.Sweep(new Ellipsoid(.3f, .2f, .1f), new RigidPose(default), new BodyVelocity(new Vector3(0, 2, 0)), 20, world.Pool, ref hits);
        Assert.Equal((2.75f - .2f) / 2, Assert.Single(found).T, 1e-4f);
        Assert.True(world.Simulation.FindNearest(new Box(1, 1, 1), new Vector3(5, 2.9f, 0), 100, world.Pool, out var nearest));
        // The rim.
        Assert.Equal(4.1f, nearest.Distance, 1e-4f);
        Assert.True(world.Simulation.RayCast(new Vector3(0, 9, 0), -Vector3.UnitY, 100, world.Pool, out var ray));
        Assert.Equal(5.25f, ray.T, 1e-4f);
    }

    /// <summary>A rod with a cone at each end, as children of a compound: it rolls from one end to the other as its inertia says, and stands on none.</summary>
    [Fact]
    public void They_are_children_of_compounds()
    {
        using var world = Create();
        world.AddStatic(new Box(20, 2, 20), new Vector3(0, -1, 0));
        using var builder = new CompoundBuilder(world.Pool, world.Simulation.Shapes, 2);
        var flip = Quaternion.CreateFromAxisAngle(Vector3.UnitX, MathF.PI);
        // Two cones, base on base: 0.4 m thick, 2 m long.
        builder.Add(new Cone(.4f, 1), new RigidPose(new Vector3(0, .25f, 0)), 1);
        builder.Add(new Cone(.4f, 1), new RigidPose(new Vector3(0, -.25f, 0), flip), 1);
        builder.BuildDynamicCompound(out var children, out var inertia, out var center);
        Assert.Equal(0, center.Length(), 1e-6f);
        var name = world.Simulation.Shapes.Add(new Compound(children));
        var body = world.Bodies[world.Bodies.Add(BodyDescription.CreateDynamic(new Vector3(0, 1.3f, 0), inertia, name, -1f))];
        body.Velocity.Angular = new Vector3(.2f, 0, .1f);
        world.Step(900);
        // It lies on its side, from a tip to the rim: the middle is over the rim, which is the thickest part.
        var side = MathF.Sqrt(1 + .16f);
        Assert.Equal(.4f / side, body.Pose.Position.Y, 5e-3f);
        Assert.True(MathF.Abs(Vector3.Transform(Vector3.UnitY, body.Pose.Orientation).Y) < .5f);
        world.Bodies.Clear();
        world.Simulation.Shapes.RemoveAndDispose(name, world.Pool);
    }
}
