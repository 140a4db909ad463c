using System;
using System.Collections.Generic;
using System.Linq;
using System.Numerics;
using BepuPhysics.Constraints;
using BepuUtilities;
using Xunit;

namespace DemoTests.Constraints;

/// <summary>What holds for every type of joint. A type adds its C in double precision, random descriptions and its degenerate cases.</summary>
public abstract class JointTests<TDescription> where TDescription : unmanaged, IConstraintDescription<TDescription>
{
    const int Samples = 200;
    const double Step = 1e-5;
    static readonly Substep Substep = new(0, 1 / 240f, 1, 1);

    private protected abstract TDescription Describe(JointSamples samples, SpringSettings spring);

    /// <summary>C, from its definition.</summary>
    private protected abstract double[] Error(TDescription description, DoublePose[] poses);

    /// <summary>The same, where it depends on the inertia of the bodies at which point they are held.</summary>
    private protected virtual double[] Error(TDescription description, DoublePose[] poses, SampleBody[] bodies) => Error(description, poses);

    /// <summary>Moves the last body to where the rows that hold something are satisfied.</summary>
    private protected virtual void Settle(TDescription description, SampleBody[] bodies) { }

    /// <summary>Whether C has a derivative around these poses.</summary>
    private protected virtual bool IsSmooth(TDescription description, DoublePose[] poses) => true;

    private protected abstract IEnumerable<(string Name, TDescription Description, SampleBody[] Bodies)> DegenerateCases(JointSamples samples);

    [Fact]
    public void ErrorIsTheDefinition() => ForEachSample(settled: false, (probe, lane, description, bodies, samples) =>
        AssertClose(Error(description, Poses(bodies), bodies), probe.PositionError(lane), 2e-5));

    [Fact]
    public void RelativeVelocityIsTheDerivativeOfTheError() => ForEachSample(settled: true, (probe, lane, description, bodies, samples) =>
        AssertClose(Times(Jacobian(description, bodies), probe.Velocity(lane)), probe.RelativeVelocity(lane), 2e-4));

    /// <summary>Rows that are angles lose the exact derivative away from zero, but not its part along the error.</summary>
    [Fact]
    public void ErrorShrinksAtTheRelativeVelocity() => ForEachSample(settled: false, (probe, lane, description, bodies, samples) =>
    {
        var error = Error(description, Poses(bodies), bodies);
        var change = Times(Jacobian(description, bodies), probe.Velocity(lane));
        var velocity = probe.RelativeVelocity(lane);
        var linear = Math.Min(3, error.Length);
        AssertClose([Dot(error, change, 0, linear)], [Dot(error, velocity, 0, linear)], 5e-4);
        AssertClose([Dot(error, change, linear, error.Length)], [Dot(error, velocity, linear, error.Length)], 5e-4);
    });

    [Fact]
    public void InverseEffectiveMassIsThatOfTheJacobian() => ForEachSample(settled: true, (probe, lane, description, bodies, samples) =>
    {
        var jacobian = Jacobian(description, bodies);
        var actual = probe.InverseEffectiveMass(lane);
        for (int i = 0; i < jacobian.Length; ++i)
        {
            var response = MassTimes(bodies, jacobian[i]);
            for (int j = 0; j < jacobian.Length; ++j)
            {
                var scale = Math.Sqrt(actual[i, i] * actual[j, j]);
                Assert.True(Math.Abs(Dot(jacobian[j], response, 0, response.Length) - actual[i, j]) <= 2e-4 * scale, $"K[{i}, {j}]");
            }
        }
    });

    [Fact]
    public void ImpulsesActThroughTheJacobian() => ForEachSample(settled: true, (probe, lane, description, bodies, samples) =>
    {
        var impulse = RandomImpulse(samples);
        var expected = probe.Velocity(lane);
        var jacobian = Jacobian(description, bodies);
        for (int i = 0; i < impulse.Length; ++i)
        {
            var response = MassTimes(bodies, jacobian[i]);
            for (int j = 0; j < expected.Length; ++j)
                expected[j] += response[j] * impulse[i];
        }
        probe.SetImpulse(lane, impulse);
        probe.ApplyImpulse();
        AssertClose(expected, probe.Velocity(lane), 5e-4);
    });

    /// <summary>Whether what the joint does to its bodies has no torque in sum.</summary>
    private protected virtual bool KeepsAngularMomentum => true;

