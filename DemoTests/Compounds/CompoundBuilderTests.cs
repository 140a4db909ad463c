using System;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuUtilities;
using Xunit;

namespace DemoTests.Compounds;

/// <summary>Centre of mass and inertia of compounds against closed forms.</summary>
public sealed class CompoundBuilderTests : IDisposable
{
    readonly CompoundWorkshop workshop = new(13);

    public void Dispose() => workshop.Dispose();

    CompoundBuilder CreateBuilder() => new(workshop.Pool, workshop.Shapes, 1);

    static void AssertClose(in Symmetric3x3 expected, in Symmetric3x3 actual, float tolerance)
    {
        var scale = expected.XX + expected.YY + expected.ZZ;
        var error = expected - actual;
        var sum = Math.Abs(error.XX) + Math.Abs(error.YX) + Math.Abs(error.YY) + Math.Abs(error.ZX) + Math.Abs(error.ZY) + Math.Abs(error.ZZ);
        Assert.InRange(sum / scale, 0, tolerance);
    }

    /// <summary>Two boxes side by side, one of them given lying on another side, are one box.</summary>
    [Fact]
    public void Two_halves_make_a_box()
    {
        using var builder = CreateBuilder();
        var quarter = Quaternion.CreateFromAxisAngle(Vector3.UnitZ, MathF.PI / 2);
        builder.Add(new Box(1, 2, 3), new RigidPose(new Vector3(9.5f, 4, 0)), 6);
        builder.Add(new Box(2, 1, 3), new RigidPose(new Vector3(10.5f, 4, 0), quarter), 6);
        builder.BuildDynamicCompound(out var children, out var inertia, out var center);
        Assert.Equal(new Vector3(10, 4, 0), center);
        var expected = new Box(2, 2, 3).ComputeInertia(12);
        Assert.Equal(expected.InverseMass, inertia.InverseMass, 1e-7f);
        AssertClose(expected.InverseInertiaTensor, inertia.InverseInertiaTensor, 1e-6f);
        Assert.Equal(new Vector3(-.5f, 0, 0), children[0].LocalPosition);
        workshop.Add(children, isBig: false);
    }

    [Fact]
    public void Away_from_the_center_inertia_grows_by_the_square()
    {
        using var builder = CreateBuilder();
        builder.Add(new Sphere(1), new RigidPose(new Vector3(0, 3, 4)), 2);
        builder.BuildDynamicCompound(out var children, out var inertia);
        // A ball has 2/5 m r2; the parallel axis adds m d2 around x, and what is left of it around the others.
        AssertClose(Symmetric3x3.Invert(new Symmetric3x3(.8f + 50, 0, .8f + 32, 0, -24, .8f + 18)), inertia.InverseInertiaTensor, 1e-5f);
        CompoundBuilder.GetOffsetInertiaContribution(new(0, 3, 4), 2, out var offset);
        Assert.Equal(new Symmetric3x3(50, 0, 32, 0, -24, 18), offset);
        workshop.Pool.Return(ref children);
    }

    [Theory, InlineData(false), InlineData(true)]
    public void A_compound_finds_the_inertia_that_the_builder_finds(bool isBig)
    {
        using var builder = CreateBuilder();
        var children = workshop.CreateChildren(8, 2);
        var masses = new float[children.Length];
        for (int i = 0; i < masses.Length; ++i)
        {
            masses[i] = workshop.Next(1, 5);
            var shape = (IConvexShapeBatch)workshop.Shapes[children[i].ShapeIndex.Type]!;
            builder.Add(children[i].ShapeIndex, new RigidPose(children[i].LocalPosition, children[i].LocalOrientation),
                shape.ComputeInertia(children[i].ShapeIndex.Index, masses[i]));
        }
        builder.BuildDynamicCompound(out var built, out var expected, out var center);
        var name = workshop.Add(children, isBig);
        BodyInertia actual;
        Vector3 actualCenter;
        if (isBig)
        {
            ref var big = ref workshop.Shapes.GetShape<BigCompound>(name.Index);
            actual = big.ComputeInertia(masses, workshop.Shapes, out actualCenter);
            big.Tree.Validate();
            workshop.Shapes.UpdateBounds(big.Children[3].AsPose(), big.Children[3].ShapeIndex, out var bounds);
            Assert.Equal(bounds.Min, big.Tree.GetBounds(3).Min);
        }
        else
        {
            actual = workshop.Shapes.GetShape<Compound>(name.Index).ComputeInertia(masses, workshop.Shapes, out actualCenter);
        }
        Assert.InRange((center - actualCenter).Length(), 0, 1e-5f);
        Assert.Equal(expected.InverseMass, actual.InverseMass, 1e-6f);
        AssertClose(expected.InverseInertiaTensor, actual.InverseInertiaTensor, 1e-5f);
        for (int i = 0; i < built.Length; ++i)
            Assert.InRange((built[i].LocalPosition - children[i].LocalPosition).Length(), 0, 1e-5f);
        // Around that centre it is the same again, and none other is.
        Assert.InRange(CompoundBuilder.ComputeCenterOfMass(new Span<CompoundChild>(ref built[0])[..1], masses.AsSpan(0, 1)).Length(), .1f, 10);
        workshop.Pool.Return(ref built);
    }

