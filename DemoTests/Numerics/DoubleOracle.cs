using System;
using System.Linq;
using System.Numerics;
using MathNet.Numerics.LinearAlgebra;
using Xunit;
using DoubleVector = MathNet.Numerics.LinearAlgebra.Vector<double>;

namespace DemoTests.Numerics;

/// <summary>The operations in double precision, from their definitions and MathNet; nothing here is shared with the library.</summary>
static class DoubleOracle
{
    public static DoubleVector Column(double[] v) => DoubleVector.Build.Dense(v);

    public static Matrix<double> Rows(double[] nine) => Matrix<double>.Build.DenseOfRowMajor(3, 3, nine);

    public static Matrix<double> JacobianRows(double[] six) => Matrix<double>.Build.DenseOfRowMajor(2, 3, six);

    public static Matrix<double> Symmetric3(double[] m) => Rows([m[0], m[1], m[3], m[1], m[2], m[4], m[3], m[4], m[5]]);

    public static Matrix<double> Symmetric2(double[] m) => Matrix<double>.Build.DenseOfRowMajor(2, 2, [m[0], m[1], m[1], m[2]]);

    public static double[] LowerTriangle(Matrix<double> m) =>
        [.. from row in Enumerable.Range(0, m.RowCount) from column in Enumerable.Range(0, row + 1) select m[row, column]];

    public static Matrix<double> Skew(double[] v) => Rows([0, -v[2], v[1], v[2], 0, -v[0], -v[1], v[0], 0]);

    /// <summary>Hamilton product: the rotation by <paramref name="b"/> first, then <paramref name="a"/>. Order x, y, z, w.</summary>
    public static double[] Hamilton(double[] a, double[] b) =>
    [
        a[3] * b[0] + a[0] * b[3] + a[1] * b[2] - a[2] * b[1],
        a[3] * b[1] - a[0] * b[2] + a[1] * b[3] + a[2] * b[0],
        a[3] * b[2] + a[0] * b[1] - a[1] * b[0] + a[2] * b[3],
        a[3] * b[3] - a[0] * b[0] - a[1] * b[1] - a[2] * b[2],
    ];

    /// <summary>q v q* as Hamilton products.</summary>
    public static double[] Rotate(double[] q, double[] v) => Hamilton(Hamilton(q, [v[0], v[1], v[2], 0]), [-q[0], -q[1], -q[2], q[3]])[..3];

    public static double[] Components(Vector3 v) => [v.X, v.Y, v.Z];

    public static double[] Components(Quaternion q) => [q.X, q.Y, q.Z, q.W];

    /// <summary>Every component within a tolerance relative to the largest expected one.</summary>
    public static void AssertClose(double[] expected, double[] actual, double tolerance)
    {
        Assert.Equal(expected.Length, actual.Length);
        var size = Math.Max(expected.Max(Math.Abs), double.Epsilon);
        var error = expected.Zip(actual, (e, a) => double.IsNaN(a) ? double.PositiveInfinity : Math.Abs(e - a)).Max() / size;
        Assert.True(error <= tolerance, $"relative error {error:g3} > {tolerance:g3}: expected {string.Join(" ", expected)}, got {string.Join(" ", actual)}");
    }
}
