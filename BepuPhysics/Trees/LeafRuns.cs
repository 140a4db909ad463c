using System;
using System.Numerics;
using System.Runtime.CompilerServices;
using System.Runtime.Intrinsics;
using BepuUtilities.Diagnostics;
using BepuUtilities.Memory;

namespace BepuPhysics.Trees;

/// <summary>
/// Boxes of a tree's leaves in depth-first order, one array for each coordinate: the leaves of every subtree are a run in them, and one
/// box is tested against
/// eight neighbours of a run by six comparisons.
/// </summary>
/// <remarks>A copy for the time in which overlaps are looked for. Eight at a time on every processor, so nothing depends on the width of
/// vectors.</remarks>
unsafe struct LeafRuns
{
    /// <summary>Subtrees with no more leaves than this are tested as runs instead of being descended into.</summary>
    public const int RunLength = 8;

    const int ArrayCount = 7;
    // Two cache lines: what threads write over and over without need, they write apart.
    const int Separation = 32;

    Buffer<float> memory;
    Buffer<int> firstLeaves;
    TreeParts parts;
    readonly int stride;
    readonly int* packings;

    /// <summary>For each set of eight lanes the lanes in it, moved to the front.</summary>
    static readonly int[] Packings = MakePackings();

    /// <summary>Copies the boxes of a tree in depth-first order.</summary>
    public LeafRuns(in Tree tree, BufferPool pool) : this(tree, 0, pool) => Fill(tree, 0, tree.NodeCount, tree.NodeCount);

    /// <summary>Prepares for a tree of at least two leaves in depth-first order; its boxes are copied by <see cref="FillPart"/>.</summary>
    public static LeafRuns Prepare(in Tree tree, int threadCount, BufferPool pool)
    {
        var parts = new TreeParts(tree, threadCount, pool);
        var runs = new LeafRuns(tree, parts.Parts.Count * Separation, pool) { parts = parts };
        for (var i = 0; i < parts.Tops.Count; ++i)
            runs.Fill(tree, parts.Tops[i], parts.Tops[i] + 1, tree.NodeCount);
        return runs;
    }

    /// <summary>Number of independent parts whose boxes are left to be copied.</summary>
    public readonly int PartCount => parts.Parts.Count;

    /// <summary>Copies the boxes of one part.</summary>
    public readonly void FillPart(in Tree tree, int part) =>
        Fill(tree, parts.Parts[part].Start, parts.Parts[part].End, tree.NodeCount + (part + 1) * Separation);

    LeafRuns(in Tree tree, int unused, BufferPool pool)
    {
        Check.That(tree.IsDepthFirst);
        // Whole runs are read wherever a run begins, so a run of padding follows the last leaf.
        stride = tree.LeafCount + RunLength;
        packings = (int*)Unsafe.AsPointer(ref Packings[0]);
        pool.TakeAtLeast(ArrayCount * stride, out memory);
        pool.TakeAtLeast(tree.NodeCount + 1 + unused, out firstLeaves);
        firstLeaves[0] = 0;
        // One run of eight floats.
        for (var array = 0; array < ArrayCount; ++array)
            Vector256<float>.Zero.Store(memory.Memory + tree.LeafCount + array * stride);
    }

    public void Dispose(BufferPool pool)
    {
        pool.Return(ref memory);
        pool.Return(ref firstLeaves);
        if (parts.Tops.Span.Allocated)
            parts.Dispose(pool);
    }

    /// <summary>Place of the first leaf below a node. The node's first child begins there too, its second after all leaves of the
    /// first.</summary>
    public readonly int* FirstLeaves => firstLeaves.Memory;

    /// <summary>Index in the tree of the leaf at each place.</summary>
    public readonly int* LeafIndices => (int*)memory.Memory + 6 * stride;

    // The nodes [start, end), where the place of a first leaf that nobody asks for is written to an index past the last node.
    readonly void Fill(in Tree tree, int start, int end, int unused)
    {
        var first = firstLeaves.Memory;
        var boxes = memory.Memory;
        var indices = LeafIndices;
        for (var node = start; node < end; ++node)
        {
            var child = tree.Children + 2 * node;
            var place = first[node];
            for (var side = 0; side < 2; ++side, ++child)
            {
                // No branch on what a child is: a subtree is written where its first leaf will be, and that comes later in order.
                var index = child->Index;
                first[index < 0 ? unused : index] = place;
                boxes[place] = child->Min.X;
                boxes[place + stride] = child->Min.Y;
                boxes[place + 2 * stride] = child->Min.Z;
                boxes[place + 3 * stride] = child->Max.X;
                boxes[place + 4 * stride] = child->Max.Y;
                boxes[place + 5 * stride] = child->Max.Z;
                indices[place] = ~index;
                place += child->LeafCount;
            }
        }
    }

    static int[] MakePackings()
    {
        // Pinned, so that a pointer to it may be kept.
        var table = GC.AllocateArray<int>(256 * RunLength, pinned: true);
        for (var mask = 0; mask < 256; ++mask)
        {
            var count = 0;
            for (var lane = 0; lane < RunLength; ++lane)
            {
                if ((mask & 1 << lane) != 0)
                    table[mask * RunLength + count++] = lane;
            }
        }
        return table;
    }

    /// <summary>Bits of the leaves of a run that overlap or touch a box.</summary>
    /// <param name="queryMin">Lower corner of the box: x, and two and one strides further y and z.</param>
    /// <param name="queryMax">Upper corner of the box, likewise.</param>
    /// <param name="queryStride">Distance of a corner's coordinates.</param>
    /// <param name="first">Place of the run's first leaf.</param>
    /// <param name="count">Leaves in the run, at most <see cref="RunLength"/>.</param>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    readonly uint FindOverlaps(float* queryMin, float* queryMax, int queryStride, int first, int count)
    {
        var box = memory.Memory + first;
        var apart = (Vector256.LessThan(Vector256.Create(*queryMax), Vector256.Load(box))
                | Vector256.GreaterThan(Vector256.Create(*queryMin), Vector256.Load(box + 3 * stride)))
            | (Vector256.LessThan(Vector256.Create(queryMax[queryStride]), Vector256.Load(box + stride))
                | Vector256.GreaterThan(Vector256.Create(queryMin[queryStride]), Vector256.Load(box + 4 * stride)))
            | (Vector256.LessThan(Vector256.Create(queryMax[2 * queryStride]), Vector256.Load(box + 2 * stride))
                | Vector256.GreaterThan(Vector256.Create(queryMin[2 * queryStride]), Vector256.Load(box + 5 * stride)));
        return ~apart.ExtractMostSignificantBits() & ((1u << count) - 1);
    }

    /// <inheritdoc cref="FindOverlaps(float*, float*, int, int, int)"/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public readonly uint FindOverlaps(NodeChild* query, int first, int count) =>
        FindOverlaps((float*)query, (float*)query + 4, 1, first, count);

    /// <summary>Bits of the leaves of a run that overlap or touch the leaf at a place.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public readonly uint FindOverlaps(int place, int first, int count) =>
        FindOverlaps(memory.Memory + place, memory.Memory + place + 3 * stride, stride, first, count);

    /// <summary>Writes those of eight values whose bits are set, one after the other and then rubbish up to eight; returns how many are
    /// meant.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public readonly int Pack(Vector256<int> values, uint mask, int* target)
    {
        Vector256.ShuffleNative(values, Vector256.Load(packings + RunLength * mask)).Store(target);
        return BitOperations.PopCount(mask);
    }
}
