using System;
using System.Runtime.InteropServices;
using BepuUtilities.Diagnostics;

namespace BepuPhysics;

// Looking at the whole state: for tests, and for finding out where two runs part.
public sealed partial class Simulation
{
    /// <summary>Walks all that must hold between steps: handles, lists, constraint batches, pairs, trees, id pools, numbers.</summary>
    /// <remarks>
    /// Takes about as long as a step, and works in release builds. Not from within a step, and not between writing bounds through pointers
    /// and the next step. A failure is a defect of the library, a number or an inertia that was written through a reference, or the removal
    /// of a shape that is in use.
    /// </remarks>
    /// <exception cref="PhysicsInvariantException">Something does not hold; the message says what and where.</exception>
    public void Validate()
    {
        using var reading = world.Read("Simulation.Validate");
        BroadPhase.Validate();
        Bodies.Validate();
        Statics.Validate();
        Solver.Validate();
        NarrowPhase.Validate();
        islands.Validate();
    }

    /// <summary>Hash of the bits of all poses and velocities, in the order of the slots of handles.</summary>
    /// <remarks>Equal on all machines, for any number of threads and any width of vectors, after the same calls on the same build.</remarks>
    public ulong StateHash()
    {
        using var reading = world.Read("Simulation.StateHash");
        StateHash hash = default;
        Span<float> numbers = stackalloc float[13];
        for (int slot = 0; slot <= Bodies.HandlePool.HighestPossiblyClaimedId; ++slot)
        {
            var location = Bodies.Locations[slot];
            if (location.SetIndex < 0)
                continue;
            ref var motion = ref Bodies.Sets[location.SetIndex].MotionStates[location.Index];
            // Without the padding, which is nobody's state.
            (numbers[0], numbers[1], numbers[2], numbers[3]) =
                (motion.Pose.Orientation.X, motion.Pose.Orientation.Y, motion.Pose.Orientation.Z, motion.Pose.Orientation.W);
            motion.Pose.Position.CopyTo(numbers[4..]);
            motion.Velocity.Linear.CopyTo(numbers[7..]);
            motion.Velocity.Angular.CopyTo(numbers[10..]);
            hash.Add(MemoryMarshal.AsBytes(numbers));
        }
        return hash.Value;
    }
}
