using System;
using System.Linq;
using System.Numerics;
using BepuPhysics.Collidables;
using BepuPhysics.CollisionDetection;
using BepuUtilities.Memory;
using DemoTests.CollisionDetection.References;
using DemoTests.Quality;
using Xunit;

namespace DemoTests.CollisionDetection;

/// <summary>Pairs of all shapes: where contacts are, and that lanes are pure.</summary>
public sealed class FaceShapePairTests : IDisposable
{
    readonly BufferPool pool = new();
    readonly ConvexHull[] hulls;

    public FaceShapePairTests()
    {
        // Prisms with 3 to 30 sides, upright and upside down narrower, and a few round ones.
        var random = new PairRandom(5);
        hulls = [.. Enumerable.Range(0, 24).Select(i =>
        {
            var count = 3 + i + i / 8 * 3;
            var points = new Vector3[2 * count];
            for (int k = 0; k < count; ++k)
            {
                var (sine, cosine) = MathF.SinCos(k * MathF.Tau / count);
                points[k] = i % 4 == 3 ? random.NextDirection() : new(cosine, -0.5f, sine);
                points[k + count] = i % 4 == 3 ? random.NextDirection() : new(cosine * 0.8f, 0.5f, sine * 0.8f);
            }
            return new ConvexHull(points, pool, out _);
        })];
    }

    public void Dispose()
    {
        foreach (var hull in hulls)
        {
            var copy = hull;
            copy.Dispose(pool);
        }
        pool.Dispose();
    }

    static float Varied(int i, int step) => 0.4f + i * step % 97 / 60f;

    static Box BoxAt(int i) => new(Varied(i, 7), Varied(i, 11), Varied(i, 13));

    static Capsule CapsuleAt(int i) => new(Varied(i, 5) * 0.3f, Varied(i, 7));

    static Cylinder CylinderAt(int i) => new(Varied(i, 11) * 0.5f, Varied(i, 3));

    static Triangle TriangleAt(int i) => new(new(-Varied(i, 3), 0.1f, 0.2f), new(0.3f, Varied(i, 5), -0.3f), new(Varied(i, 7), -0.2f, 0.4f))
    {
        TwoSided = true,
    };

    ConvexHull HullAt(int i) => hulls[i % hulls.Length];

    [Fact]
    public void LanesArePure()
    {
        FaceShapePairs<Box, BoxWide, BoxFeature, Box, BoxWide, BoxFeature>.AssertLanesArePure(BoxAt, BoxAt);
        FaceShapePairs<Capsule, CapsuleWide, CapsuleFeature, Box, BoxWide, BoxFeature>.AssertLanesArePure(CapsuleAt, BoxAt);
        FaceShapePairs<Box, BoxWide, BoxFeature, Cylinder, CylinderWide, CylinderFeature>.AssertLanesArePure(BoxAt, CylinderAt);
        FaceShapePairs<Capsule, CapsuleWide, CapsuleFeature, Cylinder, CylinderWide, CylinderFeature>.AssertLanesArePure(CapsuleAt, CylinderAt);
        FaceShapePairs<Triangle, TriangleWide, TriangleFeature, Triangle, TriangleWide, TriangleFeature>.AssertLanesArePure(TriangleAt, TriangleAt);
        FaceShapePairs<Cylinder, CylinderWide, CylinderFeature, Cylinder, CylinderWide, CylinderFeature>.AssertLanesArePure(CylinderAt, CylinderAt);
        FaceShapePairs<Cylinder, CylinderWide, CylinderFeature, ConvexHull, ConvexHullWide, ConvexHullFeature>.AssertLanesArePure(CylinderAt, HullAt);
        FaceShapePairs<ConvexHull, ConvexHullWide, ConvexHullFeature, ConvexHull, ConvexHullWide, ConvexHullFeature>.AssertLanesArePure(
            HullAt, i => HullAt(i * 7));
    }

    // Every third has a corner of two to four degrees.
    static Triangle SometimesNeedleAt(int i) => i % 3 != 0
        ? TriangleAt(i)
        : new(new(-1.5f, 0.1f, 0.2f), new(Varied(i, 5), 0.3f, -0.3f), new(Varied(i, 5), 0.3f, -0.16f)) { TwoSided = true };

    [Fact]
    public void LanesArePureBesideNeedles()
    {
        FaceShapePairs<Box, BoxWide, BoxFeature, Triangle, TriangleWide, TriangleFeature>.AssertLanesArePure(BoxAt, SometimesNeedleAt);
        FaceShapePairs<Capsule, CapsuleWide, CapsuleFeature, Triangle, TriangleWide, TriangleFeature>.AssertLanesArePure(CapsuleAt, SometimesNeedleAt);
        FaceShapePairs<Triangle, TriangleWide, TriangleFeature, Triangle, TriangleWide, TriangleFeature>.AssertLanesArePure(
            i => SometimesNeedleAt(i + 1), SometimesNeedleAt);
    }

