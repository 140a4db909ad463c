using BepuPhysics.Collidables;
using BepuPhysics.Constraints;
using BepuPhysics.Constraints.Contact;
using BepuUtilities.Memory;

namespace BepuPhysics.CollisionDetection;

// What a body had with statics, and with kinematic bodies, in the last step.
public sealed unsafe partial class NarrowPhase<TCallbacks>
{
    // Which of the body's contact constraints are with something that does not give way, and what becomes of them.
    void ListOldPatches(ref StaticPairs statics, int first, int end, BufferPool pool)
    {
        var a = Waiting(first).Tested.Pair.A;
        ref var location = ref Simulation.Bodies.Locations[a.Slot];
        if (location.SetIndex != 0)
            return;
        var solver = Simulation.Solver;
        var list = Simulation.Bodies.Awake.Constraints[location.Index];
        var edge = list.First;
        for (int i = 0; i < list.Count; ++i, edge = solver.Edges.Next(edge))
        {
            var slot = solver.Edges.ConstraintSlot(edge);
            // Most constraints of a body in a cloth are joints or contacts with others: their pair tells. That of a joint is of who had its slot before.
            if (slot >= pairOfConstraint.Length)
                continue;
            var pair = pairOfConstraint[slot];
            if (pair.A.Packed != a.Packed || pair.B.Mobility == CollidableMobility.Dynamic ||
                solver.Locations[slot].TypeId >= ConstraintTypeIds.ContactTypeCount)
                continue;
            var handle = solver.ReferenceOf(edge).ConnectingConstraintHandle;
            var place = FindWaiting(first, end, pair.B);
            if (!TryFind(handle, place, out var cacheIndex, out var children))
                continue;
            var old = new OldPatch { Constraint = handle, CacheIndex = cacheIndex, Children = children, Pair = place };
            old.ContactCount = ConstraintTypeIds.ContactCount(solver.Locations[slot].TypeId);
            var rows = new ContactRows(solver, Simulation.Bodies, handle, old.ContactCount);
            for (int j = 0; j < old.ContactCount; ++j)
                old.Arms[j] = rows.Arm(j);
            foreach (ref var manifold in Pairs.ManifoldsOf(cacheIndex))
            {
                if (manifold.HasConstraint && manifold.Constraint == handle)
                    old.Features = manifold.Features;
            }
            old.IsWritten = old.Pair < 0 && Pairs.IsSeen(cacheIndex);
            statics.Old.Add(old, pool);
        }
    }

    int FindWaiting(int first, int end, CollidableReference b)
    {
        for (int i = first; i < end; ++i)
        {
            if (Waiting(i).Tested.Pair.B.Packed == b.Packed)
                return i;
        }
        return StaticPairs.Nothing;
    }

    // A pair that waits, and has one manifold, was found already.
    bool TryFind(ConstraintHandle handle, int place, out int cacheIndex, out ChildIds children)
    {
        if (place < 0 || Waiting(place).IsOfChildren || Waiting(place).Tested.ConstraintTypeId == CachedManifold.NoConstraint ||
            Waiting(place).Tested.Constraint != handle)
        {
            return TryFind(handle, out cacheIndex, out children);
        }
        cacheIndex = Waiting(place).Tested.CacheIndex;
        children = ChildIds.None;
        return true;
    }
}
