using System;
using System.Diagnostics;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuPhysics.CollisionDetection;
using BepuPhysics.Trees;
using BepuUtilities;
using BepuUtilities.Memory;
using Demos.Engine;
using Demos.Running;
using Demos.Scenes;

namespace Demos.Levels;

/// <summary>What a level of triangles costs.</summary>
/// <param name="Build">Seconds for a million triangles, each with corners of its own.</param>
/// <param name="Slanted">Rays that come down on the hills at about 45 degrees, nanoseconds each.</param>
/// <param name="Grazing">Rays of 100 m along the hills, nanoseconds each.</param>
/// <param name="HitShare">Part of all rays that hit.</param>
readonly record struct LevelFigures(double Build, double Slanted, double Grazing, double HitShare);

/// <summary>Measures a mesh of the engine that this program is compiled against: the hills of the scene mesh-terrain.</summary>
static class LevelRun
{
    const int RayCount = 20_000;
    const float Reach = 100, Start = 10, HalfWidth = 100;

    /// <summary>Makes the level and casts rays.</summary>
    /// <param name="repetitions">Times that each is done; the least counts.</param>
    /// <param name="threads">Threads to build with.</param>
    public static LevelFigures Measure(int repetitions, int threads)
    {
        using var pool = new BufferPool();
        using var dispatcher = threads > 1 ? new ThreadDispatcher(threads) : null;
        SceneShape hills = Hills();
        double build = double.MaxValue;
        for (int i = 0; i < repetitions; ++i)
            build = Math.Min(build, TimeBuild(hills, pool, dispatcher));
        Simulation simulation = Simulation.Create(
            pool, new SceneNarrowPhaseCallbacks(new ContactRecorder(1), new PairMaterialProperties(1, 1, EngineDefaults.ContactSpring)),
            new ScenePoseIntegratorCallbacks(SceneDescription.Gravity, 0), EngineDefaults.Solve(new RunSettings()));
        TypedIndex shape = new ShapeFactory(simulation).Build(hills, solid: false).Index;
        simulation.Statics.Add(new StaticDescription(Vector3.Zero, shape));
        // So that trees and poses are as in a world that runs.
        simulation.Timestep(1 / 60f);
        (double slanted, int slantedHits) = TimeRays(simulation, pool, Rays(slope: -1), repetitions);
        (double grazing, int grazingHits) = TimeRays(simulation, pool, Rays(slope: -.02f), repetitions);
        simulation.Dispose();
        return new(build, slanted, grazing, (slantedHits + grazingHits) / (2.0 * RayCount));
    }

    static SceneShape Hills()
    {
        SceneDescription scene = SceneLibrary.Load("mesh-terrain", 1);
        return scene.Shapes.Find(shape => shape.Kind == SceneShapeKind.Mesh)!;
    }

    static double TimeBuild(SceneShape hills, BufferPool pool, IThreadDispatcher? dispatcher)
    {
        int count = hills.Indices.Length / 3;
        pool.Take(count, out Buffer<Triangle> triangles);
        // A front is where corners are clockwise.
        for (int i = 0; i < count; ++i)
            triangles[i] = new(hills.Points[hills.Indices[3 * i]], hills.Points[hills.Indices[3 * i + 2]], hills.Points[hills.Indices[3 * i + 1]]);
        long start = Stopwatch.GetTimestamp();
        var mesh = new Mesh(triangles, Vector3.One, pool, dispatcher);
        double seconds = Stopwatch.GetElapsedTime(start).TotalSeconds;
        mesh.Dispose(pool);
        return seconds * 1e6 / count;
    }

    static RayData[] Rays(float slope)
    {
        var random = new SceneRandom(1);
        var rays = new RayData[RayCount];
        foreach (ref RayData ray in rays.AsSpan())
        {
            float angle = random.Next(-MathF.PI, MathF.PI);
            var direction = new Vector3(MathF.Cos(angle), slope, MathF.Sin(angle));
            ray.Origin = new(random.Next(-HalfWidth, HalfWidth), slope < -.5f ? Start : 2, random.Next(-HalfWidth, HalfWidth));
            ray.Direction = direction / direction.Length();
        }
        return rays;
    }

    static (double Nanoseconds, int Hits) TimeRays(Simulation simulation, BufferPool pool, RayData[] rays, int repetitions)
    {
        double least = double.MaxValue;
        var handler = default(NearestHit);
        for (int i = 0; i < repetitions; ++i)
        {
            handler.Count = 0;
            long start = Stopwatch.GetTimestamp();
            foreach (ref RayData ray in rays.AsSpan())
            {
                handler.HasHit = false;
                simulation.RayCast(ray.Origin, ray.Direction, Reach, pool, ref handler);
                handler.Count += handler.HasHit ? 1 : 0;
            }
            least = Math.Min(least, Stopwatch.GetElapsedTime(start).TotalNanoseconds);
        }
        return (least / rays.Length, handler.Count);
    }

    struct NearestHit : IRayHitHandler
    {
        public bool HasHit;
        public int Count;

        public readonly bool AllowTest(CollidableReference collidable) => true;

        public readonly bool AllowTest(CollidableReference collidable, int childIndex) => true;

        public void OnRayHit(in RayData ray, ref float maximumT, float t, Vector3 normal, CollidableReference collidable, int childIndex)
        {
            HasHit = true;
            maximumT = t;
        }
    }
}
