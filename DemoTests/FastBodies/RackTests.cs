using System;
using System.Collections.Generic;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuPhysics.CollisionDetection;
using BepuPhysics.Constraints;
using BepuUtilities.Memory;
using Xunit;

namespace DemoTests.FastBodies;

/// <summary>What FastThings.md says of things at rest that are hit: with a least speculative margin of the way of a step they see each other in time.</summary>
public class RackTests
{
    // A break seen from above, without gravity: nothing else presses the balls together, and some touch by their rounding and others do not.
    [Theory]
    [InlineData(3, 0, false), InlineData(8, 0, false), InlineData(12, 0, false), InlineData(3, 0, true), InlineData(12, 0, true)]
    [InlineData(8, 1e-6f, false), InlineData(12, 1e-4f, true)]
    public void NoBallPassesAnother(float speed, float gap, bool isMarked) => Break(speed, gap, isMarked, speed / 60, .98f);

    // What is marked needs no margin: whoever is hit within a step meets those who are beside it. Balls came into each other by half of their size, and those
    // that slept were walls: momentum changed by twice what there was.
    [Theory]
    [InlineData(3, 0), InlineData(12, 0), InlineData(3, 1e-6f), InlineData(12, 1e-6f)]
    public void NoMarkedBallPassesAnotherWithoutAMargin(float speed, float gap) => Break(speed, gap, isMarked: true, 0, .95f);

    static void Break(float speed, float gap, bool isMarked, float margin, float leastDistance)
    {
        const float Radius = .0286f, Mass = .17f;
        for (int seed = 0; seed < 5; ++seed)
        {
            var random = new Random(seed);
            using var pool = new BufferPool();
            using var simulation = Simulation.Create(
                pool,
                new DefaultNarrowPhaseCallbacks(new PairMaterialProperties(.05f, 2, SpringSettings.Rigid)) { Surface = new() { Restitution = .95f } },
                new DefaultPoseIntegratorCallbacks(Vector3.Zero), new SolveDescription(1, 4));
            var ball = new Sphere(Radius);
            var collidable = new CollidableDescription(
                simulation.Shapes.Add(ball), margin, float.MaxValue, isMarked ? ContinuousDetection.Continuous() : ContinuousDetection.Passive);
            var balls = new List<BodyHandle>();
            for (int row = 0; row < 5; ++row)
            {
                for (int i = 0; i <= row; ++i)
                {
                    var place = new Vector3(row * (2 * Radius + gap) * .8660254f, 0, (i - row * .5f) * (2 * Radius + gap));
                    balls.Add(simulation.Bodies.Add(BodyDescription.CreateDynamic(place, ball.ComputeInertia(Mass), collidable, .01f)));
                }
            }
            for (int step = 0; step < 60; ++step)
                simulation.Timestep(1 / 60f);
            balls.Add(simulation.Bodies.Add(BodyDescription.CreateDynamic(
                new Vector3(-.5f - .3f * random.NextSingle(), 0, .02f * random.NextSingle() - .01f), new BodyVelocity(new Vector3(speed, 0, 0)),
                ball.ComputeInertia(Mass), collidable, -1)));

            for (int step = 0; step < 60 / speed + 20; ++step)
            {
                simulation.Timestep(1 / 60f);
                for (int a = 0; a < balls.Count; ++a)
                {
                    for (int b = 0; b < a; ++b)
                    {
                        var distance = Vector3.Distance(simulation.Bodies[balls[a]].Pose.Position, simulation.Bodies[balls[b]].Pose.Position);
                        Assert.InRange(distance, 2 * Radius * leastDistance, float.MaxValue);
                    }
                }
            }
            var momentum = Vector3.Zero;
            float energy = 0;
            foreach (var body in balls)
            {
                momentum += simulation.Bodies[body].Velocity.Linear / speed;
                energy += simulation.Bodies[body].Velocity.Linear.LengthSquared() / (speed * speed);
            }
            Assert.InRange((momentum - Vector3.UnitX).Length(), 0, 1e-4f);
            // A ball that handed all on to one other would leave .95.
            Assert.InRange(energy, .6f, .85f);
        }
    }
}
