using System;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuPhysics.CollisionDetection;
using BepuPhysics.Constraints;
using BepuUtilities;
using BepuUtilities.Memory;
using Xunit;

namespace DemoTests.LoadPath;

/// <summary>What lies by itself on the ground comes to rest to the last bit, for as long as friction holds it and no longer.</summary>
public class LoneRestTests
{
    const float Gravity = 9.81f;

    static Vector3 Slope(float tangent)
    {
        var angle = MathF.Atan(tangent);
        return Gravity * new Vector3(MathF.Sin(angle), -MathF.Cos(angle), 0);
    }

    static BodyHandle Turn(LoadPathWorld world, BodyHandle body, float angle)
    {
        world.Simulation.Bodies[body].Pose.Orientation = Quaternion.CreateFromAxisAngle(Vector3.UnitY, angle);
        return body;
    }

    // A box that rests is one of those of which nothing changes.
    static void AssertRests(LoadPathWorld world, BodyHandle body, Action run)
    {
        var before = world.Simulation.Bodies[body].Pose;
        run();
        var after = world.Simulation.Bodies[body];
        Assert.Equal((before.Position, before.Orientation), (after.Pose.Position, after.Pose.Orientation));
        Assert.Equal((Vector3.Zero, Vector3.Zero), (after.Velocity.Linear, after.Velocity.Angular));
    }

    [Theory, InlineData(0, 0), InlineData(0.9f, 0), InlineData(0.999f, 0), InlineData(0, 1), InlineData(0.9f, 1)]
    public void Boxes_and_cylinders_rest_to_the_last_bit(float share, int relaxations)
    {
        using var world = new LoadPathWorld(LoadPathMode.WhereNeeded, Slope(share * LoadPathWorld.Friction), relaxations: relaxations);
        var random = new Random(3);
        var bodies = new BodyHandle[24];
        for (int i = 0; i < bodies.Length; ++i)
        {
            var mass = MathF.Pow(10, random.NextSingle() * 8 - 4);
            Vector3 size = new(0.5f + random.NextSingle(), 0.1f + 0.4f * random.NextSingle(), 0.5f + random.NextSingle());
            Vector3 place = new(i * 3, size.Y / 2, 0);
            var body = i % 3 == 0 ? world.Add(place, new Cylinder(size.X / 2, size.Y), mass) : world.Add(place, size, mass);
            bodies[i] = Turn(world, body, random.NextSingle() * 6);
        }
        world.Run(4);
        Assert.InRange(world.Moved, 0, 1e-5);
        foreach (var body in bodies)
            AssertRests(world, body, () => { });
        AssertRests(world, bodies[0], () => world.Run(1));
        foreach (var body in bodies)
            AssertRests(world, body, () => { });
    }

    /// <summary>Whether a body rests is its own affair: neither the first of all bodies, nor those in the same bundle have a part in it.</summary>
    [Fact]
    public void Neighbours_in_a_bundle_do_not_change_a_bit()
    {
        RigidPose[] Run(bool moves)
        {
            using var world = new LoadPathWorld(LoadPathMode.WhereNeeded);
            var resting = new BodyHandle[4];
            for (int i = 0; i < 9; ++i)
            {
                var body = Turn(world, world.Add(new Vector3(i * 4, 0.5f, 0), new Vector3(1 + 0.1f * i, 1, 1), 1 + i), i);
                if (i % 2 == 1)
                    resting[i / 2] = body;
                else if (moves)
                    world.Simulation.Bodies[body].Velocity = new(new Vector3(0, i, 30), new Vector3(0, 0, 0.1f * i));
            }
            world.Run(3);
            foreach (var body in resting)
                AssertRests(world, body, () => { });
            return Array.ConvertAll(resting, body => world.Simulation.Bodies[body].Pose);
        }

        var (alone, among) = (Run(moves: false), Run(moves: true));
        for (int i = 0; i < alone.Length; ++i)
            Assert.Equal((alone[i].Position, alone[i].Orientation), (among[i].Position, among[i].Orientation));
    }

    /// <summary>However slow it is: on ice there is nothing that would stop it.</summary>
    [Theory, InlineData(1e-5f), InlineData(1e-7f), InlineData(1e-9f)]
    public void What_friction_does_not_stop_goes_on(float speed)
    {
        using var world = new LoadPathWorld(LoadPathMode.WhereNeeded, friction: 0);
        var body = world.Add(new Vector3(0, 0.5f, 0), Vector3.One, 1);
        world.Run(1);
        world.Simulation.Bodies[body].Velocity = new(new Vector3(speed, 0, 0), new Vector3(0, speed, 0));
        var start = world.Position(body).X;
        world.Run(3);
        Assert.InRange((world.Position(body).X - start) / (3 * speed), 0.99, 1.01);
        Assert.InRange(world.Simulation.Bodies[body].Velocity.Angular.Y / speed, 0.99, 1.01);
    }

