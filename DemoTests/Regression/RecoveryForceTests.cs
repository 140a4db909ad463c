using System;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using Demos.Accuracy;
using Xunit;

namespace DemoTests.Regression;

/// <summary>
/// The velocity by which contacts push bodies apart is limited, and their force only at four times the load: a contact rests where its spring
/// says. (With the limit on the force, too, light bodies sank through the floor under a pile.)
/// </summary>
public class RecoveryForceTests
{
    // That of rigid contacts: an eighth of a cycle per substep.
    const double Frequency = .125 * 4 * 60;

    /// <summary>g / w2 for a spring of angular frequency w, whatever the mass: beyond 30 mm the recovery velocity is at its limit.</summary>
    [Theory]
    [InlineData(100, 1)]
    [InlineData(1000, 1)]
    [InlineData(2000, 1)]
    [InlineData(4000, 2)]
    [InlineData(1000, .5f)]
    public void A_load_rests_at_the_depth_that_its_spring_says(float gravity, float maximumRecoveryVelocity)
    {
        var settings = new AccuracySettings
        {
            Gravity = new Vector3(0, -gravity, 0),
            MaximumRecoveryVelocity = maximumRecoveryVelocity,
            SubstepCount = 4,
        };
        using var world = new AccuracyWorld(settings);
        world.AddGround(thickness: 20);
        var body = world.AddDynamic(new Sphere(.5f), 1, new Vector3(0, .5f, 0));

        world.Run(2);

        double angular = 2 * Math.PI * Frequency;
        Assert.Equal(gravity / (angular * angular), .5 - world.Position(body).Y, .02 * gravity / (angular * angular));
    }

    [Theory]
    [InlineData(.5f)]
    [InlineData(2)]
    public void A_body_that_is_deep_comes_out_no_faster_than_it_may(float maximumRecoveryVelocity)
    {
        var settings = new AccuracySettings { Gravity = default, MaximumRecoveryVelocity = maximumRecoveryVelocity };
        using var world = new AccuracyWorld(settings);
        world.AddGround();
        var body = world.AddDynamic(new Sphere(.5f), 1, new Vector3(0, .1f, 0));
        double fastest = 0;

        world.Run(2, () => fastest = Math.Max(fastest, world.LinearVelocity(body).Y));

        Assert.InRange(fastest, .9 * maximumRecoveryVelocity, 1.001 * maximumRecoveryVelocity);
        Assert.True(world.Position(body).Y > .5);
    }

    /// <summary>
    /// Each of a column of overlapping bodies may leave the one below by the limit, so the topmost has one limit per body. (Impulses that had thrown
    /// them were given again in the next substep, as if they bore a load: the topmost of two came out with 2.4 limits, of four with 4.7.) Boxes lie on
    /// each other, and are moved out by their poses; so the speed is that of the way.
    /// </summary>
    [Theory]
    [InlineData(2, 2, true)]
    [InlineData(4, 2, true)]
    [InlineData(4, 1, true)]
    [InlineData(2, 2, false)]
    [InlineData(4, 2, false)]
    public void Who_is_deep_in_a_column_leaves_the_next_no_faster_than_it_may(int count, float maximumRecoveryVelocity, bool isRound)
    {
        const float depth = .15f;
        using var world = new AccuracyWorld(new AccuracySettings { MaximumRecoveryVelocity = maximumRecoveryVelocity });
        world.AddGround();
        var bodies = new BodyHandle[count];
        for (int i = 0; i < count; ++i)
        {
            var place = new Vector3(0, .5f - depth + i * (1 - depth), 0);
            bodies[i] = isRound ? world.AddDynamic(new Sphere(.5f), 1, place) : world.AddDynamic(new Box(1, 1, 1), 1, place);
        }
        double fastest = 0, height = world.Position(bodies[^1]).Y;

        world.Run(1, () =>
        {
            var last = height;
            height = world.Position(bodies[^1]).Y;
            fastest = Math.Max(fastest, (height - last) / world.Settings.Dt);
        });

        // At least what would separate them at all; a twentieth above the limits is what sweeps leave.
        Assert.InRange(fastest, .5 * count * maximumRecoveryVelocity, 1.05 * count * maximumRecoveryVelocity);
    }
}
