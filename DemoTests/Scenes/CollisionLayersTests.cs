using System;
using System.Collections.Generic;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuPhysics.CollisionDetection;
using BepuPhysics.Trees;
using BepuUtilities;
using BepuUtilities.Memory;
using Xunit;

namespace DemoTests.Scenes;

/// <summary>Layers against callbacks that leave out the same pairs, which must give the same world.</summary>
public sealed class CollisionLayersTests
{
    const int BodyCount = 600;
    const int StepCount = 40;

    // Leaves out by hand what layers leave out; a body's value is found by its index of creation, which is its slot here.
    readonly struct Filter(CollisionLayers[]? bodies, CollisionLayers floor) : INarrowPhaseCallbacks
    {
        public void Initialize(Simulation simulation) { }

        public bool AllowContactGeneration(int workerIndex, CollidableReference a, CollidableReference b, ref float speculativeMargin) =>
            bodies is null || MayMeetByHand(LayersOf(a), LayersOf(b));

        public bool AllowContactGeneration(int workerIndex, CollidablePair pair, int childIndexA, int childIndexB) => true;

        public bool ConfigureContactManifold<TManifold>(int workerIndex, CollidablePair pair, ref TManifold manifold, out PairMaterialProperties pairMaterial)
            where TManifold : unmanaged, IContactManifold<TManifold>
        {
            pairMaterial = new PairMaterialProperties(.5f, 2, default);
            return true;
        }

        public bool ConfigureContactManifold(int workerIndex, CollidablePair pair, int childA, int childB, ref ConvexContactManifold manifold) => true;

        public void Dispose() { }

        CollisionLayers LayersOf(CollidableReference collidable) => collidable.Mobility == CollidableMobility.Static ? floor : bodies![collidable.Slot];
    }

    // Bit by bit, unlike the library.
    static bool MayMeetByHand(CollisionLayers a, CollisionLayers b)
    {
        bool aMeetsB = false, bMeetsA = false;
        for (int layer = 0; layer < 32; ++layer)
        {
            aMeetsB |= (a.Meets >> layer & b.Is >> layer & 1) == 1;
            bMeetsA |= (b.Meets >> layer & a.Is >> layer & 1) == 1;
        }
        return aMeetsB && bMeetsA;
    }

    // One layer for each body, and a random table of which layers meet.
    static CollisionLayers[] RandomLayers(int seed)
    {
        var random = new Random(seed);
        var meets = new uint[32];
        for (int a = 0; a < 32; ++a)
        {
            for (int b = 0; b <= a; ++b)
            {
                if (random.Next(2) == 0)
                    continue;
                meets[a] |= 1u << b;
                meets[b] |= 1u << a;
            }
        }
        var layers = new CollisionLayers[BodyCount];
        for (int i = 0; i < BodyCount; ++i)
        {
            int layer = random.Next(32);
            layers[i] = new(1u << layer, meets[layer]);
        }
        return layers;
    }

    static readonly CollisionLayers floorLayers = new(0xffff, uint.MaxValue);

    static (Simulation Simulation, BufferPool Pool) Build(CollisionLayers[]? filter, bool givesLayers)
    {
        var pool = new BufferPool();
        var simulation = Simulation.Create(
            pool, new Filter(givesLayers ? null : filter, floorLayers), new DefaultPoseIntegratorCallbacks(new Vector3(0, -10, 0)),
            new SolveDescription(1, 4));
        var floor = simulation.Statics.Add(new StaticDescription(new Vector3(0, -1, 0), simulation.Shapes.Add(new Box(100, 2, 100))));
        if (givesLayers)
            simulation.Layers[floor] = floorLayers;
        var random = new Random(5);
        var box = new Box(1, .7f, .9f);
        var shape = simulation.Shapes.Add(box);
        for (int i = 0; i < BodyCount; ++i)
        {
            var place = TestWorld.Scatter(random, 8) + new Vector3(0, 4.5f, 0);
            var body = simulation.Bodies.Add(BodyDescription.CreateDynamic(
                new RigidPose(place, TestWorld.Turn(random)), box.ComputeInertia(1), shape, new BodyActivityDescription(-1)));
            Assert.Equal(i, body.Slot);
            if (givesLayers)
                simulation.Layers[body] = filter![i];
        }
        return (simulation, pool);
    }

    static List<ulong> Run(CollisionLayers[]? filter, bool givesLayers, int threads)
    {
        var (simulation, pool) = Build(filter, givesLayers);
        using var dispatcher = new ThreadDispatcher(threads);
        var hashes = new List<ulong>();
        for (int i = 0; i < StepCount; ++i)
        {
            simulation.Timestep(1 / 60f, dispatcher);
            hashes.Add(simulation.StateHash());
        }
        Assert.NotEqual(0, simulation.NarrowPhase.PairCount);
        simulation.Dispose();
        pool.AssertEmpty();
        pool.Clear();
        return hashes;
    }

    [Theory]
    [InlineData(1)]
    [InlineData(3)]
    public void AWorldWithLayersIsTheWorldThatCallbacksMake(int threads)
    {
        var layers = RandomLayers(3);
        var byLayers = Run(layers, givesLayers: true, threads);
        Assert.Equal(Run(layers, givesLayers: false, threads: 1), byLayers);
        Assert.NotEqual(Run(null, givesLayers: false, threads: 1), byLayers);
    }

