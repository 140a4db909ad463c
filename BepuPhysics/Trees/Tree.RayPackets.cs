using System.Numerics;
using System.Runtime.Intrinsics;
using BepuUtilities.Memory;

namespace BepuPhysics.Trees;

public unsafe partial struct Tree
{
    struct PendingPacketVisit
    {
        public Vector256<float> T;
        public int Index;
        public uint Rays;
    }

    /// <summary>Tells which leaves have boxes that rays meet, near subtrees first, as the first of those has it that meet both.</summary>
    /// <param name="packet">The rays.</param>
    /// <param name="pool">Passed on to the callback.</param>
    /// <param name="leafTester">Receives the leaves on the calling thread, ray by ray.</param>
    internal readonly void RayCast<TLeafTester>(ref RayPacket packet, BufferPool pool, ref TLeafTester leafTester) where TLeafTester : IRayLeafTester
    {
        if (LeafCount == 0)
            return;
        var children = Children;
        var stack = stackalloc PendingPacketVisit[TraversalStackSize];
        var count = 0;
        var index = 0;
        // One query goes through two trees: the first may have ended it.
        var rays = FindNotEnded(packet, Vector256<float>.Zero) & (1u << packet.Count) - 1;
        while (true)
        {
            if (index < 0)
            {
                TestLeaf(ref packet, rays, ~index, pool, ref leafTester);
            }
            else
            {
                var a = children + 2 * index;
                var b = a + 1;
                var meetA = packet.FindMeeting(a, out var tA) & rays;
                var meetB = packet.FindMeeting(b, out var tB) & rays;
                if (meetA != 0 && meetB != 0)
                {
                    var both = meetA & meetB;
                    var lane = BitOperations.TrailingZeroCount(both);
                    if (both == 0 || tA.GetElement(lane) <= tB.GetElement(lane))
                    {
                        stack[count++] = new() { T = tB, Index = b->Index, Rays = meetB };
                        (index, rays) = (a->Index, meetA);
                    }
                    else
                    {
                        stack[count++] = new() { T = tA, Index = a->Index, Rays = meetA };
                        (index, rays) = (b->Index, meetB);
                    }
                    continue;
                }
                if (meetA != 0)
                {
                    (index, rays) = (a->Index, meetA);
                    continue;
                }
                if (meetB != 0)
                {
                    (index, rays) = (b->Index, meetB);
                    continue;
                }
            }
            do
            {
                if (count == 0)
                    return;
                --count;
                rays = stack[count].Rays & FindNotEnded(packet, stack[count].T);
            }
            while (rays == 0);
            index = stack[count].Index;
        }
    }

    // A callback may have shortened rays since.
    static uint FindNotEnded(in RayPacket packet, Vector256<float> t) => Vector256.LessThanOrEqual(t, packet.MaximumT).ExtractMostSignificantBits();

    static void TestLeaf<TLeafTester>(ref RayPacket packet, uint rays, int leafIndex, BufferPool pool, ref TLeafTester leafTester)
        where TLeafTester : IRayLeafTester
    {
        fixed (RayPacket* pointer = &packet)
        {
            for (; rays != 0; rays &= rays - 1)
            {
                var lane = BitOperations.TrailingZeroCount(rays);
                leafTester.TestLeaf(leafIndex, (RayData*)&pointer->Data + lane, (float*)&pointer->MaximumT + lane, pool);
            }
        }
    }
}
