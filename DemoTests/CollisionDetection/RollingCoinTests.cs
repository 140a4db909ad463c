using System;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using Demos.Accuracy;
using Demos.References;
using DemoTests.Scenes;
using Xunit;

namespace DemoTests.CollisionDetection;

/// <summary>A coin that rolls round in a circle, as a rigid disc can by its equations, goes on so: nothing takes or gives it energy.</summary>
public class RollingCoinTests
{
    const float Mass = 2;
    const float Radius = .5f;

    /// <summary>What it rolls on, and what it is.</summary>
    public enum Kind
    {
        OnBox,
        OnHalfSpace,
        OnTiles,
        OnTriangles,
        OnDisc,
        OnKinematic,
        OnEarlierBody,
        OnLaterBody,
        AsChild,
    }

    [Theory]
    [InlineData(Kind.OnBox, .06f, 60, 1, 4, 0)]
    [InlineData(Kind.OnBox, .06f, 60, 1, 16, 1)]
    [InlineData(Kind.OnBox, .2f, 55, .8, 4, 0)]
    [InlineData(Kind.OnBox, .2f, 55, .8, 16, 1)]
    [InlineData(Kind.OnHalfSpace, .06f, 60, 1, 4, 0)]
    [InlineData(Kind.OnTiles, .2f, 55, .8, 4, 0)]
    [InlineData(Kind.OnTriangles, .06f, 60, 1, 4, 0)]
    [InlineData(Kind.OnDisc, .2f, 55, .8, 4, 0)]
    [InlineData(Kind.OnKinematic, .2f, 55, .8, 4, 0)]
    [InlineData(Kind.OnEarlierBody, .06f, 60, 1, 4, 0)]
    [InlineData(Kind.OnLaterBody, .06f, 60, 1, 4, 0)]
    [InlineData(Kind.AsChild, .06f, 60, 1, 4, 0)]
    [InlineData(Kind.AsChild, .2f, 55, .8, 16, 1)]
    public void A_coin_that_rolls_in_a_circle_keeps_its_lean_and_its_energy(
        Kind kind, float thickness, double degrees, double circle, int substeps, int relaxations)
    {
        var rolling = new SteadyRolling(Radius, thickness / 2, degrees / 180 * Math.PI, circle);
        using var world = new TestWorld(new AccuracySettings { Friction = 2, SubstepCount = substeps, RelaxationCount = relaxations });
        // About X from upright to the lean: the axis, which is Y, goes from up to outwards, and that is -Z.
        var orientation = Quaternion.CreateFromAxisAngle(Vector3.UnitX, (float)-rolling.Tilt);
        var pose = new RigidPose(new Vector3(0, (float)rolling.Height, -(float)circle), orientation);
        var axis = Vector3.Transform(Vector3.UnitY, orientation);
        var velocity = new BodyVelocity(
            Vector3.Cross(Vector3.UnitY, -Vector3.UnitZ) * (float)(rolling.Precession * circle),
            Vector3.UnitY * (float)rolling.Precession + axis * (float)rolling.Spin);
        if (kind != Kind.OnLaterBody)
            AddFloor(world, kind);
        var coin = AddCoin(world, kind, new Cylinder(Radius, thickness), pose, velocity);
        if (kind == Kind.OnLaterBody)
            AddFloor(world, kind);
        double across = Mass * (Radius * Radius / 4 + thickness * thickness / 12), along = Mass * Radius * Radius / 2;
        double first = Energy(), off = 0, lean = 0;
        for (int i = 0; i < 300; ++i)
        {
            world.Step();
            off = Math.Max(off, Math.Abs(Energy() / first - 1));
            lean = Math.Max(lean, Math.Abs(Tilt() - rolling.Tilt));
        }
        world.Simulation.DisposeHulls();
        Assert.True(off < .01 && lean < .08, FormattableString.Invariant($"energy off by {off:p3}, lean by {lean:g4} rad"));

        double Energy()
        {
            ref var state = ref world.Bodies[coin].MotionState;
            Double3 linear = state.Velocity.Linear, angular = state.Velocity.Angular;
            double spin = Double3.Dot(angular, Axis());
            return Mass * linear.LengthSquared / 2 + (across * (angular.LengthSquared - spin * spin) + along * spin * spin) / 2 +
                Mass * 9.81 * state.Pose.Position.Y;
        }

        double Tilt() => Math.Acos(Math.Clamp(Axis().Y, -1, 1));

        // A child has its axis along X of the body.
        Double3 Axis()
        {
            DoubleQuaternion orientation = world.Bodies[coin].Pose.Orientation;
            return orientation.Rotate(kind == Kind.AsChild ? new(1, 0, 0) : new(0, 1, 0));
        }
    }

