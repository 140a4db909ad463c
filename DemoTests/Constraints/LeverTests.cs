using System;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuPhysics.Constraints;
using Demos.Accuracy;
using Demos.JointTables;
using DemoTests.Scenes;
using Xunit;

namespace DemoTests.Constraints;

/// <summary>
/// A beam that turns about a pivot and bears a weight swings with its period, 2 pi sqrt(I / (g (M a + m c))), with I = m L^2 / 12 + m c^2 + M a^2 for a
/// centre at c and a weight at a from the pivot, wherever on the beam the two are: in trebuchets, barriers, drawbridges the weight is near the pivot.
/// </summary>
public class LeverTests
{
    const float Length = 8, Width = .2f;
    const double Amplitude = .05;

    // The beam is taken to be heavier by a tenth of what the weight has about the pivot, where that is more than its own: 5 % of the period.
    [Theory]
    [InlineData(60, 2000, 2.5f, 4, .05)]
    [InlineData(60, 2000, 2.5f, 3, .05)]
    [InlineData(60, 2000, 3.5f, 2.5f, .05)]
    [InlineData(60, 500, 3.9f, 3.4f, .01)]
    [InlineData(20, 80, 1, 1.5f, .01)]
    [InlineData(60, 2000, 2.5f, 2.5f, .01)]
    [InlineData(10, 100, 0, 3, .01)]
    [InlineData(10, 100, -3, 3, .05)]
    public void It_swings_with_its_period(float mass, float weight, float pivot, float place, double tolerance)
    {
        using var world = new TestWorld(new AccuracySettings { Contacts = ContactScope.None });
        var beam = new Box(Length, Width, Width);
        double c = -pivot, a = place - pivot;
        double moment = mass * c + weight * a;
        // Its heavier end hangs down.
        var direction = moment > 0 ? 1 : -1;
        var orientation = Quaternion.CreateFromAxisAngle(Vector3.UnitZ, -MathF.PI / 2 * direction + (float)Amplitude);
        Vector3 At(double x) => Vector3.Transform(new((float)x, 0, 0), orientation);
        var frame = world.AddKinematic(new Sphere(.1f), RigidPose.Identity);
        var body = world.AddDynamic(beam, mass, new RigidPose(At(c), orientation));
        var load = world.AddDynamic(new Sphere(.3f), weight, new RigidPose(At(a)));
        world.Solver.Add(frame, body, new Hinge
        {
            LocalHingeAxisA = Vector3.UnitZ,
            LocalOffsetB = new(pivot, 0, 0),
            LocalHingeAxisB = Vector3.UnitZ,
        });
        world.Solver.Add(body, load, new BallSocket { LocalOffsetA = new(place, 0, 0) });
        var clock = new SwingClock();
        for (int i = 1; i <= 1200; ++i)
        {
            world.Step();
            clock.Observe(i / 60.0, Vector3.Transform(new(direction, 0, 0), world.Bodies[body].Pose.Orientation).X);
        }
        double inertia = mass * (Length * Length + Width * Width) / 12 + mass * c * c + weight * a * a;
        double period = 2 * Math.PI * Math.Sqrt(inertia / (9.81 * Math.Abs(moment)));
        Assert.InRange(clock.Mean() / period, 1 - tolerance, 1 + tolerance);
    }
}
