using System;
using System.Linq;
using System.Numerics;
using BepuPhysics.Collidables;
using BepuPhysics.CollisionDetection;
using Xunit;

namespace DemoTests.CollisionDetection;

/// <summary>Capsules against cylinders: what is known without a reference. <see cref="ConvexPairTests"/> has the rest.</summary>
public sealed class CapsuleCylinderTests
{
    static readonly Quaternion alongX = Quaternion.CreateFromAxisAngle(Vector3.UnitZ, -MathF.PI / 2);

    static ConvexContactManifold Run(Capsule capsule, Cylinder cylinder, Vector3 capsulePosition, Quaternion capsuleOrientation,
        float margin = 0) => PairHarness.Run<Capsule, Cylinder>(
            [new(capsule, cylinder, -capsulePosition, capsuleOrientation, Quaternion.Identity)], margin)[0];

    static void AssertContacts(in ConvexContactManifold manifold, Vector3 normal, float depth, params Vector3[] offsets)
    {
        Assert.Equal(offsets.Length, manifold.Count);
        Assert.True((manifold.Normal - normal).Length() < 2e-6f, $"{manifold.Normal}, not {normal}");
        for (int i = 0; i < offsets.Length; ++i)
        {
            Assert.Equal(depth, manifold.GetDepth(i), 3e-6f);
            Assert.True((manifold.GetOffset(i) - offsets[i]).Length() < 2e-4f, $"{manifold.GetOffset(i)}, not {offsets[i]}");
        }
    }

    [Fact]
    public void ACapsuleAlongTheSideTouchesAtTheEndsOfTheSharedStretch()
    {
        // The capsule's segment from -0.5 to 1.5, the side to 1.
        var manifold = Run(new(0.25f, 2), new(0.5f, 2), new Vector3(0.7f, 0.5f, 0), Quaternion.Identity);
        AssertContacts(manifold, Vector3.UnitX, 0.05f, new(-0.225f, -1, 0), new(-0.225f, 0.5f, 0));
    }

    [Fact]
    public void ACapsuleOnAnEndTouchesAtTheEndsOfTheChord()
    {
        // The segment from -0.7 to 1.3, half the radius beside the axis: the chord reaches to 0.5 * sqrt(0.75).
        foreach (var side in new[] { 1, -1 })
        {
            var manifold = Run(new(0.25f, 2), new(0.5f, 2), new Vector3(0.3f, side * 1.2f, 0.25f), alongX);
            AssertContacts(manifold, Vector3.UnitY * side, 0.05f, new(-0.7330127f, side * -0.225f, 0), new(0.1330127f, side * -0.225f, 0));
        }
    }

    [Fact]
    public void AnUprightCapsuleTouchesAnEndOnce() => AssertContacts(
        Run(new(0.25f, 2), new(0.5f, 2), new Vector3(0.1f, 2.2f, 0.2f), Quaternion.Identity, 5), Vector3.UnitY, 0.05f, new Vector3(0, -1.225f, 0));

    [Fact]
    public void ACapsuleAcrossTheSideTouchesOnce() => AssertContacts(
        Run(new(0.25f, 2), new(0.5f, 2), new Vector3(0, 0.3f, 0.7f), alongX), Vector3.UnitZ, 0.05f, new Vector3(0, 0, -0.225f));

    [Fact]
    public void CapsulesThroughTheAxisLeaveByTheShortestWay()
    {
        // On the axis along it: any way to the side. Across it through the centre: across itself, or by the end where that is nearer.
        var along = Run(new(0.25f, 1), new(0.5f, 2), default, Quaternion.Identity);
        Assert.Equal(0.75f, along.GetDepth(0), 1e-6f);
        Assert.Equal(0, along.Normal.Y, 1e-6f);
        var across = Run(new(0.25f, 2), new(0.5f, 4), default, alongX);
        Assert.Equal(0.75f, across.GetDepth(0), 1e-6f);
        Assert.Equal(1, MathF.Abs(across.Normal.Z), 1e-6f);
        var coin = Run(new(0.25f, 2), new(0.5f, 0.2f), new Vector3(0, 0.02f, 0), alongX);
        Assert.Equal(0.33f, coin.GetDepth(0), 1e-6f);
        Assert.Equal(1, coin.Normal.Y, 1e-6f);
    }

    [Fact]
    public void ShapesOfTheLeastSizesAreSpheresAndDiscs()
    {
        var sphere = Run(new(0.25f, 0), new(0.5f, 2), new Vector3(0, 0.2f, 0.7f), alongX);
        AssertContacts(sphere, Vector3.UnitZ, 0.05f, new Vector3(0, 0, -0.225f));
        var disc = Run(new(0.25f, 2), new(0.5f, 2e-6f), new Vector3(0, 0.2f, 0), alongX);
        AssertContacts(disc, Vector3.UnitY, 0.05f, new(-0.5f, -0.225f, 0), new(0.5f, -0.225f, 0));
        var point = Run(new(0.25f, 0), new(2e-6f, 4e-6f), default, Quaternion.Identity);
        Assert.Equal(1, point.Count);
        Assert.Equal(0.25f, point.GetDepth(0), 3e-6f);
        Assert.Equal(1, point.Normal.Length(), 1e-6f);
    }

    [Fact]
    public void ContactsKeepTheirNamesWhenTheCapsuleRocks()
    {
        // The second contact is at the end that the capsule's own axis points to, whichever of the two is higher.
        foreach (var angle in new[] { -1e-3f, -1e-6f, 0, 1e-6f, 1e-3f })
        {
            foreach (var side in new[] { 1, -1 })
            {
                var orientation = Quaternion.Concatenate(alongX, Quaternion.CreateFromAxisAngle(Vector3.UnitZ, angle));
                var manifold = Run(new(0.25f, 0.6f), new(0.5f, 2), new Vector3(0, side * 1.24f, 0), orientation, 0.1f);
                Assert.Equal(2, manifold.Count);
                for (int i = 0; i < 2; ++i)
                    Assert.Equal(manifold.GetFeatureId(i) == 0 ? -0.3f : 0.3f, manifold.GetOffset(i).X, 1e-3f);
            }
        }
    }

    [Fact]
    public void ResultsDoNotDependOnTheOtherPairs()
    {
        var random = new PairRandom(5);
        var cases = new PairCase<Capsule, Cylinder>[333];
        for (int i = 0; i < cases.Length; ++i)
        {
            Capsule capsule = new(random.NextLogarithmic(0.01, 1), random.NextLogarithmic(0.02, 2));
            Cylinder cylinder = new(random.NextLogarithmic(0.01, 1), random.NextLogarithmic(0.02, 2));
            var reach = capsule.Radius + capsule.HalfLength + cylinder.Radius + cylinder.HalfLength;
            cases[i] = new(capsule, cylinder, random.NextDirection() * (reach * random.Next(0, 0.8)), random.NextOrientation(),
                random.NextOrientation());
        }
        var expected = PairHarness.Run(cases, 0.2f);
        int[] order = [.. Enumerable.Range(0, cases.Length).OrderBy(_ => random.Next())];
        var actual = PairHarness.Run(cases, 0.2f, order, 11);
        for (int i = 0; i < cases.Length; ++i)
        {
            Assert.Equal(expected[i].Count, actual[i].Count);
            Assert.Equal(expected[i].Normal, actual[i].Normal);
            for (int j = 0; j < expected[i].Count; ++j)
                Assert.Equal((expected[i].GetDepth(j), expected[i].GetOffset(j)), (actual[i].GetDepth(j), actual[i].GetOffset(j)));
        }
    }
}
