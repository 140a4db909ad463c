using BepuPhysics.Collidables;
using BepuPhysics.CollisionDetection;
using BepuUtilities.Memory;

namespace BepuPhysics;

/// <summary>A convex shape that is asked about in a world, and the collidable that it is compared with.</summary>
unsafe struct WorldQuery
{
    public Simulation Simulation;
    public BufferPool Pool;
    /// <summary>Layers that the query is in and meets, if it has any.</summary>
    public CollisionLayers? Layers;
    /// <summary>Where the shape is and how it moves, on the stack of the caller; of the collidable only what has to do with its velocity.</summary>
    public SweepMotion* Motion;
    /// <summary>The shape.</summary>
    public ImpactBody* Shape;
    /// <summary>Its position at the time zero, m.</summary>
    public DoubleVector3 Position;
    /// <summary>The collidable.</summary>
    public CollidableReference Collidable;

    /// <summary>Whether layers let the query meet a collidable.</summary>
    public readonly bool MayMeet(CollidableReference collidable) => Simulation.MayMeet(Layers, collidable);

    /// <summary>Puts a collidable where it is beside the shape.</summary>
    /// <param name="collidable">The collidable.</param>
    /// <param name="type">Type of its shape.</param>
    /// <param name="data">Its shape.</param>
    /// <returns>Whether it has a shape that there are answers for.</returns>
    public bool TryPlace(CollidableReference collidable, out int type, out void* data)
    {
        Simulation.GetPoseAndShape(collidable, out var pose, out var shape);
        type = shape.Type;
        data = null;
        if (!SweepPairs.IsKnown(type, Simulation.Shapes))
            return false;
        Collidable = collidable;
        Motion->OrientationB = DoubleMatrix3x3.FromQuaternion(pose.Orientation);
        Motion->OffsetB = new DoubleVector3(pose.Position) - Position;
        data = Simulation.Shapes.GetBatch(type).GetPointer(shape.Index);
        return true;
    }
}