    static void AddFloor(TestWorld world, Kind kind)
    {
        var box = new Box(200, 2, 200);
        var below = new RigidPose(new Vector3(0, -1, 0));
        switch (kind)
        {
            case Kind.OnHalfSpace:
                world.Statics.Add(new StaticDescription(Vector3.Zero, world.Simulation.Shapes.Add(new HalfSpace(Vector3.UnitY))));
                break;
            case Kind.OnTiles:
                for (int i = 0; i < 64; ++i)
                    world.AddStatic(new Box(1, 2, 1), new RigidPose(new Vector3(i % 8 - 3.7f, -1, i / 8 - 3.6f)));
                break;
            case Kind.OnTriangles:
                AddTriangles(world);
                break;
            case Kind.OnDisc:
                world.AddStatic(new Cylinder(9, 2), below);
                break;
            case Kind.OnKinematic:
                world.AddKinematic(box, below);
                break;
            case Kind.OnEarlierBody or Kind.OnLaterBody:
                world.AddStatic(box, below with { Position = new Vector3(0, -3, 0) });
                world.AddDynamic(box, 1e6f, below);
                break;
            default:
                world.AddStatic(box, below);
                break;
        }
    }

    static void AddTriangles(TestWorld world)
    {
        const int count = 8;
        world.Pool.Take<Triangle>(2 * count * count, out var triangles);
        for (int i = 0; i < count * count; ++i)
        {
            var corner = new Vector3(i % count - 3.7f, 0, i / count - 3.6f);
            triangles[2 * i] = new(corner, corner + Vector3.UnitX, corner + Vector3.UnitX + Vector3.UnitZ);
            triangles[2 * i + 1] = new(corner, corner + Vector3.UnitX + Vector3.UnitZ, corner + Vector3.UnitZ);
        }
        world.Statics.Add(new StaticDescription(Vector3.Zero, world.Simulation.Shapes.Add(new Mesh(triangles, Vector3.One, world.Pool))));
    }

    // A child lies across in its body, to which X is what Y is to the cylinder.
    static BodyHandle AddCoin(TestWorld world, Kind kind, in Cylinder cylinder, RigidPose pose, in BodyVelocity velocity)
    {
        if (kind != Kind.AsChild)
            return world.AddDynamic(cylinder, Mass, pose, velocity);
        var across = Quaternion.CreateFromAxisAngle(Vector3.UnitZ, -MathF.PI / 2);
        world.Pool.Take<CompoundChild>(1, out var children);
        children[0] = new(new RigidPose(default, across), world.Simulation.Shapes.Add(cylinder));
        var compound = world.Simulation.Shapes.Add(new Compound(children));
        pose.Orientation *= Quaternion.Conjugate(across);
        var inertia = cylinder.ComputeInertia(Mass);
        ref var tensor = ref inertia.InverseInertiaTensor;
        (tensor.XX, tensor.YY) = (tensor.YY, tensor.XX);
        return world.Bodies.Add(BodyDescription.CreateDynamic(pose, velocity, inertia, compound, new BodyActivityDescription(-1)));
    }

    // A disc whose axis leans by an angle from the vertical rolls round a vertical line at a distance from its centre. With e outwards, n up,
    // the axis a = s e + c n and the lowest point p = (R c - H s) e - (R s + H c) n: rolling is v + w x p = 0, with w = W n + S a; and the
    // torque of the floor's force m (g n - W^2 q e) is what the angular momentum, which turns with W, needs.
    readonly struct SteadyRolling
    {
        public SteadyRolling(double radius, double halfThickness, double tilt, double circle)
        {
            double s = Math.Sin(tilt), c = Math.Cos(tilt);
            double across = radius * radius / 4 + halfThickness * halfThickness / 3, along = radius * radius / 2;
            Tilt = tilt;
            Height = radius * s + halfThickness * c;
            var arm = radius * c - halfThickness * s;
            Precession = Math.Sqrt(9.81 * arm / (s * (along * (circle - halfThickness * s) / radius + across * c) + Height * circle));
            Spin = -Precession * (circle + arm) / radius;
        }

        public double Tilt { get; }
        public double Height { get; }
        public double Precession { get; }
        public double Spin { get; }
    }
}
