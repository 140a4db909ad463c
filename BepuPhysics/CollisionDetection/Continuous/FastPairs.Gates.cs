using BepuPhysics.Collidables;

namespace BepuPhysics.CollisionDetection;

// What is known of the shapes of a pair, and which ways may meet at all: asked at its first sweep, by whichever thread makes that.
sealed unsafe partial class FastPairs
{
    void SetGate(ref FastPair pair)
    {
        pair.SmallerInner = SmallerInner(pair);
        pair.Gate.Set(ReachOf(pair, pair.ShapeA), ReachOf(pair, pair.ShapeB), TouchingPart * pair.Inner);
        if (pair.Pair.B.Mobility != CollidableMobility.Static)
            return;
        if (pair.ShapeB.Type == HalfSpace.Id)
        {
            pair.Gate.SetPlane(*(HalfSpace*)PointerTo(pair.ShapeB), pair.PoseB.Orientation);
            return;
        }
        ref var still = ref simulation.Statics.StaticsBuffer[simulation.Statics.Indices[pair.Pair.B.Slot]];
        var bounds = simulation.BroadPhase.StaticTree.GetBounds(still.BroadPhaseIndex);
        pair.Gate.SetStatic(new(bounds.Min), new(bounds.Max));
    }

    // A half-space has no inner radius, and reaches farthest.
    float SmallerInner(in FastPair pair)
    {
        var (a, b) = (narrowPhase.RadiiOf(pair.ShapeA), narrowPhase.RadiiOf(pair.ShapeB));
        return a.Radius <= b.Radius ? a.Inner : b.Inner;
    }

    // How far what is swept of a shape reaches from its centre.
    double ReachOf(in FastPair pair, TypedIndex shape)
    {
        if (shape.Type == HalfSpace.Id || !ImpactCore.Exists(shape.Type))
            return narrowPhase.RadiiOf(shape).Radius;
        var core = ImpactCore.Of(shape.Type, PointerTo(shape));
        if (!pair.IsSensor)
            core.Thin(SkinParts[0], pair.SmallerInner);
        return core.Margin + core.Reach;
    }

    void* PointerTo(TypedIndex shape) => simulation.Shapes.GetBatch(shape.Type).GetPointer(shape.Index);
}
