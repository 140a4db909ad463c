using System;
using System.Numerics;
using BepuPhysics.Collidables;
using BepuPhysics.CollisionDetection;
using BepuPhysics.Trees;
using BepuUtilities.Memory;

namespace BepuPhysics;

// What is near a shape or a point, and what a shape overlaps.
public sealed unsafe partial class Simulation
{
    /// <summary>Finds what is within a distance of a convex shape; at a distance of zero, what it overlaps or touches.</summary>
    /// <remarks>
    /// <para>Distances are found in double precision, and are the same on every machine. Triangles have a front only, as for rays and
    /// contacts: what is nearest to the back of one is not near it, and a shape that is across a triangle overlaps it if its centre is in
    /// front.</para>
    /// <para>Only reads: any number of threads may ask at once, each with a pool of its own, while none changes or steps the simulation.
    /// A body is found by its bounds of the last step; call <see cref="Bodies.UpdateBounds"/> after writing a pose.</para>
    /// </remarks>
    /// <param name="shape">The shape; it need not be in <see cref="Shapes"/>, and is no half-space.</param>
    /// <param name="pose">Where it is.</param>
    /// <param name="maximumDistance">Greatest distance, m; may be infinite.</param>
    /// <param name="pool">Source of temporary memory; a pool of the calling thread.</param>
    /// <param name="handler">Chooses what to test and receives what is near; copied in and copied back.</param>
    /// <param name="layers">Layers that the query is in, and that it meets; everything, if not given. The handler hears of no others.</param>
    /// <exception cref="ArgumentException">
    /// The shape is not valid, or none that has a distance, or a value is not finite or outside its range.
    /// </exception>
    public void FindNear<TShape, THandler>(
        in TShape shape, in RigidPose pose, float maximumDistance, BufferPool pool, ref THandler handler, CollisionLayers? layers = null)
        where TShape : unmanaged, IConvexShape where THandler : IProximityHandler
    {
        using var reading = world.Read("Simulation.FindNear");
        SweepChecks.Shape(shape, Shapes, "have no distances");
        var near = shape;
        FindNear(ImpactCore.Of(TShape.TypeId, &near, Shapes), pose, maximumDistance, pool, ref handler, layers);
    }

    /// <summary>Finds what is within a distance of a point.</summary>
    /// <remarks>As for a shape, which see.</remarks>
    /// <param name="point">The point, m.</param>
    /// <param name="maximumDistance">Greatest distance, m; may be infinite.</param>
    /// <param name="pool">Source of temporary memory; a pool of the calling thread.</param>
    /// <param name="handler">Chooses what to test and receives what is near; copied in and copied back.</param>
    /// <param name="layers">Layers that the query is in, and that it meets; everything, if not given. The handler hears of no others.</param>
    /// <exception cref="ArgumentException">A value is not finite or outside its range.</exception>
    public void FindNear<THandler>(
        Vector3 point, float maximumDistance, BufferPool pool, ref THandler handler, CollisionLayers? layers = null)
        where THandler : IProximityHandler
    {
        using var reading = world.Read("Simulation.FindNear");
        FindNear(ImpactCore.Point, new RigidPose(point), maximumDistance, pool, ref handler, layers);
    }

    /// <summary>Finds what is nearest to a convex shape.</summary>
    /// <remarks>
    /// As <see cref="FindNear{TShape, THandler}(in TShape, in RigidPose, float, BufferPool, ref THandler, CollisionLayers?)"/>. Of several
    /// that are equally near, or overlap, it is the one with the lowest reference.
    /// </remarks>
    /// <param name="shape">The shape; it need not be in <see cref="Shapes"/>, and is no half-space.</param>
    /// <param name="pose">Where it is.</param>
    /// <param name="maximumDistance">Greatest distance, m; may be infinite.</param>
    /// <param name="pool">Source of temporary memory; a pool of the calling thread.</param>
    /// <param name="nearest">What is nearest.</param>
    /// <param name="layers">Layers that the query is in, and that it meets; everything, if not given.</param>
    /// <returns>Whether there is anything within the distance.</returns>
    /// <exception cref="ArgumentException">
    /// The shape is not valid, or none that has a distance, or a value is not finite or outside its range.
    /// </exception>
    public bool FindNearest<TShape>(in TShape shape, in RigidPose pose, float maximumDistance, BufferPool pool, out Proximity nearest,
        CollisionLayers? layers = null) where TShape : unmanaged, IConvexShape
    {
        var handler = new NearestProximity();
        FindNear(shape, pose, maximumDistance, pool, ref handler, layers);
        nearest = handler.Nearest;
        return handler.Exists;
    }

    /// <summary>Finds what is nearest to a point.</summary>
    /// <remarks>As for a shape, which see.</remarks>
    /// <param name="point">The point, m.</param>
    /// <param name="maximumDistance">Greatest distance, m; may be infinite.</param>
    /// <param name="pool">Source of temporary memory; a pool of the calling thread.</param>
    /// <param name="nearest">What is nearest.</param>
    /// <param name="layers">Layers that the query is in, and that it meets; everything, if not given.</param>
    /// <returns>Whether there is anything within the distance.</returns>
    /// <exception cref="ArgumentException">A value is not finite or outside its range.</exception>
    public bool FindNearest(
        Vector3 point, float maximumDistance, BufferPool pool, out Proximity nearest, CollisionLayers? layers = null)
    {
        var handler = new NearestProximity();
        FindNear(point, maximumDistance, pool, ref handler, layers);
        nearest = handler.Nearest;
        return handler.Exists;
    }

    /// <summary>Whether a convex shape overlaps or touches anything.</summary>
    /// <remarks>
    /// As <see cref="FindNear{TShape, THandler}(in TShape, in RigidPose, float, BufferPool, ref THandler, CollisionLayers?)"/> with a distance
    /// of zero, up to the first that is found.
    /// </remarks>
    /// <param name="shape">The shape; it need not be in <see cref="Shapes"/>, and is no half-space.</param>
    /// <param name="pose">Where it is.</param>
    /// <param name="pool">Source of temporary memory; a pool of the calling thread.</param>
    /// <param name="layers">Layers that the query is in, and that it meets; everything, if not given.</param>
    /// <exception cref="ArgumentException">
    /// The shape is not valid, or none that has a distance, or a value is not finite or outside its range.
    /// </exception>
    public bool OverlapsAny<TShape>(in TShape shape, in RigidPose pose, BufferPool pool, CollisionLayers? layers = null)
        where TShape : unmanaged, IConvexShape
    {
        var handler = new AnyProximity();
        FindNear(shape, pose, 0, pool, ref handler, layers);
        return handler.Exists;
    }

    void FindNear<THandler>(in ImpactCore core, in RigidPose pose, float maximumDistance, BufferPool pool, ref THandler handler,
        CollisionLayers? layers) where THandler : IProximityHandler
    {
        BodyChecks.Pose(pose);
        BoxMath.RequireLength(maximumDistance);
        ArgumentNullException.ThrowIfNull(pool);
        var motion = new SweepMotion { OrientationA = DoubleMatrix3x3.FromQuaternion(pose.Orientation) };
        var body = new ImpactBody(core, motion.OrientationA, default);
        var tester = new WorldProximity<THandler>
        {
            Handler = handler,
            Query = new() { Simulation = this, Pool = pool, Layers = layers, Motion = &motion, Shape = &body, Position = new(pose.Position) },
        };
        SweepBounds.InWorld(motion, body, tester.Query.Position, out var min, out var max);
        BroadPhase.FindNear(min, max, maximumDistance, ref tester);
        handler = tester.Handler;
    }
}
