using System.Runtime.CompilerServices;
using BepuPhysics;
using Xunit;

namespace DemoTests.Utilities;

/// <summary>Frames of what is called are at the same place of a cache line wherever the stack is.</summary>
public unsafe class StackLineTests
{
    struct Local
    {
        public long A, B, C, D;
    }

    [Fact]
    public void FramesBelowAreAtTheSamePlaceOfALine()
    {
        var first = Look(0, onLine: true);
        for (int used = 16; used < 128; used += 16)
            Assert.Equal(first, Look(used, onLine: true));
    }

    [Fact]
    public void WithoutItTheyAreWhereverTheStackIs()
    {
        var first = Look(0, onLine: false);
        Assert.NotEqual(first, Look(16, onLine: false));
        Assert.NotEqual(first, Look(48, onLine: false));
    }

    // The stack is moved by as much as is taken of it first.
    [MethodImpl(MethodImplOptions.NoInlining)]
    static nuint Look(int used, bool onLine)
    {
        var taken = stackalloc byte[16 + used];
        *taken = 1;
        return onLine ? CallOnLine() : PlaceOfFrame();
    }

    [MethodImpl(MethodImplOptions.NoInlining)]
    static nuint CallOnLine()
    {
        var above = stackalloc byte[StackLine.Length];
        var line = stackalloc byte[StackLine.BytesBelow(above, 72)];
        Assert.Equal(0u, (nuint)line % StackLine.Length);
        Assert.True(above - line >= 72);
        *line = 0;
        return PlaceOfFrame();
    }

    [MethodImpl(MethodImplOptions.NoInlining)]
    static nuint PlaceOfFrame()
    {
        Local local;
        local.A = 1;
        return (nuint)(&local) % StackLine.Length;
    }
}
