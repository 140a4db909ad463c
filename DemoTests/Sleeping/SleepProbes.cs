using System;
using System.Collections.Generic;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuPhysics.Trees;
using BepuUtilities;
using BepuUtilities.Memory;

namespace DemoTests.Sleeping;

/// <summary>A dispatcher that must not be used.</summary>
sealed unsafe class CountingDispatcher : IThreadDispatcher
{
    public int Count { get; private set; }

    public int ThreadCount => 8;

    public void* UnmanagedContext => null;

    public object? ManagedContext => null;

    public WorkerBufferPools WorkerPools => throw new InvalidOperationException("Nobody works.");

    public void DispatchWorkers(delegate*<int, IThreadDispatcher, void> workerBody, int maximumWorkerCount = int.MaxValue,
        void* unmanagedContext = null, object? managedContext = null) => ++Count;

    public void DispatchWorkers(Action<int> workerBody, int maximumWorkerCount = int.MaxValue,
        void* unmanagedContext = null, object? managedContext = null) => ++Count;
}

/// <summary>The nearest hit of a ray.</summary>
struct NearestHit : IRayHitHandler
{
    public CollidableReference Collidable;
    public float T;

    public readonly bool AllowTest(CollidableReference collidable) => true;

    public readonly bool AllowTest(CollidableReference collidable, int childIndex) => true;

    public void OnRayHit(in RayData ray, ref float maximumT, float t, Vector3 normal, CollidableReference collidable, int childIndex)
    {
        maximumT = T = t;
        Collidable = collidable;
    }
}

/// <summary>Lists bodies.</summary>
struct Others : IForEach<BodyHandle>
{
    public List<BodyHandle> Found;

    public readonly void LoopBody(BodyHandle body) => Found.Add(body);
}
