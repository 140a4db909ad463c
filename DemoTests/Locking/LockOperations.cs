using System;
using System.Collections.Generic;
using System.Numerics;
using System.Runtime.InteropServices;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuPhysics.CollisionDetection;
using BepuPhysics.Constraints;
using BepuPhysics.Trees;
using BepuUtilities;
using BepuUtilities.Collections;
using BepuUtilities.Memory;
using DemoTests.Quality;
using static DemoTests.Quality.DocSamples;

namespace DemoTests.Locking;

/// <summary>What a call does to a world, which decides when it may come.</summary>
enum OperationKind
{
    /// <summary>Adds, removes, or moves something in memory.</summary>
    Change,
    /// <summary>Writes values where they are.</summary>
    Write,
    /// <summary>Only reads.</summary>
    Query,
    /// <summary>A stage of a step.</summary>
    Stage,
    /// <summary>A whole step, or the end.</summary>
    Whole,
}

/// <summary>All that can be asked of a world, as calls that are right in themselves.</summary>
static class LockOperations
{
    public static readonly IReadOnlyDictionary<string, (OperationKind Kind, Action<LockedWorld> Do)> All = List();

    static Dictionary<string, (OperationKind, Action<LockedWorld>)> List()
    {
        var list = new Dictionary<string, (OperationKind, Action<LockedWorld>)>();
        Bodies(list);
        Statics(list);
        Constraints(list);
        Shapes(list);
        BroadPhase(list);
        Whole(list);
        return list;
    }

    static void Bodies(Dictionary<string, (OperationKind, Action<LockedWorld>)> list)
    {
        Change("Bodies.Add", w => w.Simulation.Bodies.Add(w.HealthyBody(new Vector3(0, 60, 0))));
        Change("Bodies.Remove", w => w.Simulation.Bodies.Remove(w.Spare));
        Change("Bodies.RemoveAt", w => w.Simulation.Bodies.RemoveAt(0));
        Change("Bodies.ApplyDescription", w => w.Simulation.Bodies.ApplyDescription(w.Body, w.HealthyBody(new Vector3(3, 31, 50))));
        Change("Bodies.SetShape", w => w.Simulation.Bodies.SetShape(w.Body, w.OtherShape));
        Change("Bodies.SetShape to none", w => w.Simulation.Bodies.SetShape(w.Body, default));
        Change("Bodies.SetLocalInertia", w => w.Simulation.Bodies.SetLocalInertia(w.Body, new Sphere(.5f).ComputeInertia(2)));
        Change("BecomeKinematic", w => w.Simulation.Bodies[w.Body].BecomeKinematic());
        Change("Bodies.UpdateBounds", w => w.Simulation.Bodies.UpdateBounds(w.Body));
        Change("Simulation.PlainHandles", w => w.Simulation.PlainHandles = true);
        Change("Bodies.EnsureCapacity", w => w.Simulation.Bodies.EnsureCapacity(5000));
        Change("Layers of a body", w => w.Simulation.Layers[w.Body] = new CollisionLayers(1, 2));
        Change("Layers of a static", w => w.Simulation.Layers[w.SpareStatic] = new CollisionLayers(1, 2));
        Change("Events.Listen", w => w.Simulation.Events.Listen(w.Body, EventMask.All));
        Change("Events.SetSensor", w => w.Simulation.Events.SetSensor(w.SpareStatic, true));
        list.Add("Events.HitSpeed", (OperationKind.Write, w => w.Simulation.Events.HitSpeed = 2));
        list.Add("GetInterpolatedPose", (OperationKind.Query, w => w.Simulation.Bodies.GetInterpolatedPose(w.Body, .5f)));
        Change("Awake", w =>
        {
            var body = w.Simulation.Bodies[w.Body];
            body.Awake = true;
        });
        Change("Asleep", w =>
        {
            var body = w.Simulation.Bodies[w.Spare];
            body.Awake = false;
        });
        Change("AwakenBody", w => w.Simulation.Awakener.AwakenBody(w.Body));
        Change("AwakenSet", w => w.Simulation.Awakener.AwakenSet(1));
        Change("AwakenSets", w =>
        {
            var none = default(QuickList<int>);
            w.Simulation.Awakener.AwakenSets(ref none);
        });
        Change("AwakenAll", w => w.Simulation.Awakener.AwakenAll());
        list.Add("ApplyImpulse", (OperationKind.Write, w => w.Simulation.Bodies[w.Body].ApplyImpulse(Vector3.UnitY, Vector3.UnitX)));
        list.Add("ApplyLinearImpulse", (OperationKind.Write, w => w.Simulation.Bodies[w.Body].ApplyLinearImpulse(Vector3.UnitY)));
        list.Add("ApplyAngularImpulse", (OperationKind.Write, w => w.Simulation.Bodies[w.Body].ApplyAngularImpulse(Vector3.UnitY)));
        list.Add("EnumerateConnectedBodies", (OperationKind.Query, w =>
        {
            var nothing = new Nothing();
            w.Simulation.Bodies.EnumerateConnectedBodies(w.Body, ref nothing);
        }
        ));

        void Change(string name, Action<LockedWorld> act) => list.Add(name, (OperationKind.Change, act));
    }

