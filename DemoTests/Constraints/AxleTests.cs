using System;
using System.Linq;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuPhysics.Constraints;
using BepuUtilities;
using Demos.Accuracy;
using Demos.References;
using Demos.Running;
using DemoTests.Scenes;
using Xunit;
using Xunit.Abstractions;

namespace DemoTests.Constraints;

/// <summary>Wheels that spin on axles which are bodies themselves. Nothing turns a balanced wheel about its own axis: its spin is a constant.</summary>
public class AxleTests(ITestOutputHelper output)
{
    const float G = 9.81f;
    static readonly Cylinder wheel = new(0.35f, 0.2f);
    static readonly Quaternion alongX = Quaternion.CreateFromAxisAngle(Vector3.UnitZ, -MathF.PI / 2);
    static readonly ServoSettings servo = new(float.MaxValue, 0, float.MaxValue);

    static TestWorld NewWorld(float gravity, int substeps = 4, int relaxations = 0, DirectJointsChoice directJoints = DirectJointsChoice.Off) =>
        new(new AccuracySettings
        {
            Gravity = new(0, -gravity, 0),
            Contacts = ContactScope.None,
            SubstepCount = substeps,
            RelaxationCount = relaxations,
            DirectJoints = directJoints,
        });

    static Hinge OnAxle(float offset) => new()
    {
        LocalOffsetA = new(offset, 0, 0),
        LocalHingeAxisA = Vector3.UnitX,
        LocalHingeAxisB = Vector3.UnitY,
    };

    static double Spin(TestWorld world, BodyHandle handle)
    {
        var body = world.Bodies[handle];
        return DoubleVector.Dot(new(body.Velocity.Angular), DoubleRotation.From(body.Pose.Orientation) * new DoubleVector(0, 1, 0));
    }

    /// <summary>
    /// A gyroscope: a wheel on a rod that is held at its end and goes round level, beside a top in double precision. The rod, which does not spin, only adds to
    /// weight and to inertia across.
    /// </summary>
    [Theory]
    [InlineData(20, 4, 0, DirectJointsChoice.Off, 0.04)]
    [InlineData(60, 4, 0, DirectJointsChoice.Off, 0.01)]
    [InlineData(200, 4, 0, DirectJointsChoice.Off, 0.01)]
    [InlineData(200, 8, 0, DirectJointsChoice.Off, 0.01)]
    [InlineData(200, 4, 1, DirectJointsChoice.Off, 0.01)]
    [InlineData(20, 4, 0, DirectJointsChoice.Always, 0.005)]
    [InlineData(200, 4, 0, DirectJointsChoice.Always, 0.005)]
    public void A_gyroscope_goes_round_as_a_top_does(float speed, int substeps, int relaxations, DirectJointsChoice directJoints, double tolerance)
    {
        const float mass = 10, rodMass = 1, length = 0.4f, duration = 10;
        var disc = new Cylinder(0.3f, 0.1f);
        var rod = new Box(length, 0.06f, 0.06f);
        var ofDisc = disc.ComputeInertia(mass).InverseInertiaTensor;
        var ofRod = rod.ComputeInertia(rodMass).InverseInertiaTensor;
        double axial = 1 / ofDisc.YY, weightTimesArm = (double)G * length * (mass + rodMass / 2);
        double across = 1 / ofDisc.XX + 1 / ofRod.YY + (double)length * length * (mass + rodMass / 4);
        double rate = weightTimesArm / (axial * speed);
        using var world = NewWorld(G, substeps, relaxations, directJoints);
        var anchor = world.AddKinematic(rod, new RigidPose(Vector3.Zero));
        var turn = new Vector3(0, (float)rate, 0);
        var arm = new Vector3(length, 0, 0);
        var axle = world.AddDynamic(rod, rodMass, new RigidPose(arm / 2), new BodyVelocity(Vector3.Cross(turn, arm / 2), turn));
        var spinning = world.AddDynamic(disc, mass, new RigidPose(arm, alongX), new BodyVelocity(Vector3.Cross(turn, arm), turn + new Vector3(speed, 0, 0)));
        world.Solver.Add(anchor, axle, new BallSocket { LocalOffsetB = -arm / 2 });
        world.Solver.Add(axle, spinning, OnAxle(length / 2));
        // Tilted from +y to +z, spun the same way.
        var truth = new HeavyTop(new(across, axial, across), DoubleQuaternion.FromAxisAngle(new(1, 0, 0), Math.PI / 2), new(0, speed, -rate), weightTimesArm);
        double turned = 0, expected = 0;
        var (last, lastOfTruth) = (world.Bodies[spinning].Pose.Position, truth.Axis);
        for (int step = 0; step < duration * 60; ++step)
        {
            world.Step();
            truth.Advance(TestWorld.Dt, 1e-4);
            var (now, nowOfTruth) = (world.Bodies[spinning].Pose.Position, truth.Axis);
            turned += Math.Atan2((double)last.Z * now.X - (double)last.X * now.Z, (double)last.X * now.X + (double)last.Z * now.Z);
            expected += Math.Atan2(
                lastOfTruth.Z * nowOfTruth.X - lastOfTruth.X * nowOfTruth.Z, lastOfTruth.X * nowOfTruth.X + lastOfTruth.Z * nowOfTruth.Z);
            (last, lastOfTruth) = (now, nowOfTruth);
        }
        output.WriteLine($"round by {turned:0.000} rad, a top by {expected:0.000}; spin {Spin(world, spinning) / speed:0.00000} of what it was");
        Assert.Equal(rate * duration, expected, 0.001 * expected);
        Assert.Equal(expected, turned, tolerance * expected);
        Assert.Equal(speed, Spin(world, spinning), 1e-3 * speed);
    }

