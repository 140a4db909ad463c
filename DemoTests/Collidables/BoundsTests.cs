using System;
using System.Numerics;
using BepuPhysics.Collidables;
using BepuUtilities;
using Demos.References;
using FsCheck;
using FsCheck.Fluent;
using Xunit;

namespace DemoTests.Collidables;

public class BoundsTests
{
    [Fact]
    public void SphereBoundsAreTight() => BoundsAreTight(ShapeGenerators.Spheres);

    [Fact]
    public void CapsuleBoundsAreTight() => BoundsAreTight(ShapeGenerators.Capsules);

    [Fact]
    public void BoxBoundsAreTight() => BoundsAreTight(ShapeGenerators.Boxes);

    [Fact]
    public void SphereExpansionCoversEveryRotation() => ExpansionCoversEveryRotation(ShapeGenerators.Spheres);

    [Fact]
    public void CapsuleExpansionCoversEveryRotation() => ExpansionCoversEveryRotation(ShapeGenerators.Capsules);

    [Fact]
    public void BoxExpansionCoversEveryRotation() => ExpansionCoversEveryRotation(ShapeGenerators.Boxes);

    [Fact]
    public void CylinderExpansionCoversEveryRotation() => ExpansionCoversEveryRotation(ShapeGenerators.Cylinders);

    [Fact]
    public void SphereLanesAreIndependent() => LanesAreIndependent<Sphere, SphereWide>(ShapeGenerators.Spheres);

    [Fact]
    public void CapsuleLanesAreIndependent() => LanesAreIndependent<Capsule, CapsuleWide>(ShapeGenerators.Capsules);

    [Fact]
    public void BoxLanesAreIndependent() => LanesAreIndependent<Box, BoxWide>(ShapeGenerators.Boxes);

    [Fact]
    public void CylinderLanesAreIndependent() => LanesAreIndependent<Cylinder, CylinderWide>(ShapeGenerators.Cylinders);

    /// <summary>All of the surface is inside the box, and each side of the box is touched.</summary>
    static void BoundsAreTight<TShape>(Gen<TShape> shapes) where TShape : unmanaged, IConvexShape =>
        Prop.ForAll((from shape in shapes from orientation in ShapeGenerators.Orientations select (shape, orientation)).ToArbitrary(), c =>
        {
            c.shape.ComputeBounds(c.orientation, out var min, out var max);
            DoubleQuaternion rotation = c.orientation;
            var tolerance = ShapeOracle.Size(c.shape).Largest * 1e-6;
            var inside = true;
            foreach (var point in ShapeOracle.SampleSurface(c.shape, 300))
            {
                var p = rotation.Rotate(point);
                inside &= Least(p - min, max - p) >= -tolerance;
            }
            var (corners, radius) = ShapeOracle.Core(c.shape);
            var greatest = new Double3(double.MinValue, double.MinValue, double.MinValue);
            foreach (var corner in corners)
            {
                var p = rotation.Rotate(corner) + new Double3(radius, radius, radius);
                greatest = new(Math.Max(greatest.X, p.X), Math.Max(greatest.Y, p.Y), Math.Max(greatest.Z, p.Z));
            }
            // The shapes are symmetric to their centre.
            var touched = (greatest - max).Length <= tolerance && (-greatest - min).Length <= tolerance;
            return inside.Label("inside").And(touched.Label($"touched: {min} {max}, should be {greatest}"));
        }).Check(ShapeGenerators.Reproducible(100));

    static void ExpansionCoversEveryRotation<TShape>(Gen<TShape> shapes) where TShape : unmanaged, IConvexShape =>
        Prop.ForAll((
            from shape in shapes
            from a in ShapeGenerators.Orientations
            from b in ShapeGenerators.Orientations
            select (shape, a, b)).ToArbitrary(), c =>
        {
            c.shape.ComputeAngularExpansionData(out var radius, out var expansion);
            var (largest, smallest) = ShapeOracle.Size(c.shape);
            c.shape.ComputeBounds(c.a, out var minA, out var maxA);
            c.shape.ComputeBounds(c.b, out var minB, out var maxB);
            var grown = new Vector3(expansion + (float)largest * 1e-6f);
            return (Math.Abs(radius - largest) <= 1e-6 * largest).Label("radius")
                .And((Math.Abs(expansion - (largest - smallest)) <= 1e-6 * largest).Label("expansion"))
                .And(BoundingBox.Contains(new(minA - grown, maxA + grown), new(minB, maxB)).Label("covers"));
        }).Check(ShapeGenerators.Reproducible(300));

    /// <summary>A bundle of unlike shapes gives each lane the bits that the scalar query gives, wherever the lane is.</summary>
    static void LanesAreIndependent<TShape, TShapeWide>(Gen<TShape> shapes)
        where TShape : unmanaged, IConvexShape where TShapeWide : unmanaged, IShapeWide<TShape> =>
        Prop.ForAll(Gen.ArrayOf(
            from shape in shapes
            from orientation in ShapeGenerators.Orientations
            select (shape, orientation), Vector<float>.Count).ToArbitrary(), lanes =>
        {
            var equal = true;
            for (int shift = 0; shift < lanes.Length; ++shift)
            {
                TShapeWide bundle = default;
                QuaternionWide orientations = default;
                for (int i = 0; i < lanes.Length; ++i)
                {
                    Lanes.Write(lanes[i].shape, ref bundle, (i + shift) % lanes.Length);
                    Lanes.Write(lanes[i].orientation, ref orientations, (i + shift) % lanes.Length);
                }
                bundle.GetBounds(orientations, out var radius, out var expansion, out var min, out var max);
                for (int i = 0; i < lanes.Length; ++i)
                {
                    var lane = (i + shift) % lanes.Length;
                    lanes[i].shape.ComputeBounds(lanes[i].orientation, out var expectedMin, out var expectedMax);
                    lanes[i].shape.ComputeAngularExpansionData(out var expectedRadius, out var expectedExpansion);
                    equal &= radius[lane] == expectedRadius && expansion[lane] == expectedExpansion &&
                        Lanes.Read<Vector3, Vector3Wide>(ref min, lane) == expectedMin &&
                        Lanes.Read<Vector3, Vector3Wide>(ref max, lane) == expectedMax;
                }
            }
            return equal;
        }).Check(ShapeGenerators.Reproducible(50));

    static double Least(Double3 a, Double3 b) =>
        Math.Min(Math.Min(Math.Min(a.X, a.Y), a.Z), Math.Min(Math.Min(b.X, b.Y), b.Z));
}
