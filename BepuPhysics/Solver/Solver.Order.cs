using System;
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
// Contacts come after all joints then, in the order of their batches: what touches no joint keeps every bit, whatever hubs there are elsewhere.
public sealed unsafe partial class Solver
{
    /// <summary>Joints of one body from which on a fixed order gains energy at the mass ratio that is worst for it, with one sweep per substep.</summary>
    const int JointsToShuffleForOneSweep = 8;
    /// <summary>The same with several sweeps per substep, be they iterations or relaxations.</summary>
    const int JointsToShuffleForSweeps = 4;

    // Part of the state of a simulation: it begins with zero and takes the same values in each run.
    uint shuffleState;

    /// <summary>Lists the batches that have joints, in the order of their indices, if any sweep goes through them in another.</summary>
    void BuildOrder(ref SolveWork work)
    {
        if (hubsToShuffleForOneSweep + hubsToShuffleForSweeps == 0)
            return;
        work.Order = new QuickList<int>(Math.Max(1, work.BlocksOfBatch.Count), pool);
        for (int i = 0; i < work.BlocksOfBatch.Count; ++i)
            if (work.BlocksOfBatch[i].JointCount > 0)
                work.Order.Add(i, pool);
    }

    /// <summary>Shuffles the order of joints for the next substep, where a fixed one is not stable.</summary>
    // Fisher and Yates. Of the linear congruential generator only the upper bits count, which are the good ones.
    void ShuffleOrder(ref SolveWork work)
    {
        var hubs = work.Iterations + relaxationIterationCount > 1 ? hubsToShuffleForSweeps : hubsToShuffleForOneSweep;
        work.ShufflesOrder = hubs > 0;
        if (!work.ShufflesOrder)
        {
            // Who comes after the last hub finds what the first one found.
            shuffleState = 0;
            return;
        }
        for (int i = work.Order.Count - 1; i > 0; --i)
        {
            shuffleState = shuffleState * 1664525 + 1013904223;
            var other = (int)(((ulong)shuffleState * (ulong)(i + 1)) >> 32);
            (work.Order[i], work.Order[other]) = (work.Order[other], work.Order[i]);
        }
    }
}
