using System;
using System.Numerics;
using System.Runtime.CompilerServices;
using BepuPhysics.Collidables;
using BepuPhysics.CollisionDetection;
using BepuPhysics.Trees;
using BepuUtilities;
using BepuUtilities.Memory;

namespace BepuPhysics;

// The contacts that a shape would have.
public sealed unsafe partial class Simulation
{
    /// <summary>Finds the contacts that a convex shape has with the world: where it overlaps, how deeply, and which way leads out.</summary>
    /// <remarks>
    /// <para>Contacts are those of a step, up to eight for a collidable: along a contact's normal the shape has to move by its depth to get out
    /// there. No contact is foreseen from velocities; everything stands still.</para>
    /// <para>Only reads: any number of threads may ask at once, each with a pool of its own, while none changes or steps the simulation.
    /// A body is found by its bounds of the last step; call <see cref="Bodies.UpdateBounds"/> after writing a pose.</para>
    /// </remarks>
    /// <param name="shape">The shape; it need not be in <see cref="Shapes"/>, and is no half-space.</param>
    /// <param name="pose">Where it is.</param>
    /// <param name="margin">Greatest distance at which there are contacts, m; these have negative depths. Zero for what overlaps.</param>
    /// <param name="pool">Source of temporary memory; a pool of the calling thread.</param>
    /// <param name="handler">Chooses what to test and receives the contacts; copied in and copied back.</param>
    /// <param name="layers">Layers that the query is in, and that it meets; everything, if not given. The handler hears of no others.</param>
    /// <exception cref="ArgumentException">
    /// The shape is not valid, or none that is tested against others, or a value is not finite or outside its range.
    /// </exception>
    public void FindContacts<TShape, THandler>(
        in TShape shape, in RigidPose pose, float margin, BufferPool pool, ref THandler handler, CollisionLayers? layers = null)
        where TShape : unmanaged, IConvexShape where THandler : struct, IShapeContactHandler
    {
        using var reading = world.Read("Simulation.FindContacts");
        SweepChecks.Shape(shape, Shapes, "have no contacts");
        NarrowPhase.CollisionTaskRegistry.CheckTypes(Shapes);
        BodyChecks.Pose(pose);
        BoxMath.RequireLength(margin);
        ArgumentOutOfRangeException.ThrowIfEqual(margin, float.PositiveInfinity);
        ArgumentNullException.ThrowIfNull(pool);
        var tested = shape;
        var receiver = new WorldContacts<THandler>.Receiver { Handler = handler };
        var batcher = new CollisionBatcher<WorldContacts<THandler>.Receiver>(pool, Shapes, NarrowPhase.CollisionTaskRegistry, 0, receiver);
        var tester = new WorldContacts<THandler>
        {
            Simulation = this,
            BatcherOfCaller = Unsafe.AsPointer(ref batcher),
            Layers = layers,
            Shape = &tested,
            ShapeType = TShape.TypeId,
            Pose = pose,
            Margin = margin,
        };
        try
        {
            BroadPhase.FindOverlapping(BoundsWithin(shape, pose, margin), ref tester);
            batcher.Flush();
        }
        finally
        {
            batcher.Dispose();
            handler = batcher.Callbacks.Handler;
        }
    }

    // A box that meets the bounds of all that the shape may have contacts with: what it loses by being of floats is less than what is added.
    static BoundingBox BoundsWithin<TShape>(in TShape shape, in RigidPose pose, float margin) where TShape : unmanaged, IConvexShape
    {
        const float sizePart = 4e-5f, coordinatePart = 2e-6f;
        shape.ComputeBounds(pose.Orientation, out var min, out var max);
        var size = Vector3.Abs(min) + Vector3.Abs(max);
        var pad = new Vector3(margin) + new Vector3(Exact.Dot(size, Vector3.One) * sizePart) + Vector3.Abs(pose.Position) * coordinatePart;
        return new(pose.Position + (min - pad), pose.Position + (max + pad));
    }
}
