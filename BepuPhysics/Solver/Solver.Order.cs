using BepuPhysics.Constraints;
using BepuUtilities.Collections;

namespace BepuPhysics;

// The order of the batches in a substep.
//
// A sweep is one Gauss-Seidel iteration and starts from the impulses of the substep before, so that over many substeps errors go through the
// powers of one matrix, (D + L)^-1 K, where K couples the joints, D is its diagonal and L what of it a joint sees solved before it. The joints of
// a chain have two colours, and that matrix real eigenvalues. The joints of one body are all coupled with each other: solved in the same
// order each time, they have complex eigenvalues. Errors then travel along the order like a wave, and the correction of positions, which comes
// late by the delay of that wave, feeds it: arms that together are as heavy as the hub that they hang on, or heavier, throw it about until all bursts.
//
// In a new random order nothing travels. Turning an order around transposes (D + L)^-1, so that its mean over all orders is
// symmetric, and K's is positive: the eigenvalues of the mean are real again. Two fixed orders in turn are no remedy, least of all one order
// and its reverse, where the last joint of a substep is the first of the next. One order for all sweeps of a substep: an exactly straight
// chain, with three sweeps and the stiffness that they allow, gains energy where each of them has its own.
//
// Joints of such bodies have batches of their own, before all others. So what has no such body keeps every bit, whatever there is elsewhere. Each of
// these batches draws a number, which follows from its own place among them, the substep and the number of steps: that of others, which may be there or
// not, does not come into it.
public sealed unsafe partial class Solver
{
    /// <summary>Joints of one body from which on a fixed order gains energy at the mass ratio that is worst for it, with one sweep per substep.</summary>
    const int JointsToShuffleForOneSweep = 8;
    /// <summary>The same with several sweeps per substep, be they iterations or relaxations.</summary>
    const int JointsToShuffleForSweeps = 4;

    uint stepNumber;

    /// <summary>Steps since the simulation began, was cleared, or was last empty.</summary>
    internal uint StepNumber => stepNumber;

    // Joints of one body from which on they are shuffled, by the settings of the last step.
    int jointsToShuffle;
    // Bodies that have begun or ceased to have that many, whose joints are yet to be moved.
    TurnedBodies turned;

    struct TurnedBodies
    {
        public int Count;
        public BodyNumbers Indices;
    }

    // A batch of the random order.
    struct Drawn
    {
        public int Batch;
        // Place among the shuffled batches.
        public int Place;
        public uint Number;

        public readonly bool IsBefore(in Drawn other) => Number != other.Number ? Number < other.Number : Place < other.Place;
    }

    int JointsToShuffle => VelocityIterationScheduler is not null || velocityIterationCount + relaxationIterationCount > 1
        ? JointsToShuffleForSweeps : JointsToShuffleForOneSweep;

    // Whether joints of a body are swept over in random order.
    bool IsShuffled(int bodyIndex) => bodies.ActiveSet.JointCounts.Allocated && Degree(bodyIndex) >= jointsToShuffle;

    // Takes note of a body that has another number of joints. They are moved when nobody looks at a batch any more.
    void NoteTurned(int bodyIndex, int before, int after)
    {
        if (before >= jointsToShuffle != after >= jointsToShuffle)
            turned.Indices[turned.Count++] = bodyIndex;
    }

    // In the order in which they were added, so that they have the colours that they would have if they had always been there.
    void MoveJointsOfTurned()
    {
        var count = turned.Count;
        turned.Count = 0;
        for (int i = 0; i < count; ++i)
            SortJointsOf(turned.Indices[i]);
    }

    void SortJointsOf(int bodyIndex)
    {
        foreach (var constraint in new BodyConstraints(this, bodies.ActiveSet.Constraints[bodyIndex]))
        {
            var handle = constraint.ConnectingConstraintHandle;
            ref var location = ref Locations[handle.Slot];
            if (location.TypeId >= ConstraintTypeIds.ContactTypeCount && location.SetIndex == 0 && BatchOf(location).IsOfColour &&
                KindOf(location) == BatchKind.Shuffled != HasShuffledBody(location))
                TryMove(handle, BatchKind.Coloured);
        }
    }

    // Whether a joint of the active set belongs to those that are shuffled.
    bool HasShuffledBody(in ConstraintLocation location)
    {
        var processor = Processor(location.TypeId);
        for (int slot = 0; slot < processor.BodiesPerConstraint; ++slot)
        {
            if (IsShuffled(processor.BodyReference(ref TypeBatchAt(location), location.IndexInTypeBatch, slot) & EncodedBody.IndexMask))
                return true;
        }
        return false;
    }

    // Settings of a solver may change between steps, and with them which joints are shuffled.
    void SortJoints()
    {
        if (jointsToShuffle == JointsToShuffle)
            return;
        jointsToShuffle = JointsToShuffle;
        for (int i = 0; i < bodies.ActiveSet.Count && bodies.ActiveSet.JointCounts.Allocated; ++i)
        {
            if (Degree(i) >= JointsToShuffleForSweeps)
                SortJointsOf(i);
        }
    }

    /// <summary>Lists the batches that are swept over in random order.</summary>
    // What of shuffled joints falls back is in the batch of all that do, which has joints of them only where there are more of these than batches.
    void BuildOrder(ref SolveWork work)
    {
        ref var batches = ref ActiveSet.Batches;
        var place = 0;
        for (int i = 0; i < batches.Count; ++i)
        {
            if (batches[i].Kind != BatchKind.Shuffled)
                continue;
            if (work.BlocksOfBatch[i].Count > 0)
                AddToOrder(ref work, i, place);
            ++place;
        }
        if (place == 0 || FindBatch(ActiveSet, BatchKind.Fallback) is not (>= 0 and var fallback))
            return;
        for (int i = 0; i < batches[fallback].TypeBatches.Count; ++i)
        {
            if (batches[fallback].TypeBatches[i].TypeId < ConstraintTypeIds.ContactTypeCount)
                continue;
            AddToOrder(ref work, fallback, FallbackBatchThreshold);
            return;
        }
    }

    void AddToOrder(ref SolveWork work, int batch, int place)
    {
        if (!work.Order.Span.Allocated)
            work.Order = new QuickList<Drawn>(16, pool);
        work.Order.Add(new() { Batch = batch, Place = place }, pool);
        work.BlocksOfBatch[batch].IsDrawn = true;
    }

    /// <summary>Draws the order for the next substep.</summary>
    void ShuffleOrder(ref SolveWork work, int substep)
    {
        if (work.Order.Count == 0)
            return;
        var drawn = Mix(Mix(stepNumber) + (uint)substep);
        foreach (ref var batch in work.Order.AsSpan())
            batch.Number = Mix(drawn + (uint)batch.Place);
        for (int i = 1; i < work.Order.Count; ++i)
        {
            for (int j = i; j > 0 && work.Order[j].IsBefore(work.Order[j - 1]); --j)
                (work.Order[j], work.Order[j - 1]) = (work.Order[j - 1], work.Order[j]);
        }
    }

    // Each bit of a number to each bit of another: the last steps of MurmurHash3.
    static uint Mix(uint bits)
    {
        bits = (bits ^ bits >> 16) * 0x85ebca6b;
        bits = (bits ^ bits >> 13) * 0xc2b2ae35;
        return bits ^ bits >> 16;
    }
}