    static void Statics(Dictionary<string, (OperationKind, Action<LockedWorld>)> list)
    {
        Change("Statics.Add", w => w.Simulation.Statics.Add(new StaticDescription(new Vector3(0, 70, 0), Quaternion.Identity, w.OtherShape)));
        Change("Statics.AddWithoutAwakeningBodies", w => w.Simulation.Statics.AddWithoutAwakeningBodies(
            new StaticDescription(new Vector3(0, 70, 0), Quaternion.Identity, w.OtherShape)));
        Change("Statics.Remove without waking", w =>
        {
            var filter = default(StaticsShouldntAwakenBodies);
            w.Simulation.Statics.Remove(w.SpareStatic, ref filter);
        });
        Change("Statics.Remove", w => w.Simulation.Statics.Remove(w.SpareStatic));
        Change("Statics.Remove the ground", w => w.Simulation.Statics.Remove(w.Ground));
        Change("Statics.RemoveAt", w => w.Simulation.Statics.RemoveAt(1));
        Change("Statics.ApplyDescription", w => w.Simulation.Statics.ApplyDescription(
            w.SpareStatic, new StaticDescription(new Vector3(0, 80, 0), Quaternion.Identity, w.OtherShape)));
        Change("Statics.SetShape", w => w.Simulation.Statics.SetShape(w.SpareStatic, w.OtherShape));
        Change("Statics.UpdateBounds", w => w.Simulation.Statics.UpdateBounds(w.SpareStatic));
        Change("Statics.EnsureCapacity", w => w.Simulation.Statics.EnsureCapacity(5000));

        void Change(string name, Action<LockedWorld> act) => list.Add(name, (OperationKind.Change, act));
    }

    static void Constraints(Dictionary<string, (OperationKind, Action<LockedWorld>)> list)
    {
        Change("Solver.Add", w => w.Simulation.Solver.Add(
            w.Body, w.Spare, new Weld { LocalOffset = new Vector3(3, 0, 0), LocalOrientation = Quaternion.Identity }));
        Change("Solver.Remove", w => w.Simulation.Solver.Remove(w.Joint));
        Change("Solver.SetEnabled", w => w.Simulation.Solver.SetEnabled(w.Joint, false));
        Change("Solver.SetCollideConnected", w => w.Simulation.Solver.SetCollideConnected(w.Joint, false));
        Change("Solver.SetBreakThreshold", w => w.Simulation.Solver.SetBreakThreshold(w.Joint, new(1000, 1000)));
        Change("Solver.Register", w => w.Simulation.Solver.Register<Weld>());
        Change("Solver.SubstepCount", w => w.Simulation.Solver.SubstepCount = 3);
        Change("Solver.VelocityIterationCount", w => w.Simulation.Solver.VelocityIterationCount = 2);
        Change("Solver.RelaxationIterationCount", w => w.Simulation.Solver.RelaxationIterationCount = 1);
        Change("Solver.DirectJoints", w => w.Simulation.Solver.DirectJoints = DirectJointsMode.Always);
        Change("Solver.LoadPath", w => w.Simulation.Solver.LoadPath = LoadPathMode.Always);
        Change("Solver.Governor", w => w.Simulation.Solver.Governor = new(0.001f, 2, 8));
        Change("Solver.MinimumCapacityPerTypeBatch", w => w.Simulation.Solver.MinimumCapacityPerTypeBatch = 128);
        list.Add("Solver.ApplyDescription", (OperationKind.Write, w => w.Simulation.Solver.ApplyDescription(
            w.Joint, new BallSocket { LocalOffsetA = new Vector3(1, 0, 0), LocalOffsetB = new Vector3(-2, 0, 0) })));
        list.Add("Solver.GetSeparation", (OperationKind.Query, w => w.Simulation.Solver.GetSeparation(w.Joint)));
        list.Add("EnumerateAccumulatedImpulses", (OperationKind.Query, w => w.Simulation.Solver.GetAccumulatedImpulseMagnitude(w.Joint)));

        void Change(string name, Action<LockedWorld> act) => list.Add(name, (OperationKind.Change, act));
    }

