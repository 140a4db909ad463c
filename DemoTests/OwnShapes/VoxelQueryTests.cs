using System;
using System.Collections.Generic;
using System.Linq;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuPhysics.Trees;
using DemoTests.Queries;
using DemoTests.Support;
using Xunit;
using static DemoTests.Quality.DocSamples;

namespace DemoTests.OwnShapes;

/// <summary>What queries find of voxels, beside all of their cubes, one after the other.</summary>
public class VoxelQueryTests
{
    const int Size = 12;

    static readonly RigidPose pose = new(new Vector3(3, -2, 5), Quaternion.CreateFromYawPitchRoll(.4f, -.3f, .8f));

    readonly Random random = new(LevelSeeds.Of(17));

    // Full at the bottom, then fewer and fewer: a maze that rays get far in.
    static Voxels Create(VoxelWorld world)
    {
        var noise = new Random(5);
        return world.Create(Size, Size, Size, .5f, new Vector3(-3), (x, y, z) => y == 0 || noise.Next(4) == 0);
    }

    Vector3 Next(float extent) => (new Vector3(random.NextSingle(), random.NextSingle(), random.NextSingle()) - new Vector3(.5f)) * extent;

    static List<(int Child, float T, Vector3 Normal)> HitEach(in Voxels voxels, Vector3 origin, Vector3 direction, float maximumT)
    {
        List<(int, float, Vector3)> hits = [];
        for (int i = 0; i < voxels.ChildCount; ++i)
        {
            if (!voxels.Cells[i])
                continue;
            voxels.GetPosedLocalChild(i, out var cube, out var place);
            var center = pose.Position + Vector3.Transform(place.Position, pose.Orientation);
            if (cube.RayTest(new RigidPose(center, pose.Orientation), origin, direction, out var t, out var normal) && t <= maximumT)
                hits.Add((i, t, normal));
        }
        return hits;
    }

    struct Hits(List<(int Child, float T, Vector3 Normal)> found, Func<int, bool>? allows = null) : IRayHitHandler
    {
        public readonly bool AllowTest(CollidableReference collidable) => true;

        public readonly bool AllowTest(CollidableReference collidable, int childIndex) => allows is null || allows(childIndex);

        public readonly void OnRayHit(in RayData ray, ref float maximumT, float t, Vector3 normal, CollidableReference collidable, int childIndex) =>
            found.Add((childIndex, t, normal));
    }

    [Fact]
    public void Rays_hit_the_cubes_that_they_hit_one_by_one()
    {
        using var world = new VoxelWorld();
        var voxels = Create(world);
        world.AddStatic(voxels, pose);
        var hitCount = 0;
        for (int i = 0; i < 2000; ++i)
        {
            // From outside and inside, of any length, and along axes of the grid.
            var origin = pose.Position + Next(i % 2 == 0 ? 14 : 5);
            var direction = i % 5 == 0
                ? Vector3.Transform(i % 3 == 0 ? Vector3.UnitX : i % 3 == 1 ? -Vector3.UnitY : Vector3.UnitZ, pose.Orientation) * 2
                : Next(2);
            var maximumT = i % 3 == 0 ? 2 : 1000;
            var expected = HitEach(voxels, origin, direction, maximumT);
            List<(int Child, float T, Vector3 Normal)> found = [];
            var all = new Hits(found);
            world.Simulation.RayCast(origin, direction, maximumT, world.Pool, ref all);
            var missed = Compare(expected, found, direction);
            hitCount += expected.Count;
            Assert.True(missed.Count == 0, $"ray {i} from {origin} along {direction}: {string.Join(", ", missed)}");
            Assert.Equal(expected.Count > 0, world.Simulation.RayCast(origin, direction, maximumT, world.Pool, out var nearest));
            if (expected.Count > 0)
                Assert.Equal(expected.Min(hit => hit.T), nearest.T, 1e-4f);
        }
        Assert.True(hitCount > 2000);
    }

    // What one of the two has and not the other, unless it is grazed: in the frame of the shape a ray is another by rounding.
    static List<string> Compare(List<(int Child, float T, Vector3 Normal)> expected, List<(int Child, float T, Vector3 Normal)> found, Vector3 direction)
    {
        List<string> different = [];
        Assert.Equal(found.Count, found.Select(hit => hit.Child).Distinct().Count());
        foreach (var (child, t, normal) in expected)
        {
            var twin = found.FindIndex(hit => hit.Child == child);
            var isGrazing = MathF.Abs(Vector3.Dot(normal, Vector3.Normalize(direction))) < .02f;
            if (twin < 0 || MathF.Abs(found[twin].T - t) > 1e-4f * (1 + t) || (!isGrazing && (found[twin].Normal - normal).Length() > 1e-3f))
                different.Add($"child {child} at {t} with {normal}, found {(twin < 0 ? "not at all" : found[twin])}");
        }
        if (found.Count > expected.Count)
            different.Add($"{found.Count} for {expected.Count}");
        return different;
    }

