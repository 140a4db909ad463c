using System;
using System.Collections.Generic;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuPhysics.Constraints;
using BepuUtilities;
using BepuUtilities.Memory;
using Demos.Accuracy;
using Demos.References;
using Xunit;

namespace DemoTests.Scenes;

/// <summary>Bodies without constraints that are left out of the substeps, and moved once per step.</summary>
public class FreeBodyTests
{
    static readonly AccuracySettings atOnce = new() { SubstepsForFreeBodies = false, Contacts = ContactScope.None };

    /// <summary>A throw is a parabola: the error is that of rounding, and the same for short and long steps and any number of substeps.</summary>
    [Theory]
    [InlineData(1 / 60f, 1)]
    [InlineData(1 / 60f, 4)]
    [InlineData(1 / 20f, 3)]
    public void A_throw_is_a_parabola(float dt, int substeps)
    {
        using var world = new TestWorld(atOnce with { SubstepCount = substeps });
        var start = new Vector3(3, -2, 1);
        var velocity = new Vector3(4, 7, -5);
        var body = world.AddDynamic(new Box(1, 2, 3), 2, new RigidPose(start), new BodyVelocity(velocity));
        const int count = 90;
        for (int i = 0; i < count; ++i)
            world.Step(dt);
        var t = count * (double)dt;
        var height = start.Y + velocity.Y * t - 9.81f * t * t / 2;
        // Speeds of up to 40 m/s, rounded 90 times, over t.
        var tolerance = 90 * 2e-6 * t;
        var position = world.Bodies[body].Pose.Position;
        Assert.Equal(height, position.Y, tolerance);
        Assert.Equal(start.X + velocity.X * t, position.X, tolerance);
        Assert.Equal(start.Z + velocity.Z * t, position.Z, tolerance);
        Assert.Equal(velocity.Y - 9.81f * t, world.Bodies[body].Velocity.Linear.Y, tolerance);
    }

    /// <summary>A body that tumbles does so as Euler's equations say, with its momentum and energy.</summary>
    [Theory]
    [InlineData(1, 10, 1)]
    [InlineData(6, 2, 3)]
    [InlineData(.3f, .2f, -.5f)]
    public void What_tumbles_does_so_as_by_its_equations(float x, float y, float z)
    {
        using var world = new TestWorld(atOnce);
        var body = world.AddDynamic(new Box(1, 2, 3), 1, new RigidPose(Vector3.Zero), new BodyVelocity(default, new Vector3(x, y, z)));
        var inertia = TorqueFreeBody.BoxInertia(1, 1, 2, 3);
        var reference = new TorqueFreeBody(inertia, DoubleQuaternion.Identity, new(x, y, z));
        const int steps = 120;
        world.Step(steps);
        reference.Advance(steps * (double)TestWorld.Dt, TestWorld.Dt / 100.0);
        DoubleQuaternion orientation = world.Bodies[body].Pose.Orientation;
        var angular = world.Bodies[body].Velocity.Angular;
        var local = orientation.RotateBack(new Double3(angular.X, angular.Y, angular.Z));
        // Two seconds at up to 10 rad/s, in which the body tumbles over once: half a degree is 4e-4 of the way.
        Assert.InRange(DoubleQuaternion.AngleBetween(orientation, reference.Orientation), 0, .5 * Math.PI / 180);
        var momentum = orientation.Rotate(Double3.Scale(inertia, local));
        Assert.InRange((momentum - reference.Momentum).Length / reference.Momentum.Length, 0, 2e-5);
        var energy = Double3.Dot(Double3.Scale(inertia, local), local) / 2;
        Assert.InRange(Math.Abs(energy / reference.Energy - 1), 0, 2e-4);
    }

    /// <summary>Who is free and who is not share bundles; to the bit, neither notices.</summary>
    [Theory]
    [InlineData(1)]
    [InlineData(3)]
    public void Neither_sees_the_other(int threads)
    {
        List<(Vector3, Quaternion, Vector3, Vector3)> together = Run(threads, 25, 25), free = Run(threads, 25, 0), joined = Run(1, 0, 25);
        for (int i = 0; i < 25; ++i)
        {
            Assert.Equal(free[i], together[2 * i]);
            Assert.Equal(joined[i], together[2 * i + 1]);
        }
    }

