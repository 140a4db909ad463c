using System;
using System.Diagnostics.CodeAnalysis;
using System.Numerics;
using System.Runtime.CompilerServices;
using System.Runtime.Intrinsics;
using BepuPhysics.Collidables;
using BepuUtilities.Memory;

namespace BepuPhysics.CollisionDetection;

/// <summary>Collects pairs of shapes, tests them in bundles of one pair of types, and hands the contacts to callbacks.</summary>
/// <remarks>
/// Results come in no particular order, during an Add whose batch is full or during <see cref="Flush"/>; the contacts of a pair do not
/// depend on what else is tested. Used by one thread at a time; any number of batchers may share shapes and registry. Do not copy one
/// that holds pairs.
/// </remarks>
public unsafe partial struct CollisionBatcher<TCallbacks> : IDisposable where TCallbacks : struct, ICollisionCallbacks
{
    /// <summary>Source of the batcher's memory; used by the calling thread only.</summary>
    public BufferPool Pool;
    /// <summary>Shapes that pairs refer to.</summary>
    public Shapes Shapes;
    /// <summary>Time that velocities are extrapolated over, s.</summary>
    public float Dt;
    /// <summary>Receives the results.</summary>
    public TCallbacks Callbacks;

    readonly CollisionTaskRegistry registry;
    readonly PairHistory* histories;
    PairBatches batches;
    // None or one; in memory of the pool, as the receiver of the tasks points to it.
    Buffer<ChildPairs> childPairs;
    bool executing;

    /// <summary>Creates an empty batcher, which takes no memory yet.</summary>
    /// <param name="pool">Source of the batcher's memory.</param>
    /// <param name="shapes">Shapes that pairs refer to.</param>
    /// <param name="collisionTypeMatrix">Tasks by shape types.</param>
    /// <param name="dt">Time that velocities are extrapolated over, s.</param>
    /// <param name="callbacks">Receives the results; copied.</param>
    public CollisionBatcher(BufferPool pool, Shapes shapes, CollisionTaskRegistry collisionTypeMatrix, float dt, TCallbacks callbacks)
    {
        ArgumentNullException.ThrowIfNull(pool);
        ArgumentNullException.ThrowIfNull(shapes);
        ArgumentNullException.ThrowIfNull(collisionTypeMatrix);
        CheckNotNegative(dt, nameof(dt));
        Pool = pool;
        Shapes = shapes;
        Dt = dt;
        Callbacks = callbacks;
        registry = collisionTypeMatrix;
    }

    /// <summary>Creates an empty batcher for pairs of which some have a history.</summary>
    internal CollisionBatcher(BufferPool pool, Shapes shapes, CollisionTaskRegistry collisionTypeMatrix, float dt, TCallbacks callbacks,
        PairHistory* histories) : this(pool, shapes, collisionTypeMatrix, dt, callbacks) => this.histories = histories;

    /// <summary>Adds a pair of shapes.</summary>
    /// <param name="shapeIndexA">First shape.</param>
    /// <param name="shapeIndexB">Second shape.</param>
    /// <param name="offsetB">Position of B less that of A, m.</param>
    /// <param name="orientationA">Rotation from A's frame to the world; unit length.</param>
    /// <param name="orientationB">Rotation from B's frame to the world; unit length.</param>
    /// <param name="speculativeMargin">Greatest distance at which contacts are wanted, m.</param>
    /// <param name="continuation">What becomes of the result.</param>
    /// <exception cref="ArgumentException">A shape does not exist, or a number is not finite or out of range.</exception>
    /// <exception cref="InvalidOperationException">No task is registered for the two shape types.</exception>
    // Inlined, because a caller of the whole would take the rotations to registers by halves, and put them together again on the other side.
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public void Add(TypedIndex shapeIndexA, TypedIndex shapeIndexB, Vector3 offsetB, Quaternion orientationA, Quaternion orientationB,
        float speculativeMargin, in PairContinuation continuation) =>
        AddChecked(shapeIndexA, shapeIndexB, offsetB, orientationA, orientationB, speculativeMargin, continuation.PairId, null);