    /// <summary>How far the last body may be from where the joint holds it, m, for that to be so.</summary>
    private protected virtual float GapThatKeepsMomentum => 0;

    [Fact]
    public void BodiesKeepTheirMomentum() => ForEachSample(settled: true, (probe, lane, description, bodies, samples) =>
    {
        if (bodies.Length == 1)
            return;
        if (GapThatKeepsMomentum > 0)
        {
            bodies[^1].Position += samples.Vector(GapThatKeepsMomentum);
            probe.Set(lane, description, bodies);
        }
        var before = probe.Velocity(lane);
        probe.SetImpulse(lane, RandomImpulse(samples));
        probe.ApplyImpulse();
        var after = probe.Velocity(lane);
        var linear = new DoubleVector();
        var angular = new DoubleVector();
        double size = 0;
        for (int i = 0; i < bodies.Length; ++i)
        {
            DoubleVector Change(int k) => new DoubleVector(after[k], after[k + 1], after[k + 2]) - new DoubleVector(before[k], before[k + 1], before[k + 2]);
            var momentum = Change(i * 6) * (1 / bodies[i].InverseMass);
            linear += momentum;
            angular += DoubleVector.Cross(new DoubleVector(bodies[i].Position) - new DoubleVector(bodies[0].Position), momentum);
            angular += SolveInertia(bodies[i].InverseInertia, Change(i * 6 + 3));
            size += momentum.Length + SolveInertia(bodies[i].InverseInertia, Change(i * 6 + 3)).Length;
        }
        Assert.True(linear.Length <= 1e-5 * (1 + size), $"Linear momentum changed by {linear}.");
        Assert.True(angular.Length <= 1e-4 * (1 + size) || !KeepsAngularMomentum, $"Angular momentum changed by {angular}.");
    });

    [Fact]
    public void SweepsConvergeToTheWantedVelocity() => ForEachSample(settled: false, (probe, lane, description, bodies, samples) =>
    {
        probe.SetImpulse(lane, new double[RowCount]);
        var error = probe.PositionError(lane);
        for (int sweep = 0; sweep < 60; ++sweep)
        {
            probe.WarmStart(Substep);
            probe.Solve(Substep);
        }
        var velocity = probe.RelativeVelocity(lane);
        var scale = 1 + error.Max(Math.Abs) / Substep.Dt;
        var wantedVelocity = Wanted(description, error, Poses(bodies));
        for (int i = 0; i < velocity.Length; ++i)
        {
            var wanted = wantedVelocity[i];
            if (Kind == RowKind.Inequality)
                wanted = Math.Min(wanted, -error[i] / Substep.Dt);
            if (Kind == RowKind.Inequality && velocity[i] > wanted)
                continue;
            Assert.True(Math.Abs(velocity[i] - wanted) <= 1e-3 * scale, $"Row {i}: velocity {velocity[i]}, wanted {wanted}.");
        }
    }, spring: default(SpringSettings));

    [Fact]
    public void InequalitiesOnlyPush()
    {
        if (Kind != RowKind.Inequality)
            return;
        var pushed = 0;
        var rested = 0;
        ForEachSample(settled: false, (probe, lane, description, bodies, samples) =>
        {
            probe.SetImpulse(lane, [samples.Uniform(0, 2)]);
            probe.WarmStart(Substep);
            probe.Solve(Substep);
            Assert.True(probe.Impulse(lane)[0] >= 0);
            if (probe.Impulse(lane)[0] > 0)
                ++pushed;
            else
                ++rested;
        });
        Assert.True(pushed > 10 && rested > 10, $"{pushed} pushed, {rested} did not.");
    }

    /// <summary>What is left of the way is used up by no less than the whole of it in a substep: until then a limit is not there.</summary>
    [Fact]
    public void LimitsDoNothingInside()
    {
        if (Kind != RowKind.Inequality)
            return;
        var inside = 0;
        ForEachSample(settled: false, (probe, lane, description, bodies, samples) =>
        {
            var before = probe.Velocity(lane);
            if (probe.RelativeVelocity(lane)[0] < -probe.PositionError(lane)[0] / Substep.Dt + 1e-3)
                return;
            probe.Solve(Substep);
            Assert.Equal(before, probe.Velocity(lane));
            Assert.Equal(0, probe.Impulse(lane)[0]);
            ++inside;
        });
        Assert.True(inside > 10, $"Only {inside} were inside.");
    }

