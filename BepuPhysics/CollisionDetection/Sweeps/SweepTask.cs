using System;
using System.Numerics;
using BepuPhysics.Collidables;
using BepuUtilities.Memory;

namespace BepuPhysics.CollisionDetection;

/// <summary>Sweeps shapes of two types against each other: when two bodies that move and turn first touch.</summary>
/// <remarks>Only reads, and keeps nothing: any number of threads may ask at once, each with a pool of its own.</remarks>
public sealed unsafe class SweepTask
{
    internal SweepTask(int shapeTypeIndexA, int shapeTypeIndexB) => (ShapeTypeIndexA, ShapeTypeIndexB) = (shapeTypeIndexA, shapeTypeIndexB);

    /// <summary>Type id of the one shape.</summary>
    public int ShapeTypeIndexA { get; }

    /// <summary>Type id of the other shape.</summary>
    public int ShapeTypeIndexB { get; }

    /// <summary>Finds when two shapes first touch.</summary>
    /// <param name="shapeDataA">The first shape.</param>
    /// <param name="shapeTypeA">Its type, one of the two of the task.</param>
    /// <param name="orientationA">Its orientation; unit length.</param>
    /// <param name="velocityA">Its velocity, m/s and rad/s.</param>
    /// <param name="shapeDataB">The second shape.</param>
    /// <param name="shapeTypeB">Its type, the other of the two.</param>
    /// <param name="offsetB">Position of the second shape less that of the first, m.</param>
    /// <param name="orientationB">Its orientation; unit length.</param>
    /// <param name="velocityB">Its velocity, m/s and rad/s.</param>
    /// <param name="maximumT">Length of the sweep, s; may be infinite.</param>
    /// <param name="minimumProgression">
    /// Time that a round goes on by at least, s: what is met and left within it may be missed. Zero misses nothing.
    /// </param>
    /// <param name="convergenceThreshold">
    /// Shapes count as touching where they are nearer than their greatest speed takes them in this time, s, or than 1e-5 of the smaller
    /// one's size.
    /// </param>
    /// <param name="maximumIterationCount">Greatest number of rounds for a pair of convex shapes; what takes more is no hit.</param>
    /// <param name="filter">Chooses which children are tested.</param>
    /// <param name="shapes">Shapes that children refer to.</param>
    /// <param name="sweepTasks">Not used. Kept for callers.</param>
    /// <param name="pool">Source of temporary memory; a pool of the calling thread.</param>
    /// <param name="t0">A time at which the shapes are still apart, or zero, s.</param>
    /// <param name="t1">Time of the hit, s; zero where they overlap from the start.</param>
    /// <param name="hitLocation">
    /// Place of the hit less the first shape's position, in world axes, m; zero where they overlap from the start.
    /// </param>
    /// <param name="hitNormal">
    /// Unit normal from the second shape to the first in world axes; zero where they overlap from the start.
    /// </param>
    /// <returns>Whether they touch within that time.</returns>
    /// <exception cref="ArgumentException">A type is not one of the task's, or a value is not finite or outside its range.</exception>
    public bool Sweep<TSweepFilter>(
        void* shapeDataA, int shapeTypeA, Quaternion orientationA, in BodyVelocity velocityA,
        void* shapeDataB, int shapeTypeB, Vector3 offsetB, Quaternion orientationB, in BodyVelocity velocityB,
        float maximumT, float minimumProgression, float convergenceThreshold, int maximumIterationCount,
        ref TSweepFilter filter, Shapes shapes, SweepTaskRegistry sweepTasks, BufferPool pool,
        out float t0, out float t1, out Vector3 hitLocation, out Vector3 hitNormal)
        where TSweepFilter : ISweepFilter
    {
        var types = (ShapeTypeIndexA, ShapeTypeIndexB);
        if ((shapeTypeA, shapeTypeB) != types && (shapeTypeB, shapeTypeA) != types)
        {
            throw new ArgumentException(
                $"This task sweeps shapes of types {ShapeTypeIndexA} and {ShapeTypeIndexB}, not {shapeTypeA} and {shapeTypeB}.");
        }
        ArgumentNullException.ThrowIfNull(shapeDataA);
        ArgumentNullException.ThrowIfNull(shapeDataB);
        ArgumentNullException.ThrowIfNull(shapes);
        SweepChecks.Offset(offsetB);
        BodyChecks.Orientation(orientationA, nameof(orientationA));
        BodyChecks.Orientation(orientationB, nameof(orientationB));
        BodyChecks.Velocity(velocityA);
        BodyChecks.Velocity(velocityB);
        SweepChecks.Length(maximumT, pool);
        var motion = new SweepMotion
        {
            OrientationA = DoubleMatrix3x3.FromQuaternion(orientationA),
            OrientationB = DoubleMatrix3x3.FromQuaternion(orientationB),
            LinearA = new(velocityA.Linear),
            LinearB = new(velocityB.Linear),
            AngularA = new(velocityA.Angular),
            AngularB = new(velocityB.Angular),
            OffsetB = new(offsetB),
            MaximumT = maximumT,
            Accuracy = SweepChecks.Accuracy(minimumProgression, convergenceThreshold, maximumIterationCount),
        };
        SweepPairs.Test(motion, shapeTypeA, shapeDataA, shapeTypeB, shapeDataB, ref filter, shapes, pool, out var hit);
        t0 = t1 = hit.EarliestT;
        hitLocation = hit.Place.ToSingle();
        hitNormal = hit.Normal.ToSingle();
        return hit.Exists;
    }
}
