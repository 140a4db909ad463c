using System;
using System.Numerics;
using BepuUtilities.Memory;

namespace BepuPhysics.Constraints;

/// <summary>In which order the joints of a structure are eliminated, so that few blocks come to be that were not there.</summary>
// A tree, from its leaves to its root, gets none: when a joint is eliminated, the others that are left on its outer body are none, and those on its inner
// body are neighbours of each other anyway. With loops, the joint with the fewest neighbours is next: minimum degree, by rows of bits.
static class EliminationOrder
{
    /// <summary>Joints of a tree, leaves first.</summary>
    /// <param name="graph">The structure.</param>
    /// <param name="order">Receives the joints.</param>
    /// <param name="pool">Memory for the time being.</param>
    internal static void OfTree(in JointGraph graph, Span<int> order, BufferPool pool)
    {
        var count = order.Length;
        pool.Take<byte>(count, out var isKnown);
        isKnown.Clear(0, count);
        // From the root outwards, filled from the end.
        var next = count - 1;
        order[next] = 0;
        isKnown[0] = 1;
        for (int i = count - 1; i >= 0; --i)
        {
            foreach (var body in graph.BodiesOf(order[i]))
            {
                foreach (var joint in graph.JointsOf(body))
                {
                    if (isKnown[joint] != 0)
                        continue;
                    isKnown[joint] = 1;
                    order[--next] = joint;
                }
            }
        }
        pool.Return(ref isKnown);
    }

    /// <summary>Joints of any structure, the one with the fewest neighbours first.</summary>
    /// <param name="graph">The structure.</param>
    /// <param name="order">Receives the joints.</param>
    /// <param name="pool">Memory for the time being.</param>
    internal static void ByDegree(in JointGraph graph, Span<int> order, BufferPool pool)
    {
        var count = order.Length;
        var words = (count + 63) / 64;
        pool.Take<ulong>(count * words, out var neighbours);
        neighbours.Clear(0, count * words);
        pool.Take<int>(count, out var degrees);
        for (int joint = 0; joint < count; ++joint)
        {
            var row = neighbours.Slice(joint * words, words);
            foreach (var body in graph.BodiesOf(joint))
            {
                foreach (var other in graph.JointsOf(body))
                    row[other >> 6] |= 1ul << (other & 63);
            }
            row[joint >> 6] &= ~(1ul << (joint & 63));
            degrees[joint] = Count(row);
        }
        for (int i = 0; i < count; ++i)
        {
            var joint = Least(degrees, count);
            order[i] = joint;
            degrees[joint] = int.MaxValue;
            var row = neighbours.Slice(joint * words, words);
            for (int word = 0; word < words; ++word)
            {
                for (var bits = row[word]; bits != 0; bits &= bits - 1)
                {
                    var other = word * 64 + BitOperations.TrailingZeroCount(bits);
                    var rowOfOther = neighbours.Slice(other * words, words);
                    for (int j = 0; j < words; ++j)
                        rowOfOther[j] |= row[j];
                    rowOfOther[joint >> 6] &= ~(1ul << (joint & 63));
                    rowOfOther[other >> 6] &= ~(1ul << (other & 63));
                    degrees[other] = Count(rowOfOther);
                }
            }
        }
        pool.Return(ref degrees);
        pool.Return(ref neighbours);
    }

    static int Least(Buffer<int> degrees, int count)
    {
        var least = 0;
        for (int i = 1; i < count; ++i)
        {
            if (degrees[i] < degrees[least])
                least = i;
        }
        return least;
    }

    static int Count(Buffer<ulong> row)
    {
        var count = 0;
        for (int i = 0; i < row.Length; ++i)
            count += BitOperations.PopCount(row[i]);
        return count;
    }
}