    /// <summary>Adds a pair of shapes that move; two convex shapes need no velocities.</summary>
    /// <param name="shapeIndexA">First shape.</param>
    /// <param name="shapeIndexB">Second shape.</param>
    /// <param name="offsetB">Position of B less that of A, m.</param>
    /// <param name="orientationA">Rotation from A's frame to the world; unit length.</param>
    /// <param name="orientationB">Rotation from B's frame to the world; unit length.</param>
    /// <param name="velocityA">Velocity of A.</param>
    /// <param name="velocityB">Velocity of B.</param>
    /// <param name="speculativeMargin">Greatest distance at which contacts are wanted, m.</param>
    /// <param name="maximumExpansion">Greatest distance by which velocities expand the bounds of children, m.</param>
    /// <param name="continuation">What becomes of the result.</param>
    /// <exception cref="ArgumentException">A shape does not exist, or a number is not finite or out of range.</exception>
    /// <exception cref="InvalidOperationException">No task is registered for the two shape types.</exception>
    public void Add(TypedIndex shapeIndexA, TypedIndex shapeIndexB, Vector3 offsetB, Quaternion orientationA, Quaternion orientationB,
        in BodyVelocity velocityA, in BodyVelocity velocityB, float speculativeMargin, float maximumExpansion,
        in PairContinuation continuation)
    {
        CheckNotNegative(maximumExpansion, nameof(maximumExpansion));
        var motion = new PairMotion(velocityA, velocityB, maximumExpansion);
        AddChecked(shapeIndexA, shapeIndexB, offsetB, orientationA, orientationB, speculativeMargin, continuation.PairId, &motion);
    }

    /// <summary>Adds a pair of shapes that need not be in <see cref="Shapes"/>; they are copied.</summary>
    /// <param name="shapeA">First shape.</param>
    /// <param name="shapeB">Second shape.</param>
    /// <param name="offsetB">Position of B less that of A, m.</param>
    /// <param name="orientationA">Rotation from A's frame to the world; unit length.</param>
    /// <param name="orientationB">Rotation from B's frame to the world; unit length.</param>
    /// <param name="speculativeMargin">Greatest distance at which contacts are wanted, m.</param>
    /// <param name="pairId">Id that the callbacks get with the result.</param>
    /// <exception cref="ArgumentException">A shape is not valid, or a number is not finite or out of range.</exception>
    /// <exception cref="InvalidOperationException">No task is registered for the two shape types.</exception>
    public void Add<TShapeA, TShapeB>(TShapeA shapeA, TShapeB shapeB, Vector3 offsetB, Quaternion orientationA, Quaternion orientationB,
        float speculativeMargin, int pairId) where TShapeA : unmanaged, IShape where TShapeB : unmanaged, IShape
    {
        shapeA.Validate();
        shapeB.Validate();
        AddDirectly(TShapeA.TypeId, TShapeB.TypeId, &shapeA, &shapeB, offsetB, orientationA, orientationB, speculativeMargin, new(pairId));
    }

