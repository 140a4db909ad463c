using System;
using System.Numerics;
using BepuUtilities;
using Xunit;
using static DemoTests.Numerics.DoubleOracle;
using static DemoTests.Numerics.WideSamples;

namespace DemoTests.Numerics;

/// <summary>Every wide operation, lane by lane, against double precision.</summary>
public class AlgebraTests
{
    const int Count = 200;
    readonly WideSamples samples = new(11);

    delegate double[] Truth(int lane);

    /// <summary>Compares each lane of a wide result with its true value.</summary>
    static void Verify<T>(T actual, Truth truth, double tolerance = 1e-6) where T : unmanaged
    {
        for (int lane = 0; lane < Vector<float>.Count; ++lane)
            AssertClose(truth(lane), Lane(actual, lane), tolerance);
    }

    [Fact]
    public void Vectors()
    {
        for (int i = 0; i < Count; ++i)
        {
            var (a, b, s) = (samples.Vectors(), samples.Vectors(), samples.Numbers());
            Verify(a + b, l => (Column(Lane(a, l)) + Column(Lane(b, l))).ToArray());
            Verify(a - b, l => (Column(Lane(a, l)) - Column(Lane(b, l))).ToArray());
            Verify(-a, l => (-Column(Lane(a, l))).ToArray());
            Verify(a * s, l => (Column(Lane(a, l)) * s[l]).ToArray());
            Verify(a / s, l => (Column(Lane(a, l)) / s[l]).ToArray());
            Verify(a.Length(), l => [Column(Lane(a, l)).L2Norm()]);
            Verify(Vector3Wide.Normalize(a), l => Column(Lane(a, l)).Normalize(2).ToArray());

            // Cancellation: absolute errors, in units of the operands.
            Verify(Vector3Wide.Dot(a, b) + new Vector<float>(4), l => [Column(Lane(a, l)) * Column(Lane(b, l)) + 4]);
            Verify(Vector3Wide.Cross(a, b) + new Vector<float>(4), l => (Skew(Lane(a, l)) * Column(Lane(b, l)) + 4).ToArray());
        }
    }

    [Fact]
    public void OrthonormalBasis()
    {
        for (int i = 0; i < Count; ++i)
        {
            var n = i == 0 ? new Vector3Wide(Vector<float>.Zero, Vector<float>.Zero, -Vector<float>.One) : Vector3Wide.Normalize(samples.Vectors());
            Vector3Wide.BuildOrthonormalBasis(n, out var t1, out var t2);
            var frame = new Matrix3x3Wide(n, t1, t2);
            Verify(frame, l => (Rows(Lane(frame, l)).Inverse().Transpose() * Math.Sign(Rows(Lane(frame, l)).Determinant())).ToRowMajorArray(), 2e-6);
        }
    }

    [Fact]
    public void Rotations()
    {
        for (int i = 0; i < Count; ++i)
        {
            var (q, p, v) = (samples.Rotations(), samples.Rotations(), samples.Vectors());
            Verify(q * v, l => Rotate(Lane(q, l), Lane(v, l)));
            Verify(QuaternionWide.TransformUnitX(q), l => Rotate(Lane(q, l), [1, 0, 0]));
            Verify(QuaternionWide.TransformUnitY(q), l => Rotate(Lane(q, l), [0, 1, 0]));
            Verify(QuaternionWide.TransformUnitZ(q), l => Rotate(Lane(q, l), [0, 0, 1]));
            Verify(QuaternionWide.Concatenate(q, p), l => Hamilton(Lane(p, l), Lane(q, l)));
            Verify(QuaternionWide.Concatenate(q, p) * v, l => Rotate(Lane(p, l), Rotate(Lane(q, l), Lane(v, l))));
            Verify(QuaternionWide.Normalize(q * new Vector<float>(7)), l => Lane(q, l));
            var m = Matrix3x3Wide.FromQuaternion(q);
            Verify(m, l => [.. Rotate(Lane(q, l), [1, 0, 0]), .. Rotate(Lane(q, l), [0, 1, 0]), .. Rotate(Lane(q, l), [0, 0, 1])]);
            Verify(Matrix3x3Wide.TransposeTimes(m, v), l => Rotate(Lane(q, l), Lane(v, l)));
            Verify(m * v, l => Rotate(Lane(QuaternionWide.Conjugate(q), l), Lane(v, l)));
        }
    }

    [Fact]
    public void AxesAndAngles()
    {
        for (int i = 0; i < Count; ++i)
        {
            var (axis, angle) = (Vector3Wide.Normalize(samples.Vectors()), samples.Numbers(3.14f));
            var q = QuaternionWide.CreateFromAxisAngle(axis, angle);
            Verify(q, l => [.. (Column(Lane(axis, l)) * Math.Sin(angle[l] * 0.5)).ToArray(), Math.Cos(angle[l] * 0.5)]);
            QuaternionWide.GetAxisAngleFromQuaternion(q, out var axisBack, out var angleBack);
            Verify(axisBack * angleBack, l => (Column(Lane(axis, l)) * angle[l]).ToArray(), 3e-6);

            var (from, to) = (Vector3Wide.Normalize(samples.Vectors()), Vector3Wide.Normalize(samples.Vectors()));
            Verify(QuaternionWide.GetQuaternionBetweenNormalizedVectors(from, to) * from, l => Lane(to, l), 1e-4);
            Verify(QuaternionWide.GetQuaternionBetweenNormalizedVectors(from, -from) * from, l => Lane(-from, l), 3e-6);
        }
    }

