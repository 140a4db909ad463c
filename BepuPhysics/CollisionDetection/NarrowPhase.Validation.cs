using System;
using BepuPhysics.Collidables;
using BepuPhysics.Constraints;
using BepuUtilities;

namespace BepuPhysics.CollisionDetection;

public abstract partial class NarrowPhase
{
    /// <summary>Pairs and their contact constraints, both ways.</summary>
    // What a pair's collidables are now may differ from what they were at the last step: a static may be gone, a body kinematic. The
    // next step sorts that out, so only the bodies of the constraint are compared.
    internal void Validate()
    {
        int contactPairCount = 0;
        int constraintCount = 0;
        int historyCount = 0;
        int parentHistoryCount = 0;
        int childManifoldCount = 0;
        for (int j = 0; j < Pairs.Pairs.Count + Pairs.Asleep.Count; ++j)
        {
            // Those that sleep behind the others.
            var isAsleep = j >= Pairs.Pairs.Count;
            ref var table = ref isAsleep ? ref Pairs.Asleep : ref Pairs.Pairs;
            var i = isAsleep ? j - Pairs.Pairs.Count : j;
            var key = table.Keys[i];
            Invariant.Require(table.IndexOf(key) == i, "place of pair", j);
            Invariant.Require(!isAsleep || Pairs.Pairs.IndexOf(key) < 0, "second place of sleeping pair", i);
            ref var cached = ref table.Values[i];
            var hasParentHistory = cached.IsOfChildren && cached.Single.History >= 0;
            Invariant.Require(!hasParentHistory || Pairs.Parents.MayExist(cached.Single.History), "history of pair of parents", i, cached.Single.History);
            parentHistoryCount += hasParentHistory ? 1 : 0;
            var constraintCountBefore = constraintCount;
            var last = 0ul;
            for (var manifolds = Pairs.ManifoldsOf(ref cached); manifolds.MoveNext();)
            {
                ref var manifold = ref manifolds.Current;
                if (cached.IsOfChildren)
                {
                    Invariant.Require(manifolds.Children.Order >= last, "order of the manifolds of pair", i);
                    last = manifolds.Children.Order + 1;
                    ++childManifoldCount;
                }
                Invariant.Require(manifold.History < 0 || Pairs.Histories.MayExist(manifold.History), "history of pair", i, manifold.History);
                historyCount += manifold.History < 0 ? 0 : 1;
                if (!manifold.HasConstraint)
                    continue;
                ++constraintCount;
                ValidateConstraint(i, key, isAsleep, manifold, manifolds.Children);
            }
            Invariant.Require(!isAsleep || constraintCount > constraintCountBefore, "sleeping pair without contacts", i);
            contactPairCount += constraintCount > constraintCountBefore ? 1 : 0;
            Invariant.Require(!cached.IsOfChildren || cached.ChildConstraintCount == constraintCount - constraintCountBefore,
                "number of constraints of pair", i, cached.ChildConstraintCount);
        }
        Invariant.Require(contactPairCount == PairCount, "number of pairs with contacts, counted are", contactPairCount, PairCount);
        Invariant.Require(historyCount == Pairs.Histories.Count, "number of histories, pairs have", historyCount, Pairs.Histories.Count);
        Invariant.Require(parentHistoryCount == Pairs.Parents.Count, "number of histories of parents, pairs have", parentHistoryCount, Pairs.Parents.Count);
        Invariant.Require(childManifoldCount == Pairs.Manifolds.Count, "number of manifolds, pairs have", childManifoldCount, Pairs.Manifolds.Count);
        Invariant.Require(CountContactConstraints() == constraintCount, "number of contact constraints, manifolds are", constraintCount);
    }

    void ValidateConstraint(int index, CollidablePair pair, bool isAsleep, in CachedManifold manifold, ChildIds children)
    {
        var solver = Simulation.Solver;
        Invariant.Require(solver.ConstraintExists(manifold.Constraint), "constraint of pair", index, manifold.Constraint.Slot);
        var location = solver.Locations[manifold.Constraint.Slot];
        Invariant.Require(location.TypeId == manifold.ConstraintTypeId && location.TypeId < ConstraintTypeIds.ContactTypeCount,
            "type of the constraint of pair", index, location.TypeId);
        Invariant.Require(solver.IsAsleep(manifold.Constraint.Slot) == isAsleep, "sleep of the constraint of pair", index);
        Invariant.Require(isAsleep ? IsSame(pairOfConstraint[manifold.Constraint.Slot], pair) :
            TryFind(manifold.Constraint, out var knownIndex, out var knownChildren) && knownIndex == index && knownChildren == children,
            "pair of constraint", manifold.Constraint.Slot);
        var processor = solver.Processor(location.TypeId);
        Invariant.Require(processor.BodiesPerConstraint == (pair.B.Mobility == CollidableMobility.Static ? 1 : 2),
            "number of bodies of the constraint of pair", index);
        Invariant.Require(IsBody(location, 0, pair.A), "first body of the constraint of pair", index);
        Invariant.Require(processor.BodiesPerConstraint == 1 || IsBody(location, 1, pair.B), "second body of the constraint of pair", index);
        ValidatePatch(index, manifold);
    }

    // What a patch keeps from step to step. Where its bodies are now says nothing of that: they have moved, and a game may have moved them.
    void ValidatePatch(int index, in CachedManifold manifold)
    {
        // Rounding of a sum of impulses, over these.
        const float rounding = 1e-4f;
        new ContactConstraint(Simulation.Solver, manifold.Constraint, ConstraintTypeIds.ContactCount(manifold.ConstraintTypeId))
            .ReadPatch(manifold.Features, out var patch);
        float load = 0;
        for (int i = 0; i < patch.Count; ++i)
        {
            Invariant.Require(float.IsFinite(Exact.LengthSquared(patch.Arms[i])), "arm of the constraint of pair", index, i);
            Invariant.Require(patch.Normals[i] >= 0, "normal impulse of the constraint of pair", index, i);
            load += patch.Normals[i];
        }
        Invariant.Require(float.IsFinite(Exact.LengthSquared(patch.OffsetB)), "offset between the bodies of the constraint of pair", index);
        Invariant.Require(MathF.Abs(Exact.LengthSquared(patch.Normal) - 1) < rounding, "normal of the constraint of pair", index);
        // Not the square, which is zero for what is next to nothing.
        var friction = MathF.Abs(patch.Friction.X) + MathF.Abs(patch.Friction.Y) + MathF.Abs(patch.Friction.Z);
        Invariant.Require(MathF.Abs(Exact.Dot(patch.Friction, patch.Normal)) <= rounding * (friction + load), "plane of the friction of pair", index);
    }

    static bool IsSame(CollidablePair a, CollidablePair b) => a.A == b.A && a.B == b.B;

    bool IsBody(in ConstraintLocation location, int slot, CollidableReference collidable) =>
        Simulation.Bodies.HandleAt(Simulation.Solver.BodySlotOf(location, slot)) == collidable.BodyHandle;

    int CountContactConstraints()
    {
        int count = 0;
        for (int i = 0; i < Simulation.Solver.Sets.Length; ++i)
        {
            ref var batches = ref Simulation.Solver.Sets[i].Batches;
            for (int j = 0; j < batches.Count; ++j)
            {
                ref var typeBatches = ref batches[j].TypeBatches;
                for (int k = 0; k < typeBatches.Count; ++k)
                    count += typeBatches[k].TypeId < ConstraintTypeIds.ContactTypeCount ? typeBatches[k].ConstraintCount : 0;
            }
        }
        return count;
    }
}