    [Fact]
    public void Rays_ask_about_children_and_stop_where_they_are_told_to()
    {
        using var world = new VoxelWorld();
        world.AddStatic(world.Create(5, 1, 1, 1, default, (_, _, _) => true), RigidPose.Identity);
        List<(int Child, float T, Vector3 Normal)> found = [];
        var odd = new Hits(found, child => child % 2 == 1);
        world.Simulation.RayCast(new Vector3(-1, .5f, .5f), Vector3.UnitX, 100, world.Pool, ref odd);
        Assert.Equal([1, 3], found.Select(hit => hit.Child));
        Assert.Equal([2f, 4f], found.Select(hit => hit.T));
        Assert.True(world.Simulation.RayCast(new Vector3(9, .5f, .5f), -Vector3.UnitX, 100, world.Pool, out var first));
        Assert.Equal((4, 4f), (first.ChildIndex, first.T));
    }

    /// <summary>Moves along a line, and turns.</summary>
    [Theory, InlineData(false, false), InlineData(true, false), InlineData(false, true)]
    public void Sweeps_hit_what_they_hit_of_a_compound(bool turns, bool isMoving)
    {
        using var voxels = new VoxelWorld();
        using var cubes = new VoxelWorld(isOfCubes: true);
        foreach (var world in new[] { voxels, cubes })
        {
            if (isMoving)
                world.AddBody(Create(world), pose, new BodyVelocity(new Vector3(1, 0, 2), new Vector3(0, 1, .5f)));
            else
                world.AddStatic(Create(world), pose);
        }
        var count = 0;
        for (int i = 0; i < 600; ++i)
        {
            var start = new RigidPose(pose.Position + Next(16), Quaternion.Normalize(new(Next(2), 1)));
            var velocity = new BodyVelocity(Next(20), turns ? Next(6) : default);
            var (found, expected) = (Sweep(voxels, start, velocity, i), Sweep(cubes, start, velocity, i));
            Assert.Equal(expected.Count, found.Count);
            if (expected.Count == 0)
                continue;
            ++count;
            Assert.Equal(expected[^1].Overlaps, found[^1].Overlaps);
            Assert.Equal(expected[^1].T, found[^1].T, 1e-5f);
            Assert.Equal(0, (expected[^1].Place - found[^1].Place).Length(), 1e-2f);
        }
        Assert.True(count > 60, $"{count} hits");
    }

    static List<SweptHit> Sweep(VoxelWorld world, RigidPose start, BodyVelocity velocity, int kind)
    {
        var nearest = new List<SweptHit>();
        var hits = new SweepHits(nearest, nearestOnly: true);
        if (kind % 2 == 0)
            world.Simulation.Sweep(new Box(.2f, .4f, .3f), start, velocity, 3, world.Pool, ref hits);
        else
            world.Simulation.Sweep(new Capsule(.1f, .5f), start, velocity, 100, world.Pool, ref hits);
        return nearest;
    }

    [Fact]
    public void Distances_and_overlaps_are_those_of_a_compound()
    {
        using var voxels = new VoxelWorld();
        using var cubes = new VoxelWorld(isOfCubes: true);
        voxels.AddStatic(Create(voxels), pose);
        cubes.AddStatic(Create(cubes), pose);
        var (overlapping, near) = (0, 0);
        for (int i = 0; i < 400; ++i)
        {
            var place = new RigidPose(pose.Position + Next(i % 4 == 0 ? 200 : i % 4 == 1 ? 14 : 6), Quaternion.Normalize(new(Next(2), 1)));
            var shape = new Cylinder(.1f, .3f);
            var maximum = i % 3 == 0 ? 1 : float.PositiveInfinity;
            var exists = cubes.Simulation.FindNearest(shape, place, maximum, cubes.Pool, out var expected);
            Assert.Equal(exists, voxels.Simulation.FindNearest(shape, place, maximum, voxels.Pool, out var found));
            Assert.Equal(expected.Overlaps, found.Overlaps);
            Assert.Equal(expected.Distance, found.Distance, 1e-5f * (1 + expected.Distance));
            Assert.Equal(cubes.Simulation.OverlapsAny(shape, place, cubes.Pool), voxels.Simulation.OverlapsAny(shape, place, voxels.Pool));
            overlapping += exists && expected.Overlaps ? 1 : 0;
            near += exists && !expected.Overlaps ? 1 : 0;
        }
        Assert.True(overlapping > 20 && near > 100, $"{overlapping} overlap, {near} are near");
    }
}
