using System.Runtime.Intrinsics;
using BepuUtilities.Collections;
using BepuUtilities.Memory;

namespace BepuPhysics.Constraints.Contact;

/// <summary>The structures of joints that have bodies which may bounce: a blow on one of their bodies moves all.</summary>
// An impact takes no time. What holds in no time are joints that hold both ways and are as stiff as a substep can tell; a spring, a motor or a limit
// gives way first, or comes after. With velocities v that the joints allow, an impulse p on the bodies makes them v + P M^-1 p: what the joints leave of the
// change, P = 1 - M^-1 J^T (J M^-1 J^T)^-1 J. So a row of a contact has the inverse mass n P M^-1 n^T in the place of n M^-1 n^T, and all else is as for bodies
// that are free. The factors are those of joints that are solved at once (DirectEquations.cs).
//
// When impacts are made, velocities have gained what gravity gives in the substep, and the joints have not taken their part of it yet. So impacts are made
// among the velocities P v; what is missing to v is put back afterwards, for the solver to take. P makes the two independent of each other: the energy of v is
// that of both, and what impacts do to P v is all that they do.
sealed unsafe partial class ImpactStructures(Solver solver, Bodies bodies, BufferPool pool)
{
    // Joints of a structure beyond which its bodies are as free: each impact takes a time in proportion to them, and their bodies have as many impacts.
    const int MostJoints = 256;
    // Of one with loops, whose work grows faster.
    const int MostJointsWithLoops = 96;

    // Places of bodies that are in no structure, and of those of which nobody has asked.
    const int Alone = -1;
    const int Unknown = -2;

    // A body of a structure.
    struct Part
    {
        // In the active set, with the mark of a kinematic one.
        public int Reference;
        public int Island;
        // World axes, without what makes the solver's substep stable.
        public BodyInertia Inertia;
        // What is missing to the velocity that it had before its joints took their part.
        public BodyVelocity Lost;
        // What the acceleration of a substep gives it, and in its joints.
        public BodyVelocity FreeGain;
        public BodyVelocity Gain;
        // What the impact that is being made adds to its velocity, and that as the joints let it halfway (ImpactStructures.Ways.cs).
        public BodyVelocity Change;
        public BodyVelocity Path;
        // Of the first part of a structure: whether the structure goes along its joints.
        public bool IsLed;
    }

    DirectPlan plan;
    Buffer<Vector256<double>> memory;
    // Of each body of the active set: its part.
    QuickList<int> places;
    QuickList<Part> parts;
    // Of each island, whether its equations are those of the present substep.
    QuickList<bool> isEntered;
    // Of each row, the speed at which it drives where the structure was hit.
    QuickList<OneNumber> driven;
    // Of each island, whether it rests on something, while that is asked.
    QuickList<bool> isBorne;
    // The structure that is being looked for.
    QuickList<int> found;
    QuickList<DirectNode> joints;
    QuickList<ConstraintHandle> handles;

    /// <summary>Whether no body that may bounce is in any.</summary>
    internal bool IsEmpty => isEntered.Count == 0;

    /// <summary>Number of structures.</summary>
    internal int Count => isEntered.Count;

    /// <summary>The structure of a body of the active set, or -1.</summary>
    int IslandOf(int body) => places[body] >= 0 ? parts[places[body]].Island : Alone;

    /// <summary>Those of the bodies of a pair, or -1.</summary>
    internal (int A, int B) IslandsOf(in BouncingPair pair) => (IslandOf(pair.A), pair.B >= 0 ? IslandOf(pair.B) : Alone);

    /// <summary>Whether a structure hangs in joints from something that nothing moves; not where there is none, -1.</summary>
    internal bool Hangs(int island) =>
        island >= 0 && plan.Islands[island].EndBody > plan.Islands[island].FirstBody + plan.Islands[island].DynamicCount;

    /// <summary>Whether a structure has been noted to rest on something; not where there is none, -1.</summary>
    internal bool IsBorne(int island) => island >= 0 && isBorne[island];

    /// <summary>Notes whether a structure rests on something.</summary>
    internal void NoteBorne(int island, bool value)
    {
        if (island >= 0)
            isBorne[island] = value;
    }

    /// <summary>Finds those of the bodies of some pairs.</summary>
    internal void Find(ref QuickList<BouncingPair> pairs)
    {
        isEntered.Count = 0;
        isBorne.Count = 0;
        if (!AnyJoints())
            return;
        MakeLists();
        places.EnsureCapacity(bodies.Awake.Count, pool);
        places.Count = bodies.Awake.Count;
        places.AsSpan().Fill(Unknown);
        for (int i = 0; i < pairs.Count; ++i)
        {
            Add(pairs[i].A);
            if (pairs[i].B >= 0)
                Add(pairs[i].B);
        }
        if (IsEmpty)
            return;
        plan.PlaceMemory();
        pool.ReturnIfTaken(ref memory);
        pool.Take(plan.MemoryCount, out memory);
        memory.Clear(0, plan.MemoryCount);
        var rowCount = plan.Islands[plan.Islands.Count - 1].EndRow;
        driven.EnsureCapacity(rowCount, pool);
        driven.Count = rowCount;
    }

