using System;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using DemoTests.CollisionDetection.Children;
using Xunit;
using Xunit.Abstractions;

namespace DemoTests.CollisionDetection.Seams;

/// <summary>What has an edge is stopped by the wall of a lip, however low that is, as a rigid body is; a lip within the tolerance is none.</summary>
public class SharpEdgeTests(ITestOutputHelper output)
{
    const float Speed = 5;
    const float Gravity = 10;
    const float StepLength = 1 / 60f;

    /// <summary>What a floor with a lip is made of.</summary>
    public enum Ground
    {
        /// <summary>Two boxes.</summary>
        Separate,
        /// <summary>A compound of two boxes.</summary>
        Compound,
        /// <summary>A mesh.</summary>
        Mesh,
    }

    // A floor at y = 0 up to x = 1, and one that is higher from there.
    static void AddLip(ClusterWorld world, Ground ground, float lip)
    {
        var (shapes, statics) = (world.Simulation.Shapes, world.Simulation.Statics);
        var floor = shapes.Add(new Box(10, 1, 10));
        Vector3 low = new(-4, -.5f, 0), high = new(6, lip - .5f, 0);
        if (ground == Ground.Separate)
        {
            statics.Add(new StaticDescription(low, floor));
            statics.Add(new StaticDescription(high, floor));
        }
        else if (ground == Ground.Compound)
            statics.Add(new StaticDescription(Vector3.Zero, world.AddCluster([new(floor, new RigidPose(low)), new(floor, new RigidPose(high))])));
        else
        {
            Vector3[] corners =
            [
                new(-9, 0, -5), new(1, 0, -5), new(-9, 0, 5), new(1, 0, 5), new(1, lip, -5), new(11, lip, -5), new(1, lip, 5), new(11, lip, 5)
            ];
            int[] indices = [0, 1, 2, 1, 3, 2, 1, 4, 3, 4, 6, 3, 4, 5, 6, 5, 7, 6];
            var mesh = new Mesh(corners, indices, Vector3.One, world.Simulation.BufferPool);
            world.Own(mesh);
            statics.Add(new StaticDescription(Vector3.Zero, shapes.Add(mesh)));
        }
    }

    // Velocity a step after that in which it was hit, if it was: what is hit at the end of a step is stopped in two.
    static BodyVelocity Slide(in Box box, Ground ground, bool isCompound, float lip, float phase, int sweeps, float speed = Speed)
    {
        using var world = new ClusterWorld(isCluster: true);
        world.Behaviour.Friction = 0;
        world.Simulation.Solver.VelocityIterationCount = sweeps;
        var (shapes, bodies) = (world.Simulation.Shapes, world.Simulation.Bodies);
        AddLip(world, ground, lip);
        var pose = new RigidPose(new Vector3(1 - box.HalfWidth - (3 + phase) * speed * StepLength, box.HalfHeight - 1e-4f, 0));
        var velocity = new BodyVelocity(new Vector3(speed, 0, 0));
        BodyHandle body;
        if (isCompound)
        {
            var half = shapes.Add(new Box(box.HalfWidth, box.Height, box.Length));
            var offset = new Vector3(box.HalfWidth / 2, 0, 0);
            var both = world.AddCluster([new(half, new RigidPose(-offset)), new(half, new RigidPose(offset))]);
            body = bodies.Add(BodyDescription.CreateDynamic(pose, velocity, box.ComputeInertia(1), both, -1f));
        }
        else
            body = world.AddBody(box, pose, velocity);
        for (int i = 0; i < 8; ++i)
        {
            world.Step(validate: false);
            if (bodies[body].Velocity.Linear.X < .9f * speed)
                break;
        }
        world.Step(validate: false);
        return bodies[body].Velocity;
    }

    /// <summary>
    /// The lower edge in front meets the wall and cannot go down, so that the body turns about it, and keeps its angular momentum about it. With the centre x
    /// behind and y above the edge and a radius of gyration k, it turns at v y / (k^2 + x^2 + y^2): of a cube 3/8 of the speed is left, whatever
    /// the height of the lip. Floor and wall push at once, which one sweep over the two does not do.
    /// </summary>
    [Theory]
    [InlineData(.5f, .5f, false, 1), InlineData(.8f, .2f, false, 1), InlineData(.8f, .2f, true, 1), InlineData(.3f, .6f, false, 1)]
    [InlineData(.5f, .5f, false, 8), InlineData(.8f, .2f, false, 8), InlineData(.8f, .2f, true, 8), InlineData(.3f, .6f, false, 8)]
    public void A_sharp_edge_stumbles_over_a_lip_as_a_rigid_body_does(float width, float height, bool isCompound, int sweeps) =>
        Stumble(Ground.Separate, width, height, isCompound, sweeps);

    /// <summary>The same where wall and floor are parts of one static.</summary>
    [Theory]
    [InlineData(Ground.Compound, .5f, .5f, false), InlineData(Ground.Compound, .8f, .2f, false), InlineData(Ground.Compound, .8f, .2f, true)]
    [InlineData(Ground.Mesh, .5f, .5f, false), InlineData(Ground.Mesh, .8f, .2f, false)]
    [InlineData(Ground.Mesh, .3f, .6f, false), InlineData(Ground.Compound, .3f, .6f, false)]
    public void A_sharp_edge_stumbles_within_one_static(Ground ground, float width, float height, bool isCompound) =>
        Stumble(ground, width, height, isCompound, 1);

    void Stumble(Ground ground, float width, float height, bool isCompound, int sweeps)
    {
        var box = new Box(width, height, .5f);
        // Of the inner radius a thousandth.
        var tolerance = 1e-3f * .5f * Math.Min(.5f, Math.Min(width, height));
        foreach (var phase in new[] { 0, .4f, .8f })
        {
            var free = Slide(box, ground, isCompound, .9f * tolerance, phase, sweeps);
            Assert.InRange(free.Linear.X, (1 - 1e-3f) * Speed, Speed);
            Assert.InRange(MathF.Abs(free.Angular.Z), 0, .02f);
            foreach (var lip in new[] { 1.1f * tolerance, 1e-3f, 5e-3f })
            {
                var (x, y) = (box.HalfWidth, box.HalfHeight - lip);
                var square = (width * width + height * height) / 12 + x * x + y * y;
                var turn = Speed * y / square;
                var hit = Slide(box, ground, isCompound, lip, phase, sweeps);
                output.WriteLine($"{width} x {height}, lip {lip * 1000} mm, {phase}: {hit.Linear}, {hit.Angular.Z} of {-turn}, {turn * y}");
                // Gravity turns it back for a part of two steps.
                var back = Gravity * x / square * StepLength * 2;
                Assert.InRange(-hit.Angular.Z, .96f * turn - back, 1.04f * turn);
                Assert.InRange(hit.Linear.X, (turn - back) * y - .01f * Speed, turn * y + .01f * Speed);
                Assert.InRange(hit.Linear.Y, .96f * turn * x - 2 * Gravity * StepLength, 1.06f * turn * x);
            }
        }
    }
}
