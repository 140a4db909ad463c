using System;
using System.Collections.Generic;
using System.Linq;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuPhysics.Trees;
using DemoTests.Scenes;
using Xunit;

namespace DemoTests.Queries;

/// <summary>Rays that are cast together hit what each of them hits by itself, to the last bit.</summary>
public sealed class RayBatchTests : IDisposable
{
    readonly TestWorld world = new();
    readonly Random random = new(3);
    readonly TypedIndex terrain;

    readonly record struct Hit(int Ray, CollidableReference Collidable, int Child, float T, Vector3 Normal);

    readonly record struct Ray(Vector3 Origin, Vector3 Direction, float MaximumT);

    public RayBatchTests()
    {
        for (int i = 0; i < 300; ++i)
        {
            var pose = new RigidPose(Next(10), Quaternion.Normalize(new Quaternion(Next(1), 0.1f + random.NextSingle())));
            switch (i % 4)
            {
                case 0: world.AddStatic(new Box(.5f + random.NextSingle(), .4f, .9f), pose); break;
                case 1: world.AddKinematic(new Capsule(.2f, random.NextSingle()), pose); break;
                case 2: world.AddDynamic(new Cylinder(.4f, .7f), 1, pose); break;
                default: world.AddStatic(new Sphere(.2f + .4f * random.NextSingle()), pose); break;
            }
        }
        world.Pool.Take<Triangle>(2 * 16 * 16, out var triangles);
        for (int i = 0; i < triangles.Length; ++i)
        {
            float x = i / 2 % 16 - 8, z = i / 32 - 8;
            triangles[i] = i % 2 == 0
                ? new(Ground(x, z), Ground(x + 1, z), Ground(x, z + 1)) : new(Ground(x + 1, z), Ground(x + 1, z + 1), Ground(x, z + 1));
        }
        terrain = world.Simulation.Shapes.Add(new Mesh(triangles, new Vector3(2, 1, 2), world.Pool));
        world.Statics.Add(new StaticDescription(new Vector3(0, -8, 0), terrain));
        world.Step();
    }

    static Vector3 Ground(float x, float z) => new(x, MathF.Sin(x) * MathF.Cos(z), z);

    Vector3 Next(float most) => most * new Vector3(2 * random.NextSingle() - 1, 2 * random.NextSingle() - 1, 2 * random.NextSingle() - 1);

    public void Dispose()
    {
        world.Statics.Clear();
        world.Simulation.Shapes.RemoveAndDispose(terrain, world.Pool);
        world.Dispose();
    }

    IEnumerable<Ray> Rays(int kind, int count)
    {
        for (int i = 0; i < count; ++i)
        {
            yield return kind switch
            {
                // All over; a fan; side by side, some of them along an axis; from within; without a length, or without a direction.
                0 => new(Next(15), Next(3), 10 * random.NextSingle()),
                1 => new(new Vector3(12, 9, 11), new Vector3(-1, 0.05f * (i / 20) - 1, 0.05f * (i % 20) - 1), float.PositiveInfinity),
                2 => new(new Vector3(0.5f * (i % 20) - 5, 15, 0.5f * (i / 20) - 5), i % 3 == 0 ? -Vector3.UnitY : new Vector3(0.1f, -1, 0), 40),
                3 => new(Vector3.Zero, Next(1), 1e6f),
                _ => new(Next(10), i % 2 == 0 ? default : Next(5), i % 4 < 2 ? 0 : 3),
            };
        }
    }

    [Theory]
    [InlineData(0, 401, 2048), InlineData(1, 400, 64), InlineData(2, 403, 7), InlineData(3, 200, 100), InlineData(4, 90, 9)]
    public void All_hits_are_those_of_each_alone(int kind, int count, int capacity)
    {
        var rays = Rays(kind, count).ToArray();
        var alone = CastAlone(rays, isNearest: false);
        Assert.NotEmpty(alone);
        Assert.Equal(InOrder(alone), InOrder(CastTogether(rays, capacity, isNearest: false)));
    }

    /// <summary>Who shortens the ray at each hit is left with the nearest, in whichever order the hits are told.</summary>
    [Theory]
    [InlineData(0), InlineData(1), InlineData(2), InlineData(3)]
    public void The_nearest_hit_is_that_of_each_alone(int kind)
    {
        var rays = Rays(kind, 400).ToArray();
        var alone = Nearest(CastAlone(rays, isNearest: true));
        Assert.NotEmpty(alone);
        Assert.Equal(alone, Nearest(CastTogether(rays, 256, isNearest: true)));
    }

