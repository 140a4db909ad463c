using System;
using System.Numerics;
using BenchmarkDotNet.Attributes;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuPhysics.Constraints;
using BepuUtilities.Memory;

namespace Benchmarks.Micro;

/// <summary>What it costs to remove a contact constraint of a body that has many and to add one: nanoseconds per edit, of which there are two.</summary>
public class EditBenchmarks : IDisposable
{
    const int PairsOfEdits = 256;

    readonly Random random = new(1);
    BufferPool? pool;
    Simulation? simulation;
    BodyHandle hub;
    BodyHandle[] others = [];
    ConstraintHandle[] constraints = [];

    /// <summary>Constraints of the body.</summary>
    [Params(4, 100, 10_000)]
    public int Count { get; set; } = 100;

    /// <summary>Creates the body, as many around it, and their constraints.</summary>
    [GlobalSetup]
    public void Setup()
    {
        pool = new();
        simulation = Simulation.Create(pool, new DefaultNarrowPhaseCallbacks(), new DefaultPoseIntegratorCallbacks(default), new SolveDescription(1, 4));
        var inertia = new Sphere(.5f).ComputeInertia(1);
        hub = simulation.Bodies.Add(BodyDescription.CreateDynamic(new RigidPose(Vector3.Zero), inertia, default(CollidableDescription), .01f));
        others = new BodyHandle[Count];
        constraints = new ConstraintHandle[Count];
        for (int i = 0; i < Count; ++i)
        {
            others[i] = simulation.Bodies.Add(
                BodyDescription.CreateDynamic(new RigidPose(new Vector3(i, 0, 0)), inertia, default(CollidableDescription), .01f));
            constraints[i] = Add(i);
        }
    }

    /// <summary>Frees them.</summary>
    [GlobalCleanup]
    public void Dispose()
    {
        simulation?.Dispose();
        pool?.Clear();
        simulation = null;
        GC.SuppressFinalize(this);
    }

    /// <summary>Removes constraints at random places and adds them again.</summary>
    [Benchmark(OperationsPerInvoke = 2 * PairsOfEdits)]
    public void RemoveAndAdd()
    {
        for (int i = 0; i < PairsOfEdits; ++i)
        {
            var place = random.Next(Count);
            simulation!.Solver.RemoveWithoutNotice(constraints[place]);
            constraints[place] = Add(place);
        }
    }

    // As the narrow phase does; these have no contacts behind them, and no step is taken.
    ConstraintHandle Add(int i) => simulation!.Solver.AddUnwritten([hub, others[i]], ConstraintTypeIds.ConvexContact(4, 2));
}