    void MakeLists()
    {
        plan.Dispose(pool);
        plan = DirectPlan.Create(pool);
        plan.KeepsApart = true;
        parts.Count = 0;
        if (places.Span.Allocated)
            return;
        places = new(16, pool);
        parts = new(16, pool);
        isEntered = new(4, pool);
        isBorne = new(4, pool);
        driven = new(16, pool);
        found = new(16, pool);
        joints = new(16, pool);
        handles = new(16, pool);
    }

    /// <summary>Whether any body is in a joint that may hold in no time.</summary>
    internal bool AnyJoints()
    {
        foreach (ref var batch in solver.ActiveSet.Batches.AsSpan())
        {
            foreach (ref var typeBatch in batch.TypeBatches.AsSpan())
            {
                if (typeBatch.ConstraintCount > 0 && MayHold(typeBatch.TypeId))
                    return true;
            }
        }
        return false;
    }

    bool MayHold(int typeId) => solver.MayBeDirect(typeId) && solver.Processor(typeId).LimitOf(0) is RowLimit.None or RowLimit.Length;

    // All that hangs together with a body, neighbours first, in the order in which joints were added to their bodies.
    void Add(int body)
    {
        if (places[body] != Unknown)
            return;
        found.Count = joints.Count = handles.Count = 0;
        AddBody(body);
        for (int i = 0; i < found.Count; ++i)
        {
            var list = bodies.Awake.Constraints[found[i]];
            for (int left = list.Count, edge = list.First; left > 0; --left, edge = solver.Edges.Next(edge))
                AddJoint(solver.Edges.ConstraintSlot(edge), solver.Edges.BodySlot(edge), i);
        }
        var isAdded = joints.Count is > 0 and <= MostJoints && TryAdd();
        for (int i = 0; i < found.Count && !isAdded; ++i)
            places[found[i] & EncodedBody.IndexMask] = Alone;
    }

    void AddBody(int reference)
    {
        places[reference & EncodedBody.IndexMask] = found.Count;
        found.Add(reference, pool);
    }

    static bool IsDynamic(int reference) => (reference & EncodedBody.KinematicFlag) == 0;

    // Each is seen from all of its bodies, and is of the first one that sees it.
    void AddJoint(int constraintSlot, int bodySlot, int place)
    {
        ref var location = ref solver.Locations[constraintSlot];
        if (!MayHold(location.TypeId))
            return;
        var processor = solver.Processor(location.TypeId);
        ref var batch = ref solver.TypeBatchAt(location);
        // Whether those with bounds are at them is asked when there is a blow.
        DirectNode node = new()
        {
            TypeId = location.TypeId,
            RowCount = processor.RowCount,
            BodyCount = processor.BodiesPerConstraint,
            SeesLinear = processor.SeesLinear,
        };
        for (int slot = 0; slot < node.BodyCount; ++slot)
        {
            var reference = processor.BodyReference(ref batch, location.IndexInTypeBatch, slot) & (EncodedBody.IndexMask | EncodedBody.KinematicFlag);
            node.Bodies[slot] = reference;
            if (!IsDynamic(reference))
                continue;
            var known = places[reference];
            if ((known >= 0 && known < place) || (known == place && slot < bodySlot))
                return;
        }
        for (int slot = 0; slot < node.BodyCount; ++slot)
        {
            if (IsDynamic(node.Bodies[slot]) && places[node.Bodies[slot]] < 0)
                AddBody(node.Bodies[slot]);
        }
        joints.Add(node, pool);
        handles.Add(batch.IndexToHandle[location.IndexInTypeBatch], pool);
    }

    bool TryAdd()
    {
        var dynamicCount = found.Count;
        foreach (ref var node in joints.AsSpan())
        {
            for (int slot = 0; slot < node.BodyCount; ++slot)
            {
                var index = node.Bodies[slot] & EncodedBody.IndexMask;
                if (places[index] < 0)
                    AddBody(node.Bodies[slot]);
                node.Bodies[slot] = places[index];
            }
        }
        // Kinematic bodies may be of other structures as well.
        for (int i = dynamicCount; i < found.Count; ++i)
            places[found[i] & EncodedBody.IndexMask] = Unknown;
        var isAdded = plan.TryAdd(joints, handles, found, dynamicCount, pool, MostJointsWithLoops);
        if (!isAdded)
        {
            found.Count = dynamicCount;
            return false;
        }
        var first = plan.Islands[plan.Islands.Count - 1].FirstBody;
        for (int i = 0; i < found.Count; ++i)
        {
            parts.Add(new() { Reference = found[i], Island = isEntered.Count }, pool);
            if (i < dynamicCount)
                places[found[i]] = first + i;
        }
        isEntered.Add(false, pool);
        isBorne.Add(false, pool);
        return true;
    }

    internal void Dispose()
    {
        plan.Dispose(pool);
        pool.ReturnIfTaken(ref memory);
        if (!places.Span.Allocated)
            return;
        places.Dispose(pool);
        parts.Dispose(pool);
        isEntered.Dispose(pool);
        isBorne.Dispose(pool);
        driven.Dispose(pool);
        found.Dispose(pool);
        joints.Dispose(pool);
        handles.Dispose(pool);
    }

    internal void Abandon()
    {
        plan = default;
        memory = default;
        places = default;
        parts = default;
        isEntered = default;
        isBorne = default;
        driven = default;
        found = default;
        joints = default;
        handles = default;
    }
}
