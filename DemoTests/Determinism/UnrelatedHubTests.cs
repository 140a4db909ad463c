using System;
using System.Collections.Generic;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuPhysics.Constraints;
using Demos.Accuracy;
using DemoTests.Scenes;
using Xunit;

namespace DemoTests.Determinism;

/// <summary>
/// Joints of a body that has many are swept over in random order. What has nothing to do with such a body does not see it: whether it is there, comes, goes, or
/// sleeps; nor does another such body, whose own order does not depend on it.
/// </summary>
public class UnrelatedHubTests
{
    const int Steps = 40;

    /// <summary>When there is a star of twelve arms elsewhere.</summary>
    public enum StarTime
    {
        /// <summary>Added before all others.</summary>
        First,
        /// <summary>Added behind all others.</summary>
        Last,
        /// <summary>It comes and goes.</summary>
        ForSomeSteps,
        /// <summary>It sleeps for some steps.</summary>
        Asleep,
    }

    public static TheoryData<Ingredients, int, StarTime> Cases()
    {
        var cases = new TheoryData<Ingredients, int, StarTime>();
        foreach (var ingredients in (Ingredients[])[Ingredients.Joints, Ingredients.Joints | Ingredients.Hub, Ingredients.All & ~Ingredients.Fallback])
        {
            for (int relaxations = 0; relaxations < 2; ++relaxations)
            {
                foreach (var time in Enum.GetValues<StarTime>())
                    cases.Add(ingredients, relaxations, time);
            }
        }
        return cases;
    }

    [Theory]
    [MemberData(nameof(Cases))]
    public void A_star_elsewhere_changes_no_bit(Ingredients ingredients, int relaxations, StarTime time)
    {
        var settings = new AccuracySettings { RelaxationCount = relaxations };
        for (int seed = 1; seed <= 3; ++seed)
        {
            var scene = new RandomScene(seed, ingredients);
            Run(settings, scene, null).AssertSame(Run(settings, scene, time), $"a star, seed {seed}");
        }
    }

    // From four joints on with several sweeps, from eight on with one: settings say which joints are shuffled.
    [Fact]
    public void A_star_elsewhere_changes_no_bit_where_settings_change()
    {
        var scene = new RandomScene(4, Ingredients.All & ~Ingredients.Fallback);
        Run(new(), scene, null, Change).AssertSame(Run(new(), scene, StarTime.First, Change), "a star");

        static void Change(TestWorld world, int step)
        {
            if (step % 9 == 4)
                world.Solver.RelaxationIterationCount = 1 - world.Solver.RelaxationIterationCount;
            if (step % 13 == 5)
                world.Solver.VelocityIterationScheduler = world.Solver.VelocityIterationScheduler is null ? substep => 1 + substep % 2 : null;
        }
    }

    static BodyStates Run(AccuracySettings settings, RandomScene scene, StarTime? time, Action<TestWorld, int>? beforeStep = null)
    {
        using var world = new TestWorld(settings);
        List<BodyHandle> star = [];
        if (time == StarTime.First)
            star = AddStar(world);
        var handles = scene.AddTo(world);
        if (time is StarTime.Last or StarTime.Asleep)
            star = AddStar(world);
        return BodyStates.Of(world, handles, Steps, step =>
        {
            beforeStep?.Invoke(world, step);
            if (time == StarTime.ForSomeSteps && step == 7)
                star = AddStar(world);
            if (time == StarTime.ForSomeSteps && step == 23)
                star.ForEach(world.Bodies.Remove);
            if (time == StarTime.Asleep && step % 15 == 6)
                SetAwake(world, star[0], step > 15);
            if (step % 8 == 0)
                world.Simulation.Validate();
        });
    }

    static void SetAwake(TestWorld world, BodyHandle body, bool isAwake)
    {
        var reference = world.Bodies[body];
        reference.Awake = isAwake;
    }

    static List<BodyHandle> AddStar(TestWorld world)
    {
        const int arms = 12;
        var center = new Vector3(0, 5000, 0);
        var inertia = new Box(.3f, .4f, .5f).ComputeInertia(1);
        List<BodyHandle> star = [Add(center)];
        for (int i = 0; i < arms; ++i)
        {
            var (sin, cos) = MathF.SinCos(MathF.Tau * i / arms);
            var arm = new Vector3(cos, .1f * i, sin);
            star.Add(Add(center + arm));
            world.Solver.Add(star[0], star[^1], new BallSocket { LocalOffsetA = .5f * arm, LocalOffsetB = -.5f * arm, SpringSettings = SpringSettings.Rigid });
        }
        return star;

        BodyHandle Add(Vector3 position) =>
            world.Bodies.Add(BodyDescription.CreateDynamic(new RigidPose(position), inertia, default, new BodyActivityDescription(-1)));
    }
}
