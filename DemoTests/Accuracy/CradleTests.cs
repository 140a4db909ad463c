using System;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuPhysics.CollisionDetection;
using BepuPhysics.Constraints;
using BepuUtilities.Memory;
using Xunit;
using Xunit.Abstractions;

namespace DemoTests.Accuracy;

/// <summary>Balls in a row that hang from rods and swing against each other, as games build them: without a margin to see each other by.</summary>
public class CradleTests(ITestOutputHelper output)
{
    const float Gravity = 9.81f, Length = 1, Radius = .1f;

    /// <summary>What a ball hangs from.</summary>
    public enum Hanger
    {
        BallSocket,
        TwoBallSockets,
        TwoCenterDistances,
    }

    sealed class Cradle : IDisposable
    {
        readonly BufferPool pool = new();
        readonly BodyHandle[] balls;
        readonly float scale;
        public readonly Simulation Simulation;

        public Cradle(Hanger hanger, int count, float gap, float degrees, float restitution, SolveDescription description, float scale = 1)
        {
            this.scale = scale;
            var callbacks = new DefaultNarrowPhaseCallbacks(new PairMaterialProperties(0, 2 * scale, SpringSettings.Rigid))
            {
                Surface = new() { Restitution = restitution },
            };
            Simulation = Simulation.Create(pool, callbacks, new DefaultPoseIntegratorCallbacks(new Vector3(0, -Gravity * scale, 0)), description);
            var sphere = new Sphere(Radius * scale);
            var shape = Simulation.Shapes.Add(sphere);
            balls = new BodyHandle[count];
            for (int i = 0; i < count; ++i)
            {
                var pivot = new Vector3(i * Radius * (2 + gap), Length, 0);
                var turn = Quaternion.CreateFromAxisAngle(Vector3.UnitZ, i == 0 ? -degrees * MathF.PI / 180 : 0);
                var pose = new RigidPose((pivot + Vector3.Transform(new(0, -Length, 0), turn)) * scale, turn);
                balls[i] = Simulation.Bodies.Add(BodyDescription.CreateDynamic(pose, sphere.ComputeInertia(1), shape, new BodyActivityDescription(-1)));
                Hang(hanger, balls[i], pivot);
            }
        }

        void Hang(Hanger hanger, BodyHandle ball, Vector3 pivot)
        {
            float half = hanger == Hanger.BallSocket ? 0 : .4f;
            for (int side = hanger == Hanger.BallSocket ? 1 : -1; side <= 1; side += 2)
            {
                var offset = new Vector3(0, 0, side * half);
                var anchor = Simulation.Bodies.Add(
                    BodyDescription.CreateKinematic(new RigidPose((pivot + offset) * scale), default, new BodyActivityDescription(-1)));
                var distance = MathF.Sqrt(Length * Length + half * half) * scale;
                if (hanger == Hanger.TwoCenterDistances)
                    Simulation.Solver.Add(anchor, ball, new CenterDistanceConstraint(distance, SpringSettings.Rigid));
                else
                    Simulation.Solver.Add(anchor, ball, new BallSocket { LocalOffsetB = (new Vector3(0, Length, 0) + offset) * scale });
            }
        }

        public float Height(int ball) => Simulation.Bodies[balls[ball]].Pose.Position.Y / scale;

        /// <summary>Energy of all balls above where they hang, J per kg and (m/s)^2, in the units of one that is not scaled.</summary>
        public double Energy()
        {
            double energy = 0;
            foreach (var handle in balls)
            {
                var body = Simulation.Bodies[handle];
                var spin = body.Velocity.Angular.LengthSquared() / body.LocalInertia.InverseInertiaTensor.XX;
                energy += (body.Velocity.Linear.LengthSquared() + spin) / (2 * scale * scale) + Gravity * body.Pose.Position.Y / scale;
            }
            return energy;
        }

        public void Dispose()
        {
            Simulation.Dispose();
            pool.AssertEmpty();
            pool.Clear();
        }
    }

