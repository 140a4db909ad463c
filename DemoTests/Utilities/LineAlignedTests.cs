using System.Runtime.CompilerServices;
using BepuPhysics;
using BepuUtilities;
using Xunit;

namespace DemoTests.Utilities;

/// <summary>Values on the stack that begin with a cache line do so wherever the stack is, and within their room.</summary>
public unsafe class LineAlignedTests
{
    [Fact]
    public void BeginsWithALineWithinItsRoom()
    {
        for (int used = 0; used < 128; used += 8)
            Look(used);
    }

    // The stack is moved by as much as is taken of it first.
    [MethodImpl(MethodImplOptions.NoInlining)]
    static void Look(int used)
    {
        var taken = stackalloc byte[used + 1];
        taken[used] = 1;
        LookBelow();
    }

    [MethodImpl(MethodImplOptions.NoInlining)]
    static void LookBelow()
    {
        Unsafe.SkipInit(out LineAligned<Rows8> room);
        var start = (byte*)&room;
        var value = (byte*)room.Pointer;
        Assert.Equal(0, (nint)value & 63);
        Assert.InRange(value - start, 0, sizeof(LineAligned<Rows8>) - sizeof(Rows8));
    }
}
