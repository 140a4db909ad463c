using System;
using System.Numerics;
using System.Runtime.CompilerServices;
using BepuPhysics.Collidables;
using BepuPhysics.CollisionDetection;
using BepuPhysics.Trees;
using BepuUtilities.Memory;

namespace BepuPhysics;

// Questions to a simulation that change nothing in it.
public sealed partial class Simulation
{
    /// <summary>Finds what a ray hits.</summary>
    /// <remarks>
    /// Only reads: any number of threads may ask at once, each with a pool of its own, while none changes or steps the simulation. A body
    /// is found by its bounds of the last step; call <see cref="Bodies.UpdateBounds"/> after writing a pose.
    /// </remarks>
    /// <param name="origin">Where the ray starts, m.</param>
    /// <param name="direction">Direction of the ray; its length is the unit in which t is measured. A direction of zero length hits nothing.</param>
    /// <param name="maximumT">Length of the ray in units of its direction; may be infinite.</param>
    /// <param name="pool">Source of temporary memory; a pool of the calling thread.</param>
    /// <param name="hitHandler">Chooses what to test and receives the hits; copied in and copied back.</param>
    /// <param name="id">The caller's number for the ray.</param>
    /// <exception cref="ArgumentException">A component is not finite, or the length is negative or not a number.</exception>
    public void RayCast<THitHandler>(
        Vector3 origin, Vector3 direction, float maximumT, BufferPool pool, ref THitHandler hitHandler, int id = 0) where THitHandler : IRayHitHandler
    {
        using var reading = world.Read("Simulation.RayCast");
        CheckRay(origin, direction, maximumT, pool);
        var tester = new CollidableRayTester<THitHandler> { Simulation = this, Hits = new() { Handler = hitHandler } };
        BroadPhase.CastRay(origin, direction, maximumT, pool, ref tester, id);
        hitHandler = tester.Hits.Handler;
    }

    /// <summary>Finds what a ray hits, with the pool of the simulation: by one thread at a time.</summary>
    /// <remarks>As with a pool, which see. Threads that ask at once each pass a pool of their own.</remarks>
    /// <param name="origin">Where the ray starts, m.</param>
    /// <param name="direction">Direction of the ray; its length is the unit in which t is measured. A direction of zero length hits nothing.</param>
    /// <param name="maximumT">Length of the ray in units of its direction; may be infinite.</param>
    /// <param name="hitHandler">Chooses what to test and receives the hits; copied in and copied back.</param>
    /// <param name="id">The caller's number for the ray.</param>
    /// <exception cref="ArgumentException">A component is not finite, or the length is negative or not a number.</exception>
    public void RayCast<THitHandler>(Vector3 origin, Vector3 direction, float maximumT, ref THitHandler hitHandler, int id = 0)
        where THitHandler : IRayHitHandler => RayCast(origin, direction, maximumT, BufferPool, ref hitHandler, id);

    /// <summary>Finds what a ray hits among the collidables that its layers let it meet; the handler hears of no others.</summary>
    /// <remarks>As without layers, which see.</remarks>
    /// <param name="origin">Where the ray starts, m.</param>
    /// <param name="direction">Direction of the ray; its length is the unit in which t is measured. A direction of zero length hits nothing.</param>
    /// <param name="maximumT">Length of the ray in units of its direction; may be infinite.</param>
    /// <param name="layers">Layers that the ray is in, and that it meets.</param>
    /// <param name="pool">Source of temporary memory; a pool of the calling thread.</param>
    /// <param name="hitHandler">Chooses what to test and receives the hits; copied in and copied back.</param>
    /// <param name="id">The caller's number for the ray.</param>
    /// <exception cref="ArgumentException">A component is not finite, or the length is negative or not a number.</exception>
    public void RayCast<THitHandler>(
        Vector3 origin, Vector3 direction, float maximumT, CollisionLayers layers, BufferPool pool, ref THitHandler hitHandler, int id = 0)
        where THitHandler : IRayHitHandler
    {
        using var reading = world.Read("Simulation.RayCast");
        CheckRay(origin, direction, maximumT, pool);
        var tester = new LayeredRayTester<THitHandler> { Layers = layers };
        tester.Inner.Simulation = this;
        tester.Inner.Hits.Handler = hitHandler;
        BroadPhase.CastRay(origin, direction, maximumT, pool, ref tester, id);
        hitHandler = tester.Inner.Hits.Handler;
    }

