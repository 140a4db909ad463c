using System;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuPhysics.Constraints;
using Demos.Accuracy;
using DemoTests.Scenes;
using Xunit;

namespace DemoTests.Constraints;

/// <summary>Gears, racks, pulleys, sliders and universal joints in motion, against what is known of such machines.</summary>
public class MechanismSceneTests
{
    const float Gravity = 9.81f;
    static readonly Sphere ball = new(0.3f);

    static TestWorld World() => new(new AccuracySettings { Contacts = ContactScope.None });

    static Hinge Axle(Vector3 onHousing) =>
        new() { LocalOffsetA = onHousing, LocalHingeAxisA = Vector3.UnitZ, LocalHingeAxisB = Vector3.UnitZ };

    /// <summary>An angle about Z that goes on from one turn to the next.</summary>
    sealed class Turns(BodyReference body)
    {
        double last;

        public double Angle { get; private set; }

        public void Observe()
        {
            var q = body.Pose.Orientation;
            var now = 2 * Math.Atan2(q.Z, q.W);
            Angle += Math.IEEERemainder(now - last, 2 * Math.PI);
            last = now;
        }
    }

    /// <summary>190 turns under load, and no tooth is lost.</summary>
    [Theory, InlineData(1), InlineData(-1)]
    public void Gears_keep_their_ratio_for_ever(int sign)
    {
        using var world = World();
        var housing = world.AddKinematic(ball, new RigidPose(Vector3.Zero));
        var small = world.AddDynamic(ball, 1, new RigidPose(new Vector3(-1, 0, 0)));
        var large = world.AddDynamic(ball, 4, new RigidPose(new Vector3(1, 0, 0)));
        world.Solver.Add(housing, small, Axle(new(-1, 0, 0)));
        world.Solver.Add(housing, large, Axle(new(1, 0, 0)));
        world.Solver.Add(small, large, housing, new Gear
        {
            LocalBasisA = Quaternion.Identity,
            LocalBasisB = Quaternion.Identity,
            LocalHousingBasisA = Quaternion.Identity,
            LocalHousingBasisB = Quaternion.Identity,
            TeethA = 12,
            TeethB = 31 * sign,
        });
        // The motor turns the small wheel against the housing; a brake of 1 N m holds the large one back.
        world.Solver.Add(small, housing, new AngularAxisMotor { LocalAxisA = Vector3.UnitZ, TargetVelocity = 20, Settings = new(100, 0) });
        world.Solver.Add(large, housing, new AngularAxisMotor { LocalAxisA = Vector3.UnitZ, Settings = new(1, 0) });
        var (first, second) = (new Turns(world.Bodies[small]), new Turns(world.Bodies[large]));
        for (int i = 0; i < 3600; ++i)
        {
            world.Step();
            first.Observe();
            second.Observe();
        }
        Assert.InRange(Math.Abs(first.Angle), 1190, 1210);
        Assert.Equal(-first.Angle * 12 / (31 * sign), second.Angle, 0.01);
    }

    /// <summary>The housing bears the rest of the torque: what the wheels and it have of angular momentum together is constant.</summary>
    [Fact]
    public void A_free_gearbox_keeps_its_angular_momentum()
    {
        using var world = new TestWorld(new AccuracySettings { Contacts = ContactScope.None, Gravity = default });
        var housing = world.AddDynamic(new Box(2, 0.5f, 0.5f), 2, new RigidPose(Vector3.Zero));
        var small = world.AddDynamic(ball, 1, new RigidPose(new Vector3(-1, 0, 0)), new BodyVelocity(default, new Vector3(0, 0, 30)));
        var large = world.AddDynamic(ball, 4, new RigidPose(new Vector3(1, 0, 0)));
        world.Solver.Add(housing, small, Axle(new(-1, 0, 0)));
        world.Solver.Add(housing, large, Axle(new(1, 0, 0)));
        world.Solver.Add(small, large, housing, new Gear
        {
            LocalBasisA = Quaternion.Identity,
            LocalBasisB = Quaternion.Identity,
            LocalHousingBasisA = Quaternion.Identity,
            LocalHousingBasisB = Quaternion.Identity,
            TeethA = 12,
            TeethB = 31,
        });
        var before = Momentum();
        world.Step(120);
        Assert.Equal(before, Momentum(), 1e-3 * before);
        Assert.True(Math.Abs(world.Bodies[housing].Velocity.Angular.Z) > 0.01f);

        double Momentum()
        {
            double sum = 0;
            foreach (var handle in new[] { housing, small, large })
            {
                var body = world.Bodies[handle];
                Vector3 x = body.Pose.Position, v = body.Velocity.Linear;
                sum += (x.X * v.Y - x.Y * v.X) / body.LocalInertia.InverseMass + body.Velocity.Angular.Z / body.LocalInertia.InverseInertiaTensor.ZZ;
            }
            return sum;
        }
    }

