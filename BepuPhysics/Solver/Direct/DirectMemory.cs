using System.Runtime.CompilerServices;
using System.Runtime.Intrinsics;
using BepuUtilities.Memory;

namespace BepuPhysics.Constraints;

/// <summary>Where the equations of an island are: one piece of memory, in which each thing has the place that the plan says.</summary>
readonly unsafe struct DirectMemory<TVectors, TNumbers>
    where TVectors : unmanaged, IVectors<TVectors, TNumbers> where TNumbers : unmanaged, INumbers<TNumbers>
{
    /// <summary>Jacobians, body by body of row by row.</summary>
    internal readonly DirectPair<TVectors, TNumbers>* Jacobians;
    /// <summary>M^-1 J^T.</summary>
    internal readonly DirectPair<TVectors, TNumbers>* Weighted;
    /// <summary>Bodies.</summary>
    internal readonly DirectBody<TVectors, TNumbers>* Bodies;
    /// <summary>Rows.</summary>
    internal readonly DirectRow<TNumbers>* Rows;
    /// <summary>Who is held.</summary>
    internal readonly DirectHold<TNumbers>* Holds;
    /// <summary>What is known of each joint while all is factored.</summary>
    internal readonly DirectState* States;
    /// <summary>For each joint, which of the blocks below it any structure has.</summary>
    internal readonly int* Live;
    /// <summary>The joints that are not held in all structures, after their number.</summary>
    internal readonly int* Free;
    /// <summary>Blocks.</summary>
    internal readonly TNumbers* Numbers;

    /// <summary>Finds it.</summary>
    /// <param name="memory">Memory of all islands.</param>
    /// <param name="island">The island.</param>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    internal DirectMemory(Vector256<double>* memory, in DirectIsland island)
    {
        // Places count from the first island.
        var start = (byte*)(memory + island.Memory);
        Jacobians = Place<DirectPair<TVectors, TNumbers>>(ref start, island.FirstPair, island.EndPair);
        Weighted = Place<DirectPair<TVectors, TNumbers>>(ref start, island.FirstPair, island.EndPair);
        Bodies = Place<DirectBody<TVectors, TNumbers>>(ref start, island.FirstBody, island.EndBody);
        Rows = Place<DirectRow<TNumbers>>(ref start, island.FirstRow, island.EndRow);
        Holds = Place<DirectHold<TNumbers>>(ref start, island.FirstNode, island.EndNode);
        Numbers = Place<TNumbers>(ref start, island.FirstNumber, island.EndNumber);
        States = Place<DirectState>(ref start, island.FirstNode, island.EndNode);
        Live = Place<int>(ref start, island.FirstBlock, island.EndBlock);
        Free = (int*)start;
    }

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static T* Place<T>(ref byte* start, int first, int end) where T : unmanaged
    {
        var place = (T*)start - first;
        start += (long)(end - first) * sizeof(T);
        return place;
    }

    /// <summary>How much memory an island takes.</summary>
    internal static int SizeOf(in DirectIsland island)
    {
        var bytes = (island.EndPair - island.FirstPair) * 2L * sizeof(DirectPair<TVectors, TNumbers>) +
            (island.EndBody - island.FirstBody) * (long)sizeof(DirectBody<TVectors, TNumbers>) +
            (island.EndRow - island.FirstRow) * (long)sizeof(DirectRow<TNumbers>) +
            (island.EndNode - island.FirstNode) * (long)sizeof(DirectHold<TNumbers>) +
            (island.EndNumber - island.FirstNumber) * (long)sizeof(TNumbers) +
            (island.EndNode - island.FirstNode) * (long)sizeof(DirectState) +
            (island.EndBlock - island.FirstBlock + island.EndNode - island.FirstNode + 1L) * sizeof(int);
        // Whole cache lines, and the widest vectors: what lies across two of them takes twice as long.
        return (int)((bytes + BufferPool.Alignment - 1) / BufferPool.Alignment * (BufferPool.Alignment / sizeof(Vector256<double>)));
    }
}