    [Fact]
    public void Matrices()
    {
        for (int i = 0; i < Count; ++i)
        {
            var (a, b, v, m) = (samples.Matrices(), samples.Matrices(), samples.Vectors(), samples.Definites());
            Verify(a * v, l => (Rows(Lane(a, l)) * Column(Lane(v, l))).ToArray(), 1e-5);
            Verify(Matrix3x3Wide.TransposeTimes(a, v), l => (Rows(Lane(a, l)).Transpose() * Column(Lane(v, l))).ToArray(), 1e-5);
            Verify(a * b, l => (Rows(Lane(a, l)) * Rows(Lane(b, l))).ToRowMajorArray(), 2e-6);
            Verify(Matrix3x3Wide.MultiplyByTranspose(a, b), l => (Rows(Lane(a, l)) * Rows(Lane(b, l)).Transpose()).ToRowMajorArray(), 2e-6);
            Verify(Matrix3x3Wide.TimesTranspose(a, a), l => LowerTriangle(Rows(Lane(a, l)) * Rows(Lane(a, l)).Transpose()));
            Verify(Matrix3x3Wide.Transpose(a), l => Rows(Lane(a, l)).Transpose().ToRowMajorArray());
            Verify(a * m, l => (Rows(Lane(a, l)) * Symmetric3(Lane(m, l))).ToRowMajorArray(), 2e-6);
            Verify(Matrix3x3Wide.Skew(v), l => Skew(Lane(v, l)).ToRowMajorArray());
            Verify(Matrix3x3Wide.Skew(v, m), l => (Skew(Lane(v, l)) * Symmetric3(Lane(m, l))).ToRowMajorArray(), 2e-6);
        }
    }

    [Fact]
    public void SymmetricMatrices()
    {
        for (int i = 0; i < Count; ++i)
        {
            var (m, v, q, r) = (samples.Definites(), samples.Vectors(), samples.Rotations(), samples.Matrices());
            Verify(m * v, l => (Symmetric3(Lane(m, l)) * Column(Lane(v, l))).ToArray(), 2e-6);
            Verify(Symmetric3x3Wide.SkewSandwich(v, m), l => LowerTriangle(Skew(Lane(v, l)) * Symmetric3(Lane(m, l)) * Skew(Lane(v, l)).Transpose()), 3e-6);
            Verify(Symmetric3x3Wide.VectorSandwich(v, m), l => [Column(Lane(v, l)) * Symmetric3(Lane(m, l)) * Column(Lane(v, l))]);
            Verify(Symmetric3x3Wide.RotationSandwich(r, m), l => LowerTriangle(Rows(Lane(r, l)).Transpose() * Symmetric3(Lane(m, l)) * Rows(Lane(r, l))), 2e-6);

            // R * local * transpose(R) with R made of the rotated axes as columns.
            var axes = Matrix3x3Wide.FromQuaternion(q);
            Verify(
                Symmetric3x3Wide.RotateInverseInertia(m, q),
                l => LowerTriangle(Rows(Lane(axes, l)).Transpose() * Symmetric3(Lane(m, l)) * Rows(Lane(axes, l))), 2e-6);
        }
    }

    [Theory]
    [InlineData(1f), InlineData(1e-25f), InlineData(1e-12f), InlineData(1e12f), InlineData(1e25f)]
    public void InversesAtAnyMagnitude(float scale)
    {
        for (int i = 0; i < Count; ++i)
        {
            var m = samples.Definites(scale);
            Verify(Symmetric3x3Wide.Invert(m), l => LowerTriangle(Symmetric3(Lane(m, l)).Inverse()), 1e-5);
            var two = new Symmetric2x2Wide(m.XX, m.YX, m.YY);
            Verify(Symmetric2x2Wide.Invert(two), l => LowerTriangle(Symmetric2(Lane(two, l)).Inverse()), 1e-5);
            var scalar = Lanes.Read<Symmetric3x3, Symmetric3x3Wide>(ref m, 0);
            var inverse = Symmetric3x3Wide.Invert(m);
            Assert.Equal(Lanes.Read<Symmetric3x3, Symmetric3x3Wide>(ref inverse, 0), Symmetric3x3.Invert(scalar));
        }
    }