    [Fact]
    public void LanesDoNotSeeEachOther() => JointProbes.AssertLanesAreAlone<TDescription>(new(7), Substep, Fill);

    [Fact]
    public void DegenerateCasesStayFinite()
    {
        var samples = new JointSamples(11);
        foreach (var (name, description, bodies) in DegenerateCases(samples).Concat(CommonCases(samples)))
        {
            var probe = JointProbes.New<TDescription>();
            for (int lane = 0; lane < Vector<float>.Count; ++lane)
                probe.Set(lane, description, bodies);
            var moves = bodies.Any(b => b.InverseMass > 0);
            var before = probe.Velocity(0);
            for (int i = 0; i < 10; ++i)
            {
                probe.WarmStart(Substep);
                probe.Solve(Substep);
            }
            var all = probe.Velocity(0).Concat(probe.Impulse(0)).Concat(probe.PositionError(0)).Concat(probe.Geometry(0)).ToArray();
            Assert.True(all.All(double.IsFinite), $"{name}: {string.Join(", ", all)}");
            // Nothing degenerate may blow up: velocities stay near what the error and the motion before ask for.
            var bound = 100 * (1 + before.Max(Math.Abs) + probe.PositionError(0).Max(Math.Abs) / Substep.Dt);
            Assert.True(probe.Velocity(0).Max(Math.Abs) < bound, $"{name}: {string.Join(", ", probe.Velocity(0))}");
            if (!moves)
                Assert.Equal(before, probe.Velocity(0));
        }
    }

    IEnumerable<(string, TDescription, SampleBody[])> CommonCases(JointSamples samples)
    {
        SampleBody[] Bodies(Func<SampleBody, int, SampleBody> change) => [.. NewBodies(samples).Select(change)];
        for (int i = 0; i < 5; ++i)
        {
            var description = Describe(samples, default);
            yield return ("Nothing can move", description, Bodies((b, _) => b with { InverseMass = 0, InverseInertia = default }));
            yield return ("Only the first can move", description, Bodies((b, k) => k == 0 ? b : b with { InverseMass = 0, InverseInertia = default }));
            yield return ("Only the last can move", description,
                Bodies((b, k) => k == TDescription.BodyCount - 1 ? b : b with { InverseMass = 0, InverseInertia = default }));
            yield return ("Nothing can turn", description, Bodies((b, _) => b with { InverseInertia = default }));
            yield return ("Turns about one axis only", description,
                Bodies((b, _) => b with { InverseInertia = JointSamples.InWorld(new(0, 3, 0), b.Orientation) }));
            yield return ("Cannot turn about one axis", description,
                Bodies((b, _) => b with { InverseInertia = JointSamples.InWorld(new(2, 0, 3), b.Orientation) }));
            yield return ("Same pose", description, Bodies((b, _) => b with { Position = default, Orientation = Quaternion.Identity }));
            yield return ("Far apart", description, Bodies((b, k) => b with { Position = new(k * 1e5f, 0, 0) }));
            yield return ("Far from the origin", description, Bodies((b, _) => b with { Position = b.Position + new Vector3(1e6f, -1e6f, 1e6f) }));
            yield return ("Masses apart", description, Bodies((b, k) => b with { InverseMass = k == 0 ? 1e-6f : 1e3f }));
        }
    }

    static readonly RowKind Kind = JointProbes.New<TDescription>().Kind;
    private protected static readonly int RowCount = JointProbes.New<TDescription>().RowCount;

    private protected static SampleBody[] NewBodies(JointSamples samples) => [.. Enumerable.Range(0, TDescription.BodyCount).Select(_ => samples.Body())];

    private protected static DoublePose[] Poses(SampleBody[] bodies) => [.. bodies.Select(b => b.Pose)];

    void Fill(JointProbe<TDescription> probe, int lane, JointSamples samples)
    {
        probe.Set(lane, Describe(samples, samples.Spring()), NewBodies(samples));
        probe.SetImpulse(lane, RandomImpulse(samples));
    }

    private protected delegate void Check(JointProbe<TDescription> probe, int lane, TDescription description, SampleBody[] bodies, JointSamples samples);

