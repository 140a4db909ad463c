using System.Runtime.InteropServices;

namespace BepuUtilities.TaskScheduling;

/// <summary>What belongs to one worker of a <see cref="TaskStack"/>. Two cache lines, for those are fetched in pairs.</summary>
[StructLayout(LayoutKind.Explicit, Size = Size)]
struct TaskStackWorker
{
    public const int Size = 128;

    // Used by this worker alone.
    [FieldOffset(0)] public TaskStackArena Jobs;
    [FieldOffset(8)] public TaskStackArena Continuations;
    // Any worker may be the one to complete them.
    [FieldOffset(64)] public int ActiveContinuationCount;
}