    struct Hits(CollisionLayers[] layers, CollisionLayers ray, bool filters) : IRayHitHandler
    {
        public List<(uint Collidable, float T)> Found = [];

        public readonly bool AllowTest(CollidableReference collidable) => !filters || MayMeetByHand(
            ray, collidable.Mobility == CollidableMobility.Static ? floorLayers : layers[collidable.Slot]);

        public readonly bool AllowTest(CollidableReference collidable, int childIndex) => true;

        public readonly void OnRayHit(in RayData ray, ref float maximumT, float t, Vector3 normal, CollidableReference collidable, int childIndex) =>
            Found.Add((collidable.Packed, t));
    }

    [Fact]
    public void ARayWithLayersHitsWhatAHandlerWouldLetItHit()
    {
        var layers = RandomLayers(8);
        var (simulation, pool) = Build(layers, givesLayers: true);
        var random = new Random(9);
        int found = 0, all = 0;
        for (int i = 0; i < 200; ++i)
        {
            var rayLayers = new CollisionLayers((uint)random.NextInt64(), (uint)random.NextInt64() & (uint)random.NextInt64());
            var origin = TestWorld.Scatter(random, 30);
            var direction = TestWorld.Scatter(random, 6) - origin;
            var byLayers = new Hits(layers, rayLayers, filters: false);
            simulation.RayCast(origin, direction, 2, rayLayers, pool, ref byLayers);
            var byHand = new Hits(layers, rayLayers, filters: true);
            simulation.RayCast(origin, direction, 2, pool, ref byHand);
            var unfiltered = new Hits(layers, rayLayers, filters: false);
            simulation.RayCast(origin, direction, 2, pool, ref unfiltered);
            Assert.Equal(byHand.Found, byLayers.Found);
            found += byLayers.Found.Count;
            all += unfiltered.Found.Count;
        }
        Assert.InRange(found, 1, all - 1);
        simulation.Dispose();
        pool.Clear();
    }

    [Fact]
    public void ABoxFallsThroughAFloorThatItNoLongerMeets()
    {
        using var world = new TestWorld();
        var floor = world.AddStatic(new Box(20, 2, 20), new RigidPose(new Vector3(0, -1, 0)));
        var box = world.AddDynamic(new Box(1, 1, 1), 1, new RigidPose(new Vector3(0, .5f, 0)));
        world.Step(30);
        Assert.Equal(1, world.Simulation.NarrowPhase.PairCount);
        world.Simulation.Layers[floor] = new CollisionLayers(1, uint.MaxValue);
        world.Simulation.Layers[box] = new CollisionLayers(uint.MaxValue, ~1u);
        // Another shape and another place are still the same static.
        world.Statics.SetShape(floor, world.Simulation.Shapes.Add(new Box(20, 2, 21)));
        world.Bodies.SetShape(box, default);
        world.Bodies.SetShape(box, world.Simulation.Shapes.Add(new Box(1, 1, 1)));
        world.Step(60);
        Assert.Equal(0, world.Simulation.NarrowPhase.PairCount);
        Assert.InRange(world.Bodies[box].Pose.Position.Y, -6, -4);
        Assert.False(world.Simulation.Layers.MayMeet(world.Bodies[box].CollidableReference, world.Statics[floor].CollidableReference));
    }

    [Fact]
    public void LayersGoWithTheirHandle()
    {
        using var world = new TestWorld();
        var first = world.AddDynamic(new Sphere(1), 1, RigidPose.Identity);
        var floor = world.AddStatic(new Box(20, 2, 20), new RigidPose(new Vector3(0, -10, 0)));
        world.Simulation.Layers[first] = CollisionLayers.Nothing;
        world.Simulation.Layers[floor] = CollisionLayers.Nothing;
        Assert.Equal(CollisionLayers.Nothing, world.Simulation.Layers[first]);
        world.Bodies.Remove(first);
        world.Statics.Remove(floor);
        var second = world.AddDynamic(new Sphere(1), 1, RigidPose.Identity);
        var ground = world.AddStatic(new Box(20, 2, 20), RigidPose.Identity);
        Assert.Equal((first.Slot, floor.Slot), (second.Slot, ground.Slot));
        Assert.Equal(CollisionLayers.Everything, world.Simulation.Layers[second]);
        Assert.Equal(CollisionLayers.Everything, world.Simulation.Layers[ground]);
        Assert.Throws<ArgumentException>(() => world.Simulation.Layers[first]);
        Assert.Throws<ArgumentException>(() => world.Simulation.Layers[floor] = CollisionLayers.Nothing);
        world.Simulation.Layers[second] = CollisionLayers.Nothing;
        world.Simulation.Clear();
        Assert.Equal(CollisionLayers.Everything, world.Simulation.Layers[world.AddDynamic(new Sphere(1), 1, RigidPose.Identity)]);
    }

    [Fact]
    public void WhoGivesNothingNewTakesNoMemory()
    {
        using var world = new TestWorld();
        var body = world.AddDynamic(new Sphere(1), 1, RigidPose.Identity);
        Assert.Equal(CollisionLayers.Everything, world.Simulation.Layers[body]);
        world.Simulation.Layers[body] = CollisionLayers.Everything;
        Assert.False(world.Simulation.Layers.IsUsed);
        world.Simulation.Layers[body] = new CollisionLayers(1, 1);
        Assert.True(world.Simulation.Layers.IsUsed);
    }
}
