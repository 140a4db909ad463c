using System;
using System.Collections.Generic;
using System.Linq;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using Xunit;

namespace DemoTests.LoadPath;

/// <summary>What is pressed between things that do not give way, and let go, at the default setting.</summary>
/// <remarks>
/// Overlap is corrected at the recovery velocity of the material at most. So however long something was pressed, and however deep, no surface leaves another
/// faster, and of a row that a wall is behind the n-th body is no faster than n times that. What presses had grown without end, and threw a box at 30 m/s
/// after three seconds.
/// </remarks>
public class ClampedTests
{
    // Of the ready-made material, m/s.
    const float Recovery = 2;

    readonly record struct Vice(LoadPathWorld World, BodyHandle Jaw, List<BodyHandle> Boxes) : IDisposable
    {
        /// <summary>Boxes in a row, half a metre above the ground, and a jaw at each end of the row.</summary>
        internal static Vice Create(int count)
        {
            var world = new LoadPathWorld(LoadPathMode.WhereNeeded, friction: 1);
            var boxes = Enumerable.Range(0, count).Select(i => world.Add(new Vector3(.5f + i, 1, 0), Vector3.One, 1)).ToList();
            var shape = world.Simulation.Shapes.Add(new Box(.5f, 1, 1));
            world.Simulation.Statics.Add(new StaticDescription(new Vector3(count + .25f, 1, 0), shape));
            return new(world, world.Simulation.Bodies.Add(BodyDescription.CreateKinematic(new Vector3(-.25f, 1, 0), shape, -1)), boxes);
        }

        internal void Move(float way, float seconds)
        {
            World.Simulation.Bodies[Jaw].Velocity.Linear = new Vector3(way / seconds, 0, 0);
            World.Run(seconds);
            World.Simulation.Bodies[Jaw].Velocity.Linear = default;
        }

        public void Dispose() => World.Dispose();
    }

    [Theory]
    [InlineData(1, .1f, .5f), InlineData(1, .1f, 10), InlineData(1, .3f, 3), InlineData(3, .3f, 3)]
    public void What_was_clamped_is_let_go_no_faster_than_overlaps_are_corrected(int count, float squeeze, float seconds)
    {
        using var vice = Vice.Create(count);
        vice.Move(squeeze, .1f);
        vice.World.Run(seconds);
        // It is held by friction alone, all the while.
        Assert.All(vice.Boxes, box => Assert.InRange(vice.World.Position(box).Y, .98f, 1.02f));
        for (int step = 0; step < 20; ++step)
        {
            vice.Move(-1 / 60f, 1 / 60f);
            for (int i = 0; i < count; ++i)
                Assert.InRange(vice.World.Velocity(vice.Boxes[i]).X, -(count - i) * Recovery, (count - i) * Recovery);
        }
    }

    /// <summary>What is pressed alike from both sides is in the middle. It had gone to one side, as of two velocities one is always the last.</summary>
    [Theory, InlineData(1), InlineData(3)]
    public void What_is_clamped_stays_in_the_middle(int count)
    {
        const float squeeze = .1f;
        using var vice = Vice.Create(count);
        vice.Move(squeeze, .1f);
        vice.World.Run(5);
        var middle = vice.Boxes.Average(box => vice.World.Position(box).X);
        Assert.InRange(middle - (count + squeeze) / 2, -.005f, .005f);
    }

    /// <summary>A crate on the ground that a door has come upon, and a door that opens again.</summary>
    [Theory, InlineData(1), InlineData(3)]
    public void A_crate_behind_a_door_stays_there_when_it_opens(float seconds)
    {
        using var world = new LoadPathWorld(LoadPathMode.WhereNeeded);
        var crate = world.Add(new Vector3(.5f, .5f, 0), Vector3.One, 1);
        world.Simulation.Statics.Add(new StaticDescription(new Vector3(1.5f, 2, 0), world.Simulation.Shapes.Add(new Box(1, 4, 10))));
        var door = world.Simulation.Bodies.Add(BodyDescription.CreateKinematic(
            new Vector3(-.25f, 1.01f, 0), world.Simulation.Shapes.Add(new Box(.5f, 2, 4)), -1));
        world.Simulation.Bodies[door].Velocity.Linear = new Vector3(.3f, 0, 0);
        world.Run(.5f);
        world.Simulation.Bodies[door].Velocity.Linear = default;
        world.Run(seconds);
        world.Simulation.Bodies[door].Velocity.Linear = new Vector3(-.6f, 0, 0);
        for (int step = 0; step < 60; ++step)
        {
            world.Step();
            Assert.InRange(world.Velocity(crate).Length(), 0, Recovery);
        }
    }
}
