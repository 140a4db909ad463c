using System;
using BepuUtilities.Collections;
using BepuUtilities.Memory;

namespace BepuPhysics.Constraints;

/// <summary>A joint that may be solved together with others.</summary>
struct DirectCandidate
{
    /// <summary>Whether it is to be.</summary>
    public bool IsDirect;
    /// <summary>The joint as a plan knows it, with references to its bodies.</summary>
    public DirectNode Joint;
}

/// <summary>Finds what hangs together by joints, and makes a plan for each such structure.</summary>
readonly unsafe ref struct DirectChooser(QuickList<DirectCandidate> joints, int bodyCount, BufferPool pool)
{
    readonly Span<DirectCandidate> joints = joints.AsSpan();

    /// <summary>Marks the joints that are in the plan.</summary>
    internal void Choose(ref DirectPlan plan)
    {
        if (joints.Length == 0)
            return;
        pool.Take<int>(bodyCount, out var structures);
        DisjointSets.Begin(structures, bodyCount);
        foreach (ref var joint in joints)
            Join(structures, joint.Joint);
        // Joints of each structure in their order: chained, with the first of each by the root of its bodies.
        pool.Take<int>(bodyCount, out var last);
        pool.Take<int>(joints.Length, out var next);
        pool.Take<int>(joints.Length, out var firsts);
        new Span<int>(last.Memory, bodyCount).Fill(-1);
        int count = 0;
        for (int i = 0; i < joints.Length; ++i)
        {
            next[i] = -1;
            ref var lastOfStructure = ref last[DisjointSets.Root(structures, FirstDynamic(joints[i].Joint))];
            if (lastOfStructure >= 0)
                next[lastOfStructure] = i;
            else
                firsts[count++] = i;
            lastOfStructure = i;
        }
        // From here on: the place of a body in its structure.
        new Span<int>(last.Memory, bodyCount).Fill(-1);
        for (int i = 0; i < count; ++i)
            Add(ref plan, firsts[i], next, last);
        pool.Return(ref firsts);
        pool.Return(ref next);
        pool.Return(ref last);
        pool.Return(ref structures);
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

    void Add(ref DirectPlan plan, int first, Buffer<int> next, Buffer<int> placeOf)
    {
        var nodes = new QuickList<DirectNode>(16, pool);
        var references = new QuickList<int>(16, pool);
        for (int i = first; i >= 0; i = next[i])
        {
            nodes.Add(joints[i].Joint, pool);
            Number(joints[i].Joint, ofDynamic: true, placeOf, ref references);
        }
        var dynamicCount = references.Count;
        for (int i = first; i >= 0; i = next[i])
            Number(joints[i].Joint, ofDynamic: false, placeOf, ref references);
        foreach (ref var node in nodes.AsSpan())
        {
            for (int slot = 0; slot < node.BodyCount; ++slot)
                node.Bodies[slot] = placeOf[node.Bodies[slot] & EncodedBody.IndexMask];
        }
        if (plan.TryAdd(nodes, references, dynamicCount, pool))
        {
            for (int i = first; i >= 0; i = next[i])
                joints[i].IsDirect = true;
        }
        // Kinematic bodies may be of other structures as well.
        foreach (var reference in references.AsSpan())
            placeOf[reference & EncodedBody.IndexMask] = -1;
        references.Dispose(pool);
        nodes.Dispose(pool);
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
}
