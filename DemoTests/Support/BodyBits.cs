using System;
using System.Runtime.InteropServices;
using BepuPhysics;

namespace DemoTests.Support;

/// <summary>Poses and velocities of bodies, bit by bit.</summary>
static class BodyBits
{
    /// <summary>Those of all bodies that are awake, in their order.</summary>
    public static unsafe int[] Of(Simulation simulation)
    {
        ref var set = ref simulation.Bodies.ActiveSet;
        return MemoryMarshal.Cast<MotionState, int>(new ReadOnlySpan<MotionState>(set.MotionStates.Memory, set.Count)).ToArray();
    }
}
