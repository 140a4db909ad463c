using System;
using System.Linq;
using System.Numerics;
using BepuPhysics.Collidables;
using BepuPhysics.CollisionDetection;
using BepuUtilities.Memory;
using Demos.References;
using DemoTests.Support;
using Xunit;

namespace DemoTests.CollisionDetection.Seams;

/// <summary>Depth and contacts along directions that are given, against a reference in double precision, for all pairs of shapes in both orders.</summary>
public sealed class DirectedPairTests : IDisposable
{
    // Parts of the sizes of both shapes together, of the size of the shape that a point is to be on, and of the larger size.
    const double DepthRounding = 2e-6;
    const double SurfaceTolerance = 1e-3;
    const double PlaceRounding = 2e-5;

    readonly BufferPool pool = new();

    public void Dispose() => pool.Clear();

    public static TheoryData<ConvexKind, ConvexKind> Pairs
    {
        get
        {
            var data = new TheoryData<ConvexKind, ConvexKind>();
            foreach (var a in Enum.GetValues<ConvexKind>())
            {
                foreach (var b in Enum.GetValues<ConvexKind>())
                    data.Add(a, b);
            }
            return data;
        }
    }

    static unsafe int Write<TShape>(ref ShapeCopy copy, TShape shape) where TShape : unmanaged, IConvexShape
    {
        copy.Write(TShape.TypeId, &shape);
        return TShape.TypeId;
    }

    internal static int Write(ref ShapeCopy copy, DepthSearchShape shape) => shape switch
    {
        DepthSearchShape.Typed<Sphere, SphereWide, SphereSupport> sphere => Write(ref copy, sphere.Shape),
        DepthSearchShape.Typed<Capsule, CapsuleWide, CapsuleSupport> capsule => Write(ref copy, capsule.Shape),
        DepthSearchShape.Typed<Box, BoxWide, BoxSupport> box => Write(ref copy, box.Shape),
        DepthSearchShape.Typed<Triangle, TriangleWide, TriangleSupport> triangle => Write(ref copy, triangle.Shape),
        DepthSearchShape.Typed<Cylinder, CylinderWide, CylinderSupport> cylinder => Write(ref copy, cylinder.Shape),
        DepthSearchShape.Typed<ConvexHull, ConvexHullWide, ConvexHullSupport> hull => Write(ref copy, hull.Shape),
        _ => throw new ArgumentException($"{shape}", nameof(shape)),
    };

    [Theory, MemberData(nameof(Pairs))]
    public void Depth_and_contacts_are_those_of_the_reference(ConvexKind kindA, ConvexKind kindB)
    {
        const int caseCount = 60;
        var random = new ConvexRandom(ConvexPoses.DevelopmentSeed, (ulong)((int)kindA * 6 + (int)kindB));
        var tests = new DirectedTests();
        var shapes = new (ConvexShape A, ConvexShape B, ConvexPose Pose, float Margin)[caseCount];
        for (int i = 0; i < caseCount; ++i)
        {
            var (sizeA, sizeB) = ConvexPoses.NextSizes(random);
            var a = DepthSearchShapes.Create(kindA, ConvexGenerator.NextForm(random), sizeA, random, pool);
            var b = DepthSearchShapes.Create(kindB, ConvexGenerator.NextForm(random), sizeB, random, pool);
            var found = ConvexPoses.Create(a.Reference, b.Reference, (ConvexRegime)(i % Enum.GetValues<ConvexRegime>().Length), random);
            // As it is, turned by a little, or anything.
            var local = i % 3 == 2 ? random.NextDirection() : found.Depth.Normal + random.NextDirection() * (i % 3 * .2);
            var normal = Vector3.Normalize(ConvexGenerator.ToVector(ConvexRotation.From(found.Pose.OrientationA).Rotate(local)));
            shapes[i] = (a.Reference, b.Reference, found.Pose, (float)(.1 * found.Reference.Size));
            var placed = new PlacedChildren
            {
                OffsetB = found.Pose.OffsetB,
                OrientationA = found.Pose.OrientationA,
                OrientationB = found.Pose.OrientationB,
            };
            placed.TypeA = Write(ref placed.ShapeA, a);
            placed.TypeB = Write(ref placed.ShapeB, b);
            tests.Add(placed, normal, float.MaxValue, shapes[i].Margin, i, pool);
        }
        tests.Execute();
        var contactCount = 0;
        for (int i = 0; i < caseCount; ++i)
        {
            Assert.Equal(i, tests[i].Owner);
            contactCount += Check(tests[i], shapes[i].A, shapes[i].B, shapes[i].Pose, shapes[i].Margin);
        }
        Assert.InRange(contactCount, caseCount / 10, int.MaxValue);
        tests.Dispose(pool);
    }

