using System;
using System.Linq;
using DemoTests.CollisionDetection.Children;
using DemoTests.Support;
using Xunit;
using Xunit.Abstractions;

namespace DemoTests.CollisionDetection.Seams;

/// <summary>Parts of a floor of which every other one is a little higher: felt from where it is more than the rounding of a level.</summary>
public class LipTests(ITestOutputHelper output)
{
    const float Speed = 5;

    public static TheoryData<SeparateFloor, SeamMover> Cases
    {
        get
        {
            var data = new TheoryData<SeparateFloor, SeamMover>();
            foreach (var floor in new[] { SeparateFloor.Boxes, SeparateFloor.Voxels, SeparateFloor.Fields, SeparateFloor.Meshes })
            {
                foreach (var mover in Enum.GetValues<SeamMover>().Where(mover => mover != SeamMover.TwoBoxes))
                    data.Add(floor, mover);
            }
            return data;
        }
    }

    (float Slowest, float Upward, float Highest) Run(SeparateFloor floor, SeamMover mover, float lip)
    {
        using var world = new ClusterWorld(isCluster: true);
        world.Behaviour.Friction = 0;
        var body = SeamMovers.Add(world, mover, Speed);
        SeparateFloors.Add(world, floor, LevelSeeds.Of(1003), lip);
        ref var position = ref world.Simulation.Bodies[body].Pose.Position;
        position.Y += lip;
        var start = position.Y;
        var (slowest, upward, highest) = (Speed, 0f, 0f);
        for (int i = 0; i < 120; ++i)
        {
            world.Step(validate: false);
            var moved = world.Simulation.Bodies[body];
            slowest = Math.Min(slowest, moved.Velocity.Linear.X);
            upward = Math.Max(upward, moved.Velocity.Linear.Y);
            highest = Math.Max(highest, moved.Pose.Position.Y - start);
        }
        output.WriteLine($"{floor} {mover} lip {lip}: slowest {slowest:g5}, upward {upward * 1000:g3} mm/s, highest {highest * 1000:g3} mm");
        return (slowest, upward, highest);
    }

    [Theory, MemberData(nameof(Cases))]
    public void A_lip_of_a_tenth_of_a_millimetre_is_none(SeparateFloor floor, SeamMover mover)
    {
        foreach (var lip in new[] { 0, 1e-6f, 1e-5f, 1e-4f })
        {
            var (slowest, _, highest) = Run(floor, mover, lip);
            Assert.InRange(slowest, Speed * (1 - 1e-3f), Speed);
            // A ball of 2 m goes up by .31 mm over a lip of .1 mm, where .2 may be.
            Assert.InRange(highest, float.NegativeInfinity, mover == SeamMover.LargeSphere ? 3.5e-4f : 2e-4f);
        }
    }

    /// <summary>A lip is none up to a thousandth of the inner radius of what meets it, and is one from four on.</summary>
    [Theory, InlineData(SeamMover.SmallSphere), InlineData(SeamMover.Compound)]
    public void A_lip_of_four_thousandths_is_felt(SeamMover mover)
    {
        var (slowest, upward, _) = Run(SeparateFloor.Boxes, mover, 4e-4f);
        Assert.True(slowest < Speed * (1 - 1e-2f) && upward > .3f, $"slowest {slowest}, upward {upward}");
    }

    [Theory, MemberData(nameof(Cases))]
    public void A_lip_of_a_centimetre_is_hit(SeparateFloor floor, SeamMover mover)
    {
        // The parts of these are larger than the way is long.
        if (floor == SeparateFloor.Meshes)
            return;
        var (slowest, upward, _) = Run(floor, mover, .01f);
        // A field has no walls: some of what comes to its border below the surface is lifted, and goes on.
        var leastUpward = floor == SeparateFloor.Fields ? .05f : .2f;
        Assert.True(slowest < Speed * .95f || upward > leastUpward, $"slowest {slowest}, upward {upward}");
    }
}