    [Theory, InlineData(1.001f), InlineData(1.01f)]
    public void Hardly_beyond_the_angle_of_friction_it_slides(float share)
    {
        const float seconds = 5;
        using var world = new LoadPathWorld(LoadPathMode.WhereNeeded, Slope(share * LoadPathWorld.Friction));
        var body = world.Add(new Vector3(0, 0.3f, 0), new Vector3(1, 0.6f, 0.8f), 1);
        world.Run(seconds);
        var angle = Math.Atan(share * LoadPathWorld.Friction);
        var coulomb = Gravity * (Math.Sin(angle) - LoadPathWorld.Friction * Math.Cos(angle)) * seconds * seconds / 2;
        Assert.InRange(world.Position(body).X / coulomb, 0.95, 1.05);
    }

    /// <summary>It rests by the impulses of the step before, which a surface that has become slippery does not give any more.</summary>
    [Theory, InlineData(0.2f), InlineData(0.39f)]
    public void A_surface_that_becomes_slippery_lets_go_at_once(float friction)
    {
        const float tangent = 0.4f;
        const float seconds = 2;
        using var world = new LoadPathWorld(LoadPathMode.WhereNeeded, Slope(tangent));
        var body = world.Add(new Vector3(0, 0.3f, 0), new Vector3(1, 0.6f, 0.8f), 1);
        world.Run(1);
        AssertRests(world, body, () => world.Run(0.5f));
        var start = world.Position(body).X;
        ((NarrowPhase<DefaultNarrowPhaseCallbacks>)world.Simulation.NarrowPhase).Callbacks.Material.FrictionCoefficient = friction;
        world.Run(seconds);
        var angle = Math.Atan(tangent);
        var coulomb = Gravity * (Math.Sin(angle) - friction * Math.Cos(angle)) * seconds * seconds / 2;
        Assert.InRange((world.Position(body).X - start) / coulomb, 0.98, 1.02);
    }

    sealed class Torque
    {
        public float AngularAcceleration;
    }

    readonly struct TurningCallbacks(Torque torque) : IPoseIntegratorCallbacks
    {
        public bool IntegrateVelocityForKinematics => false;
        public bool AllowSubstepsForUnconstrainedBodies => true;
        public AngularIntegrationMode AngularIntegrationMode => AngularIntegrationMode.Nonconserving;

        public void IntegrateVelocity(
            Vector<int> bodyIndices, Vector3Wide position, QuaternionWide orientation, BodyInertiaWide localInertia, Vector<int> integrationMask,
            int workerIndex, Vector<float> dt, ref BodyVelocityWide velocity)
        {
            velocity.Angular.Y += dt * torque.AngularAcceleration;
            velocity.Linear.Y -= dt * Gravity;
        }

        public void PrepareForIntegration(float dt)
        {
        }

        public void Initialize(Simulation simulation)
        {
        }
    }

    /// <summary>A torque about the vertical is held by friction against turning, and by no more of it than there is.</summary>
    [Fact]
    public void A_surface_that_becomes_slippery_lets_what_is_turned_go_at_once()
    {
        var torque = new Torque();
        using var pool = new BufferPool();
        using var simulation = Simulation.Create(
            pool, new DefaultNarrowPhaseCallbacks(new(0.5f, 2, SpringSettings.Rigid)), new TurningCallbacks(torque), new SolveDescription(1, 4));
        simulation.Statics.Add(new StaticDescription(new Vector3(0, -0.5f, 0), simulation.Shapes.Add(new Box(20, 1, 20))));
        var cube = new Box(1, 1, 1);
        var body = simulation.Bodies[simulation.Bodies.Add(BodyDescription.CreateDynamic(
            new Vector3(0, 0.5f, 0), cube.ComputeInertia(1), simulation.Shapes.Add(cube), -1))];
        void Run(float seconds)
        {
            for (float time = 0; time < seconds; time += 1 / 60f)
                simulation.Timestep(1 / 60f);
        }

        // Friction on a square of contacts, half a diagonal away, holds m g mu .707 at most, and the moment of inertia is m / 6. Six tenths of it are against
        // what turns, a face that presses evenly; all of it while it begins to.
        static float Limit(float friction) => Gravity * friction * MathF.Sqrt(0.5f) * 6;
        torque.AngularAcceleration = 0.8f * Limit(0.5f);
        Run(2);
        Assert.InRange(body.Velocity.Angular.Length(), 0, 1e-6f);
        var friction = 0.5f * 0.6f;
        ((NarrowPhase<DefaultNarrowPhaseCallbacks>)simulation.NarrowPhase).Callbacks.Material.FrictionCoefficient = friction;
        Run(1);
        Assert.InRange(body.Velocity.Angular.Y / (torque.AngularAcceleration - 0.6f * Limit(friction)), 0.94, 1);
    }
}
