using System;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuPhysics.Trees;
using BepuUtilities;
using Demos.Accuracy;
using DemoTests.Scenes;
using Xunit;

namespace DemoTests.Trees;

/// <summary>Thousands of bodies that fly past each other: slices that are refined in turn come too late.</summary>
public class MixingWorldTests
{
    [Fact]
    public void ATreeOfWhatFliesAboutStaysNearlyAsGoodAsANewOne()
    {
        const int side = 16;
        using var world = new TestWorld(new AccuracySettings { Gravity = default });
        var ball = new Sphere(.1f);
        var shape = world.Simulation.Shapes.Add(ball);
        var random = new Random(3);
        for (int i = 0; i < side * side * side; ++i)
        {
            var velocity = new BodyVelocity(Vector3.Transform(new(60, 0, 0), TestWorld.Turn(random)));
            world.Bodies.Add(BodyDescription.CreateDynamic(
                new Vector3(i % side, i / side % side, i / (side * side)) * 2, velocity, ball.ComputeInertia(1), shape, -1));
        }
        ref var tree = ref world.Simulation.BroadPhase.ActiveTree;
        var worst = 0f;
        for (int i = 0; i < 40; ++i)
        {
            world.Step();
            var reached = tree.MeasureRelativeCost();
            using var built = new TreeModel(Boxes(tree));
            built.Tree.BinnedBuild(built.Pool);
            worst = MathF.Max(worst, reached / built.Tree.MeasureRelativeCost());
        }
        Assert.InRange(worst, .9f, 1.6f);
    }

    static BoundingBox[] Boxes(in Tree tree)
    {
        var boxes = new BoundingBox[tree.LeafCount];
        for (int i = 0; i < boxes.Length; ++i)
            boxes[i] = tree.GetBounds(i);
        return boxes;
    }
}