    /// <summary>A wheel on a light hub that hangs on three soft springs, and swings on them.</summary>
    [Theory]
    [InlineData(20)]
    [InlineData(60)]
    [InlineData(200)]
    public void A_wheel_on_a_hub_that_swings_keeps_its_spin(float speed)
    {
        using var world = NewWorld(G);
        var box = new Box(0.15f, 0.15f, 0.15f);
        var anchor = world.AddKinematic(box, new RigidPose(Vector3.Zero));
        var hub = world.AddDynamic(box, 2, new RigidPose(new Vector3(0, -0.5f, 0)));
        var spinning = world.AddDynamic(wheel, 20, new RigidPose(new Vector3(0.2f, -0.5f, 0), alongX), new BodyVelocity(default, new Vector3(speed, 0, 0)));
        foreach (var onHub in new[] { new Vector3(0, 0.1f, 0), new Vector3(0, 0.1f, 0.3f), new Vector3(0, -0.2f, 0) })
        {
            world.Solver.Add(anchor, hub, new BallSocket
            {
                LocalOffsetA = onHub - new Vector3(0, 0.5f, 0),
                LocalOffsetB = onHub,
                SpringSettings = new(5, 0.5f),
            });
        }
        world.Solver.Add(hub, spinning, OnAxle(0.2f));
        AssertKeepsSpin(world, spinning);
    }

