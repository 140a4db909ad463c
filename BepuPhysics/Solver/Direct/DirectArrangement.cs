using System;
using BepuUtilities.Collections;
using BepuUtilities.Memory;

namespace BepuPhysics.Constraints;

/// <summary>Brings the joints that are solved at once into the order in which their structures lie side by side.</summary>
// Equal structures have as many joints of each kind, which come to lie in lanes of one bundle: so what is read of a bundle goes to all at once. Those of a
// structure stay in the order in which they were added, which is that of its sums of stiffness (DirectLoadStage.cs).
readonly unsafe ref struct DirectArrangement(Solver solver, DirectPlan plan, BufferPool pool)
{
    /// <summary>Orders the joints of all types.</summary>
    internal void Arrange(ref ConstraintBatch batch)
    {
        var order = new QuickList<ConstraintHandle>(plan.Nodes.Count, pool);
        pool.Take<int>(plan.Nodes.Count, out var nodes);
        foreach (ref var typeBatch in batch.TypeBatches.AsSpan())
        {
            order.Count = 0;
            // Full ones first: the next bundle begins where they end.
            for (int members = DirectPlan.Lanes; members > 0; --members)
            {
                foreach (ref var island in plan.Islands.AsSpan())
                {
                    if (island.MemberCount == members)
                        Add(island, typeBatch.TypeId, nodes, ref order);
                }
            }
            Arrange(ref typeBatch, order);
        }
        pool.Return(ref nodes);
        order.Dispose(pool);
    }

    void Add(in DirectIsland island, int typeId, Buffer<int> nodes, ref QuickList<ConstraintHandle> order)
    {
        for (int k = island.FirstNode; k < island.EndNode; ++k)
            nodes[plan.Nodes[k].Place] = k;
        for (int place = 0; place < island.EndNode - island.FirstNode; ++place)
        {
            for (int lane = 0; lane < island.MemberCount && plan.Nodes[nodes[place]].TypeId == typeId; ++lane)
                order.Add(plan.Members[nodes[place] * DirectPlan.Lanes + lane].Handle, pool);
        }
    }

    void Arrange(ref TypeBatch batch, ReadOnlySpan<ConstraintHandle> order)
    {
        var processor = solver.Processor(batch.TypeId);
        for (int i = 0; i < order.Length; ++i)
        {
            ref var place = ref solver.Locations[order[i].Slot].IndexInTypeBatch;
            if (place == i)
                continue;
            processor.Exchange(ref batch, place, i);
            solver.Locations[batch.IndexToHandle[place].Slot].IndexInTypeBatch = place;
            place = i;
        }
    }
}
