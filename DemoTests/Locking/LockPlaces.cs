using System;
using System.Collections.Generic;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuPhysics.CollisionDetection;
using BepuPhysics.Trees;
using BepuUtilities;
using BepuUtilities.Memory;

namespace DemoTests.Locking;

/// <summary>A place from which a game's code may call back into the world, and what it may call there.</summary>
/// <param name="Name">Name of the place.</param>
/// <param name="Reach">Makes the world get there.</param>
/// <param name="Allowed">Kinds of calls that work there; all others are refused.</param>
sealed record LockPlace(string Name, Action<LockedWorld> Reach, OperationKind[] Allowed)
{
    static readonly OperationKind[] nothing = [];
    static readonly OperationKind[] queries = [OperationKind.Query];
    static readonly OperationKind[] queriesAndWrites = [OperationKind.Query, OperationKind.Write];
    static readonly OperationKind[] changes = [OperationKind.Query, OperationKind.Write, OperationKind.Change, OperationKind.Stage];

    public static readonly IReadOnlyDictionary<string, LockPlace> All = List();

    static Dictionary<string, LockPlace> List()
    {
        var list = new Dictionary<string, LockPlace>();
        Add("PrepareForIntegration, bounds", Step, nothing);
        Add("IntegrateVelocity, bounds", Step, nothing);
        Add("PrepareForIntegration, substep", Step, nothing);
        Add("IntegrateVelocity, substep", Step, nothing);
        Add("AllowContactGeneration", Step, queries);
        Add("ConfigureContactManifold", Step, queries);
        Add("SubstepStarted", StepWithEvents, queriesAndWrites);
        Add("SubstepEnded", StepWithEvents, queriesAndWrites);
        Add("VelocityIterationScheduler", StepWithEvents, nothing);
        Add("BeforeCollisionDetection", StepWithEvents, changes);
        Add("CollisionsDetected", StepWithEvents, changes);
        Add("ConstraintsSolved", StepWithEvents, changes);
        Add("AllowTest", Query, queriesAndWrites);
        Add("OnRayHit", Query, queriesAndWrites);
        Add("OnHit", Query, queriesAndWrites);
        Add("RayTest", Query, queriesAndWrites);
        Add("Sweep", Query, queriesAndWrites);
        Add("GetOverlaps", Query, queriesAndWrites);
        Add("FindOverlaps", Query, queries);
        Add("EnumerateConnectedBodies", Query, queriesAndWrites);
        Add("EnumerateAccumulatedImpulses", Query, queriesAndWrites);
        return list;

        void Add(string name, Action<LockedWorld> reach, OperationKind[] allowed) => list.Add(name, new LockPlace(name, reach, allowed));
    }

    static void Step(LockedWorld world)
    {
        // Contacts exist from the first step on.
        world.Step();
    }

    static void StepWithEvents(LockedWorld world)
    {
        var solver = world.Simulation.Solver;
        var timestepper = (DefaultTimestepper)world.Simulation.Timestepper;
        Solver.SubstepEvent started = _ => world.Reach("SubstepStarted");
        Solver.SubstepEvent ended = _ => world.Reach("SubstepEnded");
        TimestepperStageHandler before = (_, _) => world.Reach("BeforeCollisionDetection");
        TimestepperStageHandler detected = (_, _) => world.Reach("CollisionsDetected");
        TimestepperStageHandler solved = (_, _) => world.Reach("ConstraintsSolved");
        solver.SubstepStarted += started;
        solver.SubstepEnded += ended;
        timestepper.BeforeCollisionDetection += before;
        timestepper.CollisionsDetected += detected;
        timestepper.ConstraintsSolved += solved;
        solver.VelocityIterationScheduler = _ =>
        {
            world.Reach("VelocityIterationScheduler");
            return 1;
        };
        try
        {
            world.Step();
        }
        finally
        {
            solver.SubstepStarted -= started;
            solver.SubstepEnded -= ended;
            timestepper.BeforeCollisionDetection -= before;
            timestepper.CollisionsDetected -= detected;
            timestepper.ConstraintsSolved -= solved;
            solver.VelocityIterationScheduler = null;
        }
    }

    static void Query(LockedWorld world)
    {
        var handler = new Handler { World = world };
        var simulation = world.Simulation;
        using var pool = new BufferPool();
        simulation.RayCast(new Vector3(0, 50, 0), -Vector3.UnitY, 100, pool, ref handler);
        simulation.Sweep(new Sphere(1), new RigidPose(new Vector3(0, 50, 0)), -Vector3.UnitY, 100, pool, ref handler);
        simulation.BroadPhase.RayCast(new Vector3(0, 50, 0), -Vector3.UnitY, 100, pool, ref handler);
        simulation.BroadPhase.Sweep(-Vector3.One, Vector3.One, Vector3.UnitX, 10, pool, ref handler);
        simulation.BroadPhase.GetOverlaps(-Vector3.One, Vector3.One, pool, ref handler);
        if (simulation.Bodies.BodyExists(world.Body))
            simulation.Bodies.EnumerateConnectedBodies(world.Body, ref handler);
        if (simulation.Solver.ConstraintExists(world.Joint))
            simulation.Solver.EnumerateAccumulatedImpulses(world.Joint, ref handler);
        simulation.BroadPhase.FindOverlaps(ref handler, world.Dispatcher);
    }

    struct Handler : IRayHitHandler, ISweepHitHandler, IBroadPhaseRayTester, IBroadPhaseSweepTester, IBroadPhaseOverlapHandler,
        IBreakableForEach<CollidableReference>, IForEach<BodyHandle>, IForEach<float>
    {
        public LockedWorld World;

        public readonly bool AllowTest(CollidableReference collidable)
        {
            World.Reach("AllowTest");
            return true;
        }

        public readonly bool AllowTest(CollidableReference collidable, int childIndex) => true;

        public readonly void OnRayHit(in RayData ray, ref float maximumT, float t, Vector3 normal, CollidableReference collidable, int childIndex) =>
            World.Reach("OnRayHit");

        public readonly void OnHit(ref float maximumT, float t, Vector3 hitLocation, Vector3 hitNormal, CollidableReference collidable) =>
            World.Reach("OnHit");

        public readonly void OnHitAtZeroT(ref float maximumT, CollidableReference collidable) { }

        public readonly unsafe void RayTest(CollidableReference collidable, RayData* rayData, float* maximumT, BufferPool pool) => World.Reach("RayTest");

        public readonly void Test(CollidableReference collidable, ref float maximumT) => World.Reach("Sweep");

        public readonly void Handle(int workerIndex, int leafA, int leafB, bool bIsStatic) => World.Reach("FindOverlaps");

        public readonly bool LoopBody(CollidableReference i)
        {
            World.Reach("GetOverlaps");
            return true;
        }

        public readonly void LoopBody(BodyHandle i) => World.Reach("EnumerateConnectedBodies");

        public readonly void LoopBody(float i) => World.Reach("EnumerateAccumulatedImpulses");
    }
}