    static double Start(float degrees) => Gravity * Length * (1 - Math.Cos(degrees * Math.PI / 180));

    public static TheoryData<Hanger, int, float> Rows()
    {
        var data = new TheoryData<Hanger, int, float>();
        foreach (var hanger in Enum.GetValues<Hanger>())
            foreach (int count in new[] { 2, 5, 7, 9 })
                foreach (float gap in new[] { 0, .01f, .1f })
                    data.Add(hanger, count, gap);
        return data;
    }

    [Theory, MemberData(nameof(Rows))]
    public void Cradle_gains_nothing(Hanger hanger, int count, float gap)
    {
        double worst = 0;
        foreach (float degrees in new[] { 10, 30, 60, 80 })
        {
            using var cradle = new Cradle(hanger, count, gap, degrees, 1, SolveDescription.Default);
            double greatest = 0;
            for (int i = 0; i < 60 * 20; ++i)
            {
                cradle.Simulation.Timestep(1 / 60f);
                greatest = Math.Max(greatest, cradle.Energy() / Start(degrees));
            }
            worst = Math.Max(worst, greatest);
        }
        output.WriteLine($"{worst:f4} of the energy at most");
        Assert.InRange(worst, .9, 1.01);
    }

    // Two balls of equal mass exchange their speeds, and so on along the row; what is pulled up is the last one. With a smaller coefficient the speed that
    // goes on is (1 + e) / 2 of it at each of the impacts.
    [Theory]
    [InlineData(2, .01f, 30, 1f)]
    [InlineData(3, .1f, 60, 1f)]
    [InlineData(5, .01f, 30, 1f)]
    [InlineData(5, .1f, 60, 1f)]
    [InlineData(7, .03f, 45, 1f)]
    [InlineData(2, .01f, 45, .5f)]
    [InlineData(3, .1f, 60, .9f)]
    public void First_blow_goes_to_the_last_ball(int count, float gap, float degrees, float restitution)
    {
        using var cradle = new Cradle(Hanger.BallSocket, count, gap, degrees, restitution, SolveDescription.Default);
        double highest = 0, passed = Math.Pow((1 + restitution) / 2, 2 * (count - 1));
        for (int i = 0; i < 60 * 6 / 5; ++i)
        {
            cradle.Simulation.Timestep(1 / 60f);
            highest = Math.Max(highest, cradle.Height(count - 1));
        }
        output.WriteLine($"{highest / (1 - Math.Cos(degrees * Math.PI / 180)):f4} of the height, {passed:f4} expected");
        Assert.InRange(highest / (1 - Math.Cos(degrees * Math.PI / 180)) / passed, .97, 1.03);
    }

    [Theory]
    [InlineData(1f, DirectJointsMode.Always, 1, 1 / 60f, 1)]
    [InlineData(1f, DirectJointsMode.WhereNeeded, 4, 1 / 120f, 1)]
    [InlineData(.9f, DirectJointsMode.Off, 8, 1 / 60f, 1)]
    [InlineData(.5f, DirectJointsMode.Off, 16, 1 / 60f, 1)]
    [InlineData(1f, DirectJointsMode.Off, 2, 1 / 120f, .01f)]
    [InlineData(1f, DirectJointsMode.Off, 4, 1 / 60f, 100)]
    public void Any_setting_gains_nothing(float restitution, DirectJointsMode mode, int substeps, float dt, float scale)
    {
        foreach (int count in new[] { 5, 8 })
        {
            using var cradle = new Cradle(
                Hanger.BallSocket, count, .02f, 40, restitution, new SolveDescription(1, substeps) { DirectJoints = mode }, scale);
            for (int i = 0; i < 20 / dt; ++i)
            {
                cradle.Simulation.Timestep(dt);
                Assert.InRange(cradle.Energy() / Start(40), 0, 1.01);
            }
        }
    }
}