    // Of no pool: the world's may be gone. It stays as long as the process, as the compound does not own it.
    static unsafe Buffer<CompoundChild> Child(TypedIndex shape)
    {
        var child = (CompoundChild*)NativeMemory.Alloc((nuint)sizeof(CompoundChild));
        *child = new(RigidPose.Identity, shape);
        return new(child, 1);
    }

    static void Shapes(Dictionary<string, (OperationKind, Action<LockedWorld>)> list)
    {
        Change("Shapes.Add", w => w.Simulation.Shapes.Add(new Box(3, 3, 3)));
        Change("Shapes.Add of a new type", w => w.Simulation.Shapes.Add(new Capsule(1, 1)));
        Change("Shapes.Add of a compound", w => w.Simulation.Shapes.Add(new Compound(Child(w.OtherShape))));
        Change("Shapes.Remove", w => w.Simulation.Shapes.Remove(w.UnusedShape));
        Change("Shapes.RemoveAndDispose", w => w.Simulation.Shapes.RemoveAndDispose(w.UnusedShape, w.Pool));
        Change("Shapes.RecursivelyRemoveAndDispose", w => w.Simulation.Shapes.RecursivelyRemoveAndDispose(w.UnusedShape, w.Pool));
        Change("Shapes.EnsureBatchCapacities", w => w.Simulation.Shapes.EnsureBatchCapacities(1000));
        Change("Shapes.ResizeBatches", w => w.Simulation.Shapes.ResizeBatches(1000));
        Change("ShapeBatch.Remove", w => w.Simulation.Shapes[w.UnusedShape.Type]!.Remove(w.UnusedShape.Index));
        Change("ShapeBatch.Resize", w => w.Simulation.Shapes[w.UnusedShape.Type]!.Resize(1000));
        Change("CollisionTaskRegistry.RegisterHomogeneousCompound", w =>
            w.Simulation.NarrowPhase.CollisionTaskRegistry.RegisterHomogeneousCompound<Voxels, Box, BoxWide>());
        Change("CollisionTaskRegistry.RegisterConvex", w =>
            w.Simulation.NarrowPhase.CollisionTaskRegistry.RegisterConvex<Cone, ConeWide, ConeSupport, ConeFeature>());
        Change("CollisionTaskRegistry.Register", w => w.Simulation.NarrowPhase.CollisionTaskRegistry.Register(
            w.Simulation.NarrowPhase.CollisionTaskRegistry[0]));
        Change("ShapeBatch.EnsureCapacity", w => w.Simulation.Shapes[w.UnusedShape.Type]!.EnsureCapacity(1000));

        void Change(string name, Action<LockedWorld> act) => list.Add(name, (OperationKind.Change, act));
    }

    static void BroadPhase(Dictionary<string, (OperationKind, Action<LockedWorld>)> list)
    {
        list.Add("BroadPhase.Update", (OperationKind.Change, w => w.Simulation.BroadPhase.Update()));
        list.Add("BroadPhase.UpdateActiveBounds", (OperationKind.Change, w => w.Simulation.BroadPhase.UpdateActiveBounds(0, -Vector3.One, Vector3.One)));
        list.Add("BroadPhase.UpdateStaticBounds", (OperationKind.Change, w => w.Simulation.BroadPhase.UpdateStaticBounds(1, -Vector3.One, Vector3.One)));
        list.Add("BroadPhase.EnsureCapacity", (OperationKind.Change, w => w.Simulation.BroadPhase.EnsureCapacity(5000, 5000)));
        list.Add("BroadPhase.Resize", (OperationKind.Change, w => w.Simulation.BroadPhase.Resize(5000, 5000)));
        list.Add("BroadPhase.FindOverlaps", (OperationKind.Stage, w =>
        {
            var nothing = new Nothing();
            w.Simulation.BroadPhase.FindOverlaps(ref nothing);
        }
        ));
        list.Add("BroadPhase.RayCast", (OperationKind.Query, w =>
        {
            var nothing = new Nothing();
            using var pool = new BepuUtilities.Memory.BufferPool();
            w.Simulation.BroadPhase.RayCast(new Vector3(0, 50, 0), -Vector3.UnitY, 100, pool, ref nothing);
        }
        ));
        list.Add("BroadPhase.GetOverlaps", (OperationKind.Query, w =>
        {
            var nothing = new Nothing();
            using var pool = new BepuUtilities.Memory.BufferPool();
            w.Simulation.BroadPhase.GetOverlaps(-Vector3.One, Vector3.One, pool, ref nothing);
        }
        ));
    }