    [Fact]
    public void A_rack_goes_as_far_as_its_pinion_turns()
    {
        using var world = World();
        var housing = world.AddKinematic(ball, new RigidPose(Vector3.Zero));
        var pinion = world.AddDynamic(ball, 1, new RigidPose(Vector3.Zero));
        var rack = world.AddDynamic(ball, 2, new RigidPose(new Vector3(0, -0.2f, 0)));
        world.Solver.Add(housing, pinion, Axle(default));
        world.Solver.Add(housing, rack, new Slider
        {
            LocalOffsetA = new(0, -0.2f, 0),
            LocalAxisA = Vector3.UnitX,
            LocalOrientation = Quaternion.Identity,
        });
        world.Solver.Add(pinion, rack, housing, new Rack
        {
            LocalBasisA = Quaternion.Identity,
            LocalHousingBasis = Quaternion.Identity,
            LocalHousingOffset = new(0, -0.2f, 0),
            LocalHousingAxis = Vector3.UnitX,
            Radius = 0.2f,
            Teeth = 20,
        });
        world.Solver.Add(pinion, housing, new AngularAxisMotor { LocalAxisA = Vector3.UnitZ, TargetVelocity = 5, Settings = new(1000, 0) });
        var turns = new Turns(world.Bodies[pinion]);
        for (int i = 0; i < 600; ++i)
        {
            world.Step();
            turns.Observe();
        }
        Assert.InRange(Math.Abs(turns.Angle), 49, 51);
        Assert.Equal(0.2 * turns.Angle, world.Bodies[rack].Pose.Position.X, 1e-3);
        Assert.Equal(-0.2f, world.Bodies[rack].Pose.Position.Y, 1e-3f);
    }

    // A falls at g - T / mA, B at g - r T / mB, and the rope says that the first is -r times the second.
    [Theory, InlineData(1, 1f, 2f), InlineData(2, 1f, 3f), InlineData(3, 2f, 1f)]
    public void A_pulley_moves_its_weights_as_Atwood_says(float ratio, float massA, float massB)
    {
        using var world = World();
        var top = world.AddKinematic(ball, new RigidPose(new Vector3(0, 10, 0)));
        var a = world.AddDynamic(ball, massA, new RigidPose(new Vector3(-1, 0, 0)));
        var b = world.AddDynamic(ball, massB, new RigidPose(new Vector3(1, 0, 0)));
        world.Solver.Add(a, b, top, new Pulley
        {
            LocalWheelA = new(-1, 0, 0),
            LocalWheelB = new(1, 0, 0),
            Ratio = ratio,
            MaximumLength = 10 + ratio * 10,
        });
        world.Step(60);
        var tension = Gravity * (1 + ratio) / (1 / massA + ratio * ratio / massB);
        Assert.Equal(-(Gravity - tension / massA), world.Bodies[a].Velocity.Linear.Y, 0.03f);
        Assert.Equal(-(Gravity - ratio * tension / massB), world.Bodies[b].Velocity.Linear.Y, 0.03f);
    }

