using System;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using Demos.Accuracy;
using DemoTests.Scenes;
using Xunit;

namespace DemoTests.CollisionDetection;

/// <summary>What lies on a turntable stays where it lies, as long as friction holds it.</summary>
public class TurntableRiderTests
{
    const float Speed = .8f;

    // A body that has the velocity of what is below it, and goes along it for a step, is farther out then by r (w dt)^2 / 2. That is what a step can
    // not do better, and nothing may come to it: friction could hold a twelfth of what it holds.
    [Theory]
    [InlineData(1, 60, 1.2f, false)]
    [InlineData(4, 60, 1.2f, false)]
    [InlineData(4, 60, 2.5f, true)]
    [InlineData(4, 240, 1.2f, false)]
    [InlineData(1, 240, 2.5f, true)]
    public void A_rider_moves_outwards_by_no_more_than_straight_steps_do(int substeps, int rate, float radius, bool isRound)
    {
        using var world = new TestWorld(new AccuracySettings { SubstepCount = substeps, Friction = 1 });
        var table = world.AddKinematic(new Cylinder(5, 1), new RigidPose(new Vector3(0, -.5f, 0)));
        var pose = new RigidPose(new Vector3(radius, .5f, .3f));
        var rider = isRound ? world.AddDynamic(new Cylinder(.5f, 1), 1, pose) : world.AddDynamic(new Box(1, 1, 1), 1, pose);
        var dt = 1f / rate;
        for (int i = 1; i <= 3 * rate; ++i)
            Step(MathF.Min(1, i * dt / 2.5f) * Speed);
        var before = Distance();
        for (int i = 0; i < 3 * rate; ++i)
            Step(Speed);
        var straight = before * (MathF.Exp(Speed * Speed * dt / 2 * 3) - 1);
        Assert.InRange(Distance() - before, -.2f * straight, 1.2f * straight);

        void Step(float speed)
        {
            world.Bodies[table].Velocity.Angular = new Vector3(0, speed, 0);
            world.Step(dt);
        }

        float Distance()
        {
            var place = world.Bodies[rider].Pose.Position;
            return new Vector2(place.X, place.Z).Length();
        }
    }
}
