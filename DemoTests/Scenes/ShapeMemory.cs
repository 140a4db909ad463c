using System.Collections.Generic;
using BepuPhysics;
using BepuPhysics.Collidables;

namespace DemoTests.Scenes;

/// <summary>Memory that shapes own, and that a simulation therefore leaves to others.</summary>
static class ShapeMemory
{
    /// <summary>Removes all bodies and statics, and disposes of their hulls: a shape that is in use stays.</summary>
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
        while (simulation.Bodies.ActiveSet.Count > 0)
            simulation.Bodies.RemoveAt(simulation.Bodies.ActiveSet.Count - 1);
        while (simulation.Statics.Count > 0)
            simulation.Statics.RemoveAt(simulation.Statics.Count - 1);
        foreach (var shape in hulls)
        {
            // Shapes that own memory. Children of compounds are of simple types here.
            if (shape.Exists && shape.Type is ConvexHull.Id or Compound.Id or BigCompound.Id or Mesh.Id or HeightField.Id)
                simulation.Shapes.RemoveAndDispose(shape, simulation.BufferPool);
        }
    }
}
