using System;
using System.Numerics;
using Demos.Running;
using Demos.Scenes;
using DemoTests.Support;
using Xunit;

namespace DemoTests.Runner;

/// <summary>The figures of a run against scenes whose answers are known.</summary>
[Collection(AloneCollection.Name)]
public class SceneRunTests
{
    static readonly RunSettings shortRun = new() { Steps = 30, Warmup = 5 };

    [Fact]
    public void Free_fall_ends_where_it_should_and_all_figures_say_so()
    {
        var scene = new SceneDescription { Name = "fall", Damping = 0 };
        int box = scene.AddBox(0.5f, 0.5f, 0.5f);
        scene.AddDynamic(box, 2, new Vector3(0, 10, 0), angularVelocity: new Vector3(0, 3, 0));

        RunResult result = Run(scene, shortRun);

        // Half a second: 5 m/s; I = m/6 about any axis of a unit cube.
        Assert.Equal(0.5 * 2 * 25 + 0.5 * (2 / 6.0) * 9, result.KineticEnergy, 2);
        Assert.InRange(result.PotentialEnergy, 2 * 10 * (10 - 1.35), 2 * 10 * (10 - 1.2));
        Assert.Equal((1, 1, 0, 1, 0, 0), (result.Bodies, result.Awake, result.Statics, result.Moved, result.Lost, result.NotFinite));
        Assert.Null(result.MaximumJointError);
        Assert.Null(result.MaximumPenetration);
        StepTimes times = result.Times;
        Assert.True(times.Max >= times.P99 && times.P99 >= times.P95 && times.P95 >= times.Median);
    }

    [Fact]
    public void Contacts_are_counted_and_their_depth_is_measured()
    {
        var scene = new SceneDescription { Name = "rest" };
        int ground = scene.AddBox(5, 1, 5);
        int box = scene.AddBox(0.5f, 0.5f, 0.5f);
        scene.AddStatic(ground, new Vector3(0, -1, 0));
        scene.AddDynamic(box, 1, new Vector3(0, 0.49f, 0));

        RunResult result = Run(scene, shortRun with { Steps = 1, Warmup = 0 });

        Assert.Equal((1, 1, 4), (result.Pairs, result.Manifolds, result.Contacts));
        Assert.InRange(result.MaximumPenetration!.Value, 1e-6, 0.01);
        Assert.Equal((1, 0), (result.Statics, result.Moved));
    }

    [Theory]
    [InlineData(0, 0, true)]
    [InlineData(0, 3, true)]
    [InlineData(3, 4, true)]
    [InlineData(3, 3, false)]
    [InlineData(-1, 0, false)]
    [InlineData(-1, -1, false)]
    [InlineData(5, -1, false)]
    public void Groups_decide_who_collides(int groupA, int groupB, bool collide)
    {
        var scene = new SceneDescription { Name = "groups" };
        int sphere = scene.AddSphere(0.5f);
        scene.AddDynamic(sphere, 1, Vector3.Zero, group: groupA);
        scene.AddDynamic(sphere, 1, new Vector3(0.75f, 0, 0), group: groupB);

        Assert.Equal(collide ? 1 : 0, Run(scene, shortRun with { Steps = 1, Warmup = 0 }).Pairs);
    }

    [Fact]
    public void A_static_takes_part_in_its_group()
    {
        var scene = new SceneDescription { Name = "groups" };
        int sphere = scene.AddSphere(0.5f);
        scene.Bodies.Add(new SceneBody
        {
            Kind = SceneBodyKind.Static,
            Children = [new SceneChild(sphere, Vector3.Zero, Quaternion.Identity)],
            Group = 2,
        });
        scene.AddDynamic(sphere, 1, new Vector3(0.75f, 0, 0), group: 2);
        scene.AddDynamic(sphere, 1, new Vector3(-0.75f, 0, 0));

        Assert.Equal(1, Run(scene, shortRun with { Steps = 1, Warmup = 0 }).Pairs);
    }

    [Fact]
    public void A_joint_to_a_static_holds()
    {
        var scene = new SceneDescription { Name = "pendulum", Damping = 0 };
        int sphere = scene.AddSphere(0.1f);
        scene.AddStatic(sphere, new Vector3(0, 5, 0));
        scene.AddDynamic(sphere, 1, new Vector3(2, 5, 0), group: -1);
        scene.Joints.Add(new SceneJoint { Kind = SceneJointKind.Ball, BodyA = 0, BodyB = 1, AnchorB = new Vector3(-2, 0, 0) });

        RunResult result = Run(scene, new RunSettings { Steps = 60 });

        Assert.InRange(result.MaximumJointError!.Value, 0, 0.02);
        Assert.InRange(result.RmsJointError!.Value, 0, result.MaximumJointError.Value);
        Assert.Equal(1, result.Moved);
    }