    // Free ones and pendulums in turn, as far as there are both.
    static List<(Vector3, Quaternion, Vector3, Vector3)> Run(int threads, int freeCount, int joinedCount)
    {
        using var world = new TestWorld(atOnce, threads);
        var handles = new List<BodyHandle>();
        for (int i = 0; i < Math.Max(freeCount, joinedCount); ++i)
        {
            var spin = new BodyVelocity(new Vector3(i, 1, 0), new Vector3(1 + i, 2, -i));
            if (i < freeCount)
                handles.Add(world.AddDynamic(new Box(1, 2, 3), 1, new RigidPose(new Vector3(5 * i, 0, 0)), spin));
            if (i < joinedCount)
            {
                handles.Add(world.AddDynamic(new Box(1, 2, 3), 1, new RigidPose(new Vector3(5 * i, 0, 9)), spin));
                world.Solver.Add(handles[^1], new OneBodyLinearServo
                {
                    Target = new Vector3(5 * i, 0, 9),
                    LocalOffset = Vector3.UnitX,
                    ServoSettings = ServoSettings.Default,
                    SpringSettings = new SpringSettings(3, 1),
                });
            }
        }
        world.Step(20);
        var states = new List<(Vector3, Quaternion, Vector3, Vector3)>();
        foreach (var handle in handles)
        {
            var body = world.Bodies[handle];
            states.Add((body.Pose.Position, body.Pose.Orientation, body.Velocity.Linear, body.Velocity.Angular));
        }
        return states;
    }

    /// <summary>The callbacks are told of a free body once per step, with the time of the step, and of others once per substep.</summary>
    [Fact]
    public void Callbacks_are_called_once_with_the_time_of_the_step()
    {
        var calls = new Calls();
        using var world = new CountingWorld(calls);
        var free = world.Add(new Vector3(0, 0, 0));
        var joined = world.Add(new Vector3(5, 0, 0));
        world.Hold(joined);
        calls.Clear();
        world.Simulation.Timestep(1 / 60f);
        Assert.Equal([1 / 60f], calls.OfSolve[world.IndexOf(free)]);
        Assert.Equal([1 / 240f, 1 / 240f, 1 / 240f, 1 / 240f], calls.OfSolve[world.IndexOf(joined)]);
        // With its first constraint it takes the substeps.
        world.Hold(free);
        calls.Clear();
        world.Simulation.Timestep(1 / 60f);
        Assert.Equal(4, calls.OfSolve[world.IndexOf(free)].Count);
    }

    /// <summary>A velocity that cannot be simulated stops that body where it was; another free one in the same bundle flies on.</summary>
    [Theory]
    [InlineData(float.NaN)]
    [InlineData(1e20f)]
    public void What_callbacks_break_stays_where_it_was(float velocity)
    {
        var calls = new Calls();
        using var world = new CountingWorld(calls);
        var broken = world.Add(new Vector3(1, 2, 3));
        var other = world.Add(new Vector3(5, 0, 0));
        world.Simulation.Timestep(1 / 60f);
        var pose = world.Simulation.Bodies[broken].Pose;
        calls.BrokenBody = world.IndexOf(broken);
        calls.BrokenVelocity = velocity;
        world.Simulation.Timestep(1 / 60f);
        Assert.Equal([broken], world.Simulation.Quarantine.Bodies.ToArray());
        Assert.Equal(pose, world.Simulation.Bodies[broken].Pose);
        Assert.Equal(default, world.Simulation.Bodies[broken].Velocity.Linear);
        // Two steps of 1/60 s at one gravity of 10 m/s2: g t^2 / 2.
        Assert.Equal(-10 * (2 / 60.0) * (2 / 60.0) / 2, world.Simulation.Bodies[other].Pose.Position.Y, 1e-7);
        calls.BrokenBody = -1;
        world.Simulation.Timestep(1 / 60f);
        Assert.Empty(world.Simulation.Quarantine.Bodies.ToArray());
        // From rest again.
        Assert.Equal(pose.Position.Y - 10 / 3600.0 / 2, world.Simulation.Bodies[broken].Pose.Position.Y, 1e-6);
    }

