using System;
using System.Runtime.InteropServices;
using BepuUtilities.Memory;

namespace BepuUtilities.TaskScheduling;

/// <summary>Memory that one worker hands out in cache lines and that is given back all at once.</summary>
unsafe struct TaskStackArena
{
    public const int LineSize = 64;

    Block* newest;

    /// <summary>Number of lines of the newest block; zero when there is none.</summary>
    public readonly int NewestBlockLength => newest == null ? 0 : newest->Lines.Length;

    /// <summary>Takes a number of lines. Their contents are undefined.</summary>
    /// <param name="lineCount">Number of lines.</param>
    /// <param name="blockLength">Least number of lines of a new block, should one be needed.</param>
    /// <param name="pool">Pool that blocks come from; the same one each time.</param>
    public void* Take(int lineCount, int blockLength, BufferPool pool)
    {
        if (newest == null || newest->Lines.Length - newest->Used < lineCount)
        {
            // The first line of a block holds the block itself.
            pool.TakeAtLeast<Line>(Math.Max(blockLength, lineCount) + 1, out var lines);
            var block = (Block*)lines.Memory;
            *block = new Block { Lines = lines, Previous = newest, Used = 1 };
            newest = block;
        }
        var result = newest->Lines.Memory + newest->Used;
        newest->Used += lineCount;
        return result;
    }

    /// <summary>Gives everything back to the pool that it came from.</summary>
    public void Return(BufferPool pool)
    {
        while (newest != null)
        {
            // The block lies in what is returned.
            var block = *newest;
            pool.Return(ref block.Lines);
            newest = block.Previous;
        }
    }

    [StructLayout(LayoutKind.Explicit, Size = LineSize)]
    struct Line;

    struct Block
    {
        public Buffer<Line> Lines;
        public Block* Previous;
        public int Used;
    }
}
