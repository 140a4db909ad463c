using System;
using System.Collections.Generic;
using System.Linq;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuPhysics.CollisionDetection;
using BepuPhysics.Constraints;
using BepuUtilities.Memory;
using DemoTests.Scenes;
using Xunit;

namespace DemoTests.LoadPath;

/// <summary>What is pressed into what carries it, by a joint or by what does not give way, at the default setting: it comes to rest.</summary>
public class PressedTests
{
    /// <summary>Only what does not move is touched, as by the parts of a ragdoll.</summary>
    readonly struct GroundAlone(float friction) : INarrowPhaseCallbacks
    {
        public void Initialize(Simulation simulation)
        {
        }

        public bool AllowContactGeneration(int workerIndex, CollidableReference a, CollidableReference b, ref float speculativeMargin) =>
            a.Mobility == CollidableMobility.Dynamic ^ b.Mobility == CollidableMobility.Dynamic;

        public bool AllowContactGeneration(int workerIndex, CollidablePair pair, int childIndexA, int childIndexB) => true;

        public bool ConfigureContactManifold<TManifold>(int workerIndex, CollidablePair pair, ref TManifold manifold, out PairMaterialProperties material)
            where TManifold : unmanaged, IContactManifold<TManifold>
        {
            material = new DefaultNarrowPhaseCallbacks().Material;
            material.FrictionCoefficient = friction;
            return true;
        }

        public bool ConfigureContactManifold(int workerIndex, CollidablePair pair, int childIndexA, int childIndexB, ref ConvexContactManifold manifold) =>
            true;

        public void Dispose()
        {
        }
    }

    static BodyHandle AddPlate(LoadPathWorld world, float y) => world.Simulation.Bodies.Add(
        BodyDescription.CreateKinematic(new Vector3(0, y, 0), world.Simulation.Shapes.Add(new Box(4, .5f, 4)), -1));

    // A sleeping threshold of bodies that were made with none given.
    const float Still = .01f;

    static void AssertStill(LoadPathWorld world, IReadOnlyList<BodyHandle> boxes)
    {
        for (int step = 0; step < 120; ++step)
        {
            world.Step();
            Assert.All(boxes, box => Assert.InRange(world.Velocity(box).Length(), 0, Still));
        }
    }

    /// <summary>Under a press that has come down and stands. It stirred by up to .8 m/s.</summary>
    [Theory, InlineData(.05f), InlineData(.15f), InlineData(.3f)]
    public void What_is_under_a_press_comes_to_rest(float squeeze)
    {
        using var world = new LoadPathWorld(LoadPathMode.WhereNeeded);
        var crate = world.Add(new Vector3(0, .5f, 0), Vector3.One, 1);
        var press = AddPlate(world, 1.25f);
        world.Run(.33f);
        world.Simulation.Bodies[press].Velocity.Linear = new Vector3(0, -.3f, 0);
        world.Run(squeeze / .3f);
        world.Simulation.Bodies[press].Velocity.Linear = default;
        world.Run(1);
        AssertStill(world, [crate]);
    }

    /// <summary>A lift that has come up to a ceiling with crates on it, and goes down again. They stirred by up to .23 m/s.</summary>
    [Theory, InlineData(1), InlineData(3)]
    public void What_a_lift_holds_under_a_ceiling_comes_to_rest(int count)
    {
        const float rise = 1.2f, gap = 1, recovery = 2;
        using var world = new LoadPathWorld(LoadPathMode.WhereNeeded);
        var lift = AddPlate(world, 1.75f);
        world.Simulation.Statics.Add(new StaticDescription(new Vector3(0, count + 2.5f + gap, 0), world.Simulation.Shapes.Add(new Box(4, 1, 4))));
        var boxes = Enumerable.Range(0, count).Select(i => world.Add(new Vector3(0, 2.5f + i, 0), Vector3.One, 1)).ToList();
        world.Simulation.Bodies[lift].Velocity.Linear = new Vector3(0, 1, 0);
        world.Run(rise);
        world.Simulation.Bodies[lift].Velocity.Linear = default;
        world.Run(1);
        AssertStill(world, boxes);
        world.Simulation.Bodies[lift].Velocity.Linear = new Vector3(0, -1, 0);
        for (int step = 0; step < 60; ++step)
        {
            world.Step();
            // Each overlap is corrected at the recovery velocity at most, beside the velocity of the lift.
            Assert.All(boxes, box => Assert.InRange(world.Velocity(box).Length(), 0, 1 + count * recovery));
        }
    }

    /// <summary>Servos of ten hertz twist a foot on the ground for ever: it was let go and held by turns. By sweeps it sleeps within ten seconds.</summary>
    // How it comes to lie is chance: of 800 that are pushed one in a hundred has found a foot that stirs.
    [Fact]
    public void Ragdolls_of_servos_fall_asleep()
    {
        var stirring = 0;
        for (int seed = 0; seed < 16; ++seed)
            stirring += FallsAsleep(seed) ? 0 : 1;
        Assert.InRange(stirring, 0, 1);
    }

