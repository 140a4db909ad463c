using System;
using BepuPhysics.Collidables;
using Xunit;

namespace DemoTests.Collidables;

public class InertiaTests
{
    public static TheoryData<float> Scales => [0.0005f, 0.03f, 1, 40, 500];

    [Theory]
    [MemberData(nameof(Scales))]
    public void SpheresAgreeWithNumericalIntegration(float scale) => AgreesWithIntegration(new Sphere(scale));

    [Theory]
    [MemberData(nameof(Scales))]
    public void CapsulesAgreeWithNumericalIntegration(float scale)
    {
        AgreesWithIntegration(new Capsule(scale, scale));
        AgreesWithIntegration(new Capsule(scale, 7 * scale));
        AgreesWithIntegration(new Capsule(scale, 0.05f * scale));
    }

    [Theory]
    [MemberData(nameof(Scales))]
    public void BoxesAgreeWithNumericalIntegration(float scale)
    {
        AgreesWithIntegration(new Box(scale, 2 * scale, 5 * scale));
        AgreesWithIntegration(new Box(3 * scale, 0.1f * scale, scale));
    }

    [Theory]
    [MemberData(nameof(Scales))]
    public void CylindersAgreeWithNumericalIntegration(float scale)
    {
        AgreesWithIntegration(new Cylinder(scale, 2 * scale));
        AgreesWithIntegration(new Cylinder(scale, 0.05f * scale));
        AgreesWithIntegration(new Cylinder(0.1f * scale, 3 * scale));
    }

    [Fact]
    public void ACapsuleWithoutLengthIsASphere()
    {
        var sphere = new Sphere(0.7f).ComputeInertia(3);
        var capsule = new Capsule(0.7f, 0).ComputeInertia(3);
        Assert.Equal(sphere.InverseMass, capsule.InverseMass);
        Assert.Equal(sphere.InverseInertiaTensor.XX, capsule.InverseInertiaTensor.XX, sphere.InverseInertiaTensor.XX * 1e-6f);
        Assert.Equal(sphere.InverseInertiaTensor.YY, capsule.InverseInertiaTensor.YY, sphere.InverseInertiaTensor.YY * 1e-6f);
    }

    public static TheoryData<float, float> Extremes
    {
        get
        {
            var data = new TheoryData<float, float>();
            foreach (var size in (float[])[1e-6f, 1e-3f, 1e3f, 1e7f])
                foreach (var mass in (float[])[1e-6f, 1, 1e6f, 1e12f])
                    data.Add(size, mass);
            return data;
        }
    }

    [Theory]
    [MemberData(nameof(Extremes))]
    public void SmallestAndLargestBodiesKeepTheirDigits(float size, float mass)
    {
        var sphere = new Sphere(size).ComputeInertia(mass).InverseInertiaTensor;
        AssertRelative(2.5 / ((double)mass * size * size), sphere.XX, 1e-6);
        var box = new Box(2 * size, 2 * size, 2 * size).ComputeInertia(mass).InverseInertiaTensor;
        AssertRelative(1.5 / ((double)mass * size * size), box.ZZ, 1e-6);
        var needle = new Capsule(1e-6f, 2 * size).ComputeInertia(mass).InverseInertiaTensor;
        Assert.True(float.IsNormal(needle.XX) && float.IsNormal(needle.YY) && needle.YY > needle.XX);
    }

    [Theory]
    [InlineData(0f)]
    [InlineData(-1f)]
    [InlineData(float.NaN)]
    [InlineData(float.PositiveInfinity)]
    [InlineData(float.NegativeInfinity)]
    [InlineData(1e-40f)]
    [InlineData(3e38f)]
    public void MassesWithoutAnInverseAreRefused(float mass)
    {
        Refuses(() => new Sphere(1).ComputeInertia(mass));
        Refuses(() => new Capsule(1, 1).ComputeInertia(mass));
        Refuses(() => new Box(1, 2, 3).ComputeInertia(mass));

        void Refuses(Func<object> attempt)
        {
            var exception = Assert.Throws<ArgumentOutOfRangeException>(attempt);
            Assert.Equal("mass", exception.ParamName);
            Assert.Equal(mass, exception.ActualValue);
        }
    }

    [Fact]
    public void ShapesWithoutVolumeHaveNoInertia()
    {
        Assert.Throws<ArgumentOutOfRangeException>(() => new Sphere(0).ComputeInertia(1));
        Assert.Throws<ArgumentOutOfRangeException>(() => new Capsule(0, 1).ComputeInertia(1));
        Assert.Throws<ArgumentOutOfRangeException>(() => new Box(1, 0, 1).ComputeInertia(1));
    }

    static void AgreesWithIntegration<TShape>(TShape shape) where TShape : unmanaged, IConvexShape
    {
        const float mass = 2.5f;
        var inertia = shape.ComputeInertia(mass);
        var moments = ShapeOracle.MomentsPerMass(shape, 150);
        AssertRelative(1.0 / mass, inertia.InverseMass, 1e-6);
        // The sum is wrong by a few 1e-5; a coefficient that is wrong is wrong by far more.
        AssertRelative(1 / (mass * moments.X), inertia.InverseInertiaTensor.XX, 2e-4);
        AssertRelative(1 / (mass * moments.Y), inertia.InverseInertiaTensor.YY, 2e-4);
        AssertRelative(1 / (mass * moments.Z), inertia.InverseInertiaTensor.ZZ, 2e-4);
        Assert.Equal(0, inertia.InverseInertiaTensor.YX);
        Assert.Equal(0, inertia.InverseInertiaTensor.ZX);
        Assert.Equal(0, inertia.InverseInertiaTensor.ZY);
    }

    static void AssertRelative(double expected, double actual, double tolerance) =>
        Assert.True(Math.Abs(actual / expected - 1) <= tolerance, $"Expected {expected}, got {actual}: off by {actual / expected - 1:e1}.");
}
