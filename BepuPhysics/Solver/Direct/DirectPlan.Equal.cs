using System;
using BepuUtilities.Collections;

namespace BepuPhysics.Constraints;

// Which structures are equal: have joints of the same types between the same of their bodies, in the order in which they were added.
unsafe partial struct DirectPlan
{
    readonly void AddMember(ref DirectIsland island, ReadOnlySpan<ConstraintHandle> handles, ReadOnlySpan<int> references)
    {
        var lane = island.MemberCount++;
        for (int k = island.FirstNode; k < island.EndNode; ++k)
            Members[k * Lanes + lane].Handle = handles[Nodes[k].Place];
        for (int i = 0; i < references.Length; ++i)
            Bodies[(island.FirstBody + i) * Lanes + lane] = references[i];
    }

    // Whether a structure can be solved beside those of an island.
    readonly bool IsEqual(in DirectIsland island, ReadOnlySpan<DirectNode> joints, int bodyCount, int dynamicCount)
    {
        if (island.MemberCount == Lanes || island.EndNode - island.FirstNode != joints.Length || island.EndBody - island.FirstBody != bodyCount ||
            island.DynamicCount != dynamicCount)
            return false;
        for (int k = island.FirstNode; k < island.EndNode; ++k)
        {
            ref var node = ref Nodes[k];
            ref readonly var joint = ref joints[node.Place];
            if (node.TypeId != joint.TypeId)
                return false;
            for (int slot = 0; slot < node.BodyCount; ++slot)
            {
                if (node.Bodies[slot] != island.FirstBody + joint.Bodies[slot])
                    return false;
            }
        }
        return true;
    }

    static ulong HashOf(ReadOnlySpan<DirectNode> joints, int bodyCount, int dynamicCount)
    {
        var hash = Mixed(Mixed(0, bodyCount), dynamicCount);
        foreach (ref readonly var joint in joints)
        {
            hash = Mixed(hash, joint.TypeId);
            for (int slot = 0; slot < joint.BodyCount; ++slot)
                hash = Mixed(hash, joint.Bodies[slot]);
        }
        return hash;
    }

    // A step of MurmurHash3's finalizer.
    static ulong Mixed(ulong hash, int number)
    {
        hash = (hash + (uint)number + 1) * 0xFF51AFD7ED558CCD;
        return hash ^ (hash >> 33);
    }

    struct HashOfHash : IEqualityComparerRef<ulong>
    {
        public readonly int Hash(ref ulong item) => (int)item;

        public readonly bool Equals(ref ulong a, ref ulong b) => a == b;
    }
}
