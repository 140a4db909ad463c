using System;
using System.Numerics;
using BepuPhysics.Collidables;
using FsCheck;
using FsCheck.Fluent;

namespace DemoTests.Collidables;

/// <summary>Random shapes, attitudes and rays for properties; every run draws the same ones.</summary>
static class ShapeGenerators
{
    public static Config Reproducible(int count) => Config.QuickThrowOnFailure.WithMaxTest(count).WithReplay(8675309, 42424243);

    /// <summary>Evenly spread over the interval.</summary>
    public static Gen<float> Uniform(float low, float high) =>
        Gen.Choose(0, 1 << 22).Select(i => low + (high - low) * (i / (float)(1 << 22)));

    /// <summary>Millimetres to hundreds of metres, every decade equally often.</summary>
    public static Gen<float> Sizes => Uniform(-3, 2.5f).Select(exponent => (float)Math.Pow(10, exponent));

    public static Gen<Vector3> Directions =>
        from y in Uniform(-1, 1)
        from angle in Uniform(0, MathF.Tau)
        select new Vector3(MathF.Sqrt(1 - y * y) * MathF.Cos(angle), y, MathF.Sqrt(1 - y * y) * MathF.Sin(angle));

    /// <summary>Unit quaternions; every fourth is a multiple of a quarter turn.</summary>
    public static Gen<Quaternion> Orientations => Gen.Frequency(
        (3, from axis in Directions from angle in Uniform(0, MathF.Tau) select Quaternion.CreateFromAxisAngle(axis, angle)),
        (1, from i in Gen.Choose(0, 2)
            from quarter in Gen.Choose(0, 3)
            select Quaternion.CreateFromAxisAngle(new(i == 0 ? 1 : 0, i == 1 ? 1 : 0, i == 2 ? 1 : 0), quarter * MathF.PI / 2)));

    public static Gen<Sphere> Spheres => Sizes.Select(radius => new Sphere(radius));

    /// <summary>Capsules from balls to needles fifty times as long as wide.</summary>
    public static Gen<Capsule> Capsules =>
        from radius in Sizes
        from ratio in Uniform(-5, 95)
        select new Capsule(radius, radius * Math.Max(0, ratio));

    /// <summary>Cylinders from coins to rods, a hundred times as wide as long and the other way round.</summary>
    public static Gen<Cylinder> Cylinders =>
        from radius in Sizes
        from exponent in Uniform(-2, 2)
        select new Cylinder(radius, 2 * radius * (float)Math.Pow(10, exponent));

    /// <summary>Boxes with sides up to a hundred times as long as others.</summary>
    public static Gen<Box> Boxes =>
        from size in Sizes
        from x in Uniform(0.01f, 1)
        from y in Uniform(0.01f, 1)
        from z in Uniform(0.01f, 1)
        select new Box(size * x, size * y, size * z);
}
