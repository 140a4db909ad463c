using System.Numerics;
using System.Runtime.CompilerServices;
using BepuUtilities;
using Xunit;

namespace DemoTests.Numerics;

/// <summary>A lane's result depends on its own inputs alone, and equals that of the scalar twin to the bit.</summary>
public class LanePurityTests
{
    /// <summary>Inputs of all operations below: no padding, floats only.</summary>
    struct Inputs
    {
        public Vector3Wide A, B;
        public QuaternionWide P, Q;
        public Symmetric3x3Wide M;
        public Matrix3x3Wide R;
        public Vector<float> Angle;
    }

    struct Outputs
    {
        public Vector3Wide Normalized, Cross, Rotated, Transformed, Minimum, Solved, Tangent1, Tangent2, Axis, X, Y;
        public QuaternionWide Concatenated, NormalizedQ, Between, FromAxis;
        public Matrix3x3Wide FromQuaternion, Product;
        public Symmetric3x3Wide Inverse, Rotation, Skew;
        public Vector<float> Dot, Length, Sin, Cos, Acos, Atan2, Angle;
    }

    static Inputs Sample(WideSamples samples) => new()
    {
        A = samples.Vectors(10),
        B = samples.Vectors(),
        P = samples.Rotations(),
        Q = samples.Rotations(),
        M = samples.Definites(),
        R = samples.Matrices(),
        Angle = samples.Numbers(1000),
    };

    [MethodImpl(MethodImplOptions.NoInlining)]
    static Outputs Compute(Inputs i)
    {
        Outputs o;
        o.Normalized = Vector3Wide.Normalize(i.A);
        o.Cross = Vector3Wide.Cross(i.A, i.B);
        o.Rotated = i.Q * i.A;
        o.Transformed = i.R * i.A;
        o.Minimum = Vector3Wide.Min(i.A, i.B);
        o.Solved = i.M * i.A;
        Vector3Wide.BuildOrthonormalBasis(o.Normalized, out o.Tangent1, out o.Tangent2);
        QuaternionWide.GetAxisAngleFromQuaternion(i.Q, out o.Axis, out o.Angle);
        Blocks.Solve(i.M, i.R * new Vector<float>(0.3f), i.M, i.A, i.B, out o.X, out o.Y);
        o.Concatenated = QuaternionWide.Concatenate(i.P, i.Q);
        o.NormalizedQ = QuaternionWide.Normalize(i.Q * new Vector<float>(3));
        o.Between = QuaternionWide.GetQuaternionBetweenNormalizedVectors(o.Normalized, Vector3Wide.Normalize(i.B));
        o.FromAxis = QuaternionWide.CreateFromAxisAngle(o.Normalized, i.Angle);
        o.FromQuaternion = Matrix3x3Wide.FromQuaternion(i.Q);
        o.Product = i.R * o.FromQuaternion;
        o.Inverse = Symmetric3x3Wide.Invert(i.M);
        o.Rotation = Symmetric3x3Wide.RotateInverseInertia(i.M, i.Q);
        o.Skew = Symmetric3x3Wide.SkewSandwich(i.A, i.M);
        o.Dot = Vector3Wide.Dot(i.A, i.B);
        o.Length = i.A.Length();
        o.Sin = Wide.Sin(i.Angle);
        o.Cos = Wide.Cos(i.Angle);
        o.Acos = Wide.Acos(i.B.X);
        o.Atan2 = Wide.Atan2(i.A.Y, i.A.X);
        return o;
    }

    static void AssertSameLane<T>(T expected, int expectedLane, T actual, int actualLane) where T : unmanaged
    {
        for (int i = 0; i < Unsafe.SizeOf<T>() / Unsafe.SizeOf<Vector<float>>(); ++i)
        {
            var e = Unsafe.Add(ref Unsafe.As<T, int>(ref expected), i * Vector<int>.Count + expectedLane);
            var a = Unsafe.Add(ref Unsafe.As<T, int>(ref actual), i * Vector<int>.Count + actualLane);
            Assert.True(e == a, $"{typeof(T).Name}, value {i}, lane {expectedLane} as lane {actualLane}: {e:x8} became {a:x8}");
        }
    }

