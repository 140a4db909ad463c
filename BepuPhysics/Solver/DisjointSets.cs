using System;
using BepuUtilities.Memory;

namespace BepuPhysics;

/// <summary>Sets that are joined two by two: each member has a parent, and the root of a set is its own.</summary>
static class DisjointSets
{
    /// <summary>Makes each member a set of its own.</summary>
    internal static void Begin(Buffer<int> parents, int count)
    {
        for (int i = 0; i < count; ++i)
            parents[i] = i;
    }

    /// <summary>Root of the set that a member is in.</summary>
    // Every step halves the path, so that no forest grows deep.
    internal static int Root(Buffer<int> parents, int member)
    {
        while (parents[member] != member)
            member = parents[member] = parents[parents[member]];
        return member;
    }

    /// <summary>Joins the set of a member with that of those before it.</summary>
    /// <param name="parents">Of each member, one of its set.</param>
    /// <param name="joined">Root of the set of those before it; less than zero for the first.</param>
    /// <param name="member">The member.</param>
    /// <returns>Root of the set of all of them.</returns>
    internal static int JoinNext(Buffer<int> parents, int joined, int member)
    {
        var root = Root(parents, member);
        return joined < 0 || joined == root ? root : Join(parents, joined, root);
    }

    /// <summary>Joins the sets of two roots and returns their common one, the lower of the two.</summary>
    internal static int Join(Buffer<int> parents, int rootA, int rootB)
    {
        var root = Math.Min(rootA, rootB);
        parents[Math.Max(rootA, rootB)] = root;
        return root;
    }
}
