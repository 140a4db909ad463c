using System;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuPhysics.CollisionDetection;
using BepuPhysics.Constraints;
using BepuUtilities.Memory;
using DemoTests.Collidables.Meshes;
using Xunit;

namespace DemoTests.Compounds;

/// <summary>What lies on a shape of children and hardly moves keeps its patches without a look at the children.</summary>
public class CarriedPatchTests
{
    const float Gravity = 9.81f;

    sealed class Asked
    {
        public int Children, Pairs;
    }

    interface IDecision
    {
        static abstract bool OnChildren { get; }
    }

    struct Decides : IDecision
    {
        public static bool OnChildren => true;
    }

    struct SaysYes : IDecision
    {
        public static bool OnChildren => false;
    }

    // Counts how often it is asked, on one thread.
    readonly struct Counting<TDecision>(Asked asked) : INarrowPhaseCallbacks where TDecision : struct, IDecision
    {
        public static bool DecidesOnChildren => TDecision.OnChildren;

        public void Initialize(Simulation simulation) { }

        public bool AllowContactGeneration(int workerIndex, CollidableReference a, CollidableReference b, ref float speculativeMargin) => true;

        public bool AllowContactGeneration(int workerIndex, CollidablePair pair, int childIndexA, int childIndexB)
        {
            ++asked.Children;
            return true;
        }

        public bool ConfigureContactManifold<TManifold>(int workerIndex, CollidablePair pair, ref TManifold manifold, out PairMaterialProperties pairMaterial)
            where TManifold : unmanaged, IContactManifold<TManifold>
        {
            asked.Pairs += manifold.Count > 0 ? 1 : 0;
            pairMaterial = new PairMaterialProperties(.5f, 2, SpringSettings.Rigid);
            return true;
        }

        public bool ConfigureContactManifold(
            int workerIndex, CollidablePair pair, int childIndexA, int childIndexB, ref ConvexContactManifold manifold) => true;

        public void Dispose() { }
    }

    // A floor of triangles of 1 m, and one body on it.
    sealed class World<TDecision> : IDisposable where TDecision : struct, IDecision
    {
        readonly BufferPool pool = new();
        readonly TypedIndex floor;

        public World(Quaternion turn = default)
        {
            Simulation = Simulation.Create(pool, new Counting<TDecision>(Asked), new DefaultPoseIntegratorCallbacks(new Vector3(0, -Gravity, 0)),
                new SolveDescription(1, 4));
            var sample = MeshSample.Terrain(20, 0);
            floor = Simulation.Shapes.Add(new Mesh(sample.Vertices, sample.Indices, Vector3.One, pool));
            Simulation.Statics.Add(new StaticDescription(Vector3.Zero, turn == default ? Quaternion.Identity : turn, floor));
        }

        public Simulation Simulation { get; }
        public Asked Asked { get; } = new();

        public BodyReference Add<TShape>(TShape shape, Vector3 position, Quaternion orientation, Vector3 linear = default, Vector3 angular = default)
            where TShape : unmanaged, IConvexShape
        {
            var description = BodyDescription.CreateDynamic(
                new RigidPose(position, orientation), new BodyVelocity(linear, angular), shape.ComputeInertia(1), Simulation.Shapes.Add(shape), -1f);
            return Simulation.Bodies[Simulation.Bodies.Add(description)];
        }

        public void Run(int steps)
        {
            for (int i = 0; i < steps; ++i)
                Simulation.Timestep(1 / 60f);
            Simulation.Validate();
        }

        public void Dispose()
        {
            Simulation.Statics.Clear();
            Simulation.Shapes.RecursivelyRemoveAndDispose(floor, pool);
            Simulation.Dispose();
            pool.AssertEmpty();
            pool.Clear();
        }
    }

    static (int Children, int Pairs) CountAtRest<TDecision>(int steps) where TDecision : struct, IDecision
    {
        using var world = new World<TDecision>();
        world.Add(new Box(1.6f, 1, 1.6f), new Vector3(.3f, .5f, .2f), Quaternion.Identity);
        world.Run(60);
        var before = (world.Asked.Children, world.Asked.Pairs);
        world.Run(steps);
        return (world.Asked.Children - before.Children, world.Asked.Pairs - before.Pairs);
    }

