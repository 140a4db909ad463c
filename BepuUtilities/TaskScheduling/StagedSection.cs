using System.Runtime.InteropServices;
using System.Threading;

namespace BepuUtilities.TaskScheduling;

/// <summary>A part of a stage's blocks, from which workers claim one after another. Two cache lines, for those are fetched in pairs.</summary>
/// <remarks>
/// The claim holds the stage in its high half and the next block in its low half. A stage's index occurs once and its blocks only
/// ascend, so a claim never has the same value twice, but for <see cref="Closed"/>: a compare-and-exchange that succeeds proves that
/// nothing has changed since the claim was read, the end of the section included, as that is written only while the claim is closed.
/// </remarks>
[StructLayout(LayoutKind.Explicit, Size = Size)]
struct StagedSection
{
    public const int Size = 128;
    const long Closed = -1;

    [FieldOffset(0)] long claim;
    [FieldOffset(8)] int end;

    /// <summary>Offers the blocks [start, end) of a stage. Only while nobody can claim any more of the stage before.</summary>
    public void Open(int stage, int start, int end)
    {
        // In this order for every observer: nobody may pair the old claim with the new end.
        Volatile.Write(ref claim, Closed);
        Volatile.Write(ref this.end, end);
        Volatile.Write(ref claim, ((long)stage << 32) | (uint)start);
    }

    /// <summary>Takes the next block of a stage, if the section is in that stage and has one.</summary>
    public bool TryClaim(int stage, out int block)
    {
        while (true)
        {
            var seen = Volatile.Read(ref claim);
            block = (int)seen;
            if ((int)(seen >> 32) != stage || block >= Volatile.Read(ref end))
                return false;
            if (Interlocked.CompareExchange(ref claim, seen + 1, seen) == seen)
                return true;
        }
    }
}
