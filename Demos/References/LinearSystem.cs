using System;

namespace Demos.References;

/// <summary>A few linear equations in double precision.</summary>
public static class LinearSystem
{
    /// <summary>Solves by elimination with the largest pivot of each column; both arguments are used up.</summary>
    /// <exception cref="ArithmeticException">The equations depend on each other.</exception>
    public static double[] Solve(double[,] matrix, double[] right)
    {
        int count = right.Length;
        for (int k = 0; k < count; ++k)
        {
            int pivot = k;
            for (int i = k + 1; i < count; ++i)
                pivot = Math.Abs(matrix[i, k]) > Math.Abs(matrix[pivot, k]) ? i : pivot;
            if (matrix[pivot, k] == 0)
                throw new ArithmeticException($"Row {k} depends on those before it.");
            for (int j = k; j < count; ++j)
                (matrix[k, j], matrix[pivot, j]) = (matrix[pivot, j], matrix[k, j]);
            (right[k], right[pivot]) = (right[pivot], right[k]);
            for (int i = k + 1; i < count; ++i)
            {
                double factor = matrix[i, k] / matrix[k, k];
                for (int j = k; j < count; ++j)
                    matrix[i, j] -= factor * matrix[k, j];
                right[i] -= factor * right[k];
            }
        }
        for (int k = count - 1; k >= 0; --k)
        {
            for (int j = k + 1; j < count; ++j)
                right[k] -= matrix[k, j] * right[j];
            right[k] /= matrix[k, k];
        }
        return right;
    }
}
