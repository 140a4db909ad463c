using BepuPhysics.Collidables;
using BepuPhysics.Constraints;

namespace BepuPhysics.CollisionDetection;

public abstract partial class NarrowPhase
{
    /// <summary>Pairs and their contact constraints, both ways.</summary>
    // What a pair's collidables are now may differ from what they were at the last step: a static may be gone, a body kinematic. The
    // next step sorts that out, so only the bodies of the constraint are compared.
    internal void Validate()
    {
        var solver = Simulation.Solver;
        int contactPairCount = 0;
        int historyCount = 0;
        for (int i = 0; i < Pairs.Pairs.Count; ++i)
        {
            var pair = Pairs.Pairs.Keys[i];
            Invariant.Require(Pairs.Pairs.IndexOf(pair) == i, "place of pair", i);
            ref var cached = ref Pairs.Pairs.Values[i];
            Invariant.Require(cached.History < 0 || Pairs.Histories.MayExist(cached.History), "history of pair", i, cached.History);
            historyCount += cached.History < 0 ? 0 : 1;
            if (!cached.HasConstraint)
                continue;
            ++contactPairCount;
            Invariant.Require(solver.ConstraintExists(cached.Constraint), "constraint of pair", i, cached.Constraint.Slot);
            var location = solver.Locations[cached.Constraint.Slot];
            Invariant.Require(location.TypeId == cached.ConstraintTypeId && location.TypeId < ConstraintTypeIds.ContactTypeCount,
                "type of the constraint of pair", i, location.TypeId);
            var known = pairOfConstraint[cached.Constraint.Slot];
            Invariant.Require(known.A == pair.A && known.B == pair.B, "pair of constraint", cached.Constraint.Slot);
            var processor = solver.Processor(location.TypeId);
            Invariant.Require(processor.BodiesPerConstraint == (pair.B.Mobility == CollidableMobility.Static ? 1 : 2),
                "number of bodies of the constraint of pair", i);
            Invariant.Require(IsBody(location, 0, pair.A), "first body of the constraint of pair", i);
            Invariant.Require(processor.BodiesPerConstraint == 1 || IsBody(location, 1, pair.B), "second body of the constraint of pair", i);
        }
        Invariant.Require(contactPairCount == PairCount, "number of pairs with contacts, counted are", contactPairCount, PairCount);
        Invariant.Require(historyCount == Pairs.Histories.Count, "number of histories, pairs have", historyCount, Pairs.Histories.Count);
        Invariant.Require(CountContactConstraints() == PairCount, "number of contact constraints, pairs are", PairCount);
    }

    bool IsBody(in ConstraintLocation location, int slot, CollidableReference collidable)
    {
        var solver = Simulation.Solver;
        var reference = solver.Processor(location.TypeId).BodyReference(ref solver.TypeBatchAt(location), location.IndexInTypeBatch, slot);
        return Simulation.Bodies.ActiveSet.IndexToHandle[reference & EncodedBody.IndexMask] == collidable.BodyHandle;
    }

    int CountContactConstraints()
    {
        int count = 0;
        ref var batches = ref Simulation.Solver.ActiveSet.Batches;
        for (int i = 0; i < batches.Count; ++i)
        {
            ref var typeBatches = ref batches[i].TypeBatches;
            for (int j = 0; j < typeBatches.Count; ++j)
                count += typeBatches[j].TypeId < ConstraintTypeIds.ContactTypeCount ? typeBatches[j].ConstraintCount : 0;
        }
        return count;
    }
}
