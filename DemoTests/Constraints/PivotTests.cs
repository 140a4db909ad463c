using System;
using System.Linq;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuPhysics.CollisionDetection;
using BepuPhysics.Constraints;
using BepuUtilities.Memory;
using DemoTests.Scenes;
using DemoTests.Support;
using Xunit;

namespace DemoTests.Constraints;

/// <summary>What turns on a corner that friction holds turns about that corner.</summary>
public class PivotTests
{
    const float Seconds = 20;
    // Of its size, and of the energy that it takes to lift it by its size. Both are none; a step moves a tip by what is of the third order in it.
    const float GreatestDrift = 8e-3f;
    const float GreatestGain = 1e-4f;

    // What leans stands on its tip, and hangs in a ball joint above that bears the other half of it: it swings about the line between the two, of which neither
    // moves. With the arm that a tip had when a step began it went round a little of its circle in each step.
    [Theory]
    [InlineData(1)]
    [InlineData(.1f)]
    [InlineData(10)]
    public void The_tip_of_what_leans_stays_and_its_swing_does_not_grow(float size)
    {
        var figures = Enumerable.Range(0, 8).Select(seed => Swing(size, seed)).ToArray();
        Assert.True(figures.All(figure => figure.Drift < GreatestDrift && figure.Gain < GreatestGain), string.Join(", ", figures));
    }

    static float Uneven(Random random) => (random.NextSingle() - .5f) * .1f;

    static (float Drift, double Gain) Swing(float size, int seed)
    {
        using var pool = new BufferPool();
        using var world = new TestWorld(material: new PairMaterialProperties(1, 2, default));
        world.AddStatic(new Box(20 * size, 2 * size, 20 * size), new Vector3(0, -size, 0));
        var random = new Random(seed);
        var joint = new Vector3(.7f, .6f + .2f * random.NextSingle(), 0) * size;
        var hull = new ConvexHull(
            [
                default, joint + new Vector3(0, 0, -.03f) * size, joint + new Vector3(0, 0, .03f) * size,
                Belly(.45f, .15f, -.15f), Belly(.45f, .15f, .15f), Belly(.6f, .35f, -.1f), Belly(.6f, .35f, .1f),
            ],
            pool, out var center);
        var turn = Quaternion.CreateFromAxisAngle(Vector3.Normalize(joint), .2f + .5f * random.NextSingle());
        var inertia = hull.ComputeInertia(1 + random.NextSingle());
        var leaning = world.Bodies.Add(BodyDescription.CreateDynamic(
            new RigidPose(Vector3.Transform(center, turn), turn), inertia, world.Simulation.Shapes.Add(hull), -1));
        var above = new Vector3(0, 3 * size, 0);
        var post = world.AddKinematic(new Sphere(.1f * size), joint + above);
        world.Solver.Add(post, leaning, new BallSocket { LocalOffsetA = -above, LocalOffsetB = joint - center });

        // Until it stands on its tip, and joint and contact know their load.
        world.Step(60);
        var tip = Tip();
        var energy = GreatestEnergy();
        world.Step((int)(Seconds / TestWorld.Dt));
        var drift = (Tip() - tip).Length() / size;
        var gain = (GreatestEnergy() - energy) * inertia.InverseMass / (9.81 * size);
        return (drift, gain);

        Vector3 Belly(float x, float y, float z) => new Vector3(x + Uneven(random), y + Uneven(random), z) * size;

        Vector3 Tip()
        {
            var pose = world.Bodies[leaning].Pose;
            return pose.Position - Vector3.Transform(center, pose.Orientation);
        }

        double GreatestEnergy()
        {
            var greatest = double.MinValue;
            for (int i = 0; i < 240; ++i)
            {
                world.Step();
                greatest = Math.Max(greatest, BodyEnergy.Of(world.Bodies[leaning], 9.81));
            }
            return greatest;
        }
    }
}
