using BepuPhysics.Collidables;
using BepuPhysics.CollisionDetection;
using BepuUtilities.Memory;

namespace BepuPhysics;

/// <summary>Tests the shape of a collidable whose bounds a swept shape meets.</summary>
/// <typeparam name="THitHandler">Type of the handler.</typeparam>
unsafe struct WorldSweep<THitHandler> : IBroadPhaseSweepTester, ISweepFilter where THitHandler : ISweepHitHandler
{
    public Simulation Simulation;
    public BufferPool Pool;
    public THitHandler Handler;
    /// <summary>Layers that the sweep is in and meets, if it has any.</summary>
    public CollisionLayers? Layers;
    /// <summary>How the swept shape moves, on the stack of the caller; of the collidable only what has to do with its velocity.</summary>
    public SweepMotion* Motion;
    /// <summary>The swept shape.</summary>
    public ImpactBody* Swept;
    /// <summary>Position of the swept shape at the time zero, m.</summary>
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
        Motion->MaximumT = maximumT;
        Motion->OrientationB = DoubleMatrix3x3.FromQuaternion(pose.Orientation);
        Motion->OffsetB = new DoubleVector3(pose.Position) - Position;
        var hit = default(SweepHit);
        var data = Simulation.Shapes.GetBatch(shape.Type).GetPointer(shape.Index);
        SweepPairs.TestPart(*Motion, ref *Swept, 0, shape.Type, data, ref this, false, Simulation.Shapes, Pool, ref hit);
        if (!hit.Exists)
            return;
        if (hit.Overlaps)
            Handler.OnHitAtZeroT(ref maximumT, collidable);
        else
            Handler.OnHit(ref maximumT, hit.EarliestT, (Position + hit.Place).ToSingle(), hit.Normal.ToSingle(), collidable);
    }

    /// <inheritdoc/>
    public bool AllowTest(int childA, int childB) => Handler.AllowTest(collidable, childB);
}
