using System;
using System.Linq;
using System.Numerics;
using System.Reflection;
using System.Runtime.CompilerServices;
using BepuPhysics.Constraints;
using BepuPhysics.Constraints.Contact;
using Xunit;

namespace DemoTests.Constraints;

/// <summary>The rows that solvers other than the sweeps read, of every registered type, without a fixture per type.</summary>
public class RowTests
{
    const int Samples = 40;
    const double Step = 1e-3;
    // Not the first of its step, so that displacements count.
    static readonly Substep Substep = new(1, 1 / 240f, iterations: 3);
    static readonly Substep Relaxation = new(1, 1 / 240f, relaxations: 1, isRelaxation: true);

    public static TheoryData<int> Types => new(RandomDescriptions.TypeIds);

    public static TheoryData<int> Joints => new(RandomDescriptions.TypeIds.Where(id => !IsContact(id)));

    static bool IsContact(int typeId) => typeId < ConstraintTypeIds.ContactTypeCount;

    /// <summary>
    /// By central differences in the bodies' own floats. Rows that are angles lose the exact derivative away from zero, so what holds is settled first.
    /// </summary>
    [Theory, MemberData(nameof(Types))]
    public void Jacobian_is_the_derivative_of_the_position_error(int typeId)
    {
        var samples = new JointSamples(typeId);
        int compared = 0, skipped = 0;
        var isMotor = RandomDescriptions.NameOf(typeId).EndsWith("Motor", StringComparison.Ordinal);
        for (int i = 0; i < Samples; ++i)
        {
            var seed = samples.Uniform(0, 1e6f);
            using var bench = RowBench.New(typeId, new JointSamples((int)seed));
            if (bench.Processor.LimitOf(0) != RowLimit.Positive)
                Settle(bench);
            var rows = bench.Rows(Substep);
            if (LetsGo(bench, typeId))
                continue;
            for (int row = 0; row < rows.Length; ++row)
            {
                if (bench.Processor.LimitOf(row) is RowLimit.Friction or RowLimit.Twist || isMotor)
                    continue;
                var jacobian = bench.Jacobian(rows[row]);
                for (int k = 0; k < jacobian.Length; ++k)
                {
                    var forward = (ErrorAt(bench, typeId, k, Step)[row] - rows[row].PositionError) / Step;
                    var back = (rows[row].PositionError - ErrorAt(bench, typeId, k, -Step)[row]) / Step;
                    // Where a limit changes sides C has no derivative.
                    if (Math.Abs(forward - back) > 0.1 * (1 + Math.Abs(jacobian[k])))
                    {
                        ++skipped;
                        continue;
                    }
                    ++compared;
                    Assert.True(Math.Abs((forward + back) / 2 - jacobian[k]) <= 5e-3 * (1 + Math.Abs(jacobian[k])),
                        $"sample {i}, row {row}, coordinate {k}: {jacobian[k]}, by differences {(forward + back) / 2}");
                }
            }
        }
        Assert.True(compared > 0 != isMotor && skipped * 10 <= compared, $"{skipped} had no derivative, {compared} had.");
    }

    // Gears and racks let go of a twist whose axes are within half a radian of pointing against each other.
    static bool LetsGo(RowBench bench, int typeId)
    {
        (string OfBody, string OfHousing, int Body)[] twists = RandomDescriptions.NameOf(typeId) switch
        {
            nameof(Gear) =>
            [
                (nameof(Gear.LocalBasisA), nameof(Gear.LocalHousingBasisA), 0), (nameof(Gear.LocalBasisB), nameof(Gear.LocalHousingBasisB), 1),
            ],
            nameof(Rack) => [(nameof(Rack.LocalBasisA), nameof(Rack.LocalHousingBasis), 0)],
            _ => [],
        };
        // The square of the cosine of half the angle between them: 1/16, and what differences reach.
        return twists.Any(twist => (1 + Vector3.Dot(Axis(twist.OfBody, twist.Body), Axis(twist.OfHousing, 2))) / 2 < 0.064f);

        Vector3 Axis(string basis, int body)
        {
            var place = JointTypes.All.Single(type => type.Id == typeId).PlaceOf(basis, out _);
            var local = new Quaternion(bench.Prestep(place), bench.Prestep(place + 1), bench.Prestep(place + 2), bench.Prestep(place + 3));
            return Vector3.Transform(Vector3.UnitZ, Quaternion.Concatenate(local, bench.Poses[body].Orientation));
        }
    }