    static int Check(in DirectedPair pair, ConvexShape a, ConvexShape b, ConvexPose pose, float margin)
    {
        var rotationA = ConvexRotation.From(pose.OrientationA);
        var rotationB = ConvexRotation.From(pose.OrientationB);
        Double3 normal = pair.Normal;
        // A's lowest point and B's highest, along the normal.
        var localA = rotationA.RotateBack(normal);
        var localB = rotationB.RotateBack(normal);
        var depth = Double3.Dot(pose.OffsetB, normal) + b.CoreExtent(localB) + b.Rounding + a.CoreExtent(-localA) + a.Rounding;
        var sizes = a.OuterRadius + a.Middle.Length + b.OuterRadius + b.Middle.Length + pose.OffsetB.Length();
        Assert.InRange(pair.Depth, depth - DepthRounding * sizes, depth + DepthRounding * sizes);
        for (int i = 0; i < pair.Manifold.Count; ++i)
        {
            pair.Manifold.GetContact(i, out var contact);
            Assert.InRange(contact.Depth, -margin, pair.Depth);
            Assert.InRange((pair.Normal - contact.Normal).Length(), 0, 1e-6f);
            Double3 halfway = contact.Normal * (contact.Depth * .5f);
            Double3 place = contact.Offset;
            var onA = a.SignedDistance(rotationA.RotateBack(place - halfway));
            var onB = b.SignedDistance(rotationB.RotateBack(place + halfway - (Double3)pose.OffsetB));
            Assert.InRange(onA, double.NegativeInfinity, SurfaceTolerance * a.OuterRadius + PlaceRounding * sizes);
            Assert.InRange(onB, double.NegativeInfinity, SurfaceTolerance * b.OuterRadius + PlaceRounding * sizes);
        }
        return pair.Manifold.Count;
    }

    ConvexContactManifold Look<TShapeA, TShapeB>(TShapeA a, TShapeB b, Vector3 offsetB, Quaternion orientationA, Vector3 normal, float margin = .1f)
        where TShapeA : unmanaged, IConvexShape where TShapeB : unmanaged, IConvexShape
    {
        var tests = new DirectedTests();
        var placed = new PlacedChildren { OffsetB = offsetB, OrientationA = orientationA, OrientationB = Quaternion.Identity };
        placed.TypeA = Write(ref placed.ShapeA, a);
        placed.TypeB = Write(ref placed.ShapeB, b);
        tests.Add(placed, normal, float.MaxValue, margin, 0, pool);
        tests.Execute();
        var manifold = tests[0].Manifold;
        tests.Dispose(pool);
        return manifold;
    }

    static readonly Triangle Floor = new(new(0, 0, 0), new(1, 0, 0), new(0, 0, 1));

    [Theory]
    [InlineData(.25f, .25f, true)]
    [InlineData(.01f, .01f, true)]
    [InlineData(-.01f, .25f, false)]
    [InlineData(.51f, .51f, false)]
    public void A_sphere_touches_what_its_lowest_point_is_over(float x, float z, bool touches)
    {
        var manifold = Look(new Sphere(.3f), Floor, new Vector3(-x, -.29f, -z), Quaternion.Identity, Vector3.UnitY);
        Assert.Equal(touches ? 1 : 0, manifold.Count);
        if (touches)
        {
            Assert.Equal(.01f, manifold.Contact0.Depth, 1e-6);
            Assert.Equal(0, (manifold.Contact0.Offset - new Vector3(0, -.295f, 0)).Length(), 1e-6);
        }
    }

