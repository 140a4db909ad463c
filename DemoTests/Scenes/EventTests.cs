using System;
using System.Collections.Generic;
using System.Linq;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuPhysics.CollisionDetection;
using BepuPhysics.Constraints;
using BepuUtilities;
using BepuUtilities.Memory;
using Xunit;

namespace DemoTests.Scenes;

/// <summary>When a step calls the game, and what becomes of an exception there.</summary>
public class EventTests
{
    [Theory]
    [InlineData(1)]
    [InlineData(2)]
    public void Events_come_in_the_order_of_the_stages(int threads)
    {
        var calls = new List<string>();
        var timestepper = new DefaultTimestepper();
        timestepper.BeforeCollisionDetection += (dt, _) => calls.Add($"before {dt}");
        timestepper.CollisionsDetected += (dt, _) => calls.Add($"detected {dt}");
        timestepper.ConstraintsSolved += (dt, _) => calls.Add($"solved {dt}");
        using var world = new TestWorld(threads: threads, timestepper: timestepper);
        AddGrid(world.Simulation);
        world.Solver.SubstepCount = 2;
        world.Solver.SubstepStarted += substep => calls.Add($"start {substep}");
        world.Solver.SubstepEnded += substep => calls.Add($"end {substep}");

        world.Step(.25f);
        world.Step(.5f);

        Assert.Equal(
            ["before 0.25", "detected 0.25", "start 0", "end 0", "start 1", "end 1", "solved 0.25",
             "before 0.5", "detected 0.5", "start 0", "end 0", "start 1", "end 1", "solved 0.5"], calls);
    }

    [Fact]
    public void Substep_events_see_bodies_before_and_after_the_substep()
    {
        using var world = new TestWorld();
        var body = world.AddDynamic(new Sphere(1), 1, RigidPose.Identity);
        var speeds = new List<float>();
        world.Solver.SubstepStarted += _ => speeds.Add(world.Bodies[body].Velocity.Linear.Y);
        world.Solver.SubstepEnded += _ => speeds.Add(world.Bodies[body].Velocity.Linear.Y);
        world.Solver.SubstepCount = 2;

        world.Step(.2f);

        Assert.Equal([0, -.981f, -.981f, -1.962f], speeds.Select(speed => MathF.Round(speed, 5)));
    }

    public static TheoryData<FailingPlace, int> Failures
    {
        get
        {
            var data = new TheoryData<FailingPlace, int>();
            foreach (var place in Enum.GetValues<FailingPlace>())
            {
                for (int threads = 1; threads <= 3; ++threads)
                    data.Add(place, threads);
            }
            return data;
        }
    }

    [Theory]
    [MemberData(nameof(Failures))]
    public void An_exception_reaches_the_caller_and_costs_no_memory(FailingPlace place, int threads)
    {
        var bomb = new Bomb(place);
        var pool = new BufferPool();
        using var dispatcher = threads > 1 ? new ThreadDispatcher(threads) : null;
        var timestepper = new DefaultTimestepper();
        timestepper.BeforeCollisionDetection += (_, _) => bomb.Pass(FailingPlace.BeforeCollisionDetection);
        timestepper.CollisionsDetected += (_, _) => bomb.Pass(FailingPlace.CollisionsDetected);
        timestepper.ConstraintsSolved += (_, _) => bomb.Pass(FailingPlace.ConstraintsSolved);
        var description = new SolveDescription(2, substep =>
        {
            bomb.Pass(FailingPlace.IterationScheduler);
            return 1;
        });
        var simulation = Simulation.Create(pool, new ThrowingContacts(bomb), new ThrowingGravity(bomb), description, timestepper);
        simulation.Solver.SubstepStarted += _ => bomb.Pass(FailingPlace.SubstepStarted);
        simulation.Solver.SubstepEnded += _ => bomb.Pass(FailingPlace.SubstepEnded);
        var bodies = AddGrid(simulation);
        simulation.Solver.Add(bodies[0], bodies[1], new BallSocket { LocalOffsetA = new Vector3(.5f, 0, 0), LocalOffsetB = new Vector3(-.5f, 0, 0) });
        // The first failure meets a step in which all pairs are new, the second one in which most are known.
        for (int i = 0; i < 2; ++i)
        {
            bomb.Armed = true;
            var error = Assert.ThrowsAny<Exception>(() => simulation.Timestep(1 / 60f, dispatcher));
            Assert.Equal(place.ToString(), Assert.IsType<InvalidTimeZoneException>(error).Message);
            bomb.Armed = false;
            for (int j = 0; j < 3; ++j)
                simulation.Timestep(1 / 60f, dispatcher);
        }
        simulation.Validate();
        bomb.Armed = true;
        Assert.Throws<InvalidTimeZoneException>(() => simulation.Timestep(1 / 60f, dispatcher));

        simulation.Dispose();
        pool.AssertEmpty();
        dispatcher?.WorkerPools.AssertEmpty();
        pool.Clear();
    }

