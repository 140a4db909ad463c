using System;
using System.Numerics;
using System.Threading;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuPhysics.CollisionDetection;
using BepuPhysics.Constraints;
using BepuUtilities;
using BepuUtilities.Memory;

namespace DemoTests.Locking;

/// <summary>A world whose callbacks call what a test wants, once, at a place that the test chooses.</summary>
sealed class LockedWorld : IDisposable
{
    public const float Dt = 1 / 60f;

    readonly Hook hook;
    readonly TypedIndex sphere;

    public LockedWorld(int threads, int bodyCount, ITimestepper? timestepper = null, Shapes? shapes = null)
    {
        hook = new Hook();
        Dispatcher = threads > 1 ? new ThreadDispatcher(threads) : null;
        Simulation = Simulation.Create(
            Pool, new HookedContacts(hook), new HookedIntegrator(hook), new SolveDescription(1, 2), timestepper,
            new SimulationAllocationSizes(16, 16, 0, 4, 16, 16, 1), shapes);
        var floor = Simulation.Shapes.Add(new Box(500, 2, 500));
        Ground = Simulation.Statics.Add(new StaticDescription(new Vector3(0, -1, 0), Quaternion.Identity, floor));
        sphere = Simulation.Shapes.Add(new Sphere(.5f));
        OtherShape = Simulation.Shapes.Add(new Box(1, 1, 1));
        UnusedShape = Simulation.Shapes.Add(new Box(1, 2, 1));
        SpareStatic = Simulation.Statics.Add(new StaticDescription(new Vector3(100, 50, 100), Quaternion.Identity, sphere));
        for (int i = 0; i < bodyCount; ++i)
            Simulation.Bodies.Add(HealthyBody(new Vector3(i % 20, .49f, i / 20)));
        Spare = Simulation.Bodies.Add(HealthyBody(new Vector3(0, 30, 50)));
        Body = Simulation.Bodies.Add(HealthyBody(new Vector3(3, 30, 50)));
        Joint = Simulation.Solver.Add(Spare, Body, new BallSocket { LocalOffsetA = new Vector3(1.5f, 0, 0), LocalOffsetB = new Vector3(-1.5f, 0, 0) });
    }

    public BufferPool Pool { get; } = new();

    public ThreadDispatcher? Dispatcher { get; }

    public Simulation Simulation { get; }

    public StaticHandle Ground { get; }

    public StaticHandle SpareStatic { get; }

    public BodyHandle Spare { get; }

    public BodyHandle Body { get; }

    public ConstraintHandle Joint { get; }

    public TypedIndex OtherShape { get; }

    public TypedIndex UnusedShape { get; }

    public BodyDescription HealthyBody(Vector3 position) => BodyDescription.CreateDynamic(
        position, new Sphere(.5f).ComputeInertia(1), new CollidableDescription(sphere), new BodyActivityDescription(-1));

    /// <summary>Has something done once, the next time that a place is reached, on whatever thread that is.</summary>
    public void Arm(string place, Action action) => hook.Arm(place, action);

    /// <summary>For places that a test reaches by its own code.</summary>
    public void Reach(string place) => hook.Reach(place);

    /// <summary>Whether the place was reached since.</summary>
    public bool WasReached => hook.WasReached;

    public void Step() => Simulation.Timestep(Dt, Dispatcher);

    public void Dispose()
    {
        Simulation.Dispose();
        Pool.AssertEmpty();
        Dispatcher?.WorkerPools.AssertEmpty();
        Dispatcher?.Dispose();
        Pool.Clear();
    }

    public sealed class Hook
    {
        string? place;
        Action? action;
        int armed;

        public bool WasReached { get; private set; }

        public void Arm(string newPlace, Action newAction)
        {
            place = newPlace;
            action = newAction;
            WasReached = false;
            Volatile.Write(ref armed, 1);
        }

        public void Reach(string reached)
        {
            if (Volatile.Read(ref armed) == 0 || reached != place || Interlocked.Exchange(ref armed, 0) == 0)
                return;
            WasReached = true;
            action!();
        }
    }

    readonly struct HookedContacts(Hook hook) : INarrowPhaseCallbacks
    {
        public void Initialize(Simulation simulation) { }

        public bool AllowContactGeneration(int workerIndex, CollidableReference a, CollidableReference b, ref float speculativeMargin)
        {
            hook.Reach("AllowContactGeneration");
            return true;
        }

        public bool AllowContactGeneration(int workerIndex, CollidablePair pair, int childIndexA, int childIndexB) => true;

        public bool ConfigureContactManifold<TManifold>(
            int workerIndex, CollidablePair pair, ref TManifold manifold, out PairMaterialProperties pairMaterial)
            where TManifold : unmanaged, IContactManifold<TManifold>
        {
            pairMaterial = new PairMaterialProperties(1, 2, default);
            hook.Reach("ConfigureContactManifold");
            return true;
        }

        public bool ConfigureContactManifold(int workerIndex, CollidablePair pair, int childIndexA, int childIndexB, ref ConvexContactManifold manifold) =>
            true;

        public void Dispose() => hook.Reach("Dispose");
    }

    readonly struct HookedIntegrator(Hook hook) : IPoseIntegratorCallbacks
    {
        public AngularIntegrationMode AngularIntegrationMode => AngularIntegrationMode.Nonconserving;

        public bool AllowSubstepsForUnconstrainedBodies => false;

        public bool IntegrateVelocityForKinematics => false;

        public void Initialize(Simulation simulation) { }

        public void PrepareForIntegration(float dt) => hook.Reach(dt == Dt ? "PrepareForIntegration, bounds" : "PrepareForIntegration, substep");

        public void IntegrateVelocity(
            Vector<int> bodyIndices, Vector3Wide position, QuaternionWide orientation, BodyInertiaWide localInertia, Vector<int> integrationMask,
            int workerIndex, Vector<float> dt, ref BodyVelocityWide velocity)
        {
            velocity.Linear.Y -= 10 * dt;
            hook.Reach(dt[0] == Dt ? "IntegrateVelocity, bounds" : "IntegrateVelocity, substep");
        }
    }
}
