using System.Numerics;
using BepuUtilities.Collections;
using BepuUtilities.Memory;

namespace BepuPhysics.CollisionDetection;

/// <summary>Which of numbered pairs meets first, while the times of some change.</summary>
// A tree over the times in the order of numbers, in which each node has the earlier one of its two: a change goes up one path, and of equal times the one of
// the lowest number is found, whatever came before.
struct EarliestTime(BufferPool pool)
{
    // Node 1 is the root, nodes 2 i and 2 i + 1 are below node i, and the times are the last half.
    QuickList<double> nodes = new(32, pool);

    int LeafCount => nodes.Count / 2;

    /// <summary>Begins with numbers that never meet.</summary>
    public void Clear(int count, BufferPool pool)
    {
        nodes.Count = 0;
        var size = 2 * (int)BitOperations.RoundUpToPowerOf2((uint)count);
        nodes.EnsureCapacity(size, pool);
        nodes.Count = size;
        nodes.AsSpan().Fill(FastPair.Never);
    }

    /// <summary>Sets a time before <see cref="Arrange"/>.</summary>
    public void Note(int number, double time) => nodes[LeafCount + number] = time;

    /// <summary>Makes ready for <see cref="First"/>, when all is noted.</summary>
    public void Arrange()
    {
        for (int i = LeafCount - 1; i > 0; --i)
            nodes[i] = EarlierBelow(i);
    }

    /// <summary>Adds the next number.</summary>
    public void Add(int number, double time, BufferPool pool)
    {
        if (number >= LeafCount)
        {
            var old = LeafCount;
            nodes.EnsureCapacity(4 * old, pool);
            nodes.Count = 4 * old;
            nodes.AsSpan().Slice(old, old).CopyTo(nodes.AsSpan()[(2 * old)..]);
            nodes.AsSpan()[(3 * old)..].Fill(FastPair.Never);
            Arrange();
        }
        Change(number, time);
    }

    /// <summary>Changes a time.</summary>
    public void Change(int number, double time)
    {
        var node = LeafCount + number;
        nodes[node] = time;
        while ((node /= 2) > 0)
            nodes[node] = EarlierBelow(node);
    }

    /// <summary>The number with the earliest time, the lowest if there are several; -1 if nothing meets.</summary>
    public int First
    {
        get
        {
            if (!(nodes[1] < FastPair.Never))
                return -1;
            var node = 1;
            while (node < LeafCount)
                node = nodes[2 * node] <= nodes[2 * node + 1] ? 2 * node : 2 * node + 1;
            return node - LeafCount;
        }
    }

    double EarlierBelow(int node) => nodes[2 * node] <= nodes[2 * node + 1] ? nodes[2 * node] : nodes[2 * node + 1];

    public void Dispose(BufferPool pool) => nodes.Dispose(pool);
}
