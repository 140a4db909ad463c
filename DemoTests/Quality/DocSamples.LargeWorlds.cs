using System;
using System.Numerics;
using BepuPhysics;

namespace DemoTests.Quality;

// Docs/Guides/LargeWorlds.md.
static partial class DocSamples
{
    public sealed class LargeWorld(Simulation simulation)
    {
        // Where the simulation's origin is in the world of the game.
        public double X, Y, Z;

        // Between two steps.
        public void Follow(Vector3 player)
        {
            if (player.Length() < 1000)
                return;
            // Whole metres: what lies still keeps its place to the last bit.
            var shift = new Vector3(MathF.Round(player.X), MathF.Round(player.Y), MathF.Round(player.Z));
            simulation.ShiftOrigin(shift);
            (X, Y, Z) = (X + shift.X, Y + shift.Y, Z + shift.Z);
        }
    }
}
