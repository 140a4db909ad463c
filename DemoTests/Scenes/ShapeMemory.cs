using System.Collections.Generic;
using System.Linq;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuUtilities.Memory;

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
        // Those that sleep.
        simulation.Bodies.Clear();
        // Compounds before their children, which several of them may share.
        foreach (var shape in hulls.Where(shape => shape.Exists).ToArray())
        {
            if (shape.Type is Compound.Id)
                Add(simulation.Shapes.GetShape<Compound>(shape.Index).Children);
            else if (shape.Type is BigCompound.Id)
                Add(simulation.Shapes.GetShape<BigCompound>(shape.Index).Children);
            if (shape.Type is Compound.Id or BigCompound.Id)
                simulation.Shapes.RemoveAndDispose(shape, simulation.BufferPool);
        }
        foreach (var shape in hulls)
        {
            if (shape.Exists && shape.Type is ConvexHull.Id or Mesh.Id or HeightField.Id)
                simulation.Shapes.RemoveAndDispose(shape, simulation.BufferPool);
        }

        void Add(Buffer<CompoundChild> children)
        {
            foreach (ref var child in children.AsSpan())
                hulls.Add(child.ShapeIndex);
        }
    }
}
