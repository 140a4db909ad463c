using System;
using BepuUtilities;
using FsCheck;
using FsCheck.Fluent;
using Xunit;
using static DemoTests.Numerics.DoubleOracle;

namespace DemoTests.Numerics;

/// <summary>Laws of the scalar operations under their public names, over generated inputs with a fixed seed.</summary>
public class RotationPropertyTests
{
    static readonly Config Settings = Config.QuickThrowOnFailure.WithMaxTest(500).WithReplay(new Replay(new Rnd(20240607, 4711), null));

    static void ForAll(Action<WideSamples> law) =>
        Check.One(Settings, Prop.ForAll(ArbMap.Default.ArbFor<int>(), (Action<int>)(seed => law(new WideSamples(seed)))));

    [Fact]
    public void RotationKeepsLength() => ForAll(s =>
    {
        var (v, q) = (s.Vector(s.Positive(1e-6f, 1e6f)), s.Rotation());
        Assert.InRange(Exact.Length(QuaternionEx.Transform(v, q)) / Exact.Length(v), 1 - 1e-6f, 1 + 1e-6f);
    });

    [Fact]
    public void ConjugateUndoes() => ForAll(s =>
    {
        var (v, q) = (s.Vector(), s.Rotation());
        AssertClose(Components(v), Components(Exact.RotateByInverse(Exact.Rotate(v, q), q)), 2e-6);
        QuaternionEx.Inverse(q, out var inverse);
        AssertClose([0, 0, 0, 1], Components(QuaternionEx.Concatenate(q, inverse)), 1e-6);
    });

    [Fact]
    public void ConcatenationAppliesTheFirstFirst() => ForAll(s =>
    {
        var (v, p, q) = (s.Vector(), s.Rotation(), s.Rotation());
        QuaternionEx.ConcatenateWithoutOverlap(p, q, out var both);
        AssertClose(Components(Exact.Rotate(Exact.Rotate(v, p), q)), Components(Exact.Rotate(v, both)), 2e-6);
        QuaternionEx.GetRelativeRotation(p, q, out var relative);
        AssertClose(Components(q), Components(QuaternionEx.Concatenate(p, relative)), 2e-6);
    });

    [Fact]
    public void MatricesGoThereAndBack() => ForAll(s =>
    {
        var q = s.Rotation();
        var m = Matrix3x3.CreateFromQuaternion(q);
        var back = QuaternionEx.CreateFromRotationMatrix(m);
        AssertClose([1], [Math.Abs(Exact.Dot(q, back))], 1e-6);
        AssertClose(Components(QuaternionEx.TransformUnitY(q)), Components(m.Y), 0);
        AssertClose([1, 0, 0, 0, 1, 0, 0, 0, 1], Flat(Matrix3x3.Transpose(m) * m), 1e-6);
    });

    [Fact]
    public void InverseTimesMatrixIsOne() => ForAll(s =>
    {
        var definite = s.Definite(s.Positive(1e-20f, 1e20f));
        Symmetric3x3.Invert(definite, out var inverse);
        AssertClose([1, 0, 0, 0, 1, 0, 0, 0, 1], Flat(Symmetric3x3.ToMatrix3x3(inverse) * Symmetric3x3.ToMatrix3x3(definite)), 1e-5);
        var m = Symmetric3x3.ToMatrix3x3(s.Definite()) * Matrix3x3.FromQuaternion(s.Rotation());
        AssertClose([1, 0, 0, 0, 1, 0, 0, 0, 1], Flat(Matrix3x3.Invert(m) * m), 1e-5);
        var transform = new AffineTransform(m, s.Vector());
        AffineTransform.Invert(transform, out var back);
        var point = s.Vector();
        AffineTransform.Transform(point, transform, out var moved);
        AffineTransform.Transform(moved, back, out var returned);
        AssertClose([.. Components(point), 1], [.. Components(returned), 1], 1e-5);
        AffineTransform.Multiply(transform, back, out var identity);
        AssertClose([1, 0, 0, 0, 1, 0, 0, 0, 1], Flat(identity.LinearTransform), 1e-5);
    });