    [Fact]
    public void ContactsLieOnBothFeatures()
    {
        int[] many =
        [
            FaceShapePairs<Capsule, CapsuleWide, CapsuleFeature, Box, BoxWide, BoxFeature>.AssertContactsLieOnBothFeatures(CapsuleAt, BoxAt),
            FaceShapePairs<Capsule, CapsuleWide, CapsuleFeature, ConvexHull, ConvexHullWide, ConvexHullFeature>.AssertContactsLieOnBothFeatures(
                CapsuleAt, HullAt),
            FaceShapePairs<Box, BoxWide, BoxFeature, Box, BoxWide, BoxFeature>.AssertContactsLieOnBothFeatures(BoxAt, BoxAt),
            FaceShapePairs<Box, BoxWide, BoxFeature, Triangle, TriangleWide, TriangleFeature>.AssertContactsLieOnBothFeatures(BoxAt, TriangleAt),
            FaceShapePairs<Box, BoxWide, BoxFeature, Cylinder, CylinderWide, CylinderFeature>.AssertContactsLieOnBothFeatures(BoxAt, CylinderAt),
            FaceShapePairs<Triangle, TriangleWide, TriangleFeature, Cylinder, CylinderWide, CylinderFeature>.AssertContactsLieOnBothFeatures(
                TriangleAt, CylinderAt),
            FaceShapePairs<Cylinder, CylinderWide, CylinderFeature, Cylinder, CylinderWide, CylinderFeature>.AssertContactsLieOnBothFeatures(
                CylinderAt, CylinderAt),
            FaceShapePairs<Cylinder, CylinderWide, CylinderFeature, ConvexHull, ConvexHullWide, ConvexHullFeature>.AssertContactsLieOnBothFeatures(
                CylinderAt, HullAt),
            FaceShapePairs<ConvexHull, ConvexHullWide, ConvexHullFeature, ConvexHull, ConvexHullWide, ConvexHullFeature>
                .AssertContactsLieOnBothFeatures(HullAt, i => HullAt(i * 7)),
        ];
        Assert.All(many, count => Assert.True(count > 300, $"{count} pairs with two contacts or more"));
    }

    [Fact]
    public void TheWitnessStandsIn()
    {
        FaceShapePairs<Box, BoxWide, BoxFeature, Cylinder, CylinderWide, CylinderFeature>.AssertTheWitnessStandsIn(BoxAt, CylinderAt);
        FaceShapePairs<Capsule, CapsuleWide, CapsuleFeature, ConvexHull, ConvexHullWide, ConvexHullFeature>.AssertTheWitnessStandsIn(
            CapsuleAt, HullAt);
        FaceShapePairs<ConvexHull, ConvexHullWide, ConvexHullFeature, ConvexHull, ConvexHullWide, ConvexHullFeature>.AssertTheWitnessStandsIn(
            HullAt, i => HullAt(i * 7));
    }

    [Fact]
    public void ManifoldsFitTheInliner()
    {
        // As the constraints' test: at other widths the gathers are longer.
        if (JitWatch.BuildIsUnoptimized || Vector<float>.Count != 8)
            return;
        LanesArePure();
        var overflows = JitWatch.Instance.Overflows("BepuPhysics.CollisionDetection.Face");
        Assert.True(overflows.Count == 0, string.Join("\n", overflows));
    }

    [Fact]
    public void PrismOnPrism()
    {
        // Six sides with a circumradius of 1 over a square with one of 4.
        var prism = new ConvexHull(Prism(6, 1), pool, out _);
        var square = new ConvexHull(Prism(4, 4), pool, out _);
        var contacts = FaceHarness<ConvexHull, ConvexHullWide, ConvexHullFeature, ConvexHull, ConvexHullWide, ConvexHullFeature>.Run(
            new FacePair<ConvexHull, ConvexHull>(prism, square, new(0.3f, -0.99f, 0.2f), Quaternion.CreateFromAxisAngle(Vector3.UnitY, 0.3f),
                Quaternion.CreateFromAxisAngle(Vector3.UnitX, 0.7f), Vector3.UnitY, 0.01f, new(0, -0.5f, 0), 0.1f));
        Assert.Equal(4, contacts.Contacts.Length);
        foreach (var contact in contacts.Contacts)
        {
            Assert.Equal(1, (contact.Offset - new Double3(0, contact.Offset.Y, 0)).Length, 1e-5);
            Assert.Equal(-0.495, contact.Offset.Y, 1e-5);
            Assert.Equal(0.01, contact.Depth, 1e-5);
        }
        // Four corners of a hexagon span two thirds of it at most.
        var points = contacts.Contacts.Select(contact => new FacePoint(contact.Offset.X, contact.Offset.Z, 0)).ToArray();
        Assert.Equal(Math.Sqrt(3), FaceReference.HullArea(points), 1e-4);

        // A capsule that lies on the square, its axis along x.
        var capsule = FaceHarness<Capsule, CapsuleWide, CapsuleFeature, ConvexHull, ConvexHullWide, ConvexHullFeature>.Run(
            new FacePair<Capsule, ConvexHull>(new Capsule(0.2f, 1), square, new(-0.69f, 0.1f, 0.2f),
                Quaternion.CreateFromAxisAngle(Vector3.UnitZ, -MathF.PI / 2), Quaternion.Identity, Vector3.UnitX, 0.01f, new(-0.2f, 0, 0), 0.1f));
        Assert.Equal(2, capsule.Contacts.Length);
        Assert.All(capsule.Contacts, contact => Assert.True(
            (contact.Offset - new Double3(-0.195, Math.CopySign(0.5, contact.Offset.Y), 0)).Length < 1e-5 && Math.Abs(contact.Depth - 0.01) < 1e-5));
        prism.Dispose(pool);
        square.Dispose(pool);
    }

    static Vector3[] Prism(int count, float radius)
    {
        var points = new Vector3[2 * count];
        for (int i = 0; i < count; ++i)
        {
            var (sine, cosine) = MathF.SinCos(i * MathF.Tau / count);
            points[i] = new(radius * cosine, -0.5f, radius * sine);
            points[i + count] = points[i] with { Y = 0.5f };
        }
        return points;
    }
}