    /// <summary>J M^-1 J^T is K, and an impulse of one acts as M^-1 J^T.</summary>
    [Theory, MemberData(nameof(Joints))]
    public void Rows_and_parts_of_a_joint_agree(int typeId) =>
        typeof(RowTests).GetMethod(nameof(CompareWithParts), BindingFlags.NonPublic | BindingFlags.Static)!
            .MakeGenericMethod(RandomDescriptions.Descriptions[typeId]).Invoke(null, BindingFlags.DoNotWrapExceptions, null, [typeId], null);

    static void CompareWithParts<T>(int typeId) where T : unmanaged, IConstraintDescription<T>
    {
        var samples = new JointSamples(typeId);
        for (int i = 0; i < Samples; ++i)
        {
            SampleBody[] bodies = [samples.Body(), samples.Body(), samples.Body(), samples.Body()];
            var column = RandomDescriptions.Column(typeId, samples);
            var lane = i % Vector<float>.Count;
            using var bench = new RowBench(typeId, column, bodies, lane);
            var probe = JointProbes.New<T>();
            probe.Set(lane, Unsafe.ReadUnaligned<T>(ref Unsafe.As<float, byte>(ref column[0])), bodies);
            var rows = bench.Rows(Substep);
            Assert.Equal(probe.RowCount, rows.Length);
            var inverseMass = probe.InverseEffectiveMass(lane);
            for (int a = 0; a < rows.Length; ++a)
            {
                var response = bench.Response(bench.Jacobian(rows[a]));
                for (int b = 0; b < rows.Length; ++b)
                {
                    var k = Dot(bench.Jacobian(rows[b]), response);
                    Assert.True(Math.Abs(k - inverseMass[a, b]) <= 1e-4 * Math.Sqrt(inverseMass[a, a] * inverseMass[b, b]) + 1e-9, $"K[{a}, {b}]: {k}");
                }
                var before = probe.Velocity(lane);
                probe.SetImpulse(lane, [.. rows.Select((_, row) => row == a ? 1.0 : 0)]);
                probe.ApplyImpulse();
                var after = probe.Velocity(lane);
                for (int j = 0; j < before.Length; ++j)
                    Assert.True(Math.Abs(after[j] - before[j] - response[j]) <= 1e-4 * (1 + Math.Abs(response[j])), $"impulse {a}, coordinate {j}");
            }
        }
    }

    /// <summary>Target, softness, limits and friction, all at once: one step by the rows, in doubles, is one of the kernel.</summary>
    [Theory, MemberData(nameof(Types))]
    public void A_step_by_the_rows_is_the_sweep(int typeId)
    {
        var samples = new JointSamples(100 + typeId);
        for (int i = 0; i < Samples * 3; ++i)
        {
            var substep = i % 3 == 2 ? Relaxation : Substep;
            using var bench = RowBench.New(typeId, samples, i % Vector<float>.Count);
            for (int body = 0; body < bench.BodyCount; ++body)
                bench.Displacement(body) = new(samples.Vector(0.01f), samples.Vector(0.01f));
            // As the load path does; some contacts are within the band then, and some are not.
            if (IsContact(typeId) && i % 4 == 0)
                bench.Prestep(ContactPrestepLayout.Spring(ConstraintTypeIds.ContactCount(typeId))) = -samples.Uniform(1e-3f, 0.05f);
            bench.WriteImpulses([.. Enumerable.Range(0, bench.RowCount).Select(row => Start(bench.Processor.LimitOf(row), samples))]);
            var (velocities, impulses) = Sweep(bench, typeId, substep);
            bench.Solve(substep);
            AssertClose(velocities, bench.Velocities, $"sample {i}: velocities");
            AssertClose(impulses, [.. bench.Rows(substep).Select(row => (double)row.Impulse)], $"sample {i}: impulses");
        }

        static float Start(RowLimit limit, JointSamples samples) =>
            limit == RowLimit.Positive ? samples.Coin() ? 0 : samples.Uniform(0, 1) : samples.Uniform(-0.05f, 0.05f);
    }

    /// <summary>On one of several kinematic bodies that bear a patch: its friction acts in the middle of all, and what is alone there has a twist.</summary>
    [Theory, InlineData(4), InlineData(5), InlineData(6), InlineData(7)]
    public void A_step_by_the_rows_is_the_sweep_where_friction_is_shared(int typeId)
    {
        var samples = new JointSamples(400 + typeId);
        for (int i = 0; i < Samples; ++i)
        {
            var column = RandomDescriptions.Column(typeId, samples);
            column[ContactPrestepLayout.Friction(ConstraintTypeIds.ContactCount(typeId))] *= -1;
            using var bench = new RowBench(typeId, column, [samples.Body(), Kinematic(samples)], i % Vector<float>.Count);
            bench.WriteImpulses([.. Enumerable.Range(0, bench.RowCount).Select(_ => samples.Uniform(0, .05f))]);
            var place = ContactPrestepLayout.OffsetB(ConstraintTypeIds.ContactCount(typeId));
            var friction = bench.Rows(Substep)[^2].A;
            Assert.Equal(Vector3.Cross(new(column[place], column[place + 1], column[place + 2]), friction.Linear), friction.Angular);
            var (velocities, impulses) = Sweep(bench, typeId, Substep);
            bench.Solve(Substep);
            AssertClose(velocities, bench.Velocities, $"sample {i}: velocities");
            AssertClose(impulses, [.. bench.Rows(Substep).Select(row => (double)row.Impulse)], $"sample {i}: impulses");
        }
    }