    [Fact]
    public void Children_are_looked_for_every_sixteen_steps_unless_callbacks_decide_on_them()
    {
        const int Steps = 170;
        var (all, pairs) = CountAtRest<Decides>(Steps);
        Assert.Equal(Steps, pairs);
        var (some, pairsOfSome) = CountAtRest<SaysYes>(Steps);
        Assert.Equal(Steps, pairsOfSome);
        // A test, and sixteen steps without.
        Assert.Equal(Steps / 17 * (all / Steps), some);
    }

    [Fact]
    public void What_moves_is_tested_in_each_step()
    {
        using var world = new World<SaysYes>();
        world.Add(new Box(1, 1, 1), new Vector3(0, .5f, 0), Quaternion.Identity, new Vector3(2, 0, 0));
        world.Run(10);
        var before = world.Asked.Children;
        world.Run(10);
        Assert.InRange(world.Asked.Children - before, 20, int.MaxValue);
    }

    static readonly Quaternion lying = Quaternion.CreateFromAxisAngle(Vector3.UnitX, MathF.PI / 2);

    // Below the motion that lets contacts be carried along: 1/1000 of the reach in a step, of which turning is half.
    [Theory]
    [InlineData("sphere", .01f), InlineData("sphere", .005f), InlineData("sphere", .002f), InlineData("capsule", .01f), InlineData("capsule", .004f)]
    [InlineData("capsule", .002f), InlineData("cylinder", .01f), InlineData("cylinder", .004f), InlineData("cylinder", .002f)]
    public void What_rolls_slowly_on_a_plane_keeps_its_speed(string shape, float speed)
    {
        var most = Roll<Decides>(shape, speed) * .7;
        Assert.InRange(Roll<SaysYes>(shape, speed), 1, most);
    }

    static int Roll<TDecision>(string shape, float speed) where TDecision : struct, IDecision
    {
        using var world = new World<TDecision>();
        const float radius = .5f;
        // Along x, about -z; rolling without sliding.
        var (position, linear, angular) = (new Vector3(-.3f, radius, .13f), new Vector3(speed, 0, 0), new Vector3(0, 0, -speed / radius));
        var body = Add(world, shape, radius, position, linear, angular);
        world.Run(30);
        var asked = world.Asked.Children;
        // Settling on the floor is done at a rounding of the speed that gravity gives in a step.
        var tolerance = .01f * speed + 3e-4f * Gravity / 60;
        Assert.InRange(body.Velocity.Linear.X, speed - tolerance, speed + tolerance);
        const int steps = 1200;
        world.Run(steps);
        Assert.InRange(body.Velocity.Linear.X, speed - tolerance, speed + tolerance);
        Assert.InRange(body.Pose.Position.Y, radius - 1e-3f, radius + 1e-4f);
        const float time = (steps + 30) / 60f;
        Assert.InRange(body.Pose.Position.X - position.X, (speed - tolerance) * time, (speed + tolerance) * time);
        return world.Asked.Children - asked;
    }

    static BodyReference Add<TDecision>(World<TDecision> world, string shape, float radius, Vector3 position, Vector3 linear = default,
        Vector3 angular = default) where TDecision : struct, IDecision => shape switch
        {
            "sphere" => world.Add(new Sphere(radius), position, Quaternion.Identity, linear, angular),
            "capsule" => world.Add(new Capsule(radius, 1), position, lying, linear, angular),
            "cylinder" => world.Add(new Cylinder(radius, 1), position, lying, linear, angular),
            "standing" => world.Add(new Cylinder(radius, 2 * radius), position, Quaternion.Identity, linear, angular),
            _ => world.Add(new Box(2 * radius, 2 * radius, 2 * radius), position, Quaternion.Identity, linear, angular),
        };