    [Fact]
    public void A_kinematic_compound_has_weights_only_for_its_center()
    {
        using var builder = CreateBuilder();
        var sphere = workshop.Shapes.Add(new Sphere(1));
        builder.AddForKinematic(sphere, new RigidPose(new Vector3(1, 0, 0)), 1);
        builder.AddForKinematic(new Box(1, 1, 1), new RigidPose(new Vector3(5, 0, 0)), 3);
        builder.BuildKinematicCompound(out var around, out var center);
        Assert.Equal(new Vector3(4, 0, 0), center);
        Assert.Equal((-3, 1), (around[0].LocalPosition.X, around[1].LocalPosition.X));
        builder.BuildKinematicCompound(out var plain);
        Assert.Equal((1, 5), (plain[0].LocalPosition.X, plain[1].LocalPosition.X));
        builder.Reset();
        Assert.Throws<InvalidOperationException>(() => builder.BuildKinematicCompound(out _));
        workshop.Pool.Return(ref around);
        workshop.Pool.Return(ref plain);
    }

    [Fact]
    public void What_has_no_mass_or_extent_is_refused()
    {
        using var builder = CreateBuilder();
        var sphere = workshop.Shapes.Add(new Sphere(1));
        Assert.Throws<InvalidOperationException>(() => builder.BuildDynamicCompound(out _, out _));
        Assert.ThrowsAny<ArgumentException>(() => builder.Add(sphere, RigidPose.Identity, default(BodyInertia)));
        Assert.ThrowsAny<ArgumentException>(() => builder.Add(sphere, RigidPose.Identity, default(Symmetric3x3), -1));
        Assert.ThrowsAny<ArgumentException>(() => builder.Add(sphere, RigidPose.Identity, default(Symmetric3x3), float.NaN));
        Assert.ThrowsAny<ArgumentException>(() => builder.Add(sphere, RigidPose.Identity, new Symmetric3x3(1, 0, float.NaN, 0, 0, 1), 1));
        Assert.ThrowsAny<ArgumentException>(() => builder.Add(sphere, new RigidPose(new Vector3(float.NaN)), default(Symmetric3x3), 1));
        Assert.ThrowsAny<ArgumentException>(() => builder.Add(default, RigidPose.Identity, default(Symmetric3x3), 1));
        Assert.ThrowsAny<ArgumentException>(() => builder.Add(new Sphere(1), new RigidPose(new Vector3(float.NaN)), 1));
        Assert.Equal(1, workshop.Shapes[Sphere.Id]!.Count);
        Assert.Equal(0, builder.Children.Count);
        // A point on the axis has no inertia around it.
        builder.AddForKinematic(sphere, new RigidPose(new Vector3(1, 0, 0)), 1);
        var before = workshop.Pool.GetTotalAllocatedByteCount();
        Assert.ThrowsAny<ArgumentException>(() => builder.BuildDynamicCompound(out _, out _));
        Assert.Equal(before, workshop.Pool.GetTotalAllocatedByteCount());
        var child = new CompoundChild(RigidPose.Identity, sphere);
        var children = new[] { child, child };
        Assert.Throws<ArgumentException>(() => CompoundBuilder.ComputeInertia(children, new float[1], workshop.Shapes));
        Assert.ThrowsAny<ArgumentException>(() => CompoundBuilder.ComputeInertia(children, new float[2], workshop.Shapes));
    }
}
