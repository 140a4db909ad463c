using System;
using System.Linq;
using BepuPhysics;
using BepuUtilities.Memory;

namespace DemoTests.Quality;

// Docs/Guides/Rollback.md.
static partial class DocSamples
{
    public static byte[] Write(SimulationSnapshot snapshot)
    {
        var bytes = new byte[snapshot.SerializedByteCount];
        snapshot.WriteTo(bytes);
        return bytes;
    }

    public sealed class Rollback(Simulation simulation, BufferPool pool, int frames, Action<int> applyInputs)
    {
        readonly SimulationSnapshot[] ring = [.. Enumerable.Range(0, frames).Select(_ => new SimulationSnapshot(pool))];

        public int Frame { get; private set; }

        public void Step()
        {
            simulation.Save(ring[Frame % ring.Length]);
            applyInputs(Frame++);
            simulation.Timestep(1 / 60f);
        }

        // Inputs from a frame on have changed: that frame and all since are taken again.
        public void CorrectFrom(int frame)
        {
            var now = Frame;
            simulation.Restore(ring[frame % ring.Length]);
            Frame = frame;
            while (Frame < now)
                Step();
        }
    }
}