    [Fact]
    public void A_slack_rope_pulls_nothing()
    {
        using var world = World();
        var top = world.AddKinematic(ball, new RigidPose(new Vector3(0, 10, 0)));
        var a = world.AddDynamic(ball, 1, new RigidPose(new Vector3(-1, 9, 0)));
        var b = world.AddDynamic(ball, 1, new RigidPose(new Vector3(1, 9, 0)));
        world.Solver.Add(a, b, top, new Pulley { LocalWheelA = new(-1, 0, 0), LocalWheelB = new(1, 0, 0), Ratio = 1, MaximumLength = 4 });
        world.Step(20);
        Assert.Equal(-Gravity / 3, world.Bodies[a].Velocity.Linear.Y, 1e-3f);
        // They fall 1 m each, and hang.
        world.Step(120);
        Assert.Equal(4, 20 - world.Bodies[a].Pose.Position.Y - world.Bodies[b].Pose.Position.Y, 0.01f);
    }

    [Fact]
    public void What_slides_down_a_slope_neither_turns_nor_leaves_it()
    {
        using var world = World();
        // 30 degrees down along X, with anchors beside the centre: the slope bears the torque of the weight.
        var axis = new Vector3(MathF.Sqrt(0.75f), -0.5f, 0);
        var rail = world.AddKinematic(ball, new RigidPose(Vector3.Zero));
        var start = new Vector3(0.2f, 0.1f, -0.3f);
        var carriage = world.AddDynamic(new Box(1, 0.4f, 0.2f), 3, new RigidPose(start));
        world.Solver.Add(rail, carriage, new Slider { LocalOffsetB = -start, LocalAxisA = axis, LocalOrientation = Quaternion.Identity });
        world.Step(60);
        var pose = world.Bodies[carriage].Pose;
        Assert.Equal(Gravity / 2, Vector3.Dot(world.Bodies[carriage].Velocity.Linear, axis), 0.01f);
        var moved = pose.Position - start;
        Assert.True((moved - axis * Vector3.Dot(moved, axis)).Length() < 2e-3f, $"It left the line: {moved}.");
        Assert.True(Math.Abs(pose.Orientation.W) > 1 - 1e-5f, $"It turned: {pose.Orientation}.");
    }

    /// <summary>A universal joint is a swivel hinge: between shafts at an angle b the second one's speed goes from cos b to 1 / cos b of the first's.</summary>
    [Fact]
    public void A_universal_joint_turns_as_Cardan_says()
    {
        using var world = new TestWorld(new AccuracySettings { Contacts = ContactScope.None, Gravity = default });
        const float Angle = 0.6f;
        var shaft = new Vector3(MathF.Cos(Angle), MathF.Sin(Angle), 0);
        var bearings = world.AddKinematic(ball, new RigidPose(Vector3.Zero));
        var first = world.AddDynamic(ball, 1, new RigidPose(-Vector3.UnitX));
        var second = world.AddDynamic(ball, 1, new RigidPose(shaft));
        world.Solver.Add(bearings, first, new Hinge { LocalOffsetA = -Vector3.UnitX, LocalHingeAxisA = Vector3.UnitX, LocalHingeAxisB = Vector3.UnitX });
        world.Solver.Add(bearings, second, new Hinge { LocalOffsetA = shaft, LocalHingeAxisA = shaft, LocalHingeAxisB = shaft });
        // The cross: one arm in the first shaft, at right angles to it, the other in the second. Both are at right angles to their shafts.
        world.Solver.Add(first, second, new SwivelHinge
        {
            LocalOffsetA = Vector3.UnitX,
            LocalSwivelAxisA = Vector3.UnitZ,
            LocalOffsetB = -shaft,
            LocalHingeAxisB = new Vector3(-shaft.Y, shaft.X, 0),
        });
        world.Solver.Add(first, bearings, new AngularAxisMotor { LocalAxisA = Vector3.UnitX, TargetVelocity = 2, Settings = new(1000, 0) });
        world.Step(60);
        float least = float.MaxValue, greatest = 0;
        for (int i = 0; i < 300; ++i)
        {
            world.Step();
            var ratio = Vector3.Dot(world.Bodies[second].Velocity.Angular, shaft) / world.Bodies[first].Velocity.Angular.X;
            least = MathF.Min(least, ratio);
            greatest = MathF.Max(greatest, ratio);
        }
        Assert.Equal(MathF.Cos(Angle), least, 0.01f);
        Assert.Equal(1 / MathF.Cos(Angle), greatest, 0.01f);
    }
}
