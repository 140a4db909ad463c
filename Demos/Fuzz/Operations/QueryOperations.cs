using System;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuPhysics.CollisionDetection;
using BepuPhysics.Trees;
using BepuUtilities;
using BepuUtilities.Memory;

namespace Demos.Fuzz.Operations;

/// <summary>Questions to a simulation.</summary>
static unsafe class QueryOperations
{
    public static FuzzOperation[] All { get; } =
    [
        new("Simulation.RayCast", 10, w =>
        {
            var hits = new Hits { World = w };
            Vector3 origin = w.Random.Spoil(w.Random.Vector(4), 6), direction = w.Random.Spoil(w.Random.Direction() * w.Random.Magnitude(0.01f, 10), 6);
            float length = w.Random.Spoil(w.Random.Number(0, 20), 10);
            w.Tell($"{origin} {direction} {length}");
            w.Simulation.RayCast(origin, direction, length, w.Pool, ref hits);
        }),
        new("Simulation.RayCast with layers", 4, w =>
        {
            var hits = new Hits { World = w };
            w.Simulation.RayCast(w.Random.Spoil(w.Random.Vector(4), 6), w.Random.Spoil(w.Random.Direction(), 6), w.Random.Spoil(w.Random.Number(0, 20), 10),
                BodyOperations.AnyLayers(w), w.Pool, ref hits);
        }),
        new("Simulation.Sweep", 8, w =>
        {
            var hits = new SweepHits { World = w };
            var pose = w.Random.Spoil(new RigidPose(w.Random.Vector(4), w.Random.Turn()), 3);
            Vector3 linear = w.Random.Direction() * w.Random.Magnitude(0.01f, 100), angular = w.Random.Vector(w.Random.Magnitude(.1f, 100));
            var velocity = w.Random.Spoil(new BodyVelocity(linear, angular), 3);
            float length = w.Random.Spoil(w.Random.Number(0, 3), 10);
            Vector3 size = w.Random.Spoil(new Vector3(w.Random.Magnitude(.01f, 3), w.Random.Magnitude(.01f, 3), w.Random.Magnitude(.01f, 3)), 4);
            w.Tell($"{pose.Position} {pose.Orientation} {velocity.Linear} {velocity.Angular} {length} {size}");
            switch (w.Random.Below(5))
            {
                case 0:
                    w.Simulation.Sweep(new Sphere(size.X), pose, velocity, length, w.Pool, ref hits);
                    break;
                case 1:
                    w.Simulation.Sweep(new Capsule(size.X, size.Y), pose, velocity, length, w.Pool, ref hits);
                    break;
                case 2:
                    w.Simulation.Sweep(new Cylinder(size.X, size.Y), pose, velocity, length, BodyOperations.AnyLayers(w), w.Pool, ref hits);
                    break;
                case 3:
                    w.Simulation.Sweep(new Triangle(size, -size, new(size.Y, -size.X, 0)), pose, velocity, length, w.Pool, ref hits);
                    break;
                default:
                    w.Simulation.Sweep(new Box(size.X, size.Y, size.Z), pose, velocity, length, w.Pool, ref hits,
                        w.Random.Spoil(w.Random.Number(0, .1f), 10), w.Random.Spoil(w.Random.Number(0, .1f), 10), w.Random.Count());
                    break;
            }
        }),
        new("BroadPhase.GetOverlaps", 6, w =>
        {
            var counter = new Counter { Left = w.Random.Below(20) };
            Vector3 min = w.Random.Spoil(w.Random.Vector(3), 5), max = w.Random.Spoil(min + w.Random.Vector(1) + Vector3.One, 5);
            w.Tell($"{min} {max}");
            w.Simulation.BroadPhase.GetOverlaps(min, max, w.Pool, ref counter);
        }),
        new("BroadPhase.RayCast", 4, w =>
        {
            var tester = new Tester();
            w.Simulation.BroadPhase.RayCast(w.Random.Spoil(w.Random.Vector(4), 6), w.Random.Spoil(w.Random.Direction(), 6),
                w.Random.Spoil(w.Random.Number(0, 20), 10), w.Pool, ref tester);
        }),
        new("BroadPhase.Sweep", 4, w =>
        {
            var tester = new Tester();
            Vector3 min = w.Random.Spoil(w.Random.Vector(3), 5), max = w.Random.Spoil(min + w.Random.Vector(1) + Vector3.One, 5);
            w.Simulation.BroadPhase.Sweep(min, max, w.Random.Spoil(w.Random.Direction(), 6), w.Random.Spoil(w.Random.Number(0, 20), 10), w.Pool, ref tester);
        }),
        new("CollidableProperty", 2, w =>
        {
            using var property = new CollidableProperty<int>(w.Simulation);
            if (w.Bodies.Live.Count > 0)
                property.Allocate(w.Random.Of(w.Bodies.Live)) = 3;
            if (w.Statics.Live.Count > 0)
                property.Allocate(w.Random.Of(w.Statics.Live)) = 5;
            if (w.Has(FuzzScope.StaleReferences))
                _ = property[w.AnyBody()] + property[w.AnyStatic()];
            property.CompactBodies();
        }),
        new("Simulation.StateHash", 1, w => w.Simulation.StateHash()),
    ];

    struct Hits : IRayHitHandler
    {
        public FuzzWorld World;

        public readonly bool AllowTest(CollidableReference collidable) => true;

        public readonly bool AllowTest(CollidableReference collidable, int childIndex) => true;

        public readonly void OnRayHit(
            in BepuPhysics.Trees.RayData ray, ref float maximumT, float t, Vector3 normal, CollidableReference collidable, int childIndex)
        {
            if (!(t >= 0 && t <= maximumT))
                throw new FuzzFailure($"a hit at {t}, beyond {maximumT}");
            CheckExists(World, collidable);
            maximumT = t;
        }
    }

    static void CheckExists(FuzzWorld world, CollidableReference collidable)
    {
        if (collidable.Mobility == CollidableMobility.Static
            ? !world.Simulation.Statics.StaticExists(collidable.StaticHandle)
            : !world.Simulation.Bodies.BodyExists(collidable.BodyHandle))
            throw new FuzzFailure($"a hit on what is not there: {collidable}");
    }

    struct SweepHits : ISweepHitHandler
    {
        public FuzzWorld World;

        public readonly bool AllowTest(CollidableReference collidable) => true;

        public readonly bool AllowTest(CollidableReference collidable, int childIndex) => childIndex % 7 != 6;

        public readonly void OnHit(ref float maximumT, float t, Vector3 hitLocation, Vector3 hitNormal, CollidableReference collidable)
        {
            if (!(t >= 0 && t <= maximumT && float.IsFinite(hitLocation.LengthSquared()) && Math.Abs(hitNormal.Length() - 1) < 1e-3f))
                throw new FuzzFailure($"a hit at {t} of {maximumT}, {hitLocation}, {hitNormal}");
            CheckExists(World, collidable);
            if (t < maximumT * .5f)
                maximumT = t;
        }

        public readonly void OnHitAtZeroT(ref float maximumT, CollidableReference collidable) => CheckExists(World, collidable);
    }

    struct Counter : IBreakableForEach<CollidableReference>
    {
        public int Left;

        public bool LoopBody(CollidableReference i) => --Left > 0;
    }

    struct Tester : IBroadPhaseRayTester, IBroadPhaseSweepTester
    {
        int count;

        public void RayTest(CollidableReference collidable, RayData* rayData, float* maximumT, BufferPool pool) => ++count;

        public void Test(CollidableReference collidable, ref float maximumT) => ++count;
    }
}