    /// <summary>As of each of some rays that were checked.</summary>
    internal void RayCast<THitHandler>(ReadOnlySpan<BatchedRay> rays, BufferPool pool, ref THitHandler hitHandler) where THitHandler : IRayHitHandler
    {
        using var reading = world.Read("Simulation.RayCast");
        var tester = new CollidableRayTester<THitHandler> { Simulation = this, Hits = new() { Handler = hitHandler } };
        for (int i = 0; i < rays.Length;)
        {
            Unsafe.SkipInit(out RayPacket packet);
            packet.Count = 0;
            packet.MaximumT = default;
            for (; i < rays.Length && packet.Count < RayPacket.Capacity; ++i)
                packet.Add(rays[i].Ray, rays[i].MaximumT);
            BroadPhase.CastRays(ref packet, pool, ref tester);
        }
        hitHandler = tester.Hits.Handler;
    }

    internal static void CheckRay(Vector3 origin, Vector3 direction, float maximumT, BufferPool pool)
    {
        BodyChecks.Position(origin, nameof(origin));
        BodyChecks.Vector(direction, nameof(direction));
        if (!(maximumT >= 0))
            throw new ArgumentOutOfRangeException(nameof(maximumT), maximumT, "The length of a ray must be zero or more.");
        ArgumentNullException.ThrowIfNull(pool);
    }

    // Tests the shapes of those that the layers of the ray let it meet.
    struct LayeredRayTester<THitHandler> : IBroadPhaseRayTester where THitHandler : IRayHitHandler
    {
        public CollidableRayTester<THitHandler> Inner;
        public CollisionLayers Layers;

        public unsafe void RayTest(CollidableReference collidable, RayData* rayData, float* maximumT, BufferPool pool)
        {
            if (Inner.Simulation.MayMeet(Layers, collidable))
                Inner.RayTest(collidable, rayData, maximumT, pool);
        }
    }

    // Tests the shape of a collidable whose bounds the ray meets.
    struct CollidableRayTester<THitHandler> : IBroadPhaseRayTester where THitHandler : IRayHitHandler
    {
        public Simulation Simulation;
        public CollidableHits<THitHandler> Hits;

        public unsafe void RayTest(CollidableReference collidable, RayData* rayData, float* maximumT, BufferPool pool)
        {
            if (!Hits.Handler.AllowTest(collidable))
                return;
            Hits.Collidable = collidable;
            Simulation.GetPoseAndShape(collidable, out var pose, out var shape);
            Simulation.Shapes.GetBatch(shape.Type).RayTest(shape.Index, pose, *rayData, ref *maximumT, pool, ref Hits);
        }
    }

    // Tells the handler of the simulation about the hits on one collidable's shape.
    struct CollidableHits<THitHandler> : IShapeRayHitHandler where THitHandler : IRayHitHandler
    {
        public THitHandler Handler;
        public CollidableReference Collidable;

        public bool AllowTest(int childIndex) => Handler.AllowTest(Collidable, childIndex);

        public void OnRayHit(in RayData ray, ref float maximumT, float t, Vector3 normal, int childIndex) =>
            Handler.OnRayHit(ray, ref maximumT, t, normal, Collidable, childIndex);
    }

    // Whether layers let a query meet a collidable; one without layers meets all.
    internal bool MayMeet(CollisionLayers? layers, CollidableReference collidable) =>
        layers is not { } own || CollisionLayers.MayMeet(own, Layers.Of(collidable));

    internal void GetPoseAndShape(CollidableReference collidable, out RigidPose pose, out TypedIndex shape)
    {
        if (collidable.Mobility == CollidableMobility.Static)
        {
            ref var target = ref Statics.StaticsBuffer[Statics.Indices[collidable.Slot]];
            pose = target.Pose;
            shape = target.Shape;
            return;
        }
        var location = Bodies.Locations[collidable.Slot];
        ref var set = ref Bodies.Sets[location.SetIndex];
        pose = set.MotionStates[location.Index].Pose;
        shape = set.Collidables[location.Index].Shape;
    }
}
