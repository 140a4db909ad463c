using System;
using System.Numerics;
using System.Runtime.CompilerServices;
using System.Threading;
using BepuPhysics.Collidables;
using BepuPhysics.CollisionDetection;
using BepuUtilities;
using BepuUtilities.Memory;
using BepuUtilities.TaskScheduling;

namespace BepuPhysics;

/// <summary>
/// First stage of a step: bounds that contain each body wherever it may go within the step, how far to look for contacts, and for how long it has rested.
/// </summary>
// A body at velocity v and angular velocity w sweeps its bounds by v dt, and its surface leaves them by no more than the arc |w| dt R of its
// farthest point, nor by more than R - r, the difference of its greatest and smallest radius: further turning changes nothing.
// The speculative margin is the same motion as a distance: what may touch within the step is looked for. It is half of what the body falls in a step at
// least. On a lift that goes up as fast as a body falls after a step nothing would be left of either, and what stands there would lose its contacts by a
// gap of rounding; while what rests on the ground falls, as far as is known here.
unsafe struct BoundsPredictor : IStagedWork
{
    const int BundlesPerBlock = 16;

    /// <summary>Bodies below which this ends before another thread is awake.</summary>
    internal const int MinimumBodyCountForThreads = 1024;

    public Bodies Bodies;
    public Shapes Shapes;
    public BroadPhase BroadPhase;
    public IPoseIntegrator Integrator;
    public float Dt;
    /// <summary>A row for each body, where what it does is asked for again; see <see cref="PredictedMotion"/>.</summary>
    public Buffer<PredictedMotion> Motions;
    /// <summary>Whether the step counts as one of rest.</summary>
    public bool CountsRest;
    /// <summary>Whether it is predicted for the second time in a step, and who rests is counted already.</summary>
    public bool IsRepeated;

    public readonly int StageCount => 1;

    public readonly int GetBlockCount(int stage) => (BundleCount + BundlesPerBlock - 1) / BundlesPerBlock;

    readonly int BundleCount => BundleIndexing.GetBundleCount(Bodies.Awake.Count);

    public readonly void Execute(int stage, int block, int workerIndex)
    {
        var end = Math.Min((block + 1) * BundlesPerBlock, BundleCount);
        long rest = 0;
        for (int bundle = block * BundlesPerBlock; bundle < end; ++bundle)
            rest += Predict(bundle, workerIndex);
        // The sum is the same in any order.
        if (rest > 0)
            Interlocked.Add(ref Bodies.RestCounts, rest);
    }

    /// <returns>What is added to <see cref="Bodies.RestCounts"/>.</returns>
    readonly long Predict(int bundle, int workerIndex)
    {
        Integrator.PredictVelocities(bundle, Dt, workerIndex, out var pose, out var velocity, out var speedSquared, out var gain);
        ref var set = ref Bodies.Awake;
        var start = bundle * Vector<float>.Count;
        var count = Math.Min(Vector<float>.Count, set.Count - start);
        var activities = set.Activity.Memory + start;
        var speeds = (float*)&speedSquared;
        long rest = 0;
        for (int i = 0; i < count && !IsRepeated; ++i)
            rest += activities[i].Note(speeds[i], CountsRest);
        // Whoever writes it writes the same.
        var moves = Vector.Equals(speedSquared, new Vector<float>(float.PositiveInfinity)) &
            Vector.GreaterThan(velocity.Linear.LengthSquared(), Vector<float>.Zero);
        if (moves != Vector<int>.Zero)
            Bodies.HasMovingKinematics = true;
        var collidables = set.Collidables.Memory + start;
        Span<int> shapeIndices = stackalloc int[Vector<float>.Count];
        Unsafe.SkipInit(out Vector<float> radius);
        Unsafe.SkipInit(out Vector<float> expansion);
        Unsafe.SkipInit(out Vector3Wide min);
        Unsafe.SkipInit(out Vector3Wide max);
        int done = 0;
        for (int first = 0; first < count; ++first)
        {
            if ((done & 1 << first) != 0 || collidables[first].BroadPhaseIndex < 0)
                continue;
            // All lanes of this shape type at once. The others have no shape.
            var type = collidables[first].Shape.Type;
            var before = done;
            for (int i = 0; i < Vector<float>.Count; ++i)
            {
                var same = i >= first && i < count && collidables[i].BroadPhaseIndex >= 0 && collidables[i].Shape.Type == type;
                shapeIndices[i] = same ? collidables[i].Shape.Index : -1;
                if (same)
                    done |= 1 << i;
            }
            Shapes.GetBatch(type).GetBounds(shapeIndices, pose.Orientation, out var typeRadius, out var typeExpansion, out var typeMin, out var typeMax);
            // Nearly always the only type.
            var isOfType = before == 0 ? new Vector<int>(-1) : Vector.GreaterThanOrEqual(new Vector<int>(shapeIndices), Vector<int>.Zero);
            radius = Wide.Select(isOfType, typeRadius, radius);
            expansion = Wide.Select(isOfType, typeExpansion, expansion);
            min = Vector3Wide.Select(isOfType, typeMin, min);
            max = Vector3Wide.Select(isOfType, typeMax, max);
        }
        if (done != 0)
            Write(done, collidables, pose.Position, velocity, gain, radius, expansion, min, max);
        if (done != 0 && Motions.Allocated)
            Remember(start, done, moves, velocity, gain, radius, expansion);
        return rest;
    }

