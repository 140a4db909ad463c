using System.Collections.Generic;
using BepuPhysics;
using BepuPhysics.Collidables;

namespace DemoTests.Scenes;

/// <summary>Memory that shapes own, and that a simulation therefore leaves to others.</summary>
static class ShapeMemory
{
    /// <summary>Disposes of the hulls of all bodies and statics; the simulation is not to be stepped any more.</summary>
    public static void DisposeHulls(this Simulation simulation)
    {
        var hulls = new HashSet<TypedIndex>();
        foreach (ref var set in simulation.Bodies.Sets.AsSpan())
        {
            for (int i = 0; i < set.Count; ++i)
                hulls.Add(set.Collidables[i].Shape);
        }
        for (int i = 0; i < simulation.Statics.Count; ++i)
            hulls.Add(simulation.Statics.StaticsBuffer[i].Shape);
        foreach (var shape in hulls)
        {
            if (shape.Exists && shape.Type == ConvexHull.Id)
                simulation.Shapes.RemoveAndDispose(shape, simulation.BufferPool);
        }
    }
}
