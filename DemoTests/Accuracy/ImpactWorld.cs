using System;
using System.Collections.Generic;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using Demos.Accuracy;
using Demos.References;

namespace DemoTests.Accuracy;

/// <summary>Bodies that bounce off each other, and what they must keep.</summary>
sealed class ImpactWorld(AccuracySettings settings) : IDisposable
{
    readonly AccuracyWorld world = new(settings);
    readonly List<BodyHandle> bodies = [];

    /// <summary>Settings of all that has effect on a bounce: substeps, iterations, relaxations.</summary>
    public static IEnumerable<AccuracySettings> Efforts()
    {
        foreach (int substeps in new[] { 1, 2, 4, 8, 16, 32 })
            foreach (int iterations in new[] { 1, 2 })
                foreach (int relaxations in new[] { 0, 1 })
                    yield return new() { SubstepCount = substeps, VelocityIterationCount = iterations, RelaxationCount = relaxations, Gravity = default };
    }

    public AccuracyWorld World => world;

    public void Add<TShape>(in TShape shape, float mass, RigidPose pose, BodyVelocity velocity = default, float margin = 0)
        where TShape : unmanaged, IConvexShape
    {
        var collidable = new CollidableDescription(
            world.Simulation.Shapes.Add(shape), margin, float.MaxValue, new ContinuousDetection { Mode = ContinuousDetectionMode.Passive });
        bodies.Add(world.Bodies.Add(
            BodyDescription.CreateDynamic(pose, velocity, shape.ComputeInertia(mass), collidable, new BodyActivityDescription(-1))));
    }

    public Double3 Velocity(int body) => world.LinearVelocity(bodies[body]);

    public IEnumerable<Vector3> Velocities()
    {
        foreach (var body in bodies)
        {
            yield return world.Bodies[body].Velocity.Linear;
            yield return world.Bodies[body].Velocity.Angular;
        }
    }

    /// <summary>Kinetic and potential energy.</summary>
    // With constant acceleration g, steps of length h and velocities v at their ends, positions lie on a parabola whose velocity is v + g h / 2: v is its
    // mean in the step that has ended.
    public double Energy()
    {
        double energy = 0;
        var gravity = (Double3)settings.Gravity;
        foreach (var body in bodies)
        {
            var inertia = world.Bodies[body].LocalInertia;
            double mass = 1.0 / inertia.InverseMass;
            var velocity = world.LinearVelocity(body) + gravity * (settings.SubstepDuration / 2);
            var spin = world.Orientation(body).RotateBack(world.AngularVelocity(body));
            var tensor = inertia.InverseInertiaTensor;
            energy += mass * (velocity.LengthSquared / 2 - Double3.Dot(gravity, world.Position(body)))
                + (spin.X * spin.X / tensor.XX + spin.Y * spin.Y / tensor.YY + spin.Z * spin.Z / tensor.ZZ) / 2;
        }
        return energy;
    }

    public Double3 Momentum()
    {
        var momentum = Double3.Zero;
        foreach (var body in bodies)
            momentum += world.LinearVelocity(body) * (1.0 / world.Bodies[body].LocalInertia.InverseMass);
        return momentum;
    }

    public void Dispose() => world.Dispose();
}
