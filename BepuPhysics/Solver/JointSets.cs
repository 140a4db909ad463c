using System;
using System.Numerics;
using BepuPhysics.Constraints;
using BepuUtilities.Collections;
using BepuUtilities.Memory;

namespace BepuPhysics;

/// <summary>Which awake bodies joints connect, over any number of them and of dynamic bodies.</summary>
// Joints come and go seldom, so what they connect is kept until one does.
struct JointSets
{
    /// <summary>A kinematic body, and a dynamic one that a constraint connects with it.</summary>
    internal readonly record struct Held(int Kinematic, int Body);

    // Of each body, the one that stands for its set.
    Buffer<int> roots;
    // What is joined to kinematic bodies.
    QuickList<Held> held;
    int count;
    int version;

    /// <summary>Begins with what joints connect, and joins the sets that contacts connect.</summary>
    /// <param name="solver">The solver.</param>
    /// <param name="parents">Becomes of each awake body one of its set.</param>
    /// <param name="reached">Per awake body: becomes 1 for each that a constraint connects with a kinematic one of which it is not zero.</param>
    /// <param name="bodyCount">Number of awake bodies.</param>
    /// <param name="pool">Where the sets of joints are kept.</param>
    internal void Join(Solver solver, Buffer<int> parents, Buffer<byte> reached, int bodyCount, BufferPool pool)
    {
        if (!roots.Allocated || version != solver.JointVersion)
            Find(solver, bodyCount, pool);
        var known = Math.Min(count, bodyCount);
        roots.AsSpan()[..known].CopyTo(parents.AsSpan());
        // Who has come since has no joint, and who has gone had none.
        for (int i = known; i < bodyCount; ++i)
            parents[i] = i;
        Mark(held, reached);
        var touching = new QuickList<Held>(64, pool);
        Join(solver, joints: false, parents, ref touching, pool);
        Mark(touching, reached);
        touching.Dispose(pool);
    }

    static void Mark(in QuickList<Held> held, Buffer<byte> reached)
    {
        foreach (var pair in held.AsSpan())
            reached[pair.Body] |= reached[pair.Kinematic];
    }

    void Find(Solver solver, int bodyCount, BufferPool pool)
    {
        Dispose(pool);
        pool.TakeAtLeast(bodyCount, out roots);
        held = new(16, pool);
        count = bodyCount;
        version = solver.JointVersion;
        DisjointSets.Begin(roots, count);
        Join(solver, joints: true, roots, ref held, pool);
        for (int i = 0; i < count; ++i)
            roots[i] = DisjointSets.Root(roots, i);
    }

    // Of the joints or the contacts of the active set.
    static void Join(Solver solver, bool joints, Buffer<int> parents, ref QuickList<Held> held, BufferPool pool)
    {
        foreach (ref var batch in solver.ActiveSet.Batches.AsSpan())
        {
            foreach (ref var typeBatch in batch.TypeBatches.AsSpan())
            {
                var bodyCount = solver.Processor(typeBatch.TypeId).BodiesPerConstraint;
                if (bodyCount > 1 && typeBatch.TypeId >= ConstraintTypeIds.ContactTypeCount == joints)
                    Join(typeBatch, bodyCount, parents, ref held, pool);
            }
        }
    }

    // What is held by a kinematic body on both sides is not connected by it.
    static unsafe void Join(in TypeBatch batch, int bodyCount, Buffer<int> parents, ref QuickList<Held> held, BufferPool pool)
    {
        for (int constraint = 0; constraint < batch.ConstraintCount; ++constraint)
        {
            var references = batch.BodyReferences.Memory + constraint / Vector<int>.Count * bodyCount * Vector<int>.Count + constraint % Vector<int>.Count;
            int joined = -1;
            var kinematics = 0;
            for (int slot = 0; slot < bodyCount; ++slot)
            {
                var reference = references[slot * Vector<int>.Count];
                kinematics |= reference & EncodedBody.KinematicFlag;
                if ((reference & EncodedBody.KinematicFlag) == 0)
                    joined = DisjointSets.JoinNext(parents, joined, reference & EncodedBody.IndexMask);
            }
            for (int slot = 0; kinematics != 0 && slot < bodyCount; ++slot)
            {
                var reference = references[slot * Vector<int>.Count];
                if ((reference & EncodedBody.KinematicFlag) != 0)
                    held.Add(new(reference & EncodedBody.IndexMask, joined), pool);
            }
        }
    }

    /// <summary>Gives the memory back.</summary>
    internal void Dispose(BufferPool pool)
    {
        pool.ReturnIfTaken(ref roots);
        held.DisposeIfTaken(pool);
    }
}
