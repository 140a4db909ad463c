using System;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Characters;
using BepuPhysics.Collidables;
using Demos.Accuracy;
using DemoTests.Scenes;
using Xunit;

namespace DemoTests.Constraints;

/// <summary>The constraint that moves characters, with forces capped and a surface that changes in each step.</summary>
public class CharacterMotionTests
{
    const float Mass = 4;
    static readonly Sphere ball = new(0.5f);

    static TestWorld World(Vector3 gravity = default, int relaxations = 0) =>
        new(new AccuracySettings { Gravity = gravity, Contacts = ContactScope.None, RelaxationCount = relaxations });

    static StaticCharacterMotion Walk(Vector2 velocity) => new()
    {
        SurfaceBasis = Quaternion.Identity,
        MaximumHorizontalForce = 20,
        MaximumVerticalForce = 100,
        TargetVelocity = velocity,
    };

    [Theory, InlineData(0), InlineData(1)]
    public void It_speeds_up_by_its_force_and_keeps_its_speed(int relaxations)
    {
        using var world = World(relaxations: relaxations);
        var walker = world.AddDynamic(ball, Mass, new RigidPose(Vector3.Zero));
        // 3 to the right and 4 forwards, which is 5 m/s in all: at 20 N / 4 kg a second's way.
        world.Solver.Add(walker, Walk(new(3, 4)));
        world.Step(30);
        var velocity = world.Bodies[walker].Velocity.Linear;
        Assert.Equal(2.5f, velocity.Length(), 1e-3f);
        Assert.True((velocity / velocity.Length() - new Vector3(0.6f, 0, -0.8f)).Length() < 1e-4f, $"{velocity}");
        world.Step(60);
        Assert.True((world.Bodies[walker].Velocity.Linear - new Vector3(3, 0, -4)).Length() < 1e-4f);
    }

    /// <summary>Over the top of a hill faster than gravity could hold it: the force is that of the circle, m v^2 / r, less the weight.</summary>
    [Theory]
    [InlineData(1000, true)]
    // 4 kg at 5 m/s around 2 m take 50 N, of which the weight gives 39.24 at the top.
    [InlineData(5, false)]
    public void It_is_held_to_a_surface_that_turns_by_no_more_than_its_force(float force, bool isHeld)
    {
        const float Radius = 2, Speed = 5;
        using var world = World(new Vector3(0, -9.81f, 0));
        var walker = world.AddDynamic(ball, Mass, new RigidPose(new Vector3(0, Radius, 0)), new BodyVelocity(new Vector3(Speed, 0, 0), default));
        var walk = Walk(new(Speed, 0)) with { MaximumHorizontalForce = 1000, MaximumVerticalForce = force };
        var constraint = world.Solver.Add(walker, walk);
        for (int i = 0; i < 10; ++i)
        {
            // The surface where it is now, and its middle half a step on, as a game that knows its ground would say.
            var position = world.Bodies[walker].Pose.Position;
            var angle = MathF.Atan2(position.X, position.Y) + Speed / Radius * TestWorld.Dt / 2;
            walk.SurfaceBasis = new Quaternion(0, 0, MathF.Sin(-angle / 2), MathF.Cos(-angle / 2));
            world.Solver.ApplyDescription(constraint, walk);
            world.Step();
        }
        var height = world.Bodies[walker].Pose.Position.Length() - Radius;
        if (isHeld)
            Assert.InRange(height, -0.01f, 0.01f);
        else
            // 50 N are asked for and 44.24 there at most: it leaves at 1.44 m/s2 or more, 20 mm in a sixth of a second.
            Assert.True(height > 0.018f, $"{height}");
    }

    [Fact]
    public void It_never_pushes_away_from_the_surface()
    {
        using var world = World();
        var walker = world.AddDynamic(ball, Mass, new RigidPose(Vector3.Zero), new BodyVelocity(new Vector3(0, -3, 0), default));
        world.Solver.Add(walker, Walk(default));
        world.Step(10);
        Assert.Equal(-3, world.Bodies[walker].Velocity.Linear.Y, 1e-5f);
    }

    /// <summary>From within the surface it may come out, and no further.</summary>
    [Fact]
    public void It_may_use_up_the_depth()
    {
        using var world = World();
        var walker = world.AddDynamic(ball, Mass, new RigidPose(Vector3.Zero), new BodyVelocity(new Vector3(0, 6, 0), default));
        world.Solver.Add(walker, Walk(default) with { Depth = 0.05f, MaximumVerticalForce = 1e6f });
        world.Step();
        Assert.Equal(0.05f, world.Bodies[walker].Pose.Position.Y, 1e-4f);
    }

    [Fact]
    public void A_support_that_can_move_gets_the_opposite()
    {
        using var world = World();
        var walker = world.AddDynamic(ball, Mass, new RigidPose(Vector3.Zero));
        var support = world.AddDynamic(new Box(4, 1, 4), 12, new RigidPose(new Vector3(0, -1, 0)));
        world.Solver.Add(walker, support, new DynamicCharacterMotion
        {
            SurfaceBasis = Quaternion.Identity,
            MaximumHorizontalForce = 1000,
            MaximumVerticalForce = 100,
            TargetVelocity = new(2, 0),
            OffsetFromCharacterToSupportPoint = new(0, -0.5f, 0),
            OffsetFromSupportToSupportPoint = new(0, 0.5f, 0),
        });
        world.Step();
        Vector3 ofWalker = world.Bodies[walker].Velocity.Linear, ofSupport = world.Bodies[support].Velocity.Linear;
        Assert.True((ofWalker * Mass + ofSupport * 12).Length() < 1e-4f, $"{ofWalker} {ofSupport}");
        var atPoint = ofWalker + Vector3.Cross(world.Bodies[walker].Velocity.Angular, new(0, -0.5f, 0)) -
            ofSupport - Vector3.Cross(world.Bodies[support].Velocity.Angular, new(0, 0.5f, 0));
        Assert.Equal(2, atPoint.X, 1e-3f);
    }

    [Fact]
    public void What_it_cannot_do_is_refused()
    {
        using var world = World();
        var walker = world.AddDynamic(ball, Mass, new RigidPose(Vector3.Zero));
        Assert.Throws<ArgumentException>(() => world.Solver.Add(walker, Walk(new(float.NaN, 0))));
        Assert.Throws<ArgumentException>(() => world.Solver.Add(walker, Walk(default) with { MaximumVerticalForce = -1 }));
        Assert.Throws<ArgumentException>(() => world.Solver.Add(walker, Walk(default) with { SurfaceBasis = default }));
        Assert.Equal(0, world.Solver.CountConstraints());
    }
}