    [Fact]
    public void Triangles_are_touched_from_the_front()
    {
        Assert.Equal(1, Look(new Sphere(.3f), Floor, new Vector3(-.2f, -.29f, -.2f), Quaternion.Identity, Vector3.UnitY).Count);
        Assert.Equal(0, Look(new Sphere(.3f), Floor, new Vector3(-.2f, .29f, -.2f), Quaternion.Identity, -Vector3.UnitY).Count);
    }

    /// <summary>An upright capsule and a tilted cylinder stand on a point that is no corner of their features.</summary>
    [Fact]
    public void The_lowest_point_of_what_is_round_is_a_contact()
    {
        var capsule = Look(new Capsule(.3f, 1), new Box(2, 2, 2), new Vector3(-.1f, -1.79f, 0), Quaternion.Identity, Vector3.UnitY);
        Assert.Equal(1, capsule.Count);
        Assert.Equal(.01f, capsule.Contact0.Depth, 1e-6);
        Assert.Equal(0, (capsule.Contact0.Offset - new Vector3(0, -.795f, 0)).Length(), 1e-5);
        // A corner of the rim is every 22.5 degrees; the lowest point is between two.
        var turn = Quaternion.Concatenate(Quaternion.CreateFromAxisAngle(Vector3.UnitY, MathF.PI / 16), Quaternion.CreateFromAxisAngle(Vector3.UnitZ, .2f));
        var lowest = Math.Cos(.2) * .5 + Math.Sin(.2) * .3;
        var cylinder = Look(new Cylinder(.3f, 1), new Box(2, 2, 2), new Vector3(-.1f, -1 - (float)lowest + .01f, 0), turn, Vector3.UnitY, 0);
        Assert.InRange(cylinder.Count, 1, 4);
        Assert.Equal(.01f, Enumerable.Range(0, cylinder.Count).Max(i => cylinder.GetDepth(i)), 1e-6);
    }

    [Fact]
    public void Boxes_touch_where_their_faces_overlap()
    {
        var manifold = Look(new Box(1, 1, 1), new Box(1, 1, 1), new Vector3(.75f, -.99f, .5f), Quaternion.Identity, Vector3.UnitY);
        Assert.Equal(4, manifold.Count);
        for (int i = 0; i < 4; ++i)
        {
            var (offset, depth) = (manifold.GetOffset(i), manifold.GetDepth(i));
            Assert.Equal(.01f, depth, 1e-6);
            Assert.True(Math.Abs(offset.X - .375f) is > .12498f and < .12502f && Math.Abs(offset.Z - .25f) is > .24998f and < .25002f, $"{offset}");
        }
        Assert.Equal(0, Look(new Box(1, 1, 1), new Box(1, 1, 1), new Vector3(1.01f, -.99f, .5f), Quaternion.Identity, Vector3.UnitY).Count);
    }

    [Fact]
    public void No_contacts_are_found_beyond_the_depth_that_is_wanted()
    {
        var tests = new DirectedTests();
        var placed = new PlacedChildren { OffsetB = new(0, -1.4f, 0), OrientationA = Quaternion.Identity, OrientationB = Quaternion.Identity };
        placed.TypeA = Write(ref placed.ShapeA, new Sphere(.5f));
        placed.TypeB = Write(ref placed.ShapeB, new Box(2, 2, 2));
        tests.Add(placed, Vector3.UnitY, .0999f, 0, 0, pool);
        tests.Add(placed, Vector3.UnitY, .1001f, 0, 1, pool);
        tests.Execute();
        Assert.Equal((0, 1), (tests[0].Manifold.Count, tests[1].Manifold.Count));
        Assert.Equal((false, true), (tests[0].IsWithinDepth, tests[1].IsWithinDepth));
        tests.Dispose(pool);
    }
}
