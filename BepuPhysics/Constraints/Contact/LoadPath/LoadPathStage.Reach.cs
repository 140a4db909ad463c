using System;
using System.Numerics;
using BepuUtilities.Collections;
using BepuUtilities.Memory;

namespace BepuPhysics.Constraints.Contact;

// Which bodies may rest on what moves.
//
// What rests on a floor that moves is looked for more widely than what rests on the ground, as each body is asked whether it rests to its own floor, and its
// supports are put in order before that is known. A stack that has nothing to do with any floor must not know that there is one somewhere: so all that is
// connected with a floor, over any number of constraints, is gone over from there. It costs what is connected; where nothing moves, nothing.
//
// What hangs on a floor by joints, as a cloth or a train, is thousands of constraints that connect what they did in the step before: beyond some constraints
// no more are gone over, and the sets of bodies that joints make, which are kept, are joined by the contacts.
sealed unsafe partial class LoadPathStage
{
    // Constraints that are gone over before sets are joined: some, and one for so many bodies, of which each takes as long in sets. None where as many
    // bodies were reached in the last step.
    const int LeastWalked = 64;
    const int BodiesPerWalked = 4;

    // Per body, whether it is connected with a floor; not there where there is no floor.
    Buffer<byte> reached;
    JointSets jointSets;
    bool hasReachedMany;

    /// <summary>Constraints that are gone over at most, before sets are joined; less than zero as is best. Tests ask both ways.</summary>
    internal int MostWalked = -1;

    void FindReached()
    {
        ref var set = ref bodies.Awake;
        pool.TakeAtLeast(set.Count, out reached);
        reached.Clear(0, set.Count);
        pool.TakeAtLeast(Math.Max(1, bundleCount * Vector<float>.Count), out riders);
        var waiting = new QuickList<int>(64, pool);
        for (int i = 0; i < set.Count; ++i)
        {
            if (set.LocalInertias[i].InverseMass == 0 && IsFloor(i))
                Reach(i, ref waiting);
        }
        var many = LeastWalked + set.Count / BodiesPerWalked;
        var left = MostWalked >= 0 ? MostWalked : hasReachedMany ? 0 : many;
        hasReachedMany = false;
        while (waiting.Count > 0 && left > 0)
        {
            var list = set.Constraints[waiting[waiting.Count - 1]];
            --waiting.Count;
            left -= list.Count;
            for (int i = 0, edge = list.First; i < list.Count; ++i, edge = solver.Edges.Next(edge))
                ReachThrough(solver.Locations[solver.Edges.ConstraintSlot(edge)], ref waiting);
        }
        if (waiting.Count > 0)
            hasReachedMany = ReachBySets() > many;
        waiting.Dispose(pool);
    }

    void ReachThrough(in ConstraintLocation location, ref QuickList<int> waiting)
    {
        // Constraints of kinematic bodies may sleep.
        if (location.SetIndex != 0)
            return;
        var processor = solver.Processor(location.TypeId);
        ref var batch = ref solver.TypeBatchAt(location);
        for (int slot = 0; slot < processor.BodiesPerConstraint; ++slot)
        {
            var reference = processor.BodyReference(ref batch, location.IndexInTypeBatch, slot);
            // What is held by a kinematic body on both sides is not moved from one to the other.
            if ((reference & EncodedBody.KinematicFlag) == 0)
                Reach(reference & EncodedBody.IndexMask, ref waiting);
        }
    }

    void Reach(int body, ref QuickList<int> waiting)
    {
        if (reached[body] != 0)
            return;
        reached[body] = 1;
        waiting.Add(body, pool);
    }

    // All of a set is reached where one of it is. Returns how many are.
    int ReachBySets()
    {
        var count = bodies.Awake.Count;
        pool.TakeAtLeast<int>(count, out var parents);
        jointSets.Join(solver, parents, reached, count, pool);
        for (int i = 0; i < count; ++i)
        {
            if (reached[i] != 0)
                reached[DisjointSets.Root(parents, i)] = 1;
        }
        var reachedCount = 0;
        for (int i = 0; i < count; ++i)
        {
            reached[i] |= reached[DisjointSets.Root(parents, i)];
            reachedCount += reached[i];
        }
        pool.Return(ref parents);
        return reachedCount;
    }
}
