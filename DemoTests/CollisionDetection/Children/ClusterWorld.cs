using System;
using System.Collections.Generic;
using System.Linq;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuPhysics.CollisionDetection;
using BepuPhysics.Constraints;
using BepuUtilities;
using BepuUtilities.Memory;
using DemoTests.Support;

namespace DemoTests.CollisionDetection.Children;

/// <summary>What the callbacks of a cluster's world do.</summary>
sealed class ClusterBehaviour
{
    public float Restitution;
    /// <summary>Whether impacts are made at the time at which surfaces meet.</summary>
    public bool HasExactImpacts;
    public float Friction = .5f;
    /// <summary>Whether a child, or the static in its place, is let through to its test.</summary>
    public Func<int, bool> Allows = _ => true;
    /// <summary>Whether the contacts of a child are kept.</summary>
    public Func<int, bool> Keeps = _ => true;
    /// <summary>Called with each manifold of a pair as a whole.</summary>
    public Func<object, object?>? Configure;
}

readonly struct ClusterCallbacks(ClusterBehaviour behaviour, bool isCluster) : ISurfaceCallbacks<ClusterCallbacks>
{
    public void Initialize(Simulation simulation) { }

    public void Dispose() { }

    public bool AllowContactGeneration(int workerIndex, CollidableReference a, CollidableReference b, ref float speculativeMargin) =>
        isCluster || b.Mobility != CollidableMobility.Static || behaviour.Allows(b.StaticHandle.Slot);

    public bool AllowContactGeneration(int workerIndex, CollidablePair pair, int childIndexA, int childIndexB) =>
        behaviour.Allows(Math.Max(childIndexA, childIndexB));

    public bool ConfigureContactManifold(int workerIndex, CollidablePair pair, int childIndexA, int childIndexB, ref ConvexContactManifold manifold) =>
        behaviour.Keeps(Math.Max(childIndexA, childIndexB));

    public bool ConfigureContactManifold<TManifold>(int workerIndex, CollidablePair pair, ref TManifold manifold, out PairMaterialProperties pairMaterial)
        where TManifold : unmanaged, IContactManifold<TManifold>
    {
        pairMaterial = new(behaviour.Friction, 2, SpringSettings.Rigid);
        if (behaviour.Configure is { } configure && manifold.Count > 0 && configure(manifold) is TManifold changed)
            manifold = changed;
        return isCluster || pair.B.Mobility != CollidableMobility.Static || behaviour.Keeps(pair.B.StaticHandle.Slot);
    }

    public SurfaceProperties GetSurface<TManifold>(int workerIndex, CollidablePair pair, ref TManifold manifold)
        where TManifold : unmanaged, IContactManifold<TManifold> =>
        new() { Restitution = behaviour.Restitution, ExactImpacts = behaviour.HasExactImpacts };
}

/// <summary>A simulation whose shapes may be clusters; all pools must be empty at its end.</summary>
sealed class ClusterWorld : IDisposable
{
    readonly ThreadDispatcher? dispatcher;
    readonly BufferPool pool = new();
    readonly List<Buffer<ClusterChild>> owned = [];
    readonly List<Action<BufferPool>> disposals = [];
    readonly bool isCluster;

    public ClusterWorld(bool isCluster, int threads = 1)
    {
        this.isCluster = isCluster;
        dispatcher = threads > 1 ? new ThreadDispatcher(threads) : null;
        Simulation = Simulation.Create(
            pool, new ClusterCallbacks(Behaviour, isCluster), new DefaultPoseIntegratorCallbacks(), new SolveDescription(1, 4));
        Register(Simulation.NarrowPhase.CollisionTaskRegistry, Rules);
    }

    /// <summary>Whether separate statics agree on their normals.</summary>
    public bool JoinsStatics
    {
        get => NarrowPhase.JoinsStatics;
        set => NarrowPhase.JoinsStatics = value;
    }

    public static void Register(CollisionTaskRegistry registry, ClusterRules rules)
    {
        registry.Register(new ClusterTask<Sphere>(rules));
        registry.Register(new ClusterTask<Capsule>(rules));
        registry.Register(new ClusterTask<Box>(rules));
        registry.Register(new ClusterTask<Cylinder>(rules));
        registry.Register(new ClusterTask<ConvexHull>(rules));
        registry.Register(new ClusterPairTask(rules));
    }

    public Simulation Simulation { get; }

    public ClusterRules Rules { get; } = new();