    [Fact]
    public void ShuffledLanesGiveShuffledBits()
    {
        var samples = new WideSamples(21);
        for (int i = 0; i < 300; ++i)
        {
            var inputs = Sample(samples);
            var outputs = Compute(inputs);
            var shift = 1 + samples.Integer(Vector<float>.Count - 1);
            var shuffled = inputs;
            for (int lane = 0; lane < Vector<float>.Count; ++lane)
                Lanes.Copy(ref inputs, lane, ref shuffled, (lane * 3 + shift) % Vector<float>.Count);
            var shuffledOutputs = Compute(shuffled);
            for (int lane = 0; lane < Vector<float>.Count; ++lane)
                AssertSameLane(outputs, lane, shuffledOutputs, (lane * 3 + shift) % Vector<float>.Count);
        }
    }

    [Fact]
    public void BrokenNeighboursDoNoHarm()
    {
        var samples = new WideSamples(22);
        for (int i = 0; i < 300; ++i)
        {
            var inputs = Sample(samples);
            var outputs = Compute(inputs);
            var lane = samples.Integer(Vector<float>.Count);
            Unsafe.SkipInit(out Inputs broken);
            for (int k = 0; k < Unsafe.SizeOf<Inputs>() / Unsafe.SizeOf<Vector<float>>(); ++k)
                Unsafe.Add(ref Unsafe.As<Inputs, Vector<float>>(ref broken), k) = new(k % 2 == 0 ? float.NaN : 0);
            Lanes.Copy(ref inputs, lane, ref broken, lane);
            AssertSameLane(outputs, lane, Compute(broken), lane);
        }
    }

    [Fact]
    public void ScalarTwinsGiveTheSameBits()
    {
        var samples = new WideSamples(23);
        for (int i = 0; i < 500; ++i)
        {
            var inputs = Sample(samples);
            var o = Compute(inputs);
            for (int lane = 0; lane < Vector<float>.Count; ++lane)
            {
                var a = Lanes.Read<Vector3, Vector3Wide>(ref inputs.A, lane);
                var b = Lanes.Read<Vector3, Vector3Wide>(ref inputs.B, lane);
                var p = Lanes.Read<Quaternion, QuaternionWide>(ref inputs.P, lane);
                var q = Lanes.Read<Quaternion, QuaternionWide>(ref inputs.Q, lane);
                var m = Lanes.Read<Symmetric3x3, Symmetric3x3Wide>(ref inputs.M, lane);
                var r = Lanes.Read<Matrix3x3, Matrix3x3Wide>(ref inputs.R, lane);
                AssertSame<Vector3, Vector3Wide>(Exact.Normalize(a), o.Normalized, lane);
                AssertSame<Vector3, Vector3Wide>(Exact.Cross(a, b), o.Cross, lane);
                AssertSame<Vector3, Vector3Wide>(Exact.Rotate(a, q), o.Rotated, lane);
                AssertSame<Vector3, Vector3Wide>(r * a, o.Transformed, lane);
                AssertSame<Vector3, Vector3Wide>(Exact.Min(a, b), o.Minimum, lane);
                AssertSame<Vector3, Vector3Wide>(m * a, o.Solved, lane);
                AssertSame<Quaternion, QuaternionWide>(Exact.Concatenate(p, q), o.Concatenated, lane);
                AssertSame<Quaternion, QuaternionWide>(Exact.Normalize(new Quaternion(q.X * 3, q.Y * 3, q.Z * 3, q.W * 3)), o.NormalizedQ, lane);
                AssertSame<Quaternion, QuaternionWide>(QuaternionEx.CreateFromAxisAngle(Exact.Normalize(a), inputs.Angle[lane]), o.FromAxis, lane);
                AssertSame<Matrix3x3, Matrix3x3Wide>(Matrix3x3.FromQuaternion(q), o.FromQuaternion, lane);
                AssertSame<Matrix3x3, Matrix3x3Wide>(r * Matrix3x3.FromQuaternion(q), o.Product, lane);
                AssertSame<Symmetric3x3, Symmetric3x3Wide>(Symmetric3x3.Invert(m), o.Inverse, lane);
                AssertSame<Symmetric3x3, Symmetric3x3Wide>(Symmetric3x3.RotateInverseInertia(m, q), o.Rotation, lane);
                Assert.Equal(Exact.Dot(a, b), o.Dot[lane]);
                Assert.Equal(Exact.Length(a), o.Length[lane]);
            }
        }
    }

    static void AssertSame<TScalar, TWide>(TScalar scalar, TWide wide, int lane) where TScalar : unmanaged where TWide : unmanaged, IWide<TScalar> =>
        AssertSameLane(Lanes.Broadcast<TScalar, TWide>(scalar), 0, wide, lane);
}
