using System.Numerics;
using BepuUtilities;

namespace BepuPhysics.Constraints.Contact;

// What is held is let go, and what a step took is given back.
sealed unsafe partial class LoadPathStage
{
    /// <summary>Gives all memory back.</summary>
    internal void Dispose()
    {
        graph.Dispose(pool);
        jointSets.Dispose(pool);
    }

    /// <summary>Forgets all memory, which the pool has given back to the system.</summary>
    internal void Abandon() => (graph, jointSets) = (default, default);

    // Gives back what the step took: the graph is kept where there is one, and what joints connect where floors move. Contacts are let go
    // of here only if an exception has broken the step off.
    void ISolverStage.EndStep()
    {
        if (!hasBegun)
            graph.Dispose(pool);
        for (int block = 0; hasBegun && block < blockCount; ++block)
            LetGo(block, 0);
        hasBegun = false;
        // Last taken, first returned: in the next step each gets the block that it had, and touches no other.
        pool.ReturnIfTaken(ref columns);
        pool.ReturnIfTaken(ref relaxedBodies);
        pool.ReturnIfTaken(ref patches);
        pool.ReturnIfTaken(ref knowledge);
        pool.ReturnIfTaken(ref supports);
        if (!reached.Allocated)
            jointSets.Dispose(pool);
        pool.ReturnIfTaken(ref elsewhere);
        pool.ReturnIfTaken(ref riders);
        pool.ReturnIfTaken(ref reached);
        pool.ReturnIfTaken(ref spoilt);
        pool.ReturnIfTaken(ref found);
        pool.ReturnIfTaken(ref turnsBefore);
        pool.ReturnIfTaken(ref before);
    }

    // The sign of the zero tells the next step that they were held. Where floors have moved for some time, what is held alone on them has
    // turned along.
    void LetGo(int block, float dt)
    {
        if (!mayHold[block])
            return;
        mayHold[block] = false;
        if (!lone[block].AreHeld && graph.Nodes.Count == 0)
            return;
        for (var bundles = BundlesOf(block); bundles.MoveNext();)
        {
            ref var batch = ref bundles.TypeBatch;
            var count = ConstraintTypeIds.ContactCount(batch.TypeId);
            var stride = ContactPrestepLayout.PrestepFloats(count);
            var spring = (Vector<float>*)batch.Prestep.Memory + bundles.First * stride + ContactPrestepLayout.Spring(count);
            var turnsAlong = dt > 0 && lone[block].AreHeld && batch.TypeId >= ConstraintTypeIds.ContactTwoBody;
            for (int i = bundles.First; i < bundles.End; ++i, spring += stride)
            {
                var isHeld = Vector.LessThan(*spring, Vector<float>.Zero);
                if (isHeld == Vector<int>.Zero)
                    continue;
                if (turnsAlong && ContactMaterialWide.TurnsAlongOf(*spring) is var turning && turning != Vector<int>.Zero)
                    TurnLone(ref batch, i, count, turning, dt);
                *spring = Wide.Select(isHeld, new Vector<float>(-0f), *spring);
            }
        }
    }
}
