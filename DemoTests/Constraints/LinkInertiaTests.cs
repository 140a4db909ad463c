using System;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuPhysics.Constraints;
using Demos.Accuracy;
using DemoTests.Scenes;
using Xunit;

namespace DemoTests.Constraints;

/// <summary>A light body that heavy ones hang in at the ends of long arms has the inertia that it lacks beside theirs, and nothing else has any.</summary>
public class LinkInertiaTests
{
    static readonly Box box = new(0.4f, 0.3f, 0.5f);
    static readonly Vector3 above = new(0.5f, 1, 0.25f), below = new(-0.5f, -0.75f, 0), beside = new(1, 0, 0);
    const float LinkMass = 2;

    // In double precision, from what the rule says: a tenth of the second greatest inertia that neighbours have at the link's arms, of their masses beyond
    // twice the link's, less the harmonic mean of the link's own moments.
    static double Added(double second)
    {
        var (x, y, z) = Own();
        return Math.Max(0, 0.1 * second - 3 / (1 / x + 1 / y + 1 / z));
    }

    static (double X, double Y, double Z) Own()
    {
        double xx = 0.4f * (double)0.4f, yy = 0.3f * (double)0.3f, zz = 0.5f * (double)0.5f;
        return (LinkMass * (yy + zz) / 12, LinkMass * (xx + zz) / 12, LinkMass * (xx + yy) / 12);
    }

    static double Worth(double mass, Vector3 arm) => (mass - 2 * LinkMass) * arm.LengthSquared();

    [Theory]
    [InlineData(true)]
    [InlineData(false)]
    public void A_link_has_a_part_of_what_its_second_neighbour_has(bool isHung)
    {
        foreach (var order in new int[][] { [0, 1, 2], [2, 1, 0], [1, 0, 2], [1, 2, 0], [0, 2, 1], [2, 0, 1] })
        {
            using var world = New(out var link);
            BodyHandle[] bodies =
                [isHung ? Kinematic(world, above) : Body(world, above, 500), Body(world, below, 90), Body(world, beside, 120)];
            foreach (var i in order)
                Join(world, link, bodies[i], i == 0 ? above : i == 1 ? below : beside);
            AssertAdded(world, link, Added(Math.Max(Worth(90, below), Worth(120, beside))));
        }
    }

    [Fact]
    public void Joints_of_all_kinds_that_hold_points_make_a_link()
    {
        using var world = New(out var link);
        var (a, b) = (Body(world, above, 100), Body(world, below, 80));
        world.Solver.Add(link, a, new Hinge { LocalOffsetA = above, LocalHingeAxisA = Vector3.UnitX, LocalHingeAxisB = Vector3.UnitX });
        world.Solver.Add(b, link, new BallSocketMotor { LocalOffsetB = below, Settings = new(float.MaxValue, 0) });
        AssertAdded(world, link, Added(Worth(80, below)));
    }

    /// <summary>A door turns in two joints of one frame, whatever that weighs; what is fixed to the world twice turns about the line through both.</summary>
    [Theory]
    [InlineData("door")]
    [InlineData("gate")]
    [InlineData("end")]
    [InlineData("chain")]
    [InlineData("spring")]
    [InlineData("servo")]
    [InlineData("short arms")]
    public void What_is_no_link_has_its_own(string what)
    {
        using var world = New(out var link);
        var frame = Body(world, above, 1000);
        Join(world, link, frame, what == "short arms" ? above * .01f : above);
        switch (what)
        {
            case "door":
                Join(world, link, frame, below);
                break;
            case "gate":
                world.Bodies[frame].BecomeKinematic();
                Join(world, link, Kinematic(world, below), below);
                break;
            case "chain":
                Join(world, link, Body(world, below, 2 * LinkMass), below);
                break;
            case "spring":
                world.Solver.Add(link, Body(world, below, 1000), new BallSocket { LocalOffsetA = below, SpringSettings = new(5, 1) });
                break;
            case "servo":
                var settings = new ServoSettings(float.MaxValue, 0, maximumForce: 1e6f);
                world.Solver.Add(link, Body(world, below, 1000), new BallSocketServo { LocalOffsetA = below, ServoSettings = settings });
                break;
            case "short arms":
                Join(world, link, Body(world, below * .01f, 1000), below * .01f);
                break;
        }
        AssertAdded(world, link, 0);
    }