    [Fact]
    public void ZeroHasAnAnswer()
    {
        Verify(Symmetric3x3Wide.Invert(default), _ => new double[6]);
        Verify(Symmetric2x2Wide.Invert(default), _ => new double[3]);
        Verify(Matrix2x2Wide.Invert(default), _ => new double[4]);
        Verify(Vector3Wide.Normalize(default), _ => new double[3]);
        Verify(QuaternionWide.Normalize(default), _ => [0, 0, 0, 1]);
        Verify(Wide.DivideOrZero(Vector<float>.One, Vector<float>.Zero), _ => [0]);
        Verify(Wide.SquareRootOrZero(-Vector<float>.One), _ => [0]);
        Verify(Vector3Wide.Normalize(new(Vector<float>.Zero, new(1e-30f), Vector<float>.Zero)), _ => new double[3]);
        Blocks.Solve(default, default(Matrix3x3Wide), default, default, default, out Vector3Wide x, out Vector3Wide y);
        Verify(x, _ => new double[3]);
        Verify(y, _ => new double[3]);
        Assert.Equal(default, Symmetric3x3.Invert(default));
        Assert.Equal(default, Matrix3x3.Invert(default));
        Assert.Equal(default, QuaternionEx.Inverse(default));
        Assert.Equal(Vector3.Zero, Exact.Normalize(default(Vector3)));
        Assert.Equal(Quaternion.Identity, Exact.Normalize(default(Quaternion)));

        // Not a number stays visible: it is not mistaken for zero.
        Assert.True(float.IsNaN(Symmetric3x3Wide.Invert(new(new(float.NaN), default, default, default, default, default)).XX[0]));
    }

    [Fact]
    public void RowsOfTwo()
    {
        for (int i = 0; i < Count; ++i)
        {
            var (j, m, v) = (new Matrix2x3Wide(samples.Vectors(), samples.Vectors()), samples.Definites(), samples.Vectors());
            var p = new Vector2Wide(samples.Numbers(), samples.Numbers());
            Verify(j * v, l => (JacobianRows(Lane(j, l)) * Column(Lane(v, l))).ToArray(), 1e-4);
            Verify(Matrix2x3Wide.TransposeTimes(j, p), l => (JacobianRows(Lane(j, l)).Transpose() * Column(Lane(p, l))).ToArray(), 1e-5);
            Verify(Matrix2x3Wide.Sandwich(j, m),
                l => LowerTriangle(JacobianRows(Lane(j, l)) * Symmetric3(Lane(m, l)) * JacobianRows(Lane(j, l)).Transpose()), 2e-6);
            Verify(Matrix2x3Wide.TransposeTimesSymmetric(j, j), l => LowerTriangle(JacobianRows(Lane(j, l)).Transpose() * JacobianRows(Lane(j, l))));
            var two = new Symmetric2x2Wide(m.XX, m.YX, m.YY);
            Verify(two * p, l => (Symmetric2(Lane(two, l)) * Column(Lane(p, l))).ToArray(), 1e-5);
            Verify(two * j, l => (Symmetric2(Lane(two, l)) * JacobianRows(Lane(j, l))).ToRowMajorArray(), 2e-6);
        }
    }

    [Fact]
    public void BlockSystems()
    {
        for (int i = 0; i < Count; ++i)
        {
            // Blocks small enough beside the diagonal for the whole matrix to be positive definite.
            var (a, d, u, v) = (samples.Definites(), samples.Definites(), samples.Vectors(), samples.Vectors());
            var b = samples.Matrices() * new Vector<float>(0.3f);
            Blocks.Solve(a, b, d, u, v, out Vector3Wide x, out Vector3Wide y);
            VerifySystem(l => Symmetric3(Lane(a, l)), l => Rows(Lane(b, l)), l => Symmetric3(Lane(d, l)), u, v, x, y);

            var transposeB = new Matrix2x3Wide(b.X, b.Y);
            var d2 = new Symmetric2x2Wide(d.XX, d.YX, d.YY);
            var v2 = new Vector2Wide(v.X, v.Y);
            Blocks.Solve(a, transposeB, d2, u, v2, out Vector3Wide x5, out Vector2Wide y5);
            VerifySystem(l => Symmetric3(Lane(a, l)), l => JacobianRows(Lane(transposeB, l)).Transpose(), l => Symmetric2(Lane(d2, l)), u, v2, x5, y5);

            Blocks.Solve(a, b.X, d.XX, u, v.X, out Vector3Wide x4, out Vector<float> y4);
            VerifySystem(l => Symmetric3(Lane(a, l)), l => Column(Lane(b.X, l)).ToColumnMatrix(), l => Column(Lane(d.XX, l)).ToColumnMatrix(), u, v.X, x4, y4);
        }
    }

    delegate MathNet.Numerics.LinearAlgebra.Matrix<double> LaneMatrix(int lane);

    static void VerifySystem<TV>(LaneMatrix a, LaneMatrix b, LaneMatrix d, Vector3Wide u, TV v, Vector3Wide x, TV y) where TV : unmanaged
    {
        for (int lane = 0; lane < Vector<float>.Count; ++lane)
        {
            var whole = a(lane).Append(b(lane)).Stack(b(lane).Transpose().Append(d(lane)));
            var truth = whole.Solve(Column([.. Lane(u, lane), .. Lane(v, lane)])).ToArray();
            AssertClose(truth, [.. Lane(x, lane), .. Lane(y, lane)], 2e-5);
        }
    }
}