    public ClusterBehaviour Behaviour { get; } = new();

    public int StepCount { get; private set; }

    NarrowPhase NarrowPhase => Simulation.NarrowPhase;

    public TypedIndex AddCluster(IReadOnlyList<ClusterChild> children)
    {
        pool.Take(children.Count, out Buffer<ClusterChild> buffer);
        for (int i = 0; i < children.Count; ++i)
            buffer[i] = children[i];
        owned.Add(buffer);
        return Simulation.Shapes.Add(new Cluster { Children = buffer });
    }

    /// <summary>Returns the memory of a shape at the end.</summary>
    public void Own<TShape>(TShape shape) where TShape : unmanaged, IDisposableShape => disposals.Add(pool => shape.Dispose(pool));

    /// <summary>A static for each child, or one cluster of all.</summary>
    public void AddStatics(IReadOnlyList<ClusterChild> children)
    {
        if (isCluster)
        {
            Simulation.Statics.Add(new StaticDescription(RigidPose.Identity, AddCluster(children)));
            return;
        }
        foreach (var child in children)
            Simulation.Statics.Add(new StaticDescription(child.Pose, child.Shape));
    }

    public BodyHandle AddBody<TShape>(in TShape shape, RigidPose pose, BodyVelocity velocity = default) where TShape : unmanaged, IConvexShape =>
        Simulation.Bodies.Add(BodyDescription.CreateDynamic(pose, velocity, shape.ComputeInertia(1), Simulation.Shapes.Add(shape), -1f));

    public void Step(bool validate = true)
    {
        ++StepCount;
        Simulation.Timestep(1 / 60f, dispatcher);
        if (validate)
            Simulation.Validate();
    }

    /// <summary>Bits of all bodies.</summary>
    public int[] State() => BodyBits.Of(Simulation);

    /// <summary>
    /// What is known of each manifold that has contacts or a history, by body and child: type, features, whether there is a history, and
    /// all of the constraint but the position of B, which one body does not use.
    /// </summary>
    public SortedDictionary<(int Body, int Child), string> Manifolds()
    {
        var solver = Simulation.Solver;
        var result = new SortedDictionary<(int, int), string>();
        for (int i = 0; i < NarrowPhase.Pairs.Pairs.Count; ++i)
        {
            var pair = NarrowPhase.Pairs.Pairs.Keys[i];
            if (pair.B.Mobility != CollidableMobility.Static)
                continue;
            for (var list = NarrowPhase.Pairs.ManifoldsOf(i); list.MoveNext();)
            {
                var manifold = list.Current;
                var text = $"{manifold.ConstraintTypeId} {manifold.History >= 0}";
                if (manifold.HasConstraint)
                {
                    var count = ConstraintTypeIds.ContactCount(manifold.ConstraintTypeId);
                    ref var location = ref solver.Locations[manifold.Constraint.Slot];
                    ref var batch = ref solver.TypeBatchAt(location);
                    var processor = solver.Processor(location.TypeId);
                    for (int j = 0; j < count; ++j)
                        text += $" {manifold.Features[j]}";
                    for (int j = 0; j < processor.PrestepFloats; ++j)
                    {
                        if (j < count * 4 || j >= count * 4 + 3)
                            text += $" {BitConverter.SingleToInt32Bits(processor.PrestepFloat(ref batch, location.IndexInTypeBatch, j)):X}";
                    }
                    for (int j = 0; j < processor.ImpulseFloats; ++j)
                        text += $" {BitConverter.SingleToInt32Bits(processor.Impulse(ref batch, location.IndexInTypeBatch, j)):X}";
                }
                result.Add((pair.A.Slot, isCluster ? list.Children.B : pair.B.Slot), text);
            }
        }
        return result;
    }

    /// <summary>Number of bodies that touch a static.</summary>
    public int StaticPairCount => Manifolds().Where(manifold => manifold.Value[0] != '-').Select(manifold => manifold.Key.Body).Distinct().Count();

    /// <summary>Number of manifolds with statics.</summary>
    public int ConstraintCount => Manifolds().Values.Count(text => text[0] != '-');

    public void Dispose()
    {
        Simulation.Dispose();
        foreach (var buffer in owned)
        {
            var returned = buffer;
            pool.Return(ref returned);
        }
        foreach (var dispose in disposals)
            dispose(pool);
        pool.AssertEmpty();
        dispatcher?.WorkerPools.AssertEmpty();
        dispatcher?.Dispose();
        pool.Clear();
    }
}
