using System;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuPhysics.Constraints;
using BepuUtilities;
using BepuUtilities.Memory;
using Xunit;

namespace DemoTests.Scenes;

/// <summary>A world whose step is over before another thread is awake keeps to the caller; one that is not does not.</summary>
public unsafe class SmallWorldThreadsTests
{
    [Theory]
    [InlineData(10, 0, false)]
    [InlineData(200, 0, false)]
    [InlineData(200, 99, false)]
    [InlineData(3000, 0, true)]
    public void Few_bodies_wake_no_thread(int bodies, int joints, bool dispatches)
    {
        var pool = new BufferPool();
        using var dispatcher = new CountingDispatcher();
        var simulation = Simulation.Create(pool, new DefaultNarrowPhaseCallbacks(), new DefaultPoseIntegratorCallbacks(), new SolveDescription(1, 4));
        var sphere = new Sphere(.5f);
        var shape = simulation.Shapes.Add(sphere);
        BodyHandle last = default;
        for (int i = 0; i < bodies; ++i)
        {
            var handle = simulation.Bodies.Add(BodyDescription.CreateDynamic(
                new RigidPose(new Vector3(2 * i, 0, 0)), default, sphere.ComputeInertia(1), shape, new BodyActivityDescription(-1)));
            if (i > 0 && i <= joints)
                simulation.Solver.Add(last, handle, new BallSocket { LocalOffsetA = Vector3.UnitX, LocalOffsetB = -Vector3.UnitX });
            last = handle;
        }
        for (int i = 0; i < 5; ++i)
            simulation.Timestep(1 / 60f, dispatcher);
        Assert.Equal(dispatches, dispatcher.Count > 0);
        simulation.Dispose();
        pool.AssertEmpty();
        pool.Clear();
    }

    sealed class CountingDispatcher : IThreadDispatcher, IDisposable
    {
        readonly ThreadDispatcher inner = new(2);

        public int Count { get; private set; }
        public int ThreadCount => inner.ThreadCount;
        public void* UnmanagedContext => inner.UnmanagedContext;
        public object? ManagedContext => inner.ManagedContext;
        public WorkerBufferPools WorkerPools => inner.WorkerPools;

        public void DispatchWorkers(delegate*<int, IThreadDispatcher, void> workerBody, int maximumWorkerCount, void* unmanagedContext, object? managedContext)
        {
            ++Count;
            inner.DispatchWorkers(workerBody, maximumWorkerCount, unmanagedContext, managedContext);
        }

        public void DispatchWorkers(Action<int> workerBody, int maximumWorkerCount, void* unmanagedContext, object? managedContext)
        {
            ++Count;
            inner.DispatchWorkers(workerBody, maximumWorkerCount, unmanagedContext, managedContext);
        }

        public void Dispose() => inner.Dispose();
    }
}
