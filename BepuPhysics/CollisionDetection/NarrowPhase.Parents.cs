using System;
using System.Numerics;
using System.Runtime.CompilerServices;
using BepuPhysics.Collidables;
using BepuUtilities;

namespace BepuPhysics.CollisionDetection;

// Pairs of which one shape at least is made of children, as a whole: what has hardly moved keeps its patches, and its children are not looked for.
public sealed unsafe partial class NarrowPhase<TCallbacks>
{
    /// <summary>Goes on with the patches of the last test of a pair, if that still holds.</summary>
    [MethodImpl(MethodImplOptions.NoInlining)]
    bool TryCarry(int workerIndex, in TestedPair tested, TypedIndex shapeA, TypedIndex shapeB, in RigidPose poseA, in RigidPose poseB)
    {
        if (!HasParentHistory(tested))
            return false;
        ref var cached = ref Pairs.Pairs.Values[tested.CacheIndex];
        // What agrees with others of its body may come out otherwise though it has not moved.
        if (Waits(tested))
            cached.CarriedPatchCount = 0;
        // What moves has no use for its history, which is in none of the caches.
        if (cached.CarriedPatchCount == 0)
            return false;
        Pairs.Manifolds.Prefetch(Pairs.Manifolds.Memory[cached.FirstManifold].Next);
        ref var history = ref Pairs.Parents.Memory[cached.Single.History];
        history.Identify(Simulation.Shapes.Identify(shapeA), Simulation.Shapes.Identify(shapeB));
        var offsetB = poseB.Position - poseA.Position;
        Unsafe.SkipInit(out ParentHistory.Results results);
        var count = history.TryCarry(offsetB, poseA.Orientation, poseB.Orientation, tested.SpeculativeMargin, results);
        if (count == 0)
            return false;
        CompleteChildren(workerIndex, tested with { IsCarried = true }, offsetB, results[..count]);
        return true;
    }

    bool HasParentHistory(in TestedPair tested) =>
        tested.CacheIndex >= 0 && Pairs.Pairs.Values[tested.CacheIndex] is { IsOfChildren: true, Single.History: >= 0 };

    /// <summary>Whether one of two bodies turns too fast, as the other sees it, for patches to be carried along, however large it is.</summary>
    static bool TurnsFast(in BodyVelocity velocityA, in BodyVelocity velocityB, float dt) =>
        Exact.Length(velocityB.Angular - velocityA.Angular) * dt > RetestBound.Tolerance * (1 + RetestBound.Rounding);

    /// <summary>Keeps the patches that a test has found, if they may be carried along and the bodies are hardly moving.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    void Record(in TestedPair tested, float dt, Vector3 offsetB, ReadOnlySpan<ChildResult> results)
    {
        Pairs.Pairs.Values[tested.CacheIndex].CarriedPatchCount = 0;
        // Then nothing else has to be looked for.
        if (tested.MayCarry && !tested.TurnsFast)
            RecordSlow(tested, dt, offsetB, results);
    }

    [MethodImpl(MethodImplOptions.NoInlining)]
    void RecordSlow(in TestedPair tested, float dt, Vector3 offsetB, ReadOnlySpan<ChildResult> results)
    {
        ref var cached = ref Pairs.Pairs.Values[tested.CacheIndex];
        var velocityA = VelocityOf(tested.Pair.A);
        var velocityB = VelocityOf(tested.Pair.B);
        var turn = Exact.Length(velocityB.Angular - velocityA.Angular);
        Simulation.GetPoseAndShape(tested.Pair.A, out var poseA, out var shapeA);
        Simulation.GetPoseAndShape(tested.Pair.B, out var poseB, out var shapeB);
        ref var history = ref Pairs.Parents.Memory[cached.Single.History];
        history.Identify(Simulation.Shapes.Identify(shapeA), Simulation.Shapes.Identify(shapeB));
        if (history.Reach == 0)
            history.Measure(ReachOf(shapeA), ReachOf(shapeB));
        if (!history.MayCarry)
            return;
        // The smaller shape's velocity as the larger one sees it.
        var turning = history.AIsLarger ? velocityA.Angular : velocityB.Angular;
        var linear = velocityB.Linear - velocityA.Linear - Exact.Cross(turning, offsetB);
        // By how much its points may move in a step.
        var step = (Exact.Length(linear) + turn * history.Reach) * dt;
        if (step < RetestBound.Tolerance * history.Reach)
            cached.CarriedPatchCount = history.Record(offsetB, poseA.Orientation, poseB.Orientation, tested.SpeculativeMargin, results);
    }

    float ReachOf(TypedIndex shape) => Simulation.Shapes.GetBatch(shape.Type).MaximumRadius(shape.Index);

    BodyVelocity VelocityOf(CollidableReference collidable) =>
        collidable.Mobility == CollidableMobility.Static ? default : MotionOf(collidable).Velocity;

    // Of a body.
    ref MotionState MotionOf(CollidableReference body)
    {
        ref var location = ref Simulation.Bodies.Locations[body.Slot];
        return ref Simulation.Bodies.SetOf(location).MotionStates[location.Index];
    }
}
