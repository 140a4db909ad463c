using System;
using System.Linq;
using System.Numerics;
using BepuPhysics.Constraints;
using BepuUtilities.Memory;
using Xunit;

namespace DemoTests.Constraints;

/// <summary>
/// Rigid joints that would turn a body far by correcting their error are damped: the rule in double precision, from what a joint's rows say.
/// </summary>
public class JointTurnTests
{
    // Radians that the impulse of a joint's points at rest, and its error, would turn a body by in a substep.
    const double Far = 0.03, Near = 0.005;
    const float Dt = 1 / 240f;
    // Rigid joints make an eighth of a period in a substep, those of hubs as well.
    const double FrequencyDt = Math.Tau / 8;
    static readonly Substep substep = new(0, Dt);
    // Those whose error is asked, and not their load.
    static readonly string[] askedByError =
        [nameof(DistanceServo), nameof(DistanceLimit), nameof(Pulley), nameof(PointOnLineServo), nameof(Slider)];
    static readonly Substep relaxation = new(0, Dt, relaxations: 1, isRelaxation: true);

    public static TheoryData<int> Types
    {
        get
        {
            using var pool = new BufferPool();
            var solver = RandomDescriptions.CreateSolver(pool);
            return new(JointTypes.All
                .Where(type => askedByError.Contains(type.Name) || solver.Processor(type.Id).CarriesPointLoad && !type.Name.EndsWith("Motor"))
                .Select(type => type.Id));
        }
    }

    [Theory, MemberData(nameof(Types))]
    public void A_joint_turns_its_bodies_by_a_small_angle_where_its_load_would_turn_them_far(int typeId)
    {
        int damped = 0, near = 0, unasked = 0;
        var byError = IsAskedByError(typeId);
        var samples = new JointSamples(typeId);
        for (int sample = 0; sample < 120; ++sample)
        {
            using var bench = New(typeId, samples, Rigid, sample % Vector<float>.Count);
            var rows = bench.Rows(substep);
            var atPoints = rows.Select((row, i) => bench.Processor.IsLinear(i) ? (double)row.Impulse : 0).ToArray();
            var load = Turn(bench, rows, atPoints) * Dt / (FrequencyDt * (FrequencyDt + 2));
            // A limit corrects only what is beyond it.
            var error = rows.Select(row => (double)row.PositionError).ToArray();
            if (bench.Processor.LimitOf(0) == RowLimit.Positive && error[0] >= 0)
                continue;
            var part = FrequencyDt / (FrequencyDt + 2);
            var angle = Turn(bench, rows, RowTests.SolveDense(RowTests.MassMatrix(bench, rows), error)) * part;
            var asked = byError ? angle : load;
            if (Math.Abs(asked / Far - 1) < 1e-3)
                continue;

            var isDamped = asked > Far && angle > Near;
            if (isDamped)
                part *= Near / angle;
            damped += isDamped ? 1 : 0;
            near += asked > Far && !isDamped ? 1 : 0;
            unasked += asked <= Far && angle > Near ? 1 : 0;
            // A spring k with damping c, implicitly: b = k / (h k + c), softness 1 / (h (h k + c)) per unit effective mass.
            var speedPerError = part / Dt;
            var stiffness = FrequencyDt * FrequencyDt / (Dt * Dt);
            var damping = stiffness / speedPerError - Dt * stiffness;
            var softness = 1 / (Dt * (Dt * stiffness + damping));

            bench.WarmStart(substep);
            rows = bench.Rows(substep);
            foreach (var row in rows)
            {
                AssertClose(1 / (1 + softness), row.MassScale, 1);
                AssertClose(softness / (1 + softness), row.ImpulseScale, 1);
                AssertClose(-speedPerError * row.PositionError, row.TargetVelocity, speedPerError * (Math.Abs(row.PositionError) + 1e-3));
            }
            var (velocities, impulses) = RowTests.Sweep(bench, typeId, substep);
            var relaxed = bench.Rows(relaxation);
            Assert.All(relaxed, row => Assert.True(row.TargetVelocity == 0 && row.ImpulseScale == 0));
            bench.Solve(substep);
            RowTests.AssertClose(velocities, bench.Velocities, "velocity");
            RowTests.AssertClose(impulses, [.. bench.Rows(substep).Select(row => (double)row.Impulse)], "impulse");
        }
        Assert.True(damped > 10 && (byError || near > 2) && unasked > (byError ? 2 : 10),
            $"{damped} damped, {near} with a small error, {unasked} with a small load");
    }