    // A contact that bounces is known to the solver by its handle: one that is removed in between must not be looked for.
    [Fact]
    public void Bodies_that_bounce_may_be_removed_between_collision_detection_and_solver()
    {
        var timestepper = new DefaultTimestepper();
        using var world = new TestWorld(timestepper: timestepper, material: new PairMaterialProperties(.5f, 2, default), restitution: .8f);
        world.AddStatic(new Box(20, 2, 20), new RigidPose(new Vector3(0, -1, 0)));
        var falling = new List<BodyHandle>();
        for (int i = 0; i < 6; ++i)
            falling.Add(world.AddDynamic(new Sphere(.5f), 1, new RigidPose(new Vector3(2 * i - 5, .51f, 0)), new BodyVelocity(new Vector3(0, -5, 0))));
        timestepper.CollisionsDetected += (_, _) =>
        {
            if (falling.Count == 6)
            {
                world.Bodies.Remove(falling[2]);
                falling.RemoveAt(2);
            }
        };

        world.Step();

        world.Simulation.Validate();
        foreach (var body in falling)
            Assert.Equal(4, world.Bodies[body].Velocity.Linear.Y, .2f);
    }

    [Fact]
    public void A_simulation_that_bounced_can_be_cleared_and_used_again()
    {
        using var world = new TestWorld(material: new PairMaterialProperties(.5f, 2, default), restitution: .8f);
        for (int round = 0; round < 2; ++round)
        {
            world.AddStatic(new Box(20, 2, 20), new RigidPose(new Vector3(0, -1, 0)));
            var ball = world.AddDynamic(new Sphere(.5f), 1, new RigidPose(new Vector3(0, .51f, 0)), new BodyVelocity(new Vector3(0, -5, 0)));
            world.Step();
            Assert.Equal(4, world.Bodies[ball].Velocity.Linear.Y, .2f);
            world.Simulation.Clear();
            world.AddDynamic(new Sphere(.5f), 1, RigidPose.Identity);
            world.Simulation.Solve(TestWorld.Dt);
            world.Simulation.Clear();
            world.Simulation.Validate();
        }
    }

    // Enough bodies that the stages are divided among threads.
    static List<BodyHandle> AddGrid(Simulation simulation)
    {
        var bodies = new List<BodyHandle>();
        var box = new Box(1, 1, 1);
        var shape = simulation.Shapes.Add(box);
        simulation.Statics.Add(new StaticDescription(new Vector3(0, -1, 0), simulation.Shapes.Add(new Box(100, 2, 100))));
        for (int i = 0; i < 900; ++i)
        {
            var position = new Vector3(i % 30 * 1.2f - 18, .5f, i / 30 * 1.2f - 18);
            bodies.Add(simulation.Bodies.Add(BodyDescription.CreateDynamic(position, box.ComputeInertia(1), shape, new BodyActivityDescription(-1))));
        }
        return bodies;
    }
}
