using System;
using System.Collections.Generic;
using System.Numerics;
using BenchmarkDotNet.Attributes;
using BepuPhysics.Collidables;
using BepuPhysics.CollisionDetection;
using BepuUtilities;

namespace Benchmarks.Micro;

/// <summary>What finding the contacts of one pair costs, without the writing into lanes before and the reading after it: nanoseconds per
/// pair.</summary>
public class PairBenchmarks : IDisposable
{
    static readonly Dictionary<string, Func<PairFixture>> Fixtures = new()
    {
        [nameof(SphereSphereTester)] = () => PairFixture.Create<Sphere, SphereWide, Sphere, SphereWide, Few1<ContactWide>,
            SphereSphereTester>(NextSphere, NextSphere),
        [nameof(SphereCapsuleTester)] = () => PairFixture.Create<Sphere, SphereWide, Capsule, CapsuleWide, Few1<ContactWide>,
            SphereCapsuleTester>(NextSphere, NextCapsule),
        [nameof(SphereBoxTester)] = () => PairFixture.Create<Sphere, SphereWide, Box, BoxWide, Few1<ContactWide>,
            SphereBoxTester>(NextSphere, NextBox),
        [nameof(SphereTriangleTester)] = () => PairFixture.Create<Sphere, SphereWide, Triangle, TriangleWide, Few1<ContactWide>,
            SphereTriangleTester>(NextSphere, NextTriangle),
        [nameof(SphereCylinderTester)] = () => PairFixture.Create<Sphere, SphereWide, Cylinder, CylinderWide, Few1<ContactWide>,
            SphereCylinderTester>(NextSphere, NextCylinder),
        [nameof(CapsuleCapsuleTester)] = () => PairFixture.Create<Capsule, CapsuleWide, Capsule, CapsuleWide, Few2<ContactWide>,
            CapsuleCapsuleTester>(NextCapsule, NextCapsule),
        [nameof(CapsuleBoxTester)] = () => PairFixture.Create<Capsule, CapsuleWide, Box, BoxWide, Few2<ContactWide>,
            CapsuleBoxTester>(NextCapsule, NextBox),
        [nameof(CapsuleTriangleTester)] = () => PairFixture.Create<Capsule, CapsuleWide, Triangle, TriangleWide, Few2<ContactWide>,
            CapsuleTriangleTester>(NextCapsule, NextTriangle),
        [nameof(CapsuleCylinderTester)] = () => PairFixture.Create<Capsule, CapsuleWide, Cylinder, CylinderWide, Few2<ContactWide>,
            CapsuleCylinderTester>(NextCapsule, NextCylinder),
        [nameof(BoxBoxTester)] = () => PairFixture.Create<Box, BoxWide, Box, BoxWide, Few4<ContactWide>,
            BoxBoxTester>(NextBox, NextBox),
        [nameof(BoxTriangleTester)] = () => PairFixture.Create<Box, BoxWide, Triangle, TriangleWide, Few4<ContactWide>,
            BoxTriangleTester>(NextBox, NextTriangle),
        [nameof(TriangleTriangleTester)] = () => PairFixture.Create<Triangle, TriangleWide, Triangle, TriangleWide, Few4<ContactWide>,
            TriangleTriangleTester>(NextTriangle, NextTriangle),
    };

    PairFixture? fixture;

    /// <summary>Names of the testers.</summary>
    public static IEnumerable<string> Names => Fixtures.Keys;

    /// <summary>Name of the tester.</summary>
    [ParamsSource(nameof(Names))]
    public string Tester { get; set; } = nameof(BoxBoxTester);

    /// <summary>Creates the pairs.</summary>
    [GlobalSetup]
    public void Setup() => fixture = Fixtures[Tester]();

    /// <summary>Frees them.</summary>
    [GlobalCleanup]
    public void Dispose()
    {
        fixture?.Dispose();
        fixture = null;
        GC.SuppressFinalize(this);
    }

    /// <summary>Contacts of all pairs.</summary>
    [Benchmark(OperationsPerInvoke = PairFixture.Pairs)]
    public void Test() => fixture!.Test();

    static Sphere NextSphere(Random random) => new(NextSize(random));

    static Capsule NextCapsule(Random random) => new(NextSize(random), 2 * NextSize(random));

    static Box NextBox(Random random) => new(2 * NextSize(random), 2 * NextSize(random), 2 * NextSize(random));

    static Cylinder NextCylinder(Random random) => new(NextSize(random), 2 * NextSize(random));

    static Triangle NextTriangle(Random random) => new(
        new Vector3(NextSize(random), 0, 0), new Vector3(0, NextSize(random), 0), new Vector3(0, 0, NextSize(random)));

    static float NextSize(Random random) => 0.25f + 0.5f * random.NextSingle();
}