    private protected void ForEachSample(bool settled, Check check, SpringSettings? spring = null)
    {
        var samples = new JointSamples(3);
        var checkedCount = 0;
        for (int i = 0; i < Samples; ++i)
        {
            var description = Describe(samples, spring ?? samples.Spring());
            TDescription.Validate(description);
            var bodies = NewBodies(samples);
            if (settled)
                Settle(description, bodies);
            if (!IsSmooth(description, Poses(bodies)))
                continue;
            var probe = JointProbes.New<TDescription>();
            probe.Set(i % Vector<float>.Count, description, bodies);
            check(probe, i % Vector<float>.Count, description, bodies, samples);
            ++checkedCount;
        }
        Assert.True(checkedCount > Samples / 4, $"Only {checkedCount} samples had a derivative.");
    }

    static double[] RandomImpulse(JointSamples samples) => [.. Enumerable.Range(0, RowCount).Select(_ => (double)samples.Uniform(0, 2))];

    /// <summary>The velocity that a rigid joint is after: frequency and damping as SpringSettings says, error to velocity w / (w h + 2).</summary>
    private protected virtual double[] Wanted(TDescription description, double[] error, DoublePose[] poses)
    {
        var frequency = 2 * Math.PI * SpringSettings.JointCyclesPerSubstep(1) / Substep.Dt;
        return [.. error.Select(e => -e * frequency / (frequency * Substep.Dt + 2))];
    }

    /// <summary>Row by row, the derivative of C by the coordinates of the bodies.</summary>
    private protected virtual double[][] Jacobian(TDescription description, SampleBody[] bodies)
    {
        var jacobian = Enumerable.Range(0, RowCount).Select(_ => new double[bodies.Length * 6]).ToArray();
        for (int k = 0; k < bodies.Length * 6; ++k)
        {
            double[] At(double step)
            {
                var poses = Poses(bodies);
                poses[k / 6] = poses[k / 6].Moved(k % 6, step);
                return Error(description, poses, bodies);
            }
            var forward = At(Step);
            var back = At(-Step);
            for (int row = 0; row < RowCount; ++row)
                jacobian[row][k] = (forward[row] - back[row]) / (2 * Step);
        }
        return jacobian;
    }

    static double[] Times(double[][] matrix, double[] vector) => [.. matrix.Select(row => Dot(row, vector, 0, row.Length))];

    static double Dot(double[] a, double[] b, int start, int end)
    {
        double sum = 0;
        for (int i = start; i < end; ++i)
            sum += a[i] * b[i];
        return sum;
    }

    static double[] MassTimes(SampleBody[] bodies, double[] row)
    {
        var result = new double[row.Length];
        for (int i = 0; i < bodies.Length; ++i)
        {
            for (int k = 0; k < 3; ++k)
                result[i * 6 + k] = bodies[i].InverseMass * row[i * 6 + k];
            var m = bodies[i].InverseInertia;
            double x = row[i * 6 + 3], y = row[i * 6 + 4], z = row[i * 6 + 5];
            result[i * 6 + 3] = m.XX * x + m.YX * y + m.ZX * z;
            result[i * 6 + 4] = m.YX * x + m.YY * y + m.ZY * z;
            result[i * 6 + 5] = m.ZX * x + m.ZY * y + m.ZZ * z;
        }
        return result;
    }

    // Inertia times a vector, given the inverse inertia: Cramer's rule.
    static DoubleVector SolveInertia(Symmetric3x3 m, DoubleVector v)
    {
        DoubleVector x = new(m.XX, m.YX, m.ZX), y = new(m.YX, m.YY, m.ZY), z = new(m.ZX, m.ZY, m.ZZ);
        var determinant = DoubleVector.Dot(x, DoubleVector.Cross(y, z));
        return new(
            DoubleVector.Dot(v, DoubleVector.Cross(y, z)) / determinant,
            DoubleVector.Dot(x, DoubleVector.Cross(v, z)) / determinant,
            DoubleVector.Dot(x, DoubleVector.Cross(y, v)) / determinant);
    }

    private protected static void AssertClose(double[] expected, double[] actual, double tolerance)
    {
        var scale = 1 + expected.Max(Math.Abs);
        for (int i = 0; i < expected.Length; ++i)
            Assert.True(Math.Abs(expected[i] - actual[i]) <= tolerance * scale, $"[{i}]: expected {expected[i]}, actual {actual[i]}");
    }
}
