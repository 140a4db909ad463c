using System;
using System.Collections.Generic;
using System.Linq;

namespace DemoTests.DirectJoints;

/// <summary>
/// Rows between bodies, some with bounds, in double precision. Which of these are at a bound is found by trying all there are: so it is a reference for any
/// way to guess it.
/// </summary>
sealed class BoundedRows
{
    const double Slack = 1e-9;

    readonly List<double[]> inverseMasses = [];
    readonly List<double[]> velocities = [];
    readonly List<Row> rows = [];

    sealed record Row(double[] Jacobian, double Target, double Softness, double Least, double Most)
    {
        public bool HasBounds => double.IsFinite(Least) || double.IsFinite(Most);
    }

    /// <summary>Adds a body whose moments about all axes are the same.</summary>
    public int AddBody(double inverseMass, double inverseMoment, double[] velocity)
    {
        inverseMasses.Add([inverseMass, inverseMass, inverseMass, inverseMoment, inverseMoment, inverseMoment]);
        velocities.Add(velocity);
        return velocities.Count - 1;
    }

    /// <summary>Adds J v + softness K x = target, with an impulse x between bounds.</summary>
    /// <param name="parts">Bodies, each with the six numbers of J.</param>
    /// <param name="target">What J v is to be.</param>
    /// <param name="softness">What the row gives, as a part of its own K.</param>
    /// <param name="least">Least impulse.</param>
    /// <param name="most">Greatest impulse.</param>
    public void Add(
        (int Body, double[] Jacobian)[] parts, double target, double softness = 0, double least = double.NegativeInfinity,
        double most = double.PositiveInfinity)
    {
        var jacobian = new double[6 * velocities.Count];
        foreach (var (body, numbers) in parts)
            numbers.CopyTo(jacobian, 6 * body);
        rows.Add(new(jacobian, target, softness, least, most));
    }

    /// <summary>How many rows have an impulse at a bound, once they are solved.</summary>
    public int CountAtBound { get; private set; }

    /// <summary>Velocities with the impulses that obey all rows.</summary>
    public IReadOnlyList<double[]> Solve()
    {
        var count = rows.Count;
        var inverse = inverseMasses.SelectMany(numbers => numbers).ToArray();
        var start = velocities.SelectMany(numbers => numbers).ToArray();
        var matrix = new double[count, count];
        var right = new double[count];
        for (int i = 0; i < count; ++i)
        {
            right[i] = rows[i].Target - Sum(k => rows[i].Jacobian[k] * start[k], start.Length);
            for (int j = 0; j < count; ++j)
                matrix[i, j] = Sum(k => rows[i].Jacobian[k] * inverse[k] * rows[j].Jacobian[k], start.Length);
            matrix[i, i] *= 1 + rows[i].Softness;
        }
        var bounded = Enumerable.Range(0, count).Where(i => rows[i].HasBounds).ToArray();
        // Of each: 0 between its bounds, 1 at the least, 2 at the greatest.
        var states = new int[bounded.Length];
        do
        {
            var fixedAt = new double?[count];
            for (int k = 0; k < bounded.Length; ++k)
                fixedAt[bounded[k]] = states[k] == 0 ? null : states[k] == 1 ? rows[bounded[k]].Least : rows[bounded[k]].Most;
            if (fixedAt.Any(value => value is { } known && !double.IsFinite(known)))
                continue;
            var impulses = With(matrix, right, fixedAt);
            if (!Obeys(matrix, right, impulses, fixedAt))
                continue;
            CountAtBound = states.Count(state => state > 0);
            var result = new List<double[]>();
            for (int body = 0; body < velocities.Count; ++body)
            {
                result.Add([.. Enumerable.Range(6 * body, 6).Select(
                    k => start[k] + inverse[k] * Sum(i => rows[i].Jacobian[k] * impulses[i], count))]);
            }
            return result;
        }
        while (Next(states));
        throw new InvalidOperationException("No impulses obey all bounds.");
    }

    static bool Next(int[] states)
    {
        for (int k = 0; k < states.Length; ++k)
        {
            states[k] = (states[k] + 1) % 3;
            if (states[k] > 0)
                return true;
        }
        return false;
    }

    bool Obeys(double[,] matrix, double[] right, double[] impulses, double?[] fixedAt)
    {
        for (int i = 0; i < rows.Count; ++i)
        {
            var scale = 1 + Math.Abs(impulses[i]);
            if (impulses[i] < rows[i].Least - Slack * scale || impulses[i] > rows[i].Most + Slack * scale)
                return false;
            if (fixedAt[i] is null)
                continue;
            // At its least impulse a row would take less, at its greatest more.
            var missing = right[i] - Sum(j => matrix[i, j] * impulses[j], rows.Count);
            if (fixedAt[i] == rows[i].Least ? missing > Slack : missing < -Slack)
                return false;
        }
        return true;
    }

    static double[] With(double[,] matrix, double[] right, double?[] fixedAt)
    {
        var count = right.Length;
        var a = (double[,])matrix.Clone();
        var b = (double[])right.Clone();
        for (int i = 0; i < count; ++i)
        {
            if (fixedAt[i] is not { } value)
                continue;
            for (int j = 0; j < count; ++j)
                a[i, j] = i == j ? 1 : 0;
            b[i] = value;
        }
        return DenseJoints.Gauss(a, b);
    }

    static double Sum(Func<int, double> term, int count)
    {
        double sum = 0;
        for (int i = 0; i < count; ++i)
            sum += term(i);
        return sum;
    }
}