    /// <summary>Adds a pair of shapes in memory, which are copied; they are not checked.</summary>
    /// <param name="shapeTypeA">Type id of the first shape.</param>
    /// <param name="shapeTypeB">Type id of the second shape.</param>
    /// <param name="shapeA">First shape.</param>
    /// <param name="shapeB">Second shape.</param>
    /// <param name="offsetB">Position of B less that of A, m.</param>
    /// <param name="orientationA">Rotation from A's frame to the world; unit length.</param>
    /// <param name="orientationB">Rotation from B's frame to the world; unit length.</param>
    /// <param name="speculativeMargin">Greatest distance at which contacts are wanted, m.</param>
    /// <param name="pairContinuation">What becomes of the result.</param>
    /// <exception cref="ArgumentException">A shape is missing, or a number is not finite or out of range.</exception>
    /// <exception cref="InvalidOperationException">No task is registered for the two shape types.</exception>
    public void AddDirectly(int shapeTypeA, int shapeTypeB, void* shapeA, void* shapeB, Vector3 offsetB, Quaternion orientationA,
        Quaternion orientationB, float speculativeMargin, in PairContinuation pairContinuation)
    {
        ArgumentNullException.ThrowIfNull(shapeA);
        ArgumentNullException.ThrowIfNull(shapeB);
        CheckInput(offsetB, orientationA, orientationB, speculativeMargin);
        var task = registry.GetTask(shapeTypeA, shapeTypeB, out var taskIndex, out var flipped);
        AddKnown(task, taskIndex, flipped, shapeA, shapeB, offsetB, orientationA, orientationB, speculativeMargin, pairContinuation.PairId);
    }

    /// <summary>Adds a pair of shapes in memory, which are copied, to the task of their types, with a pose that is known to be sound.</summary>
    internal void AddKnown(CollisionTask task, int taskIndex, bool flipped, void* shapeA, void* shapeB, in Vector3 offsetB,
        in Quaternion orientationA, in Quaternion orientationB, float speculativeMargin, int pairId)
    {
        ref var batch = ref GetBatch(task, taskIndex);
        var pair = new PairInput(speculativeMargin, pairId, flipped, PairInput.NoHistory);
        if (flipped)
            task.WriteDirectly(ref batch, shapeB, shapeA, offsetB, orientationB, orientationA, pair);
        else
            task.WriteDirectly(ref batch, shapeA, shapeB, offsetB, orientationA, orientationB, pair);
        if (batch.Count == PairBatch.Capacity)
            Execute(task, ref batch);
    }

    /// <summary>For callers that keep a copy of the second shape until its pair is tested: there is no need to, so this is the shape itself.</summary>
    /// <remarks>Adding a pair copies its shapes. The memory must stay as it is until then, and no longer.</remarks>
    /// <param name="shapeTypeA">Type id of the first shape.</param>
    /// <param name="shapeTypeB">Type id of the second shape.</param>
    /// <param name="shapeDataB">Second shape.</param>
    /// <param name="shapeSizeB">Size of the second shape, bytes.</param>
    /// <param name="cachedShapeDataB">What to give to <see cref="AddDirectly"/>.</param>
    public readonly void CacheShapeB(int shapeTypeA, int shapeTypeB, void* shapeDataB, int shapeSizeB, out void* cachedShapeDataB) =>
        cachedShapeDataB = shapeDataB;

    [MethodImpl(MethodImplOptions.NoInlining)]
    void AddChecked(TypedIndex shapeIndexA, TypedIndex shapeIndexB, in Vector3 offsetB, in Quaternion orientationA, in Quaternion orientationB,
        float speculativeMargin, int pairId, PairMotion* motion)
    {
        CheckInput(offsetB, orientationA, orientationB, speculativeMargin);
        if (!shapeIndexA.Exists || !shapeIndexB.Exists)
            RefuseShapes(shapeIndexA, shapeIndexB);
        // What is refused takes no memory, and of a shape that was never there the type says nothing. Later pairs are looked up by the task alone.
        if (!registry.TryGetTask(shapeIndexA.Type, shapeIndexB.Type, out var task, out var taskIndex, out var flipped) || !batches.Has(taskIndex))
            CheckShapes(shapeIndexA, shapeIndexB);
        task ??= registry.GetTask(shapeIndexA.Type, shapeIndexB.Type, out taskIndex, out flipped);
        ref var batch = ref GetBatch(task, taskIndex);
        var pair = new PairInput(speculativeMargin, pairId, flipped, PairInput.NoHistory);
        // The task looks for the shapes in any case.
        var exist = flipped
            ? task.TryWrite(ref batch, Shapes, shapeIndexB.Index, shapeIndexA.Index, offsetB, orientationB, orientationA, pair)
            : task.TryWrite(ref batch, Shapes, shapeIndexA.Index, shapeIndexB.Index, offsetB, orientationA, orientationB, pair);
        if (!exist)
            RefuseShapes(shapeIndexA, shapeIndexB);
        if (motion is not null && task.Expands)
            ((ExpandingTask)task).Parent(batch, batch.Count - 1).Motion = *motion;
        if (batch.Count == PairBatch.Capacity)
            Execute(task, ref batch);
    }

