using System;
using System.Collections.Generic;
using Demos.References;

namespace DemoTests.Support;

/// <summary>
/// What one impact without friction makes of bodies in joints, in double precision: the change of least energy after which all joints hold and the surfaces
/// part at a share of the speed at which they met.
/// </summary>
sealed class JointedImpactOracle
{
    // Pivots that are rounding: rows that say what others have said.
    const double LeastPivot = 1e-9;

    readonly List<double[]> velocities = [];
    readonly List<double[,]> inverseMasses = [];
    readonly List<(int A, int B, double[] OfA, double[] OfB)> rows = [];

    /// <summary>Adds a body: the inverse of its mass, of its moments along its own axes, and these in the world.</summary>
    public int AddBody(double inverseMass, Double3 inverseMoments, Double3[] axes, Double3 linear, Double3 angular)
    {
        var inverse = new double[6, 6];
        double[] moments = [inverseMoments.X, inverseMoments.Y, inverseMoments.Z];
        for (int i = 0; i < 3; ++i)
        {
            inverse[i, i] = inverseMass;
            for (int j = 0; j < 3; ++j)
            {
                for (int axis = 0; axis < 3; ++axis)
                    inverse[3 + i, 3 + j] += moments[axis] * At(axes[axis], i) * At(axes[axis], j);
            }
        }
        inverseMasses.Add(inverse);
        velocities.Add([linear.X, linear.Y, linear.Z, angular.X, angular.Y, angular.Z]);
        return velocities.Count - 1;
    }

    /// <summary>Holds two points together along a direction.</summary>
    public void HoldAlong(int a, int b, Double3 direction, Double3 armA, Double3 armB) => rows.Add((a, b, Row(direction, armA), Row(-direction, armB)));

    /// <summary>Holds two bodies together about an axis.</summary>
    public void HoldAbout(int a, int b, Double3 axis) => rows.Add((a, b, [0, 0, 0, axis.X, axis.Y, axis.Z], [0, 0, 0, -axis.X, -axis.Y, -axis.Z]));

    /// <summary>Velocities of all bodies after A has met B along a normal that shows to A.</summary>
    public IReadOnlyList<double[]> Solve(int a, int b, Double3 normal, Double3 armA, Double3 armB, double restitution)
    {
        HoldAlong(a, b, normal, armA, armB);
        int count = rows.Count;
        var matrix = new double[count, count];
        var right = new double[count];
        for (int i = 0; i < count; ++i)
        {
            right[i] = -Velocity(rows[i]);
            for (int j = 0; j < count; ++j)
                matrix[i, j] = Coupling(rows[i], rows[j]);
        }
        right[count - 1] *= 1 + restitution;
        var impulses = Gauss(matrix, right);
        var result = new List<double[]>();
        foreach (var velocity in velocities)
            result.Add((double[])velocity.Clone());
        for (int i = 0; i < count; ++i)
        {
            Add(result[rows[i].A], inverseMasses[rows[i].A], rows[i].OfA, impulses[i]);
            Add(result[rows[i].B], inverseMasses[rows[i].B], rows[i].OfB, impulses[i]);
        }
        rows.RemoveAt(count - 1);
        return result;
    }

    static double At(Double3 v, int index) => index == 0 ? v.X : index == 1 ? v.Y : v.Z;

    static double[] Row(Double3 direction, Double3 arm)
    {
        var moment = Double3.Cross(arm, direction);
        return [direction.X, direction.Y, direction.Z, moment.X, moment.Y, moment.Z];
    }

    double Velocity((int A, int B, double[] OfA, double[] OfB) row)
    {
        double sum = 0;
        for (int i = 0; i < 6; ++i)
            sum += row.OfA[i] * velocities[row.A][i] + row.OfB[i] * velocities[row.B][i];
        return sum;
    }

    double Coupling((int A, int B, double[] OfA, double[] OfB) x, (int A, int B, double[] OfA, double[] OfB) y)
    {
        double sum = 0;
        foreach (var (body, ofX) in new[] { (x.A, x.OfA), (x.B, x.OfB) })
        {
            foreach (var (other, ofY) in new[] { (y.A, y.OfA), (y.B, y.OfB) })
            {
                if (body != other)
                    continue;
                for (int i = 0; i < 6; ++i)
                {
                    for (int j = 0; j < 6; ++j)
                        sum += ofX[i] * inverseMasses[body][i, j] * ofY[j];
                }
            }
        }
        return sum;
    }

    static void Add(double[] velocity, double[,] inverseMass, double[] row, double impulse)
    {
        for (int i = 0; i < 6; ++i)
        {
            for (int j = 0; j < 6; ++j)
                velocity[i] += inverseMass[i, j] * row[j] * impulse;
        }
    }

    // With the greatest pivot on the diagonal next; rows that are left when none is, say nothing new.
    static double[] Gauss(double[,] matrix, double[] right)
    {
        int count = right.Length;
        var solution = new double[count];
        var order = new List<int>();
        double greatest = 0;
        for (int i = 0; i < count; ++i)
            greatest = Math.Max(greatest, matrix[i, i]);
        while (order.Count < count)
        {
            int pivot = -1;
            for (int i = 0; i < count; ++i)
            {
                if (!order.Contains(i) && (pivot < 0 || matrix[i, i] > matrix[pivot, pivot]))
                    pivot = i;
            }
            if (matrix[pivot, pivot] < LeastPivot * greatest)
                break;
            order.Add(pivot);
            for (int i = 0; i < count; ++i)
            {
                if (order.Contains(i))
                    continue;
                double factor = matrix[i, pivot] / matrix[pivot, pivot];
                for (int j = 0; j < count; ++j)
                    matrix[i, j] -= factor * matrix[pivot, j];
                right[i] -= factor * right[pivot];
            }
        }
        for (int k = order.Count - 1; k >= 0; --k)
        {
            double sum = right[order[k]];
            for (int j = k + 1; j < order.Count; ++j)
                sum -= matrix[order[k], order[j]] * solution[order[j]];
            solution[order[k]] = sum / matrix[order[k], order[k]];
        }
        return solution;
    }
}