    [Theory, MemberData(nameof(Types))]
    public void Impulses_are_read_as_they_were_written(int typeId)
    {
        var samples = new JointSamples(200 + typeId);
        for (int i = 0; i < Samples; ++i)
        {
            using var bench = RowBench.New(typeId, samples, i % Vector<float>.Count);
            float[] impulses = [.. Enumerable.Range(0, bench.RowCount).Select(_ => samples.Uniform(0, 2))];
            bench.WriteImpulses(impulses);
            var rows = bench.Rows(Substep);
            for (int row = 0; row < rows.Length; ++row)
                Assert.Equal(impulses[row], rows[row].Impulse, 1e-5f);
            // Other lanes have kept their zeros.
            Assert.Equal(bench.OwnImpulses.Count(value => value != 0), bench.StoredImpulses.Count(value => value != 0));
        }
    }

    [Theory, MemberData(nameof(Types))]
    public void Limits_say_what_a_row_may_do(int typeId)
    {
        var samples = new JointSamples(300 + typeId);
        int hard = 0, soft = 0;
        for (int i = 0; i < Samples; ++i)
        {
            using var bench = RowBench.New(typeId, samples);
            foreach (var (row, index) in bench.Rows(Substep).Select((row, index) => (row, index)))
            {
                hard += row.IsHard ? 1 : 0;
                soft += row.IsHard ? 0 : 1;
                Assert.True(row.MinimumImpulse <= 0 && row.MaximumImpulse >= 0);
                var limit = bench.Processor.LimitOf(index);
                Assert.Equal(limit == RowLimit.Positive, row.MinimumImpulse == 0 && row.MaximumImpulse > 0);
                Assert.Equal(limit is RowLimit.None or RowLimit.Positive, float.IsPositiveInfinity(row.MaximumImpulse));
                Assert.Equal(limit is RowLimit.Friction or RowLimit.Twist, row.FrictionCoefficient > 0);
            }
        }
        Assert.True(hard > 0 && soft > 0, $"{hard} rows were hard, {soft} soft.");
    }

    static SampleBody Kinematic(JointSamples samples) => new() { Position = samples.Vector(1), Orientation = samples.Rotation(), Linear = samples.Vector(1) };

    // Of joints by moving bodies; of contacts, whose geometry is that of collision detection, by what was travelled since.
    static double[] ErrorAt(RowBench bench, int typeId, int coordinate, double by)
    {
        var motion = new double[bench.BodyCount * 6];
        motion[coordinate] = by;
        if (IsContact(typeId))
            return Read(() => bench.Displace(motion), () => bench.Displace([.. motion.Select(x => -x)]));
        var poses = bench.Poses;
        return Read(() => bench.Move(motion), () => bench.Poses = poses);

        double[] Read(Action move, Action back)
        {
            move();
            double[] error = [.. bench.Rows(Substep).Select(row => (double)row.PositionError)];
            back();
            return error;
        }
    }

    // Newton's method, with the step that moves mass the least.
    internal static void Settle(RowBench bench)
    {
        for (int i = 0; i < 30; ++i)
        {
            var rows = bench.Rows(Substep);
            var change = SolveDense(MassMatrix(bench, rows), [.. rows.Select(row => -(double)row.PositionError)]);
            bench.Move(bench.Response(Sum(bench, rows, change)));
        }
    }

