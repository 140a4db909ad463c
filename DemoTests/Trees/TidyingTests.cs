using System;
using System.Collections.Generic;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuUtilities;
using Demos.Stages;
using DemoTests.Scenes;
using Xunit;

namespace DemoTests.Trees;

/// <summary>The tree of a step is mended for the next ones beside the flush.</summary>
public class TidyingTests
{
    /// <summary>A top that is rebuilt may leave nodes in any order until the next refit, which needs no other memory meanwhile.</summary>
    [Theory]
    [InlineData(300)]
    [InlineData(2500)]
    [InlineData(9000)]
    public void Refining_before_a_refit_that_sorts_makes_the_same_tree(int count)
    {
        using var expected = new TreeModel(TreeGenerators.World(count, seed: 5));
        using var model = new TreeModel(expected.Boxes);
        var unsorted = 0;
        for (int step = 0; step < 40; ++step)
        {
            foreach (var moved in (ReadOnlySpan<TreeModel>)[expected, model])
            {
                moved.MoveAll(leaf => new Vector3((leaf + step) % 5 - 2, (leaf * 3 + step) % 3 - 1, leaf % 7 - 3) * .7f);
                moved.Tree.Refit(moved.Pool);
            }
            Assert.Equal(TreeBytes.Of(expected.Tree), TreeBytes.Of(model.Tree));
            expected.Tree.Refine(expected.Pool);
            using var scratch = new BepuUtilities.Memory.BufferPool();
            model.Tree.RefineUnsorted(scratch);
            unsorted += model.Tree.IsDepthFirst ? 0 : 1;
            model.Validate();
        }
        Assert.True(unsorted > 0);
    }

    [Fact]
    public void The_tree_of_a_step_does_not_depend_on_threads()
    {
        var expected = Run(null);
        foreach (int threads in (ReadOnlySpan<int>)[2, 3, 5])
        {
            using var dispatcher = new ThreadDispatcher(threads);
            TreeBytes.AssertSame(expected, Run(dispatcher));
        }
    }

    static List<byte[]> Run(IThreadDispatcher? dispatcher)
    {
        using var world = new TestWorld();
        AddBoxes(world);
        var trees = new List<byte[]>();
        for (int i = 0; i < 40; ++i)
        {
            world.Simulation.Timestep(1 / 60f, dispatcher);
            world.Simulation.BroadPhase.Validate();
            trees.Add(TreeBytes.Of(world.Simulation.BroadPhase.ActiveTree));
        }
        return trees;
    }

    /// <summary>Notes are applied one after another, which leaves the other threads without anything to do but this.</summary>
    [Fact]
    public void Where_contacts_come_and_go_another_thread_tidies()
    {
        using var world = new TestWorld();
        AddBoxes(world);
        // The second of four stages that each flush has; no other part of it has two blocks in all steps.
        int steps = 0, beside = 0, counted = 0;
        using var dispatcher = new ObservingDispatcher(16, (blocks, _, _) =>
        {
            if (world.Simulation.Profiler.RunningStage == SimulationProfiler.Flush && blocks == 2)
                ++counted;
        });
        for (; steps < 40; ++steps)
        {
            counted = 0;
            world.Simulation.Timestep(1 / 60f, dispatcher);
            beside += counted > 0 ? 1 : 0;
        }
        Assert.True(beside > steps / 2, $"{beside} of {steps} steps");
    }

    static void AddBoxes(TestWorld world)
    {
        world.AddStatic(new Box(60, 1, 60), new RigidPose(new Vector3(0, -.5f, 0)));
        var random = new Random(5);
        for (int i = 0; i < 2500; ++i)
        {
            var pose = new RigidPose(new Vector3(i % 15, 1 + i / 225, i / 15 % 15) * 1.05f, TestWorld.Turn(random));
            world.AddDynamic(new Box(.9f, .7f, .8f), 1, pose, new BodyVelocity(TestWorld.Scatter(random, 12), TestWorld.Scatter(random, 12)));
        }
    }
}