    static void Whole(Dictionary<string, (OperationKind, Action<LockedWorld>)> list)
    {
        list.Add("Simulation.Clear", (OperationKind.Change, w => w.Simulation.Clear()));
        list.Add("Simulation.ShiftOrigin", (OperationKind.Whole, w => w.Simulation.ShiftOrigin(new(1, 2, 3))));
        list.Add("Simulation.WarmUp", (OperationKind.Change, w => w.Simulation.WarmUp()));
        list.Add("Simulation.EnsureCapacity", (OperationKind.Change, w => w.Simulation.EnsureCapacity(new(5000, 5000, 0, 100, 5000, 16, 4))));
        list.Add("Simulation.PredictBoundingBoxes", (OperationKind.Stage, w => w.Simulation.PredictBoundingBoxes(LockedWorld.Dt, w.Dispatcher)));
        list.Add("Simulation.CollisionDetection", (OperationKind.Stage, w => w.Simulation.CollisionDetection(LockedWorld.Dt, w.Dispatcher)));
        list.Add("Simulation.Solve", (OperationKind.Stage, w => w.Simulation.Solve(LockedWorld.Dt, w.Dispatcher)));
        list.Add("Simulation.Timestep", (OperationKind.Whole, w => w.Simulation.Timestep(LockedWorld.Dt, w.Dispatcher)));
        list.Add("Simulation.Dispose", (OperationKind.Whole, w => w.Simulation.Dispose()));
        list.Add("BufferPool.Clear", (OperationKind.Whole, w => w.Pool.Clear()));
        list.Add("Simulation.RayCast", (OperationKind.Query, w =>
        {
            var nothing = new Nothing();
            using var pool = new BepuUtilities.Memory.BufferPool();
            w.Simulation.RayCast(new Vector3(0, 50, 0), -Vector3.UnitY, 100, pool, ref nothing);
        }
        ));
        list.Add("Simulation.Sweep", (OperationKind.Query, w =>
        {
            var nothing = new Nothing();
            using var pool = new BepuUtilities.Memory.BufferPool();
            w.Simulation.Sweep(new Sphere(1), new RigidPose(new Vector3(0, 50, 0)), -Vector3.UnitY, 100, pool, ref nothing);
        }
        ));
        list.Add("Simulation.StateHash", (OperationKind.Query, w => w.Simulation.StateHash()));
    }

    struct Nothing : IForEach<BodyHandle>, IBroadPhaseOverlapHandler, IBroadPhaseRayTester, IBreakableForEach<CollidableReference>, IRayHitHandler,
        ISweepHitHandler
    {
        public readonly void LoopBody(BodyHandle i) { }

        public readonly bool LoopBody(CollidableReference i) => true;

        public readonly void Handle(int workerIndex, int leafA, int leafB, bool bIsStatic) { }

        public readonly unsafe void RayTest(CollidableReference collidable, RayData* rayData, float* maximumT, BepuUtilities.Memory.BufferPool pool) { }

        public readonly bool AllowTest(CollidableReference collidable) => true;

        public readonly bool AllowTest(CollidableReference collidable, int childIndex) => true;

        public readonly void OnRayHit(in RayData ray, ref float maximumT, float t, Vector3 normal, CollidableReference collidable, int childIndex) { }

        public readonly void OnHit(ref float maximumT, float t, Vector3 hitLocation, Vector3 hitNormal, CollidableReference collidable) { }

        public readonly void OnHitAtZeroT(ref float maximumT, CollidableReference collidable) { }
    }
}