    sealed class Calls
    {
        public Dictionary<int, List<float>> OfSolve { get; } = [];
        public int BrokenBody { get; set; } = -1;
        public float BrokenVelocity { get; set; }
        public bool IsSolving { get; set; }

        public void Clear() => OfSolve.Clear();

        public void Add(int body, float dt)
        {
            if (!OfSolve.TryGetValue(body, out var list))
                OfSolve.Add(body, list = []);
            list.Add(dt);
        }
    }

    readonly struct CountingCallbacks(Calls calls) : IPoseIntegratorCallbacks
    {
        public void IntegrateVelocity(
            Vector<int> bodyIndices, Vector3Wide position, QuaternionWide orientation, BodyInertiaWide localInertia, Vector<int> integrationMask,
            int workerIndex, Vector<float> dt, ref BodyVelocityWide velocity)
        {
            velocity.Linear.Y -= dt * new Vector<float>(10);
            if (!calls.IsSolving)
                return;
            var broken = Vector.Equals(bodyIndices, new Vector<int>(calls.BrokenBody)) & integrationMask;
            velocity.Linear.X = Vector.ConditionalSelect(broken, new Vector<float>(calls.BrokenVelocity), velocity.Linear.X);
            for (int i = 0; i < Vector<int>.Count; ++i)
            {
                Assert.Equal(bodyIndices[i] >= 0, integrationMask[i] != 0);
                if (bodyIndices[i] >= 0)
                    calls.Add(bodyIndices[i], dt[i]);
            }
        }

        public void Initialize(Simulation simulation) { }

        public bool IntegrateVelocityForKinematics => false;

        public void PrepareForIntegration(float dt) { }

        public bool AllowSubstepsForUnconstrainedBodies => false;

        public AngularIntegrationMode AngularIntegrationMode => AngularIntegrationMode.ConserveMomentumWithGyroscopicTorque;
    }

    // Knows when the solver is at work: the prediction of bounds calls the same callback.
    sealed class CountingWorld : IDisposable
    {
        readonly BufferPool pool = new();
        readonly Calls calls;

        public CountingWorld(Calls calls)
        {
            this.calls = calls;
            Simulation = Simulation.Create(pool, new DefaultNarrowPhaseCallbacks(), new CountingCallbacks(calls), new SolveDescription(1, 4),
                new Watcher(calls));
        }

        public Simulation Simulation { get; }

        public BodyHandle Add(Vector3 position) => Simulation.Bodies.Add(BodyDescription.CreateConvexDynamic(
            position, default, 1, Simulation.Shapes, new Box(.5f, .6f, .7f)));

        public void Hold(BodyHandle body) => Simulation.Solver.Add(body, new OneBodyAngularMotor { TargetVelocity = default, Settings = new(100, 1e-3f) });

        public int IndexOf(BodyHandle body) => Simulation.Bodies.HandleToLocation[body.Value].Index;

        public void Dispose()
        {
            Simulation.Dispose();
            pool.AssertEmpty();
            pool.Clear();
        }
    }

    sealed class Watcher(Calls calls) : ITimestepper
    {
        public event TimestepperStageHandler? BeforeCollisionDetection { add { } remove { } }
        public event TimestepperStageHandler? CollisionsDetected { add { } remove { } }

        public void Timestep(Simulation simulation, float dt, IThreadDispatcher? threadDispatcher = null)
        {
            simulation.PredictBoundingBoxes(dt, threadDispatcher);
            simulation.CollisionDetection(dt, threadDispatcher);
            calls.IsSolving = true;
            simulation.Solve(dt, threadDispatcher);
            calls.IsSolving = false;
        }
    }
}
