using System;
using BepuPhysics.Collidables;
using BepuPhysics.CollisionDetection;
using BepuUtilities.Memory;

namespace BepuPhysics;

// Convex shapes that are swept through the world.
public sealed unsafe partial class Simulation
{
    /// <summary>Finds what a convex shape hits on its way, as it moves and turns.</summary>
    /// <remarks>
    /// <para>Everything else stands still. The shape turns about its centre at its angular velocity, as bodies do. A hit is told when the
    /// shapes are nearer than 1e-5 of the smaller one's size, and never later than they touch; shapes that are as near at the start hit
    /// if they come nearer still, not if they part or slide. Triangles are met from their fronts, as by rays and contacts; what is in the
    /// way from behind is passed through.</para>
    /// <para>Only reads: any number of threads may ask at once, each with a pool of its own, while none changes or steps the simulation.
    /// A body is found by its bounds of the last step; call <see cref="Bodies.UpdateBounds"/> after writing a pose.</para>
    /// </remarks>
    /// <param name="shape">The shape; it need not be in <see cref="Shapes"/>, and is no half-space.</param>
    /// <param name="pose">Where it starts.</param>
    /// <param name="velocity">Its velocity, m/s and rad/s; may be zero.</param>
    /// <param name="maximumT">How long it moves, s; may be infinite.</param>
    /// <param name="pool">Source of temporary memory; a pool of the calling thread.</param>
    /// <param name="hitHandler">Chooses what to test and receives the hits; copied in and copied back.</param>
    /// <exception cref="ArgumentException">
    /// The shape is not valid, or none that can be swept, or a value is not finite or outside its range.
    /// </exception>
    public void Sweep<TShape, THitHandler>(
        in TShape shape, in RigidPose pose, in BodyVelocity velocity, float maximumT, BufferPool pool, ref THitHandler hitHandler)
        where TShape : unmanaged, IConvexShape where THitHandler : ISweepHitHandler =>
        Sweep(shape, pose, velocity, maximumT, null, ImpactAccuracy.Default, pool, ref hitHandler);

    /// <summary>
    /// Finds what a convex shape hits on its way among the collidables that its layers let it meet; the handler hears of no others.
    /// </summary>
    /// <remarks>As without layers, which see.</remarks>
    /// <param name="shape">The shape; it need not be in <see cref="Shapes"/>, and is no half-space.</param>
    /// <param name="pose">Where it starts.</param>
    /// <param name="velocity">Its velocity, m/s and rad/s; may be zero.</param>
    /// <param name="maximumT">How long it moves, s; may be infinite.</param>
    /// <param name="layers">Layers that the sweep is in, and that it meets.</param>
    /// <param name="pool">Source of temporary memory; a pool of the calling thread.</param>
    /// <param name="hitHandler">Chooses what to test and receives the hits; copied in and copied back.</param>
    /// <exception cref="ArgumentException">
    /// The shape is not valid, or none that can be swept, or a value is not finite or outside its range.
    /// </exception>
    public void Sweep<TShape, THitHandler>(
        in TShape shape, in RigidPose pose, in BodyVelocity velocity, float maximumT, CollisionLayers layers, BufferPool pool,
        ref THitHandler hitHandler)
        where TShape : unmanaged, IConvexShape where THitHandler : ISweepHitHandler =>
        Sweep(shape, pose, velocity, maximumT, layers, ImpactAccuracy.Default, pool, ref hitHandler);

    /// <summary>Finds what a convex shape hits on its way, as exactly as is asked for.</summary>
    /// <remarks>As without these parameters, which see; there, nothing is missed, and hits are told at 1e-5 of a size.</remarks>
    /// <param name="shape">The shape; it need not be in <see cref="Shapes"/>, and is no half-space.</param>
    /// <param name="pose">Where it starts.</param>
    /// <param name="velocity">Its velocity, m/s and rad/s; may be zero.</param>
    /// <param name="maximumT">How long it moves, s; may be infinite.</param>
    /// <param name="pool">Source of temporary memory; a pool of the calling thread.</param>
    /// <param name="hitHandler">Chooses what to test and receives the hits; copied in and copied back.</param>
    /// <param name="minimumProgression">
    /// Time that a round goes on by at least, s: what is met and left within it may be missed. Zero misses nothing.
    /// </param>
    /// <param name="convergenceThreshold">
    /// Shapes count as touching where they are nearer than their greatest speed takes them in this time, s, or than 1e-5 of the smaller
    /// one's size.
    /// </param>
    /// <param name="maximumIterationCount">Greatest number of rounds for a pair of convex shapes; what takes more is no hit.</param>
    /// <exception cref="ArgumentException">
    /// The shape is not valid, or none that can be swept, or a value is not finite or outside its range.
    /// </exception>
    public void Sweep<TShape, THitHandler>(
        TShape shape, in RigidPose pose, in BodyVelocity velocity, float maximumT, BufferPool pool, ref THitHandler hitHandler,
        float minimumProgression, float convergenceThreshold, int maximumIterationCount)
        where TShape : unmanaged, IConvexShape where THitHandler : ISweepHitHandler =>
        Sweep(shape, pose, velocity, maximumT, null,
            SweepChecks.Accuracy(minimumProgression, convergenceThreshold, maximumIterationCount), pool, ref hitHandler);

    void Sweep<TShape, THitHandler>(in TShape shape, in RigidPose pose, in BodyVelocity velocity, float maximumT, CollisionLayers? layers,
        in ImpactAccuracy accuracy, BufferPool pool, ref THitHandler hitHandler)
        where TShape : unmanaged, IConvexShape where THitHandler : ISweepHitHandler
    {
        using var reading = world.Read("Simulation.Sweep");
        SweepChecks.Shape(shape, Shapes, "cannot be swept");
        BodyChecks.Pose(pose);
        BodyChecks.Velocity(velocity);
        SweepChecks.Length(maximumT, pool);
        var swept = shape;
        var motion = new SweepMotion
        {
            OrientationA = DoubleMatrix3x3.FromQuaternion(pose.Orientation),
            LinearA = new(velocity.Linear),
            AngularA = new(velocity.Angular),
            MaximumT = maximumT,
            Accuracy = accuracy,
        };
        var body = new ImpactBody(ImpactCore.Of(TShape.TypeId, &swept, Shapes), motion.OrientationA, motion.AngularA);
        var tester = new WorldSweep<THitHandler>
        {
            Handler = hitHandler,
            Query = new() { Simulation = this, Pool = pool, Layers = layers, Motion = &motion, Shape = &body, Position = new(pose.Position) },
        };
        SweepBounds.InWorld(motion, body, tester.Query.Position, out var min, out var max);
        BroadPhase.SweepBox(min, max, velocity.Linear, maximumT, pool, ref tester);
        hitHandler = tester.Handler;
    }
}