    [MethodImpl(MethodImplOptions.NoInlining)]
    readonly void Remember(int start, int lanes, Vector<int> moves, in BodyVelocityWide velocity, Vector<float> gain, Vector<float> radius,
        Vector<float> expansion)
    {
        for (int left = lanes; left != 0; left &= left - 1)
        {
            var i = BitOperations.TrailingZeroCount(left);
            Motions[start + i] = new()
            {
                Linear = new(velocity.Linear.X[i], velocity.Linear.Y[i], velocity.Linear.Z[i]),
                Gain = gain[i],
                Angular = new(velocity.Angular.X[i], velocity.Angular.Y[i], velocity.Angular.Z[i]),
                Radius = radius[i],
                Expansion = expansion[i],
                Dt = Dt,
                Body = Bodies.Awake.IndexToHandle[start + i],
                Moves = moves[i] != 0,
            };
        }
    }

    readonly void Write(
        int lanes, Collidable* collidables, in Vector3Wide position, in BodyVelocityWide velocity, Vector<float> gain, Vector<float> maximumRadius,
        Vector<float> maximumAngularExpansion, Vector3Wide min, Vector3Wide max)
    {
        var dt = new Vector<float>(Dt);
        var turning = Wide.Min(velocity.Angular.Length() * dt * maximumRadius, maximumAngularExpansion);
        var reach = velocity.Linear.Length() * dt + turning;
        var missing = Wide.Max(Vector<float>.Zero, gain * dt * new Vector<float>(PredictedMotion.LeastFall) - reach);
        reach += missing;
        // What each body says of its bounds, in its lane.
        Vector<float> least = default, most = default, unbounded = default;
        for (int left = lanes; left != 0; left &= left - 1)
        {
            var i = BitOperations.TrailingZeroCount(left);
            ((float*)&least)[i] = collidables[i].MinimumSpeculativeMargin;
            ((float*)&most)[i] = collidables[i].MaximumSpeculativeMargin;
            ((float*)&unbounded)[i] = collidables[i].Continuity.AllowExpansionBeyondSpeculativeMargin ? float.MaxValue : 0;
        }
        var margin = Wide.Max(least, Wide.Min(most, reach));
        // Discrete detection leaves a body no more room than the margin in which its contacts are looked for.
        var limit = Wide.Select(Vector.GreaterThan(unbounded, Vector<float>.Zero), unbounded, margin);
        var grow = Wide.Min(limit, turning + missing + least);
        var sweep = velocity.Linear * dt;
        Sweep(position.X, sweep.X, limit, grow, ref min.X, ref max.X);
        Sweep(position.Y, sweep.Y, limit, grow, ref min.Y, ref max.Y);
        Sweep(position.Z, sweep.Z, limit, grow, ref min.Z, ref max.Z);
        // Lane by lane as the tree holds them: a component taken out of a register by itself is as much work as this for all of them.
        Unsafe.SkipInit(out LineAligned<Rows8> memory);
        var rows = (float*)memory.Pointer;
        Rows8 row;
        row.R0 = min.X;
        row.R1 = min.Y;
        row.R2 = min.Z;
        row.R3 = margin;
        row.R4 = max.X;
        row.R5 = max.Y;
        row.R6 = max.Z;
        row.R7 = Vector<float>.Zero;
        Transpose.Scatter(row, rows, Rows8.Count, Vector<int>.Indices);
        for (int left = lanes; left != 0; left &= left - 1)
        {
            var i = BitOperations.TrailingZeroCount(left);
            var bounds = rows + i * Rows8.Count;
            collidables[i].SpeculativeMargin = bounds[3];
            BroadPhase.GetActiveBoundsPointers(collidables[i].BroadPhaseIndex, out var minPointer, out var maxPointer);
            *minPointer = *(Vector3*)bounds;
            *maxPointer = *(Vector3*)(bounds + 4);
        }
    }

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static void Sweep(
        Vector<float> position, Vector<float> sweep, Vector<float> limit, Vector<float> grow, ref Vector<float> min, ref Vector<float> max)
    {
        var swept = Wide.Max(-limit, Wide.Min(limit, sweep));
        min = min + position - grow + Wide.Min(swept, Vector<float>.Zero);
        max = max + position + grow + Wide.Max(swept, Vector<float>.Zero);
    }
}
