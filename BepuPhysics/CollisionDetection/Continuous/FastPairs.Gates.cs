using BepuPhysics.Collidables;

namespace BepuPhysics.CollisionDetection;

// What is known of the shapes of a pair, and which ways may meet at all: asked at its first sweep, by whichever thread makes that.
sealed unsafe partial class FastPairs
{
    void SetGate(ref FastPair pair)
    {
        pair.IsKnown = true;
        // A sensor is met by whole shapes.
        if (!pair.IsSensor && pair.Balls.TrySet(
            pair.ShapeA.Type, PointerTo(pair.ShapeA), pair.ShapeB.Type, PointerTo(pair.ShapeB), pair.PoseB.Orientation, pair.B >= 0))
            return;
        var (a, b) = (RadiiOf(pair.A, pair.ShapeA), RadiiOf(pair.B, pair.ShapeB));
        // A half-space has no inner radius, and reaches farthest.
        pair.SmallerInner = a.Radius <= b.Radius ? a.Inner : b.Inner;
        pair.Gate.Set(ReachOf(pair, pair.ShapeA, a.Radius), ReachOf(pair, pair.ShapeB, b.Radius), TouchingPart * pair.Inner);
        if (pair.Pair.B.Mobility == CollidableMobility.Static)
            SetStill(ref pair.Gate, pair.Pair.B, pair.ShapeB, pair.PoseB);
    }

    /// <summary>Says where the B of a gate is, if it does not move.</summary>
    /// <param name="gate">The gate.</param>
    /// <param name="still">The static.</param>
    /// <param name="shape">Its shape.</param>
    /// <param name="pose">Where it is.</param>
    internal void SetStill(ref WayGate gate, CollidableReference still, TypedIndex shape, in RigidPose pose)
    {
        if (shape.Type == HalfSpace.Id)
        {
            gate.SetPlane(*(HalfSpace*)PointerTo(shape), pose.Orientation);
            return;
        }
        var leaf = simulation.Statics.StaticsBuffer[simulation.Statics.Indices[still.Slot]].BroadPhaseIndex;
        var bounds = simulation.BroadPhase.StaticTree.GetBounds(leaf);
        gate.SetStatic(new(bounds.Min), new(bounds.Max));
    }

    // Those of what moves are known: they are measured anew each time where a shape has children.
    (float Inner, float Radius) RadiiOf(int body, TypedIndex shape) =>
        body < 0 ? narrowPhase.RadiiOf(shape) : (movers[body].Inner, (float)movers[body].Radius);

    // How far what is swept of a shape reaches from its centre.
    double ReachOf(in FastPair pair, TypedIndex shape, float radius)
    {
        if (shape.Type == HalfSpace.Id || !ImpactCore.Exists(shape.Type, simulation.Shapes))
            return radius;
        var core = ImpactCore.Of(shape.Type, PointerTo(shape), simulation.Shapes);
        if (!pair.IsSensor)
            core.Thin(SkinParts[0], pair.SmallerInner);
        return core.Margin + core.Reach;
    }

    void* PointerTo(TypedIndex shape) => simulation.Shapes.GetBatch(shape.Type).GetPointer(shape.Index);
}
