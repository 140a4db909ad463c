using System;
using BepuUtilities.Collections;
using BepuUtilities.Memory;

namespace BepuPhysics.Constraints;

/// <summary>A joint that may be solved together with others.</summary>
struct DirectCandidate
{
    /// <summary>Place in the order in which joints were added.</summary>
    public long Number;
    /// <summary>Whether it asks to be: one is enough for a structure.</summary>
    public bool Asks;
    /// <summary>Whether it is decided how it is solved.</summary>
    public bool IsDecided;
    /// <summary>Whether it is to be.</summary>
    public bool IsDirect;
    /// <summary>Whether its structure asks in vain.</summary>
    public bool IsRefused;
    /// <summary>Its handle.</summary>
    public ConstraintHandle Handle;
    /// <summary>The joint as a plan knows it, with references to its bodies.</summary>
    public DirectNode Joint;
}

/// <summary>Finds what hangs together by joints, and makes a plan for each such structure.</summary>
readonly unsafe ref struct DirectChooser(QuickList<DirectCandidate> joints, int bodyCount, BufferPool pool)
{
    readonly Span<DirectCandidate> joints = joints.AsSpan();
    readonly ByNumber order = new(joints.Span);

    /// <summary>Marks the joints that are in the plan.</summary>
    // What is too much with its limits, servos and motors may do without.
    internal void Choose(ref DirectPlan plan)
    {
        if (joints.Length > 0 && !TryChoose(ref plan))
            TryChoose(ref plan);
    }

    // Whether all is decided.
    bool TryChoose(ref DirectPlan plan)
    {
        pool.Take<int>(bodyCount, out var structures);
        DisjointSets.Begin(structures, bodyCount);
        foreach (ref var joint in joints)
        {
            if (!joint.IsDecided)
                Join(structures, joint.Joint);
        }
        // Joints of each structure in their order: chained, with the first of each by the root of its bodies.
        pool.Take<int>(bodyCount, out var last);
        pool.Take<int>(joints.Length, out var next);
        pool.Take<int>(joints.Length, out var firsts);
        new Span<int>(last.Memory, bodyCount).Fill(-1);
        int count = 0;
        for (int i = 0; i < joints.Length; ++i)
        {
            next[i] = -1;
            if (joints[i].IsDecided)
                continue;
            ref var lastOfStructure = ref last[DisjointSets.Root(structures, FirstDynamic(joints[i].Joint))];
            if (lastOfStructure >= 0)
                next[lastOfStructure] = i;
            else
                firsts[count++] = i;
            lastOfStructure = i;
        }
        // From here on: the place of a body in its structure.
        new Span<int>(last.Memory, bodyCount).Fill(-1);
        var isDone = true;
        for (int i = 0; i < count; ++i)
        {
            if (AnyAsks(firsts[i], next))
                isDone &= TryAdd(ref plan, firsts[i], next, last);
        }
        pool.Return(ref firsts);
        pool.Return(ref next);
        pool.Return(ref last);
        pool.Return(ref structures);
        return isDone;
    }

    bool AnyAsks(int first, Buffer<int> next)
    {
        for (int i = first; i >= 0; i = next[i])
        {
            if (joints[i].Asks)
                return true;
        }
        return false;
    }

    static bool IsDynamic(int reference) => (reference & EncodedBody.KinematicFlag) == 0;

    static int FirstDynamic(in DirectNode node)
    {
        int slot = 0;
        while (!IsDynamic(node.Bodies[slot]))
            ++slot;
        return node.Bodies[slot];
    }

    static void Join(Buffer<int> structures, in DirectNode node)
    {
        var root = DisjointSets.Root(structures, FirstDynamic(node));
        for (int slot = 0; slot < node.BodyCount; ++slot)
        {
            if (!IsDynamic(node.Bodies[slot]))
                continue;
            var other = DisjointSets.Root(structures, node.Bodies[slot]);
            root = root == other ? root : DisjointSets.Join(structures, root, other);
        }
    }

    // Whether it is decided how the structure is solved.
    bool TryAdd(ref DirectPlan plan, int first, Buffer<int> next, Buffer<int> placeOf)
    {
        var members = new QuickList<int>(16, pool);
        for (int i = first; i >= 0; i = next[i])
            members.Add(i, pool);
        var comparer = order;
        QuickSort.Sort(members.Span, members.Count, ref comparer);
        var nodes = new QuickList<DirectNode>(16, pool);
        var handles = new QuickList<ConstraintHandle>(16, pool);
        var references = new QuickList<int>(16, pool);
        foreach (var i in members.AsSpan())
        {
            nodes.Add(joints[i].Joint, pool);
            handles.Add(joints[i].Handle, pool);
            Number(joints[i].Joint, ofDynamic: true, placeOf, ref references);
        }
        var dynamicCount = references.Count;
        foreach (var i in members.AsSpan())
            Number(joints[i].Joint, ofDynamic: false, placeOf, ref references);
        foreach (ref var node in nodes.AsSpan())
        {
            for (int slot = 0; slot < node.BodyCount; ++slot)
                node.Bodies[slot] = placeOf[node.Bodies[slot] & EncodedBody.IndexMask];
        }
        var isAdded = plan.TryAdd(nodes, handles, references, dynamicCount, pool);
        var isDecided = isAdded || !DirectPlan.HasBounds(nodes);
        for (int i = first; i >= 0; i = next[i])
        {
            ref var joint = ref joints[i];
            (joint.IsDirect, joint.IsRefused) = (isAdded, isDecided && !isAdded);
            joint.IsDecided = isDecided || joint.Joint.HasBounds;
        }
        // Kinematic bodies may be of other structures as well.
        foreach (var reference in references.AsSpan())
            placeOf[reference & EncodedBody.IndexMask] = -1;
        references.Dispose(pool);
        handles.Dispose(pool);
        nodes.Dispose(pool);
        members.Dispose(pool);
        return isDecided;
    }

    void Number(in DirectNode node, bool ofDynamic, Buffer<int> placeOf, ref QuickList<int> references)
    {
        for (int slot = 0; slot < node.BodyCount; ++slot)
        {
            var reference = node.Bodies[slot];
            ref var place = ref placeOf[reference & EncodedBody.IndexMask];
            if (place >= 0 || IsDynamic(reference) != ofDynamic)
                continue;
            place = references.Count;
            references.Add(reference, pool);
        }
    }

    readonly struct ByNumber(Buffer<DirectCandidate> joints) : IComparerRef<int>
    {
        public int Compare(ref int a, ref int b) => joints[a].Number.CompareTo(joints[b].Number);
    }
}