    /// <summary>A wheel of 20 kg on an upright of 3 kg, sprung on a chassis that turns about all axes at once, freely.</summary>
    [Theory]
    [InlineData(20, true)]
    [InlineData(60, true)]
    [InlineData(200, true)]
    [InlineData(20, false)]
    [InlineData(60, false)]
    [InlineData(200, false)]
    public void A_wheel_on_the_upright_of_a_car_keeps_its_spin(float speed, bool oneJoint)
    {
        using var world = NewWorld(gravity: 0);
        var turn = new Vector3(0.2f, 1, 0.1f);
        Vector3 onChassis = new(1.1f, 0, 1.5f), onUpright = new(0.2f, 0, 0);
        BodyVelocity At(Vector3 place) => new(Vector3.Cross(turn, place), turn);
        var chassis = world.AddDynamic(new Box(2, 0.6f, 4), 1000, new RigidPose(Vector3.Zero), At(Vector3.Zero));
        var upright = world.AddDynamic(new Box(0.1f, 0.2f, 0.1f), 3, new RigidPose(onChassis), At(onChassis));
        var velocity = At(onChassis + onUpright);
        velocity.Angular.X += speed;
        var spinning = world.AddDynamic(wheel, 20, new RigidPose(onChassis + onUpright, alongX), velocity);
        world.Solver.Add(chassis, upright, new PointOnLineServo { LocalOffsetA = onChassis, LocalDirection = Vector3.UnitY, ServoSettings = servo });
        world.Solver.Add(chassis, upright, new LinearAxisServo
        {
            LocalOffsetA = onChassis,
            LocalPlaneNormal = Vector3.UnitY,
            ServoSettings = servo,
            SpringSettings = new(3, 0.5f),
        });
        world.Solver.Add(chassis, upright, new AngularServo { TargetRelativeRotationLocalA = Quaternion.Identity, ServoSettings = servo });
        if (oneJoint)
        {
            world.Solver.Add(upright, spinning, OnAxle(0.2f));
        }
        else
        {
            world.Solver.Add(upright, spinning, new BallSocket { LocalOffsetA = onUpright });
            world.Solver.Add(upright, spinning, new AngularHinge { LocalHingeAxisA = Vector3.UnitX, LocalHingeAxisB = Vector3.UnitY });
        }
        AssertKeepsSpin(world, spinning);
    }

    void AssertKeepsSpin(TestWorld world, BodyHandle spinning)
    {
        var start = Spin(world, spinning);
        world.Step(600);
        output.WriteLine($"{Spin(world, spinning) / start:0.00000}");
        Assert.Equal(start, Spin(world, spinning), 1e-3 * start);
    }

    // Principal axes are those of the frame, turned about its z.
    static SampleBody Body(Quaternion orientation, Vector3 angular, Vector3 inverseInertia, float turned = 0) => new()
    {
        Orientation = orientation,
        Angular = angular,
        InverseMass = 1,
        InverseInertia = JointSamples.InWorld(inverseInertia, Exact.Normalize(orientation * Quaternion.CreateFromAxisAngle(Vector3.UnitZ, turned))),
    };

    // A's axis is x and B's is y of its frame, off by an angle; B spins about its own.
    static double[] Seen(float angle, Vector3 inverseInertiaA, Vector3 inverseInertiaB, float spinOfA = 0, float turned = 0)
    {
        var orientation = Exact.Normalize(Quaternion.CreateFromAxisAngle(Exact.Normalize(new Vector3(0, 0.6f, 0.8f)), angle) * alongX);
        var axis = Vector3.Transform(Vector3.UnitY, orientation);
        var probe = JointProbes.New<AngularHinge>();
        for (int lane = 0; lane < Vector<float>.Count; ++lane)
        {
            probe.Set(lane, new() { LocalHingeAxisA = Vector3.UnitX, LocalHingeAxisB = Vector3.UnitY },
                [Body(Quaternion.Identity, Vector3.UnitX * spinOfA, inverseInertiaA), Body(orientation, axis * 100, inverseInertiaB, turned)]);
        }
        return probe.RelativeVelocity(0);
    }

    static readonly Vector3 balanced = new(2, 1, 2);
    static readonly Vector3 light = new(20, 30, 40);

    /// <summary>
    /// However far the axes are apart, up to a quarter turn, rows see nothing of the spin of a wheel on a light body: as near as rounding lets its balance be
    /// known.
    /// </summary>
    [Theory]
    [InlineData(1e-3f)]
    [InlineData(0.1f)]
    [InlineData(0.7f)]
    [InlineData(1.5f)]
    public void Rows_do_not_see_a_wheel_spin(float angle) =>
        Assert.All(Seen(angle, light, balanced), row => Assert.Equal(0, row, 1e-5 + 100 * Math.Sin(angle) * 1e-3));

