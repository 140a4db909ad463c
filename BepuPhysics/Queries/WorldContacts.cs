using System.Runtime.CompilerServices;
using BepuPhysics.Collidables;
using BepuPhysics.CollisionDetection;
using BepuUtilities;

namespace BepuPhysics;

/// <summary>Tests the shape of a collidable whose bounds are near, together with others.</summary>
/// <typeparam name="THandler">Type of the handler.</typeparam>
unsafe struct WorldContacts<THandler> : IBreakableForEach<CollidableReference> where THandler : IShapeContactHandler
{
    public Simulation Simulation;
    /// <summary>The batcher, on the stack of the caller: where it is returned whatever a handler throws.</summary>
    public void* BatcherOfCaller;
    /// <summary>Layers that the query is in and meets, if it has any.</summary>
    public CollisionLayers? Layers;
    /// <summary>The shape, on the stack of the caller.</summary>
    public void* Shape;
    /// <summary>Its type.</summary>
    public int ShapeType;
    /// <summary>Where it is.</summary>
    public RigidPose Pose;
    /// <summary>Greatest distance at which contacts are wanted, m.</summary>
    public float Margin;

    readonly ref CollisionBatcher<Receiver> Batcher => ref Unsafe.AsRef<CollisionBatcher<Receiver>>(BatcherOfCaller);

    /// <inheritdoc/>
    public readonly bool LoopBody(CollidableReference collidable)
    {
        if (!Simulation.MayMeet(Layers, collidable) || !Batcher.Callbacks.Handler.AllowTest(collidable))
            return true;
        Simulation.GetPoseAndShape(collidable, out var pose, out var shape);
        if (!Simulation.NarrowPhase.CollisionTaskRegistry.TryGetTask(ShapeType, shape.Type, out var task, out var taskIndex, out var flipped))
            return true;
        var data = Simulation.Shapes.GetBatch(shape.Type).GetPointer(shape.Index);
        var offset = pose.Position - Pose.Position;
        if (CentreLine.ShowsApart(ShapeType, Shape, Pose.Orientation, shape.Type, data, pose.Orientation, offset, Margin))
            return true;
        // A reference names its collidable, and any number may name a pair.
        Batcher.AddKnown(task, taskIndex, flipped, Shape, data, offset, Pose.Orientation, pose.Orientation, Margin, (int)collidable.Packed);
        return true;
    }

    /// <summary>Tells the handler about the contacts.</summary>
    public struct Receiver : ICollisionCallbacks
    {
        public THandler Handler;

        static bool ICollisionCallbacks.ChangesChildren => false;

        public bool AllowCollisionTesting(int pairId, int childA, int childB) => Handler.AllowTest(Collidable(pairId), childB);

        public readonly void OnChildPairCompleted(int pairId, int childA, int childB, ref ConvexContactManifold manifold) { }

        public void OnPairCompleted<TManifold>(int pairId, ref TManifold manifold) where TManifold : unmanaged, IContactManifold<TManifold>
        {
            if (manifold.Count > 0)
                Handler.OnContacts(Collidable(pairId), ref manifold);
        }

        static CollidableReference Collidable(int pairId) => new() { Packed = (uint)pairId };
    }
}