    /// <summary>A frequency or a greatest speed that a game gave is what it gets, whatever turns.</summary>
    [Theory, MemberData(nameof(Types))]
    public void What_a_game_asked_for_is_not_damped(int typeId)
    {
        var samples = new JointSamples(typeId);
        for (int sample = 0; sample < 30; ++sample)
        {
            using var bench = New(typeId, samples, Given);
            var before = bench.Rows(substep);
            bench.WarmStart(substep);
            var after = bench.Rows(substep);
            for (int i = 0; i < before.Length; ++i)
            {
                Assert.Equal(before[i].MassScale, after[i].MassScale);
                Assert.Equal(before[i].TargetVelocity, after[i].TargetVelocity);
            }
        }
    }

    static bool IsAskedByError(int typeId) => askedByError.Contains(RandomDescriptions.NameOf(typeId));

    /// <summary>What a step finds is not remembered: the next one asks anew.</summary>
    [Theory, MemberData(nameof(Types))]
    public void A_joint_whose_load_or_error_is_gone_is_as_stiff_as_before(int typeId)
    {
        var samples = new JointSamples(typeId);
        var marked = 0;
        for (int sample = 0; sample < 60; ++sample)
        {
            using var bench = New(typeId, samples, Rigid);
            var before = bench.Rows(substep);
            bench.WarmStart(substep);
            marked += bench.Rows(substep)[0].MassScale != before[0].MassScale ? 1 : 0;
            bench.WriteImpulses(new float[before.Length]);
            if (IsAskedByError(typeId))
                RowTests.Settle(bench);
            bench.WarmStart(substep);
            Assert.Equal(before.Select(row => row.MassScale), bench.Rows(substep).Select(row => row.MassScale));
        }
        Assert.True(marked > 3);
    }

    static void Rigid(JointType type, float[] column)
    {
        new float[2].CopyTo(column, type.PlaceOf<SpringSettings>());
        if (type.PlaceOf<ServoSettings>() is var servo and >= 0)
            new[] { float.MaxValue, 0, float.MaxValue }.CopyTo(column, servo);
    }

    static void Given(JointType type, float[] column)
    {
        Rigid(type, column);
        if (type.PlaceOf<ServoSettings>() is var servo and >= 0)
            column[servo] = 1000;
        else
            new[] { 300f, 2 }.CopyTo(column, type.PlaceOf<SpringSettings>());
    }

    // Not far from where it belongs, under any load.
    static RowBench New(int typeId, JointSamples samples, Action<JointType, float[]> set, int lane = 0)
    {
        var type = JointTypes.All.Single(type => type.Id == typeId);
        var column = RandomDescriptions.Joint(type.Description, samples);
        set(type, column);
        SampleBody[] bodies = [.. Enumerable.Range(0, Math.Max(2, type.BodyCount)).Select(_ => samples.Body())];
        var bench = new RowBench(typeId, column, bodies, lane, samples.Coin());
        RowTests.Settle(bench);
        var apart = MathF.Exp(samples.Uniform(-7, -1));
        bench.Move([.. Enumerable.Range(0, 6 * bodies.Length).Select(_ => (double)samples.Uniform(-apart, apart))]);
        var load = MathF.Exp(samples.Uniform(-2, 5));
        var least = bench.Processor.LimitOf(0) == RowLimit.Positive ? 0 : -load;
        bench.WriteImpulses([.. Enumerable.Range(0, bench.RowCount).Select(_ => samples.Uniform(least, load))]);
        return bench;
    }

    // The greatest angular velocity that impulses give to a body at rest.
    static double Turn(RowBench bench, ConstraintRow[] rows, double[] impulses)
    {
        var change = bench.Response(RowTests.Sum(bench, rows, impulses));
        return Enumerable.Range(0, bench.BodyCount).Max(body => Length(6 * body + 3));

        double Length(int start) => Math.Sqrt(change.Skip(start).Take(3).Sum(x => x * x));
    }

    static void AssertClose(double expected, double actual, double scale) =>
        Assert.True(Math.Abs(expected - actual) <= 1e-3 * scale, $"{actual} where {expected} was expected");
}