    /// <summary>
    /// On what is kinematic or hard to turn, of what is not balanced, and where it is A that is the wheel, tangents of A stay. So they do where axes are
    /// opposite.
    /// </summary>
    [Fact]
    public void All_else_keeps_the_tangents_of_A()
    {
        const float angle = 0.1f;
        var seen = 100 * Math.Sin(angle);
        double Length(double[] rows) => Math.Sqrt(rows.Sum(row => row * row));
        Assert.Equal(seen, Length(Seen(angle, default, balanced)), 1e-3);
        Assert.Equal(seen, Length(Seen(angle, new(0.1f, 0.1f, 0.1f), balanced)), 1e-3);
        Assert.Equal(seen, Length(Seen(angle, new(1.7f, 1.7f, 1.7f), balanced)), 1e-3);
        Assert.Equal(seen, Length(Seen(angle, light, default)), 1e-3);
        Assert.Equal(seen, Length(Seen(angle, light, balanced, spinOfA: 250)), 1e-3);
        Assert.Equal(seen, Length(Seen(angle, light, balanced, turned: 0.1f)), 1e-3);
        Assert.InRange(Length(Seen(angle, light, balanced, turned: 0.02f)), 0.2 * seen, 0.8 * seen);
        Assert.True(Length(Seen(MathF.PI, light, balanced)) < 1e-3);
        Assert.InRange(Length(Seen(3, light, balanced)), 1, 100);
    }

    /// <summary>
    /// A bar whose hinge is ten degrees beside its axis has loads that go round with it. On a light hub it loses what it lost before, and gains nothing.
    /// </summary>
    [Fact]
    public void What_is_not_balanced_is_held_as_it_was()
    {
        using var world = NewWorld(gravity: 0);
        var box = new Box(0.2f, 0.2f, 0.2f);
        var anchor = world.AddKinematic(box, new RigidPose(Vector3.Zero));
        var hub = world.AddDynamic(box, 5, new RigidPose(Vector3.Zero));
        var tilt = Quaternion.CreateFromAxisAngle(Vector3.UnitZ, -0.17f);
        var rotor = world.AddDynamic(new Box(0.6f, 0.2f, 0.2f), 10, new RigidPose(Vector3.Zero, tilt), new BodyVelocity(default, new Vector3(0, 20, 0)));
        world.Solver.Add(anchor, hub, new Weld { LocalOrientation = Quaternion.Identity });
        var axis = Vector3.Transform(Vector3.UnitY, Quaternion.Conjugate(tilt));
        world.Solver.Add(hub, rotor, new Hinge { LocalHingeAxisA = Vector3.UnitY, LocalHingeAxisB = axis });
        for (int step = 0; step < 600; ++step)
        {
            world.Step();
            Assert.True(world.Bodies[rotor].Velocity.Angular.Length() < 20.2f);
        }
        // .966, the root of what is left of its energy; .906 with tangents that lean.
        Assert.InRange(Vector3.Dot(world.Bodies[rotor].Velocity.Angular, Vector3.UnitY), 0.95f * 20, 20);
    }

    /// <summary>A lane that leans changes no bit of its neighbours, which do not.</summary>
    [Fact]
    public void Lanes_lean_alone()
    {
        JointProbes.AssertLanesAreAlone<Hinge>(new(3), new Substep(0, 1 / 240f, 1, 1), Fill);

        static void Fill(JointProbe<Hinge> probe, int lane, JointSamples samples)
        {
            var hinge = new Hinge { LocalOffsetA = samples.Vector(1), LocalHingeAxisA = samples.Direction(), LocalHingeAxisB = Vector3.UnitY };
            var b = samples.Rotation();
            probe.Set(lane, hinge, [
                Body(samples.Rotation(), samples.Vector(3), samples.Coin() ? light : default),
                Body(b, samples.Vector(3), samples.Coin() ? balanced : light)]);
            probe.SetImpulse(lane, [.. Enumerable.Range(0, 5).Select(_ => (double)samples.Uniform(-1, 1))]);
        }
    }
}