    /// <summary>A tree of one leaf has a side that is missing.</summary>
    [Fact]
    public void In_a_world_of_two_things_they_are_hit()
    {
        using var small = new TestWorld();
        var still = new CollidableReference(small.AddStatic(new Box(1.1f, 1, 1), RigidPose.Identity));
        var moving = new CollidableReference(CollidableMobility.Dynamic, small.AddDynamic(new Sphere(.45f), 1, new RigidPose(new Vector3(0, 3, 0))));
        var hits = new List<Hit>();
        var batcher = new SimulationRayBatcher<Collector>(small.Pool, small.Simulation, new Collector(hits, false));
        for (int i = 0; i < 21; ++i)
            Add(ref batcher, new(new Vector3(0.1f * i - 1, 9, 0), -Vector3.UnitY, 100), i);
        batcher.Flush();
        batcher.Dispose();
        Assert.Equal(Enumerable.Range(5, 11), hits.Where(hit => hit.Collidable == still).Select(hit => hit.Ray).Order());
        Assert.Equal(Enumerable.Range(6, 9), hits.Where(hit => hit.Collidable == moving).Select(hit => hit.Ray).Order());
    }

    [Fact]
    public void Rays_before_a_bad_one_are_cast_and_those_after_it_forgotten()
    {
        var rays = Enumerable.Repeat(new Ray(new Vector3(0, 20, 0), -Vector3.UnitY, 100), 13).ToArray();
        rays[9] = rays[9] with { Direction = new Vector3(float.NaN, 0, 0) };
        var hits = new List<Hit>();
        var batcher = new SimulationRayBatcher<Collector>(world.Pool, world.Simulation, new Collector(hits, true));
        foreach (var ray in rays)
            Add(ref batcher, ray, Array.IndexOf(rays, ray));
        Assert.Throws<ArgumentException>(() => batcher.Flush());
        Assert.Equal(9, hits.Count(hit => hit.T == hits[^1].T));
        batcher.Flush();
        Assert.Equal(9, hits.Count(hit => hit.T == hits[^1].T));
        batcher.Dispose();
    }

    static Hit[] InOrder(List<Hit> hits) =>
        [.. hits.OrderBy(hit => hit.Ray).ThenBy(hit => hit.T).ThenBy(hit => hit.Collidable.Packed).ThenBy(hit => hit.Child)];

    static (int, float)[] Nearest(List<Hit> hits) => [.. hits.GroupBy(hit => hit.Ray).Select(ray => (ray.Key, ray.Min(hit => hit.T))).Order()];

    List<Hit> CastAlone(Ray[] rays, bool isNearest)
    {
        var hits = new List<Hit>();
        var collector = new Collector(hits, isNearest);
        for (int i = 0; i < rays.Length; ++i)
            world.Simulation.RayCast(rays[i].Origin, rays[i].Direction, rays[i].MaximumT, world.Pool, ref collector, i);
        return hits;
    }

    List<Hit> CastTogether(Ray[] rays, int capacity, bool isNearest)
    {
        var hits = new List<Hit>();
        var batcher = new SimulationRayBatcher<Collector>(world.Pool, world.Simulation, new Collector(hits, isNearest), capacity);
        for (int i = 0; i < rays.Length; ++i)
            Add(ref batcher, rays[i], i);
        batcher.Flush();
        batcher.Dispose();
        return hits;
    }

    static void Add(ref SimulationRayBatcher<Collector> batcher, Ray ray, int id)
    {
        var (origin, direction, maximumT) = ray;
        batcher.Add(ref origin, ref direction, maximumT, id);
    }

    struct Collector(List<Hit> hits, bool isNearest) : IRayHitHandler
    {
        public readonly bool AllowTest(CollidableReference collidable) => true;

        public readonly bool AllowTest(CollidableReference collidable, int childIndex) => true;

        public readonly void OnRayHit(in RayData ray, ref float maximumT, float t, Vector3 normal, CollidableReference collidable, int childIndex)
        {
            Assert.InRange(t, 0, maximumT);
            if (isNearest)
                maximumT = t;
            hits.Add(new(ray.Id, collidable, childIndex, t, normal));
        }
    }
}
