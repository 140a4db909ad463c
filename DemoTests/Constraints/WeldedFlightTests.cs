using System;
using System.Collections.Generic;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuPhysics.Constraints;
using BepuUtilities;
using Demos.Accuracy;
using Demos.Running;
using DemoTests.Scenes;
using Xunit;
using Xunit.Abstractions;

namespace DemoTests.Constraints;

/// <summary>Pieces that are welded together and tumble through the air: nothing turns them, so they keep their angular momentum, and gain no energy.</summary>
public class WeldedFlightTests(ITestOutputHelper output)
{
    const int Seconds = 10;

    static TestWorld NewWorld(int substeps, int relaxations, DirectJointsChoice directJoints) => new(new AccuracySettings
    {
        Gravity = default,
        Contacts = ContactScope.None,
        SubstepCount = substeps,
        RelaxationCount = relaxations,
        DirectJoints = directJoints,
    });

    // Two to six boxes of 1 to 4 kg, each .6 m from the last one, that turn as one body with up to 14 rad/s about the middle of their mass.
    static List<BodyHandle> AddPieces(TestWorld world, int seed)
    {
        var random = new Random(seed);
        float Between(float from, float to) => from + (to - from) * (float)random.NextDouble();
        var pieces = new List<BodyHandle>();
        var (place, middle, mass) = (Vector3.Zero, Vector3.Zero, 0f);
        for (int count = random.Next(2, 7); count > 0; --count)
        {
            var (weight, turn) = (Between(1, 4), TestWorld.Turn(random));
            var box = new Box(Between(0.1f, 0.6f), Between(0.1f, 0.6f), Between(0.1f, 0.6f));
            var piece = world.AddDynamic(box, weight, new RigidPose(place, turn));
            if (pieces.Count > 0)
                WeldTo(world, pieces[^1], piece);
            pieces.Add(piece);
            (middle, mass) = (middle + place * weight, mass + weight);
            place += Vector3.Transform(new Vector3(0.6f, 0, 0), TestWorld.Turn(random));
        }
        var spin = TestWorld.Scatter(random, 8);
        foreach (var piece in pieces)
            world.Bodies[piece].Velocity = new(Vector3.Cross(spin, world.Bodies[piece].Pose.Position - middle / mass), spin);
        return pieces;
    }

    static void WeldTo(TestWorld world, BodyHandle a, BodyHandle b)
    {
        var (poseA, poseB) = (world.Bodies[a].Pose, world.Bodies[b].Pose);
        var back = Quaternion.Conjugate(poseA.Orientation);
        world.Solver.Add(a, b, new Weld
        {
            LocalOffset = Vector3.Transform(poseB.Position - poseA.Position, back),
            LocalOrientation = Exact.Concatenate(poseB.Orientation, back),
        });
    }

    // Angular momentum about the origin, past which their middle does not move, and energy.
    static (DoubleVector Momentum, double Energy) Motion(TestWorld world, List<BodyHandle> pieces)
    {
        DoubleVector sum = new(Vector3.Zero);
        double energy = 0;
        foreach (var piece in pieces)
        {
            var body = world.Bodies[piece];
            var (inverse, mass) = (body.LocalInertia.InverseInertiaTensor, 1.0 / body.LocalInertia.InverseMass);
            var (linear, angular) = (new DoubleVector(body.Velocity.Linear), new DoubleVector(body.Velocity.Angular));
            var rotation = DoubleRotation.From(body.Pose.Orientation);
            var local = rotation.Inverse * angular;
            var spin = rotation * new DoubleVector(local.X / inverse.XX, local.Y / inverse.YY, local.Z / inverse.ZZ);
            sum += DoubleVector.Cross(new(body.Pose.Position), linear * mass) + spin;
            energy += 0.5 * (mass * DoubleVector.Dot(linear, linear) + DoubleVector.Dot(spin, angular));
        }
        return (sum, energy);
    }

    [Theory]
    [InlineData(4, 0, DirectJointsChoice.Off)]
    [InlineData(8, 0, DirectJointsChoice.Off)]
    [InlineData(4, 1, DirectJointsChoice.Off)]
    [InlineData(4, 0, DirectJointsChoice.Always)]
    public void Welded_pieces_in_flight_keep_their_angular_momentum_and_gain_no_energy(int substeps, int relaxations, DirectJointsChoice directJoints)
    {
        double turned = 0, most = 0, least = double.MaxValue;
        for (int seed = 0; seed < 40; ++seed)
        {
            using var world = NewWorld(substeps, relaxations, directJoints);
            var pieces = AddPieces(world, seed);
            var (momentum, energy) = Motion(world, pieces);
            for (int step = 0; step < Seconds * 60; ++step)
            {
                world.Step();
                most = Math.Max(most, Motion(world, pieces).Energy / energy - 1);
            }
            var end = Motion(world, pieces);
            turned = Math.Max(turned, (end.Momentum - momentum).Length / momentum.Length);
            least = Math.Min(least, end.Energy / energy);
        }
        output.WriteLine($"angular momentum off by {turned:P3}, energy gained {most:P2}, left {least:P1}");
        Assert.InRange(turned, 0, 0.002);
        Assert.InRange(most, 0, 0.01);
    }
}
