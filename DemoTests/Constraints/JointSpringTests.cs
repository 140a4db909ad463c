using System;
using System.Collections.Generic;
using System.Linq;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuPhysics.Constraints;
using Demos.Accuracy;
using DemoTests.Scenes;
using Xunit;

namespace DemoTests.Constraints;

/// <summary>Every joint that has a spring swings as its settings say, whatever its rows are: so many times a second, so much less each time.</summary>
public class JointSpringTests
{
    // Slow, so that what a first-order step adds in damping, half of the angular frequency times its length, is 0.9 % of the ratio with one substep.
    const float Frequency = 0.06f;
    const float DampingRatio = 0.3f;
    // In m or rad, so little that lever arms stay what they are.
    const double Amplitude = 0.01;

    public static TheoryData<int, int> Cases
    {
        get
        {
            var cases = new TheoryData<int, int>();
            foreach (var type in JointTypes.All.Where(HasSpring))
            {
                foreach (var substeps in new[] { 1, 2, 4, 8 })
                    cases.Add(type.Id, substeps);
            }
            return cases;
        }
    }

    static bool HasSpring(JointType type)
    {
        using var bench = RowBench.New(type.Id, new JointSamples(1));
        return type.PlaceOf<SpringSettings>() >= 0 && bench.Processor.LimitOf(0) != RowLimit.Positive;
    }

    [Theory, MemberData(nameof(Cases))]
    public void It_swings_as_its_spring_says(int typeId, int substeps)
    {
        var type = JointTypes.All.Single(type => type.Id == typeId);
        for (int seed = 1; seed <= 2; ++seed)
        {
            var errors = Swing(type, substeps, seed, Frequency, DampingRatio, 1.2);
            // The first extremum, the zero after it, and the next extremum on the other side.
            var sign = Math.Sign(errors[10]);
            var first = errors.Max(e => e * sign);
            var second = errors.Max(e => -e * sign);
            var zero = Enumerable.Range(10, errors.Count - 11).First(i => errors[i] * sign > 0 && errors[i + 1] * sign <= 0);
            var halfPeriod = (zero + errors[zero] / (errors[zero] - errors[zero + 1])) * TestWorld.Dt;
            var decrement = Math.Log(first / second) / Math.PI;
            var ratio = decrement / Math.Sqrt(1 + decrement * decrement);
            var frequency = 0.5 / halfPeriod / Math.Sqrt(1 - ratio * ratio);
            Assert.True(Math.Abs(frequency / Frequency - 1) < 0.02, $"{type.Name}: {frequency} Hz");
            Assert.True(Math.Abs(ratio / DampingRatio - 1) < 0.02, $"{type.Name}: damping ratio {ratio}");
        }
    }

    // A swing that nothing damps, for three periods.
    [Theory, MemberData(nameof(Cases))]
    public void It_goes_on_swinging_where_nothing_damps_it(int typeId, int substeps)
    {
        var type = JointTypes.All.Single(type => type.Id == typeId);
        var errors = Swing(type, substeps, 1, 1, 0, 3.1);
        var crossings = Enumerable.Range(3, errors.Count - 4).Where(i => errors[i] * errors[i + 1] <= 0 && errors[i] != 0)
            .Select(i => i + errors[i] / (errors[i] - errors[i + 1])).ToArray();
        var frequency = (crossings.Length - 1) / (2 * (crossings[^1] - crossings[0]) * TestWorld.Dt);
        Assert.True(Math.Abs(frequency - 1) < 0.02, $"{type.Name}: {frequency} Hz");
        var first = errors.Take(60).Max(Math.Abs);
        var last = errors.Skip(errors.Count - 60).Max(Math.Abs);
        Assert.True(Math.Abs(last / first - 1) < 0.02, $"{type.Name}: {last / first} of the swing after two periods");
    }

    // The position error of one row after each step, from rest in the other rows and from zero in all.
    static List<double> Swing(JointType type, int substeps, int seed, float frequency, float ratio, double periods)
    {
        var samples = new JointSamples(seed * 100 + type.Id);
        var column = RandomDescriptions.Joint(type.Description, samples);
        new[] { frequency * MathF.Tau, ratio * 2 }.CopyTo(column, type.PlaceOf<SpringSettings>());
        if (type.PlaceOf<ServoSettings>() >= 0)
            new[] { float.MaxValue, 0, float.MaxValue }.CopyTo(column, type.PlaceOf<ServoSettings>());
        // Balls, whose inertia is the same in all axes.
        var ball = new Sphere(0.5f);
        var bodies = Enumerable.Range(0, type.BodyCount).Select(i =>
        {
            var body = samples.Body();
            var inertia = ball.ComputeInertia(1 + i);
            return body with { Linear = default, Angular = default, InverseMass = inertia.InverseMass, InverseInertia = inertia.InverseInertiaTensor };
        }).ToArray();
        using var bench = new RowBench(type.Id, column, bodies);
        RowTests.Settle(bench);

        using var world = new TestWorld(new AccuracySettings { Gravity = default, Contacts = ContactScope.None, SubstepCount = substeps });
        var row = samples.Coin() ? 0 : bench.RowCount - 1;
        var substep = new Substep(0, TestWorld.Dt);
        var jacobian = bench.Jacobian(bench.Rows(substep)[row]);
        var response = bench.Response(jacobian);
        var speed = Amplitude * frequency * 2 * Math.PI / jacobian.Zip(response, (a, b) => a * b).Sum();
        var handles = bench.Poses.Select((pose, i) => world.AddDynamic(ball, 1 + i, pose, new BodyVelocity(
            At(response, i * 6) * (float)speed, At(response, i * 6 + 3) * (float)speed))).ToArray();
        type.AddTo(world.Solver, handles, column);
        var errors = new List<double> { 0 };
        for (int i = 0; i < periods / frequency / TestWorld.Dt; ++i)
        {
            world.Step();
            bench.Poses = [.. handles.Select(handle => world.Bodies[handle].Pose)];
            errors.Add(bench.Rows(substep)[row].PositionError);
        }
        return errors;
    }

    static Vector3 At(double[] values, int start) => new((float)values[start], (float)values[start + 1], (float)values[start + 2]);
}
