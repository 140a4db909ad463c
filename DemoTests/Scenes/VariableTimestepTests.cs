using System;
using System.Collections.Generic;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuPhysics.Constraints;
using Demos.Accuracy;
using Xunit;

namespace DemoTests.Scenes;

/// <summary>Steps of changing length: accumulated impulses follow the length, so what rests goes on resting.</summary>
public class VariableTimestepTests
{
    // Frames that take a little longer or shorter, and a game that turns the dial.
    [Fact]
    public void A_resting_stack_stays_calm_while_dt_and_substeps_change()
    {
        float[] durations = [1 / 60f, 1 / 63f, 1 / 57f, 1 / 60f, 1 / 66f, 1 / 50f];
        var (move, speed, left) = Disturb((random, step) => (durations[random.Next(durations.Length)], step % 50 < 40 ? 4 : 6));

        Assert.True(move < 1.25f * Sag(1 / 50f / 4) && speed < .25f && left < .005f, $"moved {move} m, {speed} m/s, {left} m for good");
    }

    // A step of twice the length lets rigid contacts sink at once, almost in free fall for that step, and rise slowly afterwards.
    [Fact]
    public void A_resting_stack_survives_any_step()
    {
        float[] durations = [1 / 30f, 1 / 60f, 1 / 90f, 1 / 120f, 1 / 240f];
        var (move, speed, left) = Disturb((random, _) => (durations[random.Next(durations.Length)], random.Next(4, 9)));

        Assert.True(move < 1.25f * Sag(1 / 30f / 4) && speed < .5f && left < .005f, $"moved {move} m, {speed} m/s, {left} m for good");
    }

    // What is left of a load in so short a step is rounding, which scaled to the long step threw the tower up by kilometres.
    [Theory]
    [InlineData(1e-4f, .2f)]
    [InlineData(3e-4f, .2f)]
    [InlineData(1e-3f, .5f)]
    public void A_tower_stands_while_very_short_and_long_steps_take_turns(float shortest, float longest)
    {
        var move = MoveOfTower(200, step => step % 2 == 0 ? shortest : longest);
        Assert.True(move < .01f, $"moved {move} m");
    }

    // Steps so short that the margin of contacts, which goes with the square of the length, is less than what resting boxes are apart by; and,
    // from those to the next long ones, growing impulses against the turning of boxes on each other.
    [Theory]
    [InlineData(3e-4f, .5f)]
    [InlineData(1e-3f, .5f)]
    [InlineData(3e-4f, .1f)]
    public void A_tower_stands_while_steps_of_any_length_come_at_random(float shortest, float longest)
    {
        for (int seed = 1; seed <= 8; ++seed)
        {
            var random = new Random(seed);
            var move = MoveOfTower(600, _ => shortest * MathF.Pow(longest / shortest, random.NextSingle()));
            Assert.True(move < .01f, $"seed {seed}: moved {move} m");
        }
    }

    // Greatest distance of any of eight boxes from where it was put.
    static float MoveOfTower(int steps, Func<int, float> length)
    {
        const int Count = 8;
        using var world = new TestWorld();
        world.AddStatic(new Box(20, 2, 20), new RigidPose(new Vector3(0, -1, 0)));
        var tower = new BodyHandle[Count];
        for (int i = 0; i < Count; ++i)
            tower[i] = world.AddDynamic(new Box(1, 1, 1), 1, new RigidPose(new Vector3(0, .5f + i, 0)));
        var move = 0f;
        for (int step = 0; step < steps; ++step)
        {
            world.Step(length(step));
            for (int i = 0; i < Count; ++i)
                move = MathF.Max(move, (world.Bodies[tower[i]].Pose.Position - new Vector3(0, .5f + i, 0)).Length());
        }
        return move;
    }

    // A rigid contact rests where its spring carries the load f: at f / (m w^2), with w = 2 pi / 8 per substep and m the mass that the
    // contact sees, a box on the ground and half a box above. In sum the top of five sinks by as many boxes' weights as this.
    static float Sag(float longestSubstep) => (5 + 2 * (4 + 3 + 2 + 1)) * 9.81f * longestSubstep * longestSubstep / .617f;

    // Greatest distance from rest and greatest speed meanwhile, and what is left of the distance after two seconds of usual steps.
    static (float Move, float Speed, float Left) Disturb(Func<Random, int, (float Dt, int Substeps)> choose)
    {
        using var world = new TestWorld();
        world.AddStatic(new Box(20, 2, 20), new RigidPose(new Vector3(0, -1, 0)));
        var stack = new List<BodyHandle>();
        for (int i = 0; i < 5; ++i)
            stack.Add(world.AddDynamic(new Box(1, 1, 1), 1, new RigidPose(new Vector3(0, .5f + i, 0))));
        world.Step(120);
        var rest = stack.ConvertAll(body => world.Bodies[body].Pose.Position);
        var random = new Random(4);
        float move = 0, speed = 0, left = 0;
        for (int step = 0; step < 300; ++step)
        {
            (float dt, world.Solver.SubstepCount) = choose(random, step);
            world.Step(dt);
            for (int i = 0; i < stack.Count; ++i)
            {
                var body = world.Bodies[stack[i]];
                move = MathF.Max(move, (body.Pose.Position - rest[i]).Length());
                speed = MathF.Max(speed, body.Velocity.Linear.Length());
            }
        }
        world.Solver.SubstepCount = new AccuracySettings().SubstepCount;
        world.Step(120);
        for (int i = 0; i < stack.Count; ++i)
            left = MathF.Max(left, (world.Bodies[stack[i]].Pose.Position - rest[i]).Length());
        return (move, speed, left);
    }

    [Fact]
    public void The_load_of_a_joint_follows_the_length_of_the_substep()
    {
        using var world = new TestWorld(new AccuracySettings { Contacts = ContactScope.None });
        var anchor = world.AddKinematic(new Sphere(.1f), new RigidPose(new Vector3(0, 5, 0)));
        var weight = world.AddDynamic(new Sphere(.5f), 2, new RigidPose(new Vector3(0, 4, 0)));
        var joint = world.Solver.Add(anchor, weight, new BallSocket { LocalOffsetB = new Vector3(0, 1, 0) });
        world.Step(60);

        foreach (float dt in (ReadOnlySpan<float>)[1 / 60f, 1 / 30f, 1 / 120f, 1 / 60f])
        {
            // At once nearly, and exactly when the joint has given way as much as its new stiffness says.
            world.Step(dt);
            Assert.Equal(1, world.Solver.GetAccumulatedImpulseMagnitude(joint) / Load(), .1f);
            for (int i = 0; i < 60; ++i)
                world.Step(dt);
            Assert.Equal(1, world.Solver.GetAccumulatedImpulseMagnitude(joint) / Load(), .005f);

            float Load() => 2 * 9.81f * dt / world.Solver.LastSubstepCount;
            Assert.InRange(world.Bodies[weight].Velocity.Linear.Length(), 0, .002f);
        }
    }
}
