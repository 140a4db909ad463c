using System;
using System.Linq;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using DemoTests.CollisionDetection.Children;

namespace DemoTests.CollisionDetection.Seams;

/// <summary>What moves over a floor.</summary>
public enum SeamMover
{
    SmallSphere,
    Sphere,
    LargeSphere,
    RollingCapsule,
    SlidingCapsule,
    Box,
    TurnedBox,
    StandingCylinder,
    RollingCylinder,
    Hull,
    TwoBoxes,
    Compound,
}

/// <summary>Makes movers.</summary>
static class SeamMovers
{
    static readonly Vector3[] HullPoints = [.. Enumerable.Range(0, 16).Select(i =>
    {
        var (sin, cos) = MathF.SinCos(MathF.PI * 2 * (i % 8) / 8);
        return i < 8 ? new Vector3(.3f * cos, -.2f, .3f * sin) : new Vector3(.2f * cos, .2f, .2f * sin);
    })];

    /// <summary>Adds a mover at the origin, on a floor at y = 0, along X.</summary>
    public static BodyHandle Add(ClusterWorld world, SeamMover mover, float speed)
    {
        var velocity = new BodyVelocity(new Vector3(speed, 0, 0));
        var across = Quaternion.CreateFromAxisAngle(Vector3.UnitX, MathF.PI / 2);
        var along = Quaternion.CreateFromAxisAngle(Vector3.UnitZ, MathF.PI / 2);
        // A tenth of a millimetre in the floor, as what rests there is.
        RigidPose At(float height, Quaternion orientation) => new(new Vector3(0, height - 1e-4f, 0), orientation);
        switch (mover)
        {
            case SeamMover.SmallSphere or SeamMover.Sphere or SeamMover.LargeSphere:
                var radius = mover == SeamMover.SmallSphere ? .1f : mover == SeamMover.Sphere ? .5f : 2;
                return world.AddBody(new Sphere(radius), At(radius, Quaternion.Identity), velocity with { Angular = new(0, 0, -speed / radius) });
            case SeamMover.RollingCapsule:
                return world.AddBody(new Capsule(.2f, .8f), At(.2f, across), velocity with { Angular = new(0, 0, -speed / .2f) });
            case SeamMover.SlidingCapsule:
                return world.AddBody(new Capsule(.2f, .8f), At(.2f, along), velocity);
            case SeamMover.Box:
                return world.AddBody(new Box(.5f, .5f, .5f), At(.25f, Quaternion.Identity), velocity);
            case SeamMover.TurnedBox:
                return world.AddBody(new Box(.7f, .3f, .5f), At(.15f, Quaternion.CreateFromAxisAngle(Vector3.UnitY, .7f)), velocity);
            case SeamMover.StandingCylinder:
                return world.AddBody(new Cylinder(.3f, .4f), At(.2f, Quaternion.Identity), velocity);
            case SeamMover.RollingCylinder:
                return world.AddBody(new Cylinder(.3f, .4f), At(.3f, across), velocity with { Angular = new(0, 0, -speed / .3f) });
            case SeamMover.TwoBoxes:
                var half = world.Simulation.Shapes.Add(new Box(.4f, .3f, .5f));
                var both = world.AddCluster([new(half, new RigidPose(new Vector3(-.2f, 0, 0))), new(half, new RigidPose(new Vector3(.2f, 0, 0)))]);
                return world.Simulation.Bodies.Add(BodyDescription.CreateDynamic(
                    At(.15f, Quaternion.CreateFromAxisAngle(Vector3.UnitY, .7f)), velocity, new Box(.8f, .3f, .5f).ComputeInertia(1), both, -1f));
            case SeamMover.Compound:
                using (var builder = new CompoundBuilder(world.Simulation.BufferPool, world.Simulation.Shapes, 3))
                {
                    builder.Add(new Box(.8f, .2f, .5f), new RigidPose(new Vector3(0, .1f, 0)), .08f);
                    builder.Add(new Box(.2f, .2f, .7f), new RigidPose(new Vector3(.2f, .1f, 0)), .02f);
                    builder.Add(new Sphere(.15f), new RigidPose(new Vector3(-.1f, .25f, 0)), .01f);
                    builder.BuildDynamicCompound(out var children, out var inertia, out var middle);
                    var compound = new Compound(children);
                    world.Own(compound);
                    return world.Simulation.Bodies.Add(BodyDescription.CreateDynamic(At(middle.Y, Quaternion.CreateFromAxisAngle(Vector3.UnitY, .4f)),
                        velocity, inertia, world.Simulation.Shapes.Add(compound), -1f));
                }
            default:
                var hull = new ConvexHull(HullPoints, world.Simulation.BufferPool, out var center);
                world.Own(hull);
                return world.AddBody(hull, At(.2f + center.Y, Quaternion.Identity), velocity);
        }
    }
}
