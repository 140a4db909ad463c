using System;
using System.Collections.Generic;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using Demos.Accuracy;
using DemoTests.Scenes;
using DemoTests.Sleeping;
using Xunit;

namespace DemoTests.Determinism;

/// <summary>When bodies fall asleep does not depend on what else there is in the world: how much of it rests, sleeps, or is restless.</summary>
public class UnrelatedSleepTests
{
    const int Steps = 150;

    /// <summary>What else there is.</summary>
    public enum Neighbour
    {
        /// <summary>Cubes that all come to rest in one step, more than once were put to sleep in it.</summary>
        Field,
        /// <summary>Stacks on which a cube rests that never sleeps: islands are looked for in vain.</summary>
        HeldStacks,
        /// <summary>Stacks of different heights, dropped, that come to rest one after the other.</summary>
        Landing,
        /// <summary>Cubes that are pushed now and then.</summary>
        Restless,
    }

    public static TheoryData<Neighbour, bool> Cases()
    {
        var cases = new TheoryData<Neighbour, bool>();
        foreach (var neighbour in Enum.GetValues<Neighbour>())
        {
            cases.Add(neighbour, false);
            cases.Add(neighbour, true);
        }
        return cases;
    }

    [Theory]
    [MemberData(nameof(Cases))]
    public void What_rests_elsewhere_changes_no_bit_and_nobodys_sleep(Neighbour neighbour, bool isFirst)
    {
        var alone = Run(null, isFirst, out var fellAsleep);
        Assert.Equal(alone, Run(neighbour, isFirst, out var fellAsleepBeside));
        Assert.Equal(fellAsleep, fellAsleepBeside);
        Assert.True(fellAsleep.Count > 10, $"{fellAsleep.Count} bodies fell asleep");
    }

    static List<(int, RigidPose, BodyVelocity)> Run(Neighbour? neighbour, bool isFirst, out List<(int Step, int Body)> fellAsleep)
    {
        using var world = new SleepWorld();
        List<BodyHandle> others = [];
        if (neighbour is { } first && isFirst)
            others = Add(world, first);
        List<BodyHandle> bodies = [];
        for (int i = 0; i < 8; ++i)
        {
            bodies.AddRange(world.AddStack(3 * i, 1 + i % 3, .03f * i));
            // They come to rest, are held by their neighbours, and let go when these sleep elsewhere or are removed.
            world.Bodies[bodies[^1]].Velocity.Linear.X = .2f * (i % 2);
        }
        world.Bodies[bodies[5]].Activity.SleepThreshold = -1;
        if (neighbour is { } last && !isFirst)
            others = Add(world, last);
        var states = new List<(int, RigidPose, BodyVelocity)>();
        fellAsleep = [];
        var asleep = new HashSet<int>();
        for (int step = 0; step < Steps; ++step)
        {
            if (neighbour == Neighbour.Restless && step % 7 == 3)
                world.Bodies[others[step % others.Count]].ApplyLinearImpulse(new Vector3(.3f, 0, 0));
            // What held its island gives it free without being near: it moves off at a speed.
            if (step == 66)
                world.Bodies[bodies[5]].Velocity.Linear = new Vector3(0, 30, 40);
            world.World.Step();
            for (int i = 0; i < bodies.Count; ++i)
            {
                var body = world.Bodies[bodies[i]];
                states.Add((i, body.Pose, body.Velocity));
                if (!body.Awake && asleep.Add(i))
                    fellAsleep.Add((step, i));
            }
        }
        return states;
    }

    /// <summary>
    /// A kinematic body that is left with sleepers only, as who held it has gone, sleeps in the next step in which anybody is looked for. That is the one thing
    /// which others decide, so nothing may follow from it: neither for what rests on it, nor for what lands on it, be it asleep or awake by then.
    /// </summary>
    [Theory, InlineData(false), InlineData(true)]
    public void When_a_kinematic_body_that_holds_sleepers_falls_asleep_changes_no_bit_of_others(bool isFirst)
    {
        var alone = RunPlatform(null, out var sleptAlone);
        var beside = RunPlatform(isFirst, out var sleptBeside);
        Assert.Equal(alone, beside);
        // In the step in which it is landed on it is awake in one world, and asleep in the other.
        Assert.InRange(sleptBeside, Gone + 1, Landed - 1);
        Assert.InRange(sleptAlone, Landed, int.MaxValue);
    }

    const int Gone = 66, Landed = 80;

    static List<(int, RigidPose, BodyVelocity, bool)> RunPlatform(bool? othersAreFirst, out int asleepFrom)
    {
        using var world = new SleepWorld();
        var others = othersAreFirst == true ? Add(world, Neighbour.Restless) : [];
        var height = new Vector3(0, 20, -40);
        var platform = world.Bodies.Add(BodyDescription.CreateKinematic(
            height, world.Simulation.Shapes.Add(new Box(12, 1, 12)), SleepWorld.Activity));
        var onTop = height + new Vector3(0, 1, 0);
        var holder = world.AddCube(onTop);
        world.Bodies[holder].Activity.SleepThreshold = -1;
        var time = (Landed + 1) * TestWorld.Dt;
        var fall = -new AccuracySettings().Gravity.Y * time * time / 2;
        List<BodyHandle> bodies =
        [
            holder,
            world.AddCube(onTop + new Vector3(-4, 0, 0)), world.AddCube(onTop + new Vector3(-4, 1, 0)),
            world.AddCube(onTop + new Vector3(4, fall, 0)),
            // These have nothing to do with it, and come to rest when it falls asleep or is woken.
            .. world.AddStack(0, 2, .05f), .. world.AddStack(4, 3, .1f),
        ];
        world.Bodies[bodies[^1]].Velocity.Linear.X = .3f;
        if (othersAreFirst == false)
            others = Add(world, Neighbour.Restless);
        var states = new List<(int, RigidPose, BodyVelocity, bool)>();
        asleepFrom = int.MaxValue;
        for (int step = 0; step < 2 * Landed; ++step)
        {
            // Pushed one after the other, they have rested for long enough one after the other.
            if (step % 3 == 0 && step / 3 < others.Count)
                world.Bodies[others[step / 3]].ApplyLinearImpulse(new Vector3(.3f, 0, 0));
            if (step == Gone)
                world.Bodies[holder].Velocity.Linear = new Vector3(0, 30, 40);
            world.World.Step();
            for (int i = 0; i < bodies.Count; ++i)
            {
                var body = world.Bodies[bodies[i]];
                states.Add((i, body.Pose, body.Velocity, body.Awake));
            }
            if (!world.IsAwake(platform))
                asleepFrom = Math.Min(asleepFrom, step);
        }
        return states;
    }

    static List<BodyHandle> Add(SleepWorld world, Neighbour neighbour)
    {
        List<BodyHandle> bodies = [];
        for (int i = 0; i < (neighbour == Neighbour.Field ? 600 : 24); ++i)
        {
            var (x, z) = (2 * (i % 30) - 60, 20 + 2 * (i / 30));
            var stack = neighbour switch
            {
                Neighbour.HeldStacks => 3,
                Neighbour.Landing => 1 + i % 2,
                _ => 1,
            };
            for (int level = 0; level < stack; ++level)
                bodies.Add(world.AddCube(new Vector3(x, .5f + level + (neighbour == Neighbour.Landing ? .02f * i : 0), z)));
            if (neighbour == Neighbour.HeldStacks)
                world.Bodies[bodies[^1]].Activity.SleepThreshold = -1;
        }
        return bodies;
    }
}