    [Theory]
    [InlineData(0.3f, 0.6f)]
    [InlineData(-0.6f, -0.3f)]
    public void A_twist_limit_turns_the_second_body_about_its_local_y(float minimum, float maximum)
    {
        // The neutral twist is outside of the limits: the limit has to turn the bodies into them, the lighter one further.
        var placed = Quaternion.CreateFromYawPitchRoll(0.3f, 0.7f, -0.4f);
        var turned = Quaternion.Normalize(placed * Quaternion.CreateFromAxisAngle(Vector3.UnitY, 2));
        RunResult result = RunRag(placed, turned, 3, minimum, maximum, out Quaternion relative);

        // The relative rotation, less the 2 radians that it was placed with, about y.
        double twist = 2 * Math.Atan2(relative.Y, relative.W) - 2;
        Assert.InRange(twist, minimum - 0.02, maximum + 0.02);
        Assert.Equal(0, result.NotFinite);
    }

    [Fact]
    public void A_damped_body_slows_down_as_its_rate_says()
    {
        var scene = new SceneDescription { Name = "damping", Damping = 2 };
        int sphere = scene.AddSphere(1);
        scene.AddDynamic(sphere, 1, Vector3.Zero, angularVelocity: new Vector3(4, 0, 0), linearVelocity: new Vector3(3, 0, 0));
        scene.AddDynamic(sphere, 1, new Vector3(0, 100, 0));

        RunResult result = Run(scene, new RunSettings { Steps = 60 });

        // The second body tells what gravity did; the rest is the first one's own motion, slowed for one second.
        RunResult fall = Run(WithoutMotion(scene), new RunSettings { Steps = 60 });
        double own = 0.5 * 9 + 0.5 * 0.4 * 16;
        Assert.Equal(own * Math.Exp(-4), result.KineticEnergy - fall.KineticEnergy, 3);
    }

    [Fact]
    public void The_same_run_has_the_same_hashes_and_another_state_another()
    {
        SceneDescription scene = SceneLibrary.Load("newton", 1);
        RunSettings settings = shortRun with { HashEvery = 10 };

        RunResult one = Run(scene, settings), other = Run(scene, settings), faster = Run(scene, settings with { StepDuration = 0.02f });

        Assert.Equal(one.Hashes, other.Hashes);
        Assert.Equal(3, one.Hashes.Count);
        Assert.NotEqual(one.Hash, faster.Hash);
        Assert.NotEqual(one.Hashes[0].Hash, one.Hashes[1].Hash);
    }

    [Fact]
    public void Garbage_between_the_steps_is_not_counted_as_theirs()
    {
        SceneDescription scene = SceneLibrary.Load("newton", 1);
        using var run = new SceneRun(scene, shortRun);
        object[] kept = new object[1];

        // One piece of garbage is much more than what the listener to the JIT, which hears the whole process, allocates meanwhile.
        const int garbage = 4_000_000;
        RunResult result = run.Run(_ => kept[0] = new byte[garbage]);

        Assert.NotNull(kept[0]);
        // Below zero where that listener's thread took its allocations into account in between.
        Assert.InRange(result.ManagedBytes, -garbage / 2, garbage / 2);
    }

    static RunResult RunRag(
        Quaternion orientationA, Quaternion orientationB, float swing, float minimum, float maximum, out Quaternion relative)
    {
        var scene = new SceneDescription { Name = "rag", Damping = 1 };
        int box = scene.AddBox(0.5f, 0.5f, 0.5f);
        scene.AddDynamic(box, 1, Vector3.Zero, orientationA, group: -1);
        scene.AddDynamic(box, 1, Vector3.Zero, orientationB, group: -1);
        scene.Joints.Add(new SceneJoint
        {
            Kind = SceneJointKind.Rag,
            BodyA = 0,
            BodyB = 1,
            MaximumSwing = swing,
            MinimumTwist = minimum,
            MaximumTwist = maximum,
        });
        using var run = new SceneRun(scene, new RunSettings { Steps = 240 });
        RunResult result = run.Run();
        relative = Quaternion.Normalize(Quaternion.Conjugate(run.Orientation(0)) * run.Orientation(1));
        return result;
    }

    static SceneDescription WithoutMotion(SceneDescription scene)
    {
        var still = new SceneDescription { Name = scene.Name, Damping = scene.Damping };
        int sphere = still.AddSphere(1);
        foreach (SceneBody body in scene.Bodies)
            still.AddDynamic(sphere, body.Mass, body.Position);
        return still;
    }

    static RunResult Run(SceneDescription scene, RunSettings settings)
    {
        using var run = new SceneRun(scene, settings);
        return run.Run();
    }
}
