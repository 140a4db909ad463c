using System;
using BepuPhysics.Collidables;
using BepuPhysics.CollisionDetection;
using BepuUtilities.Memory;

namespace BepuPhysics;

/// <summary>Measures how near the shape of a collidable is whose bounds are.</summary>
/// <typeparam name="THandler">Type of the handler.</typeparam>
unsafe struct WorldProximity<THandler> : IBroadPhaseSweepTester, ISweepFilter where THandler : IProximityHandler
{
    public Simulation Simulation;
    public BufferPool Pool;
    public THandler Handler;
    /// <summary>Layers that the query is in and meets, if it has any.</summary>
    public CollisionLayers? Layers;
    /// <summary>Where the shape is, on the stack of the caller; of the collidable nothing.</summary>
    public SweepMotion* Motion;
    /// <summary>The shape.</summary>
    public ImpactBody* Shape;
    /// <summary>Its position, m.</summary>
    public DoubleVector3 Position;

    CollidableReference collidable;

    /// <inheritdoc/>
    public void Test(CollidableReference collidable, ref float maximumT)
    {
        if (Layers is { } layers && !CollisionLayers.MayMeet(layers, Simulation.Layers.Of(collidable)))
            return;
        if (!Handler.AllowTest(collidable))
            return;
        Simulation.GetPoseAndShape(collidable, out var pose, out var shape);
        if (!SweepPairs.IsKnown(shape.Type))
            return;
        this.collidable = collidable;
        Motion->OrientationB = DoubleMatrix3x3.FromQuaternion(pose.Orientation);
        Motion->OffsetB = new DoubleVector3(pose.Position) - Position;
        var nearest = new NearestPart(maximumT);
        var data = Simulation.Shapes.GetBatch(shape.Type).GetPointer(shape.Index);
        DistancePairs.Test(*Motion, ref *Shape, shape.Type, data, ref this, Simulation.Shapes, Pool, ref nearest);
        if (!nearest.Exists)
            return;
        ref readonly var found = ref nearest.Found;
        var distance = (float)found.Distance;
        var proximity = new Proximity
        {
            Collidable = collidable,
            ChildIndex = nearest.Child,
            Overlaps = found.Overlaps,
            Distance = distance < found.Distance ? MathF.BitIncrement(distance) : distance,
        };
        if (!found.Overlaps)
        {
            proximity.Normal = found.Normal.ToSingle();
            proximity.Place = (Position + found.Place).ToSingle();
        }
        Handler.OnProximity(ref maximumT, proximity);
    }

    /// <inheritdoc/>
    public bool AllowTest(int childA, int childB) => Handler.AllowTest(collidable, childB);
}
