using System.Linq;
using BepuPhysics;
using Demos.Stages;
using DemoTests.Scenes;
using Xunit;

namespace DemoTests.Runner;

public class StageRunTests
{
    [Fact]
    public void Times_of_stages_are_predicted_from_their_blocks()
    {
        var share = new StageShare("");
        share.AddTime(1000);
        // Ten equal blocks; one that takes as long as three others; one alone.
        share.AddStage(10, 400, 40);
        share.AddStage(4, 300, 150);
        share.AddStage(1, 100, 100);

        Assert.Equal(300, share.Serial);
        Assert.Equal(100, share.Lone);
        Assert.Equal(1000 / (300 + 200 + 150.0), share.SpeedUp(0), 12);
        Assert.Equal(1000 / (300 + 100 + 150.0), share.SpeedUp(1), 12);
        Assert.Equal(1000 / (300 + 40 + 150.0), share.SpeedUp(3), 12);
    }

    [Fact]
    public void All_of_a_step_is_accounted_for()
    {
        using var run = new StageRun(SmallScenes.Pile("shape-pile", 12, 8), 0);
        run.Step(8, 2);

        Assert.Equal(6, run.Times.Milliseconds.Count);
        Assert.Equal(["sleep", "predict", "broad", "narrow", "flush", "solve", "between"], run.Shares.Select(share => share.Name));
        foreach (StageShare share in run.Shares)
        {
            Assert.InRange(share.Divided + share.Lone, 0, share.Total);
            Assert.InRange(share.SpeedUp(0), 1, 2);
            Assert.InRange(share.SpeedUp(3), share.SpeedUp(0), 16);
        }
        Assert.True(run.Shares.Single(share => share.Name == "solve").Divided > 0);
    }

    /// <summary>Of runs each stage, and what is on one thread, takes the least by itself.</summary>
    [Fact]
    public void The_least_of_several_runs_is_taken_by_stage()
    {
        var first = new StageTimes();
        first.AddStage(0, 4, 400, 300);
        first.AddStage(1, 2, 50, 30);
        first.EndStep(7, [10, 900]);
        var second = new StageTimes();
        second.AddStage(0, 4, 200, 100);
        second.AddStage(1, 2, 80, 25);
        second.EndStep(9, [60, 20]);
        first.TakeLeast(second);

        StageShare[] shares = first.Sum(["a", "b"]);
        Assert.Equal([7], first.Milliseconds);
        Assert.Equal([210, 70], shares.Select(share => share.Total));
        Assert.Equal([10, 20], shares.Select(share => share.Serial));
        Assert.Equal(210 / (10 + 100.0), shares[0].SpeedUp(1), 12);
        Assert.Equal(70 / (20 + 25.0), shares[1].SpeedUp(0), 12);
        Assert.Throws<System.InvalidOperationException>(() => first.TakeLeast(new StageTimes()));
    }

    /// <summary>What goes comes back where it was, and nothing else changes.</summary>
    [Fact]
    public void Bodies_are_replaced_in_turn()
    {
        using var world = new TestWorld();
        var body = BodyDescription.CreateConvexDynamic(RigidPose.Identity, 1, world.Simulation.Shapes, new BepuPhysics.Collidables.Sphere(1));
        for (int i = 0; i < 5; ++i)
        {
            body.Pose.Position.X = 10 * i;
            world.Bodies.Add(body);
        }
        var replacement = new Replacement(world.Simulation, 2);
        world.Step(3);
        replacement.Step();

        var heights = Enumerable.Range(0, 5).ToDictionary(i => world.Bodies.ActiveSet.MotionStates[i].Pose.Position.X,
            i => world.Bodies.ActiveSet.MotionStates[i].Pose.Position.Y);
        Assert.Equal(0, heights[0]);
        Assert.Equal(0, heights[10]);
        Assert.All([20f, 30f, 40f], x => Assert.True(heights[x] < 0));
    }
}
