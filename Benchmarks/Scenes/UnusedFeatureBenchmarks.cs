using System;
using System.Numerics;
using BenchmarkDotNet.Attributes;
using Benchmarks.Smoke;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuPhysics.CollisionDetection;
using BepuPhysics.Constraints;
using BepuUtilities.Memory;

namespace Benchmarks.Scenes;

/// <summary>What a feature costs a scene that does not use it: each next to the same step without the feature.</summary>
[WarmupCount(2), IterationCount(9)]
public class UnusedFeatureBenchmarks : IShortened, IDisposable
{
    const int StepsPerCall = 20;

    int steps = StepsPerCall;
    int side = 24;
    BufferPool? pool;
    Simulation? simulation;

    /// <summary>What is turned on and has nothing to do.</summary>
    public enum Feature
    {
        /// <summary>Nothing.</summary>
        None,
        /// <summary>Loads are handed down where that is needed, and nothing rests on anything.</summary>
        LoadPath,
        /// <summary>Callbacks tell a restitution, which is zero.</summary>
        Surface,
        /// <summary>A governor that may choose among one number of substeps.</summary>
        Governor,
    }

    /// <summary>What the scene is made of.</summary>
    public enum Content
    {
        /// <summary>Bodies that touch nothing.</summary>
        Flying,
        /// <summary>A cloth of ball sockets that hangs from two corners.</summary>
        Joints,
        /// <summary>Boxes on the ground; only for features that contacts do not need.</summary>
        Contacts,
    }

    /// <summary>The feature.</summary>
    [Params(Feature.None, Feature.LoadPath, Feature.Surface, Feature.Governor)]
    public Feature On { get; set; }

    /// <summary>The scene.</summary>
    [Params(Content.Flying, Content.Joints, Content.Contacts)]
    public Content Scene { get; set; }

    /// <inheritdoc/>
    void IShortened.Shorten() => (steps, side) = (2, 4);

    /// <summary>Builds the scene and lets it begin.</summary>
    [GlobalSetup]
    public void Setup()
    {
        pool = new BufferPool();
        var solve = new SolveDescription(1, 4)
        {
            LoadPath = On == Feature.LoadPath ? LoadPathMode.WhereNeeded : LoadPathMode.Off,
            Governor = On == Feature.Governor ? new SubstepGovernor(1, 4, 4) : null,
        };
        var gravity = new DefaultPoseIntegratorCallbacks(Scene == Content.Flying ? default : new Vector3(0, -9.81f, 0));
        simulation = On == Feature.Surface
            ? Simulation.Create(pool, new PlainSurface(), gravity, solve)
            : Simulation.Create(pool, new DefaultNarrowPhaseCallbacks(), gravity, solve);
        Fill(simulation);
        for (int i = 0; i < steps; ++i)
            simulation.Timestep(1 / 60f);
    }

    void Fill(Simulation world)
    {
        var box = new Box(1, 1, 1);
        var shape = world.Shapes.Add(box);
        var inertia = box.ComputeInertia(1);
        if (Scene == Content.Contacts)
            world.Statics.Add(new StaticDescription(new Vector3(0, -.5f, 0), world.Shapes.Add(new Box(1000, 1, 1000))));
        var bodies = new BodyHandle[side * side];
        for (int i = 0; i < bodies.Length; ++i)
        {
            var position = new Vector3(i % side * 3, Scene == Content.Contacts ? .5f : 10, i / side * 3);
            bodies[i] = Scene == Content.Joints && i is 0 || (Scene == Content.Joints && i == side - 1)
                ? world.Bodies.Add(BodyDescription.CreateKinematic(position, shape, -1))
                : world.Bodies.Add(BodyDescription.CreateDynamic(position, new BodyVelocity(default, new Vector3(0, .1f, 0)), inertia, shape, -1));
        }
        if (Scene != Content.Joints)
            return;
        for (int i = 0; i < bodies.Length; ++i)
        {
            if (i % side > 0)
                world.Solver.Add(bodies[i - 1], bodies[i], new BallSocket { LocalOffsetA = new(1.5f, 0, 0), LocalOffsetB = new(-1.5f, 0, 0) });
            if (i >= side)
                world.Solver.Add(bodies[i - side], bodies[i], new BallSocket { LocalOffsetA = new(0, 0, 1.5f), LocalOffsetB = new(0, 0, -1.5f) });
        }
    }

    /// <summary>A sixtieth of a second in four substeps.</summary>
    [Benchmark(OperationsPerInvoke = StepsPerCall)]
    public void Step()
    {
        for (int i = 0; i < steps; ++i)
            simulation!.Timestep(1 / 60f);
    }

    /// <summary>Frees it.</summary>
    [GlobalCleanup]
    public void Dispose()
    {
        simulation?.Dispose();
        pool?.Dispose();
        (simulation, pool) = (null, null);
        GC.SuppressFinalize(this);
    }

    struct PlainSurface : INarrowPhaseCallbacks, ISurfaceCallbacks<PlainSurface>
    {
        DefaultNarrowPhaseCallbacks inner;

        public void Initialize(Simulation simulation)
        {
            inner = new DefaultNarrowPhaseCallbacks();
            inner.Initialize(simulation);
        }

        public readonly bool AllowContactGeneration(int workerIndex, CollidableReference a, CollidableReference b, ref float speculativeMargin) => true;

        public readonly bool AllowContactGeneration(int workerIndex, CollidablePair pair, int childIndexA, int childIndexB) => true;

        public readonly bool ConfigureContactManifold<TManifold>(
            int workerIndex, CollidablePair pair, ref TManifold manifold, out PairMaterialProperties material)
            where TManifold : unmanaged, IContactManifold<TManifold> => inner.ConfigureContactManifold(workerIndex, pair, ref manifold, out material);

        public readonly bool ConfigureContactManifold(
            int workerIndex, CollidablePair pair, int childIndexA, int childIndexB, ref ConvexContactManifold manifold) => true;

        public readonly SurfaceProperties GetSurface<TManifold>(int workerIndex, CollidablePair pair, ref TManifold manifold)
            where TManifold : unmanaged, IContactManifold<TManifold> => default;

        public readonly void Dispose() { }
    }
}