    static bool FallsAsleep(int seed)
    {
        using var pool = new BufferPool();
        bool sleeps;
        using (var simulation = Simulation.Create(
            pool, new GroundAlone(.8f), new DefaultPoseIntegratorCallbacks(new Vector3(0, -9.81f, 0)), new SolveDescription(1, 4)))
        {
            simulation.Statics.Add(new StaticDescription(new Vector3(0, -.5f, 0), simulation.Shapes.Add(new Box(200, 1, 200))));
            AddRagdoll(simulation);
            Push(simulation, new Random(seed));
            for (int step = 0; step < 600; ++step)
                simulation.Timestep(LoadPathWorld.Dt);
            sleeps = simulation.Bodies.ActiveSet.Count == 0;
        }
        pool.AssertEmpty();
        return sleeps;
    }

    // By up to .1 m/s and rad/s, each part its own way.
    static void Push(Simulation simulation, Random random)
    {
        for (int i = 0; i < simulation.Bodies.ActiveSet.Count; ++i)
        {
            ref var velocity = ref simulation.Bodies[simulation.Bodies.ActiveSet.IndexToHandle[i]].Velocity;
            velocity.Linear = TestWorld.Scatter(random, .2f);
            velocity.Angular = TestWorld.Scatter(random, .2f);
        }
    }

    static void AddRagdoll(Simulation simulation)
    {
        BodyHandle Part(float x, float y, float z, float mass, float width, float height, float depth)
        {
            var box = new Box(width, height, depth);
            return simulation.Bodies.Add(
                BodyDescription.CreateDynamic(new Vector3(x, y, z), box.ComputeInertia(mass), simulation.Shapes.Add(box), Still));
        }
        void Join(BodyHandle a, BodyHandle b, float x, float y)
        {
            var at = new Vector3(x, y, 0);
            simulation.Solver.Add(a, b, new BallSocket
            {
                LocalOffsetA = at - simulation.Bodies[a].Pose.Position,
                LocalOffsetB = at - simulation.Bodies[b].Pose.Position,
                SpringSettings = new SpringSettings(30, 1),
            });
            simulation.Solver.Add(a, b, new AngularServo
            {
                TargetRelativeRotationLocalA = Quaternion.Identity,
                ServoSettings = new ServoSettings(float.MaxValue, 0, float.MaxValue),
                SpringSettings = new SpringSettings(10, 1),
            });
        }
        var pelvis = Part(0, 1, 0, 12, .35f, .2f, .2f);
        var chest = Part(0, 1.35f, 0, 25, .4f, .45f, .25f);
        var head = Part(0, 1.75f, 0, 5, .2f, .25f, .2f);
        Join(pelvis, chest, 0, 1.12f);
        Join(chest, head, 0, 1.6f);
        foreach (var side in (ReadOnlySpan<float>)[-1, 1])
        {
            var upperArm = Part(side * .4f, 1.5f, 0, 2.5f, .35f, .1f, .1f);
            var lowerArm = Part(side * .8f, 1.5f, 0, 1.5f, .35f, .08f, .08f);
            Join(chest, upperArm, side * .2f, 1.5f);
            Join(upperArm, lowerArm, side * .6f, 1.5f);
            var thigh = Part(side * .12f, .7f, 0, 9, .15f, .4f, .15f);
            var shin = Part(side * .12f, .28f, 0, 4, .12f, .4f, .12f);
            var foot = Part(side * .12f, .04f, .06f, 1, .12f, .08f, .3f);
            Join(pelvis, thigh, side * .12f, .92f);
            Join(thigh, shin, side * .12f, .49f);
            Join(shin, foot, side * .12f, .08f);
        }
    }

    /// <summary>
    /// A foot of 1 kg that bears twenty times its weight by its joints is not pressed: it comes out of the ground into which it has landed. By sweeps
    /// alone, and where eight weights are enough, it stays 5 mm in it.
    /// </summary>
    [Theory, InlineData(0), InlineData(.1f)]
    public void The_feet_of_a_machine_stand_on_the_ground(float drop)
    {
        using var world = new LoadPathWorld(LoadPathMode.WhereNeeded, friction: .8f);
        void Weld(BodyHandle a, BodyHandle b) => world.Simulation.Solver.Add(a, b, new Weld
        {
            LocalOffset = world.Position(b) - world.Position(a),
            LocalOrientation = Quaternion.Identity,
            SpringSettings = new SpringSettings(60, 1),
        });
        var trunk = world.Add(new Vector3(0, 1.2f + drop, 0), new Vector3(.6f, .4f, .4f), 60);
        var feet = new List<BodyHandle>();
        for (int i = 0; i < 4; ++i)
        {
            var place = new Vector3(i % 2 * .5f - .25f, drop, i / 2 * .36f - .18f);
            var leg = world.Add(place + new Vector3(0, .55f, 0), new Vector3(.1f, .8f, .1f), 4);
            feet.Add(world.Add(place + new Vector3(0, .04f, 0), new Vector3(.2f, .08f, .2f), 1));
            Weld(trunk, leg);
            Weld(leg, feet[i]);
        }
        world.Run(3);
        Assert.All(feet, foot => Assert.InRange(world.Position(foot).Y - .04f, -.002f, .002f));
    }
}