    [Theory, InlineData("sphere"), InlineData("capsule"), InlineData("cylinder"), InlineData("standing"), InlineData("box")]
    public void What_lies_still_stays(string shape)
    {
        using var world = new World<SaysYes>();
        var body = Add(world, shape, .3f, new Vector3(.2f, .3f, .1f));
        world.Run(60);
        var start = body.Pose;
        world.Run(1800);
        Assert.InRange(body.Velocity.Linear.Length() + body.Velocity.Angular.Length(), 0, 1e-4f);
        Assert.InRange((body.Pose.Position - start.Position).Length(), 0, 1e-4f);
    }

    // On a slope of 20 degrees, which friction of .5 holds: the normal turns with the floor.
    [Fact]
    public void A_box_on_a_slope_creeps_no_more_than_where_children_are_tested()
    {
        static float Creep<TDecision>() where TDecision : struct, IDecision
        {
            var turn = Quaternion.CreateFromAxisAngle(Vector3.UnitZ, MathF.PI / 9);
            using var world = new World<TDecision>(turn);
            var body = world.Add(new Box(1, 1, 1), Vector3.Transform(new Vector3(.3f, .5f, .2f), turn), turn);
            world.Run(120);
            var start = body.Pose.Position;
            world.Run(600);
            return (body.Pose.Position - start).Length();
        }
        Assert.InRange(Creep<SaysYes>(), 0, Math.Max(1e-5f, 1.2f * Creep<Decides>()));
    }

    [Fact]
    public void A_hole_in_the_floor_is_seen_after_sixteen_steps_at_most()
    {
        using var pool = new BufferPool();
        var simulation = Simulation.Create(pool, new DefaultNarrowPhaseCallbacks(), new DefaultPoseIntegratorCallbacks(new Vector3(0, -Gravity, 0)),
            new SolveDescription(1, 4));
        var field = new HeightField(9, 9, 1, 1, new float[81], pool, new HeightFieldCell[64]);
        simulation.Statics.Add(new StaticDescription(new Vector3(-4, 0, -4), simulation.Shapes.Add(field)));
        var body = simulation.Bodies[simulation.Bodies.Add(
            BodyDescription.CreateConvexDynamic(new Vector3(.5f, .25f, .5f), 1, simulation.Shapes, new Box(.5f, .5f, .5f)))];
        body.Activity.SleepThreshold = -1;
        for (int i = 0; i < 60; ++i)
            simulation.Timestep(1 / 60f);
        field.SetCell(4, 4, new HeightFieldCell(0, isHole: true));
        for (int i = 0; i < 17; ++i)
            simulation.Timestep(1 / 60f);
        Assert.InRange(body.Velocity.Linear.Y, float.MinValue, -Gravity / 61);
        simulation.Dispose();
        field.Dispose(pool);
    }

    /// <summary>A pair whose history was that of its patches becomes one of two convex shapes, and the other way.</summary>
    [Fact]
    public void What_lies_on_a_ground_goes_on_as_both_become_other_shapes()
    {
        using var world = new World<SaysYes>();
        // A test of a sphere and a triangle keeps no history, one of a cylinder and a box does.
        var body = world.Add(new Sphere(.2f), new Vector3(.3f, .2f, .2f), Quaternion.Identity);
        var ground = world.Simulation.Statics[world.Simulation.Statics.IndexToHandle[0]];
        var (mesh, ball) = (ground.Shape, body.Collidable.Shape);
        var box = world.Simulation.Shapes.Add(new Box(40, 1, 40));
        var cylinder = world.Simulation.Shapes.Add(new Cylinder(.5f, .4f));
        for (int i = 0; i < 4; ++i)
        {
            world.Run(60);
            Assert.InRange(body.Pose.Position.Y, .199f, .2001f);
            Assert.InRange(body.Velocity.Linear.Length(), 0, 1e-3f);
            var becomesMesh = i % 2 == 1;
            world.Simulation.Bodies.SetShape(body.Handle, becomesMesh ? ball : cylinder);
            world.Simulation.Statics.ApplyDescription(
                ground.Handle, new StaticDescription(new Vector3(0, becomesMesh ? 0 : -.5f, 0), becomesMesh ? mesh : box));
        }
    }
}
