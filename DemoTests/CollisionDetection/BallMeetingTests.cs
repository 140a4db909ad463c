using System;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuPhysics.CollisionDetection;
using BepuPhysics.Constraints;
using BepuUtilities.Memory;
using Xunit;

namespace DemoTests.CollisionDetection;

/// <summary>Balls that meet off centre, at any speed and unmarked: they push each other along the line between their centres where they meet.</summary>
public class BallMeetingTests
{
    /// <summary>
    /// A ball hits one at rest, without friction. That goes off at the angle whose sine is the offset of the ways over the sum of the radii, with the part
    /// (1 + e) m_A / (m_A + m_B) of the speed along it; across it nothing changes. Contacts without restitution give back some of the speed
    /// (Docs/decisions/restitution.md), so there it is asked across the line only.
    /// </summary>
    [Theory]
    [InlineData(1 / 60f, 0, false)]
    [InlineData(1 / 30f, 0, false)]
    [InlineData(1 / 120f, 0, true)]
    [InlineData(1 / 60f, 1, false)]
    [InlineData(1 / 60f, 0.5f, true)]
    public void The_ball_that_is_hit_goes_along_the_line_of_centres(float dt, float restitution, bool firstIsHit)
    {
        var random = new Random(3);
        for (int sample = 0; sample < 200; ++sample)
        {
            var size = MathF.Pow(10, 2 * random.NextSingle() - 2);
            float radiusA = size * (0.5f + random.NextSingle()), radiusB = size * (0.5f + random.NextSingle());
            float massA = 0.5f + random.NextSingle(), massB = 0.5f + random.NextSingle();
            // Up to some diameters in a step; without restitution up to a quarter of one, as the overlap that is left when the step ends is taken out along
            // the line of the next.
            var speed = size / dt * MathF.Pow(10, (restitution == 0 ? 1.2f : 2.3f) * random.NextSingle() - 1.8f);
            var sine = 0.9f * (2 * random.NextSingle() - 1);
            var reach = radiusA + radiusB;
            var start = new Vector3(-reach * (2 + 3 * random.NextSingle()), sine * reach, 0);
            Collide(dt, restitution, firstIsHit, start, new Vector3(speed, 0, 0), (radiusA, massA), (radiusB, massB), out var hitter, out var hit);

            var line = new Vector3(MathF.Sqrt(1 - sine * sine), -sine, 0);
            var along = speed * line.X;
            var gained = (1 + restitution) * massA / (massA + massB) * along;
            var expectedHitter = new Vector3(speed, 0, 0) - line * (gained * massB / massA);
            var (errorOfHit, errorOfHitter) = (hit - line * gained, hitter - expectedHitter);
            if (restitution == 0)
            {
                errorOfHit -= line * Vector3.Dot(errorOfHit, line);
                errorOfHitter -= line * Vector3.Dot(errorOfHitter, line);
            }
            var allowed = (restitution == 0 ? 1e-2f : 4e-3f) * speed;
            Assert.True(errorOfHit.Length() < allowed, $"{sample}: {hit} for {line * gained}, of {speed} m/s");
            Assert.True(errorOfHitter.Length() < allowed, $"{sample}: {hitter} for {expectedHitter}, of {speed} m/s");
        }
    }

    /// <summary>What passes by keeps its way to the last bit, as does what it passes.</summary>
    [Fact]
    public void Balls_that_pass_each_other_do_not_meet()
    {
        var velocity = new Vector3(16, 0, 0);
        Collide(1 / 60f, 0, false, new Vector3(-1, 0.202f, 0), velocity, (0.1f, 1), (0.1f, 1), out var passing, out var passed);
        Assert.Equal(velocity, passing);
        Assert.Equal(Vector3.Zero, passed);
    }

    static void Collide(float dt, float restitution, bool firstIsHit, Vector3 start, Vector3 velocity,
        (float Radius, float Mass) a, (float Radius, float Mass) b, out Vector3 hitter, out Vector3 hit)
    {
        using var pool = new BufferPool();
        var callbacks = new DefaultNarrowPhaseCallbacks(new PairMaterialProperties(0, 2, SpringSettings.Rigid))
        {
            Surface = new SurfaceProperties { Restitution = restitution },
        };
        using (var simulation = Simulation.Create(pool, callbacks, new DefaultPoseIntegratorCallbacks(default), SolveDescription.Default))
        {
            BodyHandle Add(Vector3 place, Vector3 moving, (float Radius, float Mass) ball)
            {
                var shape = new Sphere(ball.Radius);
                return simulation.Bodies.Add(BodyDescription.CreateDynamic(
                    place, new BodyVelocity(moving), shape.ComputeInertia(ball.Mass), simulation.Shapes.Add(shape), -1));
            }

            var first = firstIsHit ? Add(default, default, b) : Add(start, velocity, a);
            var second = firstIsHit ? Add(start, velocity, a) : Add(default, default, b);
            var steps = (int)(-2 * start.X / velocity.X / dt) + 4;
            for (int i = 0; i < steps; ++i)
                simulation.Timestep(dt);
            hitter = simulation.Bodies[firstIsHit ? second : first].Velocity.Linear;
            hit = simulation.Bodies[firstIsHit ? first : second].Velocity.Linear;
        }
        pool.AssertEmpty();
    }
}
