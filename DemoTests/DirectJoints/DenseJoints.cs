using System;
using System.Collections.Generic;

namespace DemoTests.DirectJoints;

/// <summary>Spheres in ball sockets, solved as one dense system of equations in double precision: what the velocities have to be.</summary>
sealed class DenseJoints
{
    readonly List<double[]> velocities = [];
    readonly List<(double InverseMass, double InverseMoment)> masses = [];
    readonly List<(int A, int B, double[] ArmA, double[] ArmB, double[] Gap)> sockets = [];

    /// <summary>Adds a sphere with its linear and angular velocity; inverse mass and moment are zero for what nothing moves.</summary>
    public int AddBody(double inverseMass, double inverseMoment, double[] velocity)
    {
        masses.Add((inverseMass, inverseMoment));
        velocities.Add(velocity);
        return masses.Count - 1;
    }

    /// <summary>Adds a socket by its arms in world axes, and how far its point on B is from that on A.</summary>
    public void AddSocket(int a, int b, double[] armA, double[] armB, double[] gap) => sockets.Add((a, b, armA, armB, gap));

    /// <summary>Velocities after all sockets have brought their points together at a rate.</summary>
    /// <param name="rate">Part of a gap that is to be closed in a second.</param>
    /// <param name="softness">What a socket gives, as a part of its own K.</param>
    public IReadOnlyList<double[]> Solve(double rate, double softness)
    {
        var count = 3 * sockets.Count;
        // Of each row: six numbers for each body.
        var j = new double[count, 6 * masses.Count];
        var right = new double[count];
        for (int i = 0; i < sockets.Count; ++i)
        {
            var (a, b, armA, armB, gap) = sockets[i];
            for (int axis = 0; axis < 3; ++axis)
            {
                var row = 3 * i + axis;
                Write(j, row, 6 * a, axis, armA, -1);
                Write(j, row, 6 * b, axis, armB, 1);
                right[row] = -rate * gap[axis];
                for (int k = 0; k < 6 * masses.Count; ++k)
                    right[row] -= j[row, k] * velocities[k / 6][k % 6];
            }
        }
        var matrix = new double[count, count];
        for (int row = 0; row < count; ++row)
        {
            for (int column = 0; column < count; ++column)
            {
                for (int k = 0; k < 6 * masses.Count; ++k)
                    matrix[row, column] += j[row, k] * Inverse(k) * j[column, k];
                if (row / 3 == column / 3)
                    matrix[row, column] *= 1 + softness;
            }
        }
        var impulses = Gauss(matrix, right);
        var result = new List<double[]>();
        for (int body = 0; body < masses.Count; ++body)
        {
            var velocity = (double[])velocities[body].Clone();
            for (int k = 0; k < 6; ++k)
            {
                for (int row = 0; row < count; ++row)
                    velocity[k] += Inverse(6 * body + k) * j[row, 6 * body + k] * impulses[row];
            }
            result.Add(velocity);
        }
        return result;
    }

    double Inverse(int coordinate) => coordinate % 6 < 3 ? masses[coordinate / 6].InverseMass : masses[coordinate / 6].InverseMoment;

    // The velocity of a point along an axis is v + w x r, and so the derivative by w along it is r x axis.
    static void Write(double[,] j, int row, int first, int axis, double[] arm, double sign)
    {
        j[row, first + axis] = sign;
        var (next, last) = ((axis + 1) % 3, (axis + 2) % 3);
        j[row, first + 3 + next] = sign * arm[last];
        j[row, first + 3 + last] = -sign * arm[next];
    }

    /// <summary>Solves a system of equations, which are used up, with pivots.</summary>
    internal static double[] Gauss(double[,] matrix, double[] right)
    {
        var count = right.Length;
        for (int pivot = 0; pivot < count; ++pivot)
        {
            var best = pivot;
            for (int row = pivot + 1; row < count; ++row)
                best = Math.Abs(matrix[row, pivot]) > Math.Abs(matrix[best, pivot]) ? row : best;
            for (int column = 0; column < count; ++column)
                (matrix[pivot, column], matrix[best, column]) = (matrix[best, column], matrix[pivot, column]);
            (right[pivot], right[best]) = (right[best], right[pivot]);
            for (int row = 0; row < count; ++row)
            {
                if (row == pivot)
                    continue;
                var factor = matrix[row, pivot] / matrix[pivot, pivot];
                for (int column = pivot; column < count; ++column)
                    matrix[row, column] -= factor * matrix[pivot, column];
                right[row] -= factor * right[pivot];
            }
        }
        for (int row = 0; row < count; ++row)
            right[row] /= matrix[row, row];
        return right;
    }
}