    /// <summary>It is found anew in each step: who is let go is as before.</summary>
    [Fact]
    public void A_link_that_is_let_go_has_its_own_again()
    {
        using var world = New(out var link);
        Join(world, link, Kinematic(world, above), above);
        var joint = world.Solver.Add(link, Body(world, below, 90), new BallSocket { LocalOffsetA = below });
        AssertAdded(world, link, Added(Worth(90, below)));
        world.Solver.Remove(joint);
        AssertAdded(world, link, 0);
    }

    /// <summary>What hangs on the same side as something heavier counts by how far they are apart, in either order.</summary>
    [Theory]
    [InlineData(true, false)]
    [InlineData(true, true)]
    [InlineData(false, false)]
    [InlineData(false, true)]
    public void A_weight_near_the_pivot_of_a_lever_counts_by_its_lever(bool isHung, bool weightIsFirst)
    {
        foreach (var weight in new[] { above + new Vector3(0.1f, 0.5f, 0), above * 0.7f, new Vector3(-0.2f, 1.1f, 0.3f), above })
        {
            using var world = New(out var link);
            var pivot = isHung ? Kinematic(world, above) : Body(world, above, 50_000);
            var body = Body(world, weight, 400);
            if (weightIsFirst)
                Join(world, link, body, weight);
            Join(world, link, pivot, above);
            if (!weightIsFirst)
                Join(world, link, body, weight);
            // Arms of others are known to a hundredth.
            // The link is small beside its arms, and has a part of its own mass there at least.
            var own = 0.33 / 0.1 * LinkMass * weight.LengthSquared();
            AssertAdded(world, link, Added(Math.Max(own, Math.Min(Worth(400, weight), Worth(400, weight - above)))), tolerance: 0.04);
        }
    }

    /// <summary>To a hundredth of the longest component, at any length.</summary>
    [Fact]
    public void An_arm_is_kept_in_32_bits()
    {
        var random = new Random(3);
        for (int i = 0; i < 10_000; ++i)
        {
            var arm = new Vector3(random.NextSingle() - 0.5f, random.NextSingle() - 0.5f, random.NextSingle() - 0.5f) *
                MathF.Pow(10, random.NextSingle() * 40 - 20);
            var kept = LinkInertia.Unpack(LinkInertia.Pack(arm));
            var longest = Math.Max(Math.Max(Math.Abs(arm.X), Math.Abs(arm.Y)), Math.Abs(arm.Z));
            var off = (kept - arm) / longest;
            Assert.InRange(Math.Max(Math.Max(Math.Abs(off.X), Math.Abs(off.Y)), Math.Abs(off.Z)), 0, 0.01f);
        }
    }

    static TestWorld New(out BodyHandle link)
    {
        var world = new TestWorld(new AccuracySettings { Gravity = default, Contacts = ContactScope.None });
        link = world.AddDynamic(box, LinkMass, RigidPose.Identity);
        return world;
    }

    static BodyHandle Body(TestWorld world, Vector3 place, float mass) => world.AddDynamic(box, mass, new(place, Quaternion.Identity));

    static BodyHandle Kinematic(TestWorld world, Vector3 place) => world.AddKinematic(box, new(place, Quaternion.Identity));

    static void Join(TestWorld world, BodyHandle link, BodyHandle other, Vector3 arm) =>
        world.Solver.Add(link, other, new BallSocket { LocalOffsetA = arm, LocalOffsetB = arm - world.Bodies[other].Pose.Position });

    // Everything is at rest where its joints hold it, so that the world's axes stay those of the link.
    static void AssertAdded(TestWorld world, BodyHandle link, double added, double tolerance = 1e-4)
    {
        world.Step(2);
        var inverse = world.Bodies.ActiveSet.WorldInertias[world.Bodies[link].MemoryLocation.Index].InverseInertiaTensor;
        var (x, y, z) = Own();
        Assert.Equal(1, inverse.XX * (x + added), tolerance);
        Assert.Equal(1, inverse.YY * (y + added), tolerance);
        Assert.Equal(1, inverse.ZZ * (z + added), tolerance);
        Assert.True(Math.Abs(inverse.YX) + Math.Abs(inverse.ZX) + Math.Abs(inverse.ZY) < 1e-4f * inverse.XX);
    }
}