    /// <summary>Adds a pair of shapes that exist to the task of their types, with a pose that is known to be sound.</summary>
    /// <param name="task">Task of the shapes' types.</param>
    /// <param name="taskIndex">Index of the task.</param>
    /// <param name="flipped">Whether the task has the types in the other order.</param>
    /// <param name="shapeIndexA">First shape.</param>
    /// <param name="shapeIndexB">Second shape.</param>
    /// <param name="offsetB">Position of B less that of A, m.</param>
    /// <param name="orientationA">Rotation from A's frame to the world; unit length.</param>
    /// <param name="orientationB">Rotation from B's frame to the world; unit length.</param>
    /// <param name="speculativeMargin">Greatest distance at which contacts are wanted, m.</param>
    /// <param name="pairId">Id that the callbacks get with the result.</param>
    /// <param name="history">Reference to the pair's history (<see cref="PairHistory.GetReference"/>), or <see cref="PairInput.NoHistory"/>.</param>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    internal void Add(CollisionTask task, int taskIndex, bool flipped, int shapeIndexA, int shapeIndexB, in Vector3 offsetB,
        in Quaternion orientationA, in Quaternion orientationB, float speculativeMargin, int pairId, int history)
    {
        ref var batch = ref Write(task, taskIndex, flipped, shapeIndexA, shapeIndexB, offsetB, orientationA, orientationB, speculativeMargin, pairId, history);
        if (batch.Count == PairBatch.Capacity)
            Execute(task, ref batch);
    }

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    ref PairBatch Write(CollisionTask task, int taskIndex, bool flipped, int shapeIndexA, int shapeIndexB, in Vector3 offsetB,
        in Quaternion orientationA, in Quaternion orientationB, float speculativeMargin, int pairId, int history)
    {
        ref var batch = ref GetBatch(task, taskIndex);
        var pair = new PairInput(speculativeMargin, pairId, flipped, history);
        if (flipped)
            task.Write(ref batch, Shapes, shapeIndexB, shapeIndexA, offsetB, orientationB, orientationA, pair);
        else
            task.Write(ref batch, Shapes, shapeIndexA, shapeIndexB, offsetB, orientationA, orientationB, pair);
        return ref batch;
    }

    /// <summary>Tests all pairs that wait, and returns all memory to the pool. The batcher is empty then and may be used again.</summary>
    public void Flush()
    {
        CheckNotExecuting();
        for (int i = batches.First; i < batches.End; ++i)
        {
            if (batches[i].Count > 0)
                Execute(registry[i], ref batches[i]);
        }
        FlushChildren();
        Dispose();
    }

    /// <summary>Returns all memory to the pool; pairs that wait are forgotten. May be called any number of times.</summary>
    public void Dispose()
    {
        batches.Dispose(Pool);
        DisposeChildren();
    }

    [MethodImpl(MethodImplOptions.NoInlining)]
    void Execute(CollisionTask task, ref PairBatch batch)
    {
        executing = true;
        try
        {
            if (task.Expands)
                Expand((ExpandingTask)task, batch);
            else
                task.Execute(ref batch, histories, ref Callbacks);
        }
        finally
        {
            // An exception of a callback loses what is left of the batch, and leaves the batcher usable.
            batch.Count = 0;
            executing = false;
        }
    }

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    ref PairBatch GetBatch(CollisionTask task, int taskIndex)
    {
        CheckNotExecuting();
        if (!batches.Has(taskIndex))
            batches.Take(task, taskIndex, registry.TaskCount, Pool);
        return ref batches[taskIndex];
    }

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    readonly void CheckNotExecuting()
    {
        if (executing)
            ThrowExecuting();
    }

    // One branch for all of it, and what is wrong only where something is: what is no number fails every comparison.
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static void CheckInput(in Vector3 offsetB, in Quaternion orientationA, in Quaternion orientationB, float speculativeMargin)
    {
        var numbers = Vector128.Create(offsetB.X, offsetB.Y, offsetB.Z, speculativeMargin);
        var least = Vector128.Create(float.MinValue, float.MinValue, float.MinValue, 0);
        var isInRange = Vector128.GreaterThanOrEqual(numbers, least) & Vector128.LessThanOrEqual(numbers, Vector128.Create(float.MaxValue));
        if ((isInRange & IsUnit(orientationA) & IsUnit(orientationB)).AsInt32() != Vector128<int>.AllBitsSet)
            RefuseInput(offsetB, orientationA, orientationB, speculativeMargin);
    }

    // The same answer in all lanes. Both rotations in one wider vector make a batcher of one pair take twice as long: what is compiled ahead
    // of time in the runtime, and called next, waits for the upper halves of registers.
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static Vector128<float> IsUnit(in Quaternion orientation)
    {
        var squares = Vector128.LoadUnsafe(in orientation.X) * Vector128.LoadUnsafe(in orientation.X);
        squares += Vector128.Shuffle(squares, Vector128.Create(2, 3, 0, 1));
        squares += Vector128.Shuffle(squares, Vector128.Create(1, 0, 3, 2));
        return Vector128.LessThan(Vector128.Abs(squares - Vector128<float>.One), Vector128.Create(UnitTolerance.Tested));
    }

    [MethodImpl(MethodImplOptions.NoInlining)]
    readonly void CheckShapes(TypedIndex shapeIndexA, TypedIndex shapeIndexB)
    {
        if (!Shapes.Holds(shapeIndexA) || !Shapes.Holds(shapeIndexB))
            RefuseShapes(shapeIndexA, shapeIndexB);
    }

    [DoesNotReturn]
    [MethodImpl(MethodImplOptions.NoInlining)]
    readonly void RefuseShapes(TypedIndex shapeIndexA, TypedIndex shapeIndexB)
    {
        if (Shapes.Holds(shapeIndexA))
            Shapes.ThrowMissing(shapeIndexB, nameof(shapeIndexB));
        Shapes.ThrowMissing(shapeIndexA, nameof(shapeIndexA));
    }

    [DoesNotReturn]
    [MethodImpl(MethodImplOptions.NoInlining)]
    static void RefuseInput(in Vector3 offsetB, in Quaternion orientationA, in Quaternion orientationB, float speculativeMargin)
    {
        if (!float.IsFinite(offsetB.X) || !float.IsFinite(offsetB.Y) || !float.IsFinite(offsetB.Z))
            throw new ArgumentException($"Not finite: {offsetB}", nameof(offsetB));
        if (IsUnit(orientationA).AsInt32() == Vector128<int>.Zero)
            throw new ArgumentException($"Not of unit length: {orientationA}", nameof(orientationA));
        if (IsUnit(orientationB).AsInt32() == Vector128<int>.Zero)
            throw new ArgumentException($"Not of unit length: {orientationB}", nameof(orientationB));
        ThrowNegative(speculativeMargin, nameof(speculativeMargin));
    }

    static void CheckNotNegative(float value, string name)
    {
        if (!float.IsFinite(value) || value < 0)
            ThrowNegative(value, name);
    }

    [DoesNotReturn]
    [MethodImpl(MethodImplOptions.NoInlining)]
    static void ThrowNegative(float value, string name) =>
        throw new ArgumentOutOfRangeException(name, value, "Must be finite, and zero or more.");

    [DoesNotReturn]
    static void ThrowExecuting() =>
        throw new InvalidOperationException("Callbacks must not add pairs to the batcher that calls them, nor flush it.");
}