    [Fact]
    public void BetweenTakesOneVectorToTheOther() => ForAll(s =>
    {
        var (from, to) = (Exact.Normalize(s.Vector()), Exact.Normalize(s.Vector()));
        foreach (var target in new[] { to, from, -from, Exact.Normalize(-from + to * 1e-4f), Exact.Normalize(-from + to * 1e-3f) })
        {
            QuaternionEx.GetQuaternionBetweenNormalizedVectors(from, target, out var q);
            Assert.InRange(QuaternionEx.Length(q), 1 - 1e-6f, 1 + 1e-6f);

            // Up to an angle of pi - 1.4e-3 exact; closer to opposite by half a turn.
            AssertClose(Components(target), Components(Exact.Rotate(from, q)), 2e-3);
        }

        // 0.02 radians short of opposite.
        QuaternionWide.GetAxisAngleFromQuaternion(QuaternionWide.Broadcast(s.Rotation()), out var wideAxis, out _);
        Vector3Wide.ReadFirst(wideAxis, out var other);
        var across = Exact.Normalize(Exact.Cross(from, other));
        var near = Exact.Normalize(across * 0.02f - from);
        AssertClose(Components(near), Components(Exact.Rotate(from, QuaternionEx.GetQuaternionBetweenNormalizedVectors(from, near))), 2e-5);
    });

    [Fact]
    public void YawPitchRollIsTheProductOfThree() => ForAll(s =>
    {
        var (yaw, pitch, roll) = (s.Number(4), s.Number(4), s.Number(4));
        double[] About(int axis, double angle)
        {
            var q = new double[] { 0, 0, 0, Math.Cos(angle / 2) };
            q[axis] = Math.Sin(angle / 2);
            return q;
        }
        var truth = Hamilton(About(1, yaw), Hamilton(About(0, pitch), About(2, roll)));
        AssertClose(truth, Components(QuaternionEx.CreateFromYawPitchRoll(yaw, pitch, roll)), 1e-6);
    });

    [Fact]
    public void SlerpTurnsAtAConstantRate() => ForAll(s =>
    {
        var axis = Exact.Normalize(s.Vector());
        var angle = s.Positive(1e-5f, 3f);
        var start = s.Rotation();
        var end = QuaternionEx.Concatenate(start, QuaternionEx.CreateFromAxisAngle(axis, angle));
        var amount = s.Integer(101) / 100f;
        var truth = QuaternionEx.Concatenate(start, QuaternionEx.CreateFromAxisAngle(axis, angle * amount));
        AssertClose(Components(truth), Components(QuaternionEx.Slerp(start, end, amount)), 3e-6);
        AssertClose(Components(truth), Components(QuaternionEx.Slerp(start, QuaternionEx.Negate(end), amount)), 3e-6);
    });

    [Fact]
    public void BoxesMergeAndOverlap() => ForAll(s =>
    {
        var (a, b) = (Box(s), Box(s));
        var merged = BoundingBox.CreateMerged(a, b);
        Assert.True(BoundingBox.Contains(merged, a) && BoundingBox.Contains(merged, b));
        Assert.Equal(a, BoundingBox.CreateMerged(a, BoundingBox.Empty));
        var separate = a.Max.X < b.Min.X || b.Max.X < a.Min.X || a.Max.Y < b.Min.Y || b.Max.Y < a.Min.Y || a.Max.Z < b.Min.Z || b.Max.Z < a.Min.Z;
        Assert.Equal(!separate, BoundingBox.Intersects(a, b));
        var sphere = new BoundingSphere(s.Vector(2), s.Positive(0.01f, 1));
        double squared = 0;
        for (int i = 0; i < 3; ++i)
        {
            var outside = Math.Max(0, Math.Max((double)a.Min[i] - sphere.Center[i], (double)sphere.Center[i] - a.Max[i]));
            squared += outside * outside;
        }
        var gap = Math.Sqrt(squared) - sphere.Radius;
        if (Math.Abs(gap) > 1e-6)
            Assert.Equal(gap < 0, a.Intersects(sphere));
    });

    static BoundingBox Box(WideSamples s) => BoundingBox.CreateFromPoints([s.Vector(), s.Vector()]);

    static double[] Flat(Matrix3x3 m) => [.. Components(m.X), .. Components(m.Y), .. Components(m.Z)];
}
