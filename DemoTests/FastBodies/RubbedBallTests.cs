using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using Demos.Accuracy;
using DemoTests.Scenes;
using Xunit;

namespace DemoTests.FastBodies;

/// <summary>
/// A marked ball that hits what does not give way is stopped by it, and rubbed as Coulomb says: by the coefficient times what it was stopped by, or until it
/// rolls, at 5/7 of its speed.
/// </summary>
public class RubbedBallTests
{
    const float Radius = .1f;

    [Theory]
    [InlineData(0, false)]
    [InlineData(.1f, false)]
    [InlineData(.25f, true)]
    [InlineData(1, false)]
    [InlineData(1, true)]
    public void ItLosesWhatFrictionTakes(float friction, bool isBox)
    {
        using var world = new TestWorld(new AccuracySettings { Gravity = default, Friction = friction });
        var normal = Vector3.Normalize(new(.3f, 1, -.2f));
        var turn = Quaternion.Normalize(new(Vector3.Cross(Vector3.UnitY, normal), 1 + normal.Y));
        if (isBox)
            world.AddStatic(new Box(60, 2, 60), new RigidPose(-normal, turn));
        else
            world.Statics.Add(new StaticDescription(default(Vector3), world.Simulation.Shapes.Add(new HalfSpace(normal))));
        const float along = 80, down = 100;
        var tangent = Vector3.Normalize(Vector3.Cross(normal, new(.2f, .1f, 1)));
        var ball = world.Bodies[world.AddMarked(new Sphere(Radius), 3, normal * (Radius + .7f), tangent * along - normal * down)];
        world.Step(2);
        var speed = float.Max(5 / 7f * along, along - friction * down);
        var velocity = ball.Velocity;
        Assert.InRange(Vector3.Dot(velocity.Linear, normal), -1e-3f * down, 1e-3f * down);
        Assert.InRange(Vector3.Dot(velocity.Linear, tangent), speed - 1e-3f * along, speed + 1e-3f * along);
        // What friction takes of its way turns it.
        var spin = Vector3.Cross(normal, tangent) * (2.5f * (along - speed) / Radius);
        Assert.InRange((velocity.Angular - spin).Length(), 0, 2e-3f * along / Radius);
    }
}
