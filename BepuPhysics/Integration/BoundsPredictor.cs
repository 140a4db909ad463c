using System;
using System.Numerics;
using System.Threading;
using BepuPhysics.Collidables;
using BepuPhysics.CollisionDetection;
using BepuUtilities;
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
    // Part of what its acceleration moves a body in a step for which there is room at least.
    const float LeastFall = 0.5f;

    /// <summary>Bodies below which this ends before another thread is awake.</summary>
    internal const int MinimumBodyCountForThreads = 1024;

    public Bodies Bodies;
    public Shapes Shapes;
    public BroadPhase BroadPhase;
    public IPoseIntegrator Integrator;
    public float Dt;

    public readonly int StageCount => 1;

    public readonly int GetBlockCount(int stage) => (BundleCount + BundlesPerBlock - 1) / BundlesPerBlock;

    readonly int BundleCount => BundleIndexing.GetBundleCount(Bodies.Awake.Count);

    public readonly void Execute(int stage, int block, int workerIndex)
    {
        var end = Math.Min((block + 1) * BundlesPerBlock, BundleCount);
        int ripe = 0;
        for (int bundle = block * BundlesPerBlock; bundle < end; ++bundle)
            ripe += Predict(bundle, workerIndex);
        // The sum is the same in any order.
        if (ripe > 0)
            Interlocked.Add(ref Bodies.RipeCount, ripe);
    }

    /// <returns>Number of bodies that have rested long enough to sleep.</returns>
    readonly int Predict(int bundle, int workerIndex)
    {
        Integrator.PredictVelocities(bundle, Dt, workerIndex, out var pose, out var velocity, out var speedSquared, out var gain);
        ref var set = ref Bodies.Awake;
        var start = bundle * Vector<float>.Count;
        var count = Math.Min(Vector<float>.Count, set.Count - start);
        var activities = set.Activity.Memory + start;
        var speeds = (float*)&speedSquared;
        int ripe = 0;
        for (int i = 0; i < count; ++i)
            ripe += activities[i].Note(speeds[i]);
        var collidables = set.Collidables.Memory + start;
        Span<int> shapeIndices = stackalloc int[Vector<float>.Count];
        int done = 0;
        for (int first = 0; first < count; ++first)
        {
            if ((done & 1 << first) != 0 || collidables[first].BroadPhaseIndex < 0)
                continue;
            // All lanes of this shape type at once. The others have no shape.
            var type = collidables[first].Shape.Type;
            int lanes = 0;
            for (int i = 0; i < Vector<float>.Count; ++i)
            {
                var same = i >= first && i < count && collidables[i].BroadPhaseIndex >= 0 && collidables[i].Shape.Type == type;
                shapeIndices[i] = same ? collidables[i].Shape.Index : -1;
                if (same)
                    lanes |= 1 << i;
            }
            done |= lanes;
            Shapes.GetBatch(type).GetBounds(shapeIndices, pose.Orientation, out var maximumRadius, out var maximumAngularExpansion, out var min, out var max);
            Write(lanes, collidables, pose.Position, velocity, gain, maximumRadius, maximumAngularExpansion, min, max);
        }
        return ripe;
    }

    readonly void Write(
        int lanes, Collidable* collidables, in Vector3Wide position, in BodyVelocityWide velocity, Vector<float> gain, Vector<float> maximumRadius,
        Vector<float> maximumAngularExpansion, Vector3Wide min, Vector3Wide max)
    {
        var dt = new Vector<float>(Dt);
        var turning = Wide.Min(velocity.Angular.Length() * dt * maximumRadius, maximumAngularExpansion);
        var reach = velocity.Linear.Length() * dt + turning;
        var missing = Wide.Max(Vector<float>.Zero, gain * dt * new Vector<float>(LeastFall) - reach);
        reach += missing;
        var sweep = velocity.Linear * dt;
        min += position;
        max += position;
        for (int i = 0; i < Vector<float>.Count; ++i)
        {
            if ((lanes & 1 << i) == 0)
                continue;
            ref var collidable = ref collidables[i];
            collidable.SpeculativeMargin = MathHelper.Max(collidable.MinimumSpeculativeMargin, MathHelper.Min(collidable.MaximumSpeculativeMargin, reach[i]));
            // Discrete detection leaves a body no more room than the margin in which its contacts are looked for.
            var limit = collidable.Continuity.AllowExpansionBeyondSpeculativeMargin ? float.MaxValue : collidable.SpeculativeMargin;
            var grow = new Vector3(MathHelper.Min(limit, turning[i] + missing[i] + collidable.MinimumSpeculativeMargin));
            var swept = new Vector3(Limit(sweep.X[i], limit), Limit(sweep.Y[i], limit), Limit(sweep.Z[i], limit));
            BroadPhase.GetActiveBoundsPointers(collidable.BroadPhaseIndex, out var minPointer, out var maxPointer);
            *minPointer = new Vector3(min.X[i], min.Y[i], min.Z[i]) - grow + Exact.Min(swept, Vector3.Zero);
            *maxPointer = new Vector3(max.X[i], max.Y[i], max.Z[i]) + grow + Exact.Max(swept, Vector3.Zero);
        }
    }

    static float Limit(float value, float limit) => MathHelper.Max(-limit, MathHelper.Min(limit, value));
}