    /// <summary>A sweep in double precision, by the rows.</summary>
    internal static (double[] Velocities, double[] Impulses) Sweep(RowBench bench, int typeId, in Substep substep)
    {
        var rows = bench.Rows(substep);
        var velocities = bench.Velocities;
        double[] impulses = [.. rows.Select(row => (double)row.Impulse)];
        double[] pressedVelocities = [], pressedImpulses = [];
        for (int start = 0; start < rows.Length;)
        {
            var limit = bench.Processor.LimitOf(start);
            if (limit == RowLimit.Friction)
                (pressedVelocities, pressedImpulses) = ([.. velocities], [.. impulses]);
            if (IsContact(typeId) && limit == RowLimit.Positive)
                rows[start] = RowAt(bench, substep, start, velocities);
            var count = limit == RowLimit.Friction ? 2 : IsContact(typeId) ? 1 : rows.Length;
            var block = rows[start..(start + count)];
            var first = start;
            start += count;
            // What does nothing in this sweep is not brought to its limits either.
            if (block.All(row => row.MassScale == 0 && row.ImpulseScale == 0))
                continue;
            var missing = block.Select(row => (row.TargetVelocity - Dot(bench.Jacobian(row), velocities)) * row.MassScale).ToArray();
            var change = SolveDense(MassMatrix(bench, block), missing);
            double[] old = impulses[first..start];
            double[] wanted = [.. old.Select((impulse, i) => impulse + change[i] - block[i].ImpulseScale * impulse)];
            // The load is that of this very sweep: normal rows come first.
            var load = Enumerable.Range(0, first).Where(i => bench.Processor.LimitOf(i) == RowLimit.Positive)
                .Sum(i => impulses[i] * (limit == RowLimit.Twist ? rows[i].Lever : 1));
            var greatest = limit is RowLimit.Friction or RowLimit.Twist ? block[0].FrictionCoefficient * load : block[0].MaximumImpulse;
            var length = Math.Sqrt(wanted.Sum(x => x * x));
            for (int i = 0; i < count; ++i)
            {
                impulses[first + i] = limit == RowLimit.Positive ? Math.Max(wanted[i], 0) : length > greatest ? wanted[i] * greatest / length : wanted[i];
                change[i] = impulses[first + i] - old[i];
            }
            var response = bench.Response(Sum(bench, block, change));
            for (int i = 0; i < velocities.Length; ++i)
                velocities[i] += response[i];
        }
        if (IsContact(typeId))
            SlidingReference.Slide(bench, typeId, rows, pressedVelocities, pressedImpulses, velocities, impulses);
        return (velocities, impulses);
    }

    // How soft a contact is whose recovery is limited depends on the velocity that the rows before it have left.
    static ConstraintRow RowAt(RowBench bench, in Substep substep, int row, double[] velocities)
    {
        var before = bench.Velocities;
        bench.Velocities = velocities;
        var read = bench.Rows(substep)[row];
        bench.Velocities = before;
        return read;
    }

    internal static double[,] MassMatrix(RowBench bench, ConstraintRow[] rows)
    {
        var matrix = new double[rows.Length, rows.Length];
        for (int i = 0; i < rows.Length; ++i)
        {
            var response = bench.Response(bench.Jacobian(rows[i]));
            for (int j = 0; j < rows.Length; ++j)
                matrix[i, j] = Dot(bench.Jacobian(rows[j]), response);
        }
        return matrix;
    }

    internal static double[] Sum(RowBench bench, ConstraintRow[] rows, double[] factors)
    {
        var sum = new double[bench.BodyCount * 6];
        for (int i = 0; i < rows.Length; ++i)
        {
            var jacobian = bench.Jacobian(rows[i]);
            for (int k = 0; k < sum.Length; ++k)
                sum[k] += jacobian[k] * factors[i];
        }
        return sum;
    }

    // Gauss and Jordan; the matrices are positive definite, or zero where a limit has let go.
    internal static double[] SolveDense(double[,] matrix, double[] right)
    {
        var n = right.Length;
        var m = (double[,])matrix.Clone();
        var x = (double[])right.Clone();
        for (int i = 0; i < n; ++i)
        {
            if (m[i, i] <= 0)
            {
                x[i] = 0;
                continue;
            }
            for (int j = 0; j < n; ++j)
            {
                if (j == i)
                    continue;
                var factor = m[j, i] / m[i, i];
                for (int k = 0; k < n; ++k)
                    m[j, k] -= factor * m[i, k];
                x[j] -= factor * x[i];
            }
        }
        for (int i = 0; i < n; ++i)
            x[i] = m[i, i] > 0 ? x[i] / m[i, i] : 0;
        return x;
    }

    internal static double Dot(double[] a, double[] b) => a.Zip(b, (x, y) => x * y).Sum();

    internal static void AssertClose(double[] expected, double[] actual, string what)
    {
        var scale = 1 + expected.Max(Math.Abs);
        for (int i = 0; i < expected.Length; ++i)
            Assert.True(Math.Abs(expected[i] - actual[i]) <= 1e-3 * scale, $"{what} [{i}]: by the rows {expected[i]}, by the kernel {actual[i]}");
    }
}
