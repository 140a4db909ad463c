using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuPhysics.Constraints;
using Demos.Accuracy;
using Demos.Running;
using DemoTests.Scenes;
using Xunit;

namespace DemoTests.Constraints;

/// <summary>What a blow asks of a joint that may break, whatever joints are solved by.</summary>
public class BreakingBlowTests
{
    /// <summary>
    /// Balls of m in a row, of which the first one moves along it with v. In the end all move with v / n: so the first joint had to bring n - 1 of them to
    /// that, and was pulled with m v (n - 1) / n. A joint that gives way pulls by some more, in the step of the blow.
    /// </summary>
    [Theory]
    [InlineData(2, 4, DirectJointsChoice.Off)]
    [InlineData(3, 4, DirectJointsChoice.Off)]
    [InlineData(6, 4, DirectJointsChoice.Off)]
    [InlineData(6, 8, DirectJointsChoice.Off)]
    [InlineData(2, 4, DirectJointsChoice.Always)]
    [InlineData(6, 4, DirectJointsChoice.Always)]
    public void A_blow_along_a_row_asks_for_what_brings_the_others_along(int count, int substeps, DirectJointsChoice mode)
    {
        const float speed = 10, mass = 2;
        using var world = new TestWorld(new AccuracySettings
        {
            Contacts = ContactScope.None,
            Gravity = Vector3.Zero,
            SubstepCount = substeps,
            DirectJoints = mode,
        });
        var ball = new Sphere(.25f);
        BodyHandle before = default;
        for (int i = 0; i < count; ++i)
        {
            var body = world.AddDynamic(ball, mass, new RigidPose(new Vector3(i, 0, 0)), i == 0 ? new Vector3(-speed, 0, 0) : default);
            if (i > 0)
            {
                var joint = world.Solver.Add(
                    before, body, new BallSocket { LocalOffsetA = new(.5f, 0, 0), LocalOffsetB = new(-.5f, 0, 0), SpringSettings = new(30, 1) });
                if (i == 1)
                    world.Solver.SetBreakThreshold(joint, new(1e-6f));
            }
            before = body;
        }
        world.Step();
        Assert.Equal(1, world.Solver.BrokenConstraints.Length);
        var pulled = mass * speed * (count - 1) / count;
        Assert.InRange(world.Solver.BrokenConstraints[0].Impulse, .98f * pulled, 1.15f * pulled);
    }
}
