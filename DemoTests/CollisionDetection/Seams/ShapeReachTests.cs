using System;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuPhysics.CollisionDetection;
using BepuUtilities.Memory;
using Demos.References;
using DemoTests.Support;
using Xunit;

namespace DemoTests.CollisionDetection.Seams;

/// <summary>What is known of a direction in closed form, without a test, against a reference in double precision and against the test that is spared.</summary>
public sealed unsafe class ShapeReachTests : IDisposable
{
    const int CaseCount = 200;
    // Part of the sizes of both shapes together.
    const double DepthRounding = 2e-6;

    readonly BufferPool pool = new();

    public void Dispose() => pool.Clear();

    public static TheoryData<ConvexKind, ConvexKind> Pairs => DirectedPairTests.Pairs;

    PlacedChildren Create(ConvexKind kindA, ConvexKind kindB, int number, ConvexRandom random, out Vector3 normal, out double depth, out double sizes)
    {
        var (sizeA, sizeB) = ConvexPoses.NextSizes(random);
        var a = DepthSearchShapes.Create(kindA, ConvexGenerator.NextForm(random), sizeA, random, pool);
        var b = DepthSearchShapes.Create(kindB, ConvexGenerator.NextForm(random), sizeB, random, pool);
        var found = ConvexPoses.Create(a.Reference, b.Reference, (ConvexRegime)(number % Enum.GetValues<ConvexRegime>().Length), random);
        var local = number % 3 == 2 ? random.NextDirection() : found.Depth.Normal + random.NextDirection() * (number % 3 * .2);
        var rotationA = ConvexRotation.From(found.Pose.OrientationA);
        normal = Vector3.Normalize(ConvexGenerator.ToVector(rotationA.Rotate(local)));
        var placed = new PlacedChildren
        {
            OffsetB = found.Pose.OffsetB,
            OrientationA = found.Pose.OrientationA,
            OrientationB = found.Pose.OrientationB,
        };
        placed.TypeA = DirectedPairTests.Write(ref placed.ShapeA, a);
        placed.TypeB = DirectedPairTests.Write(ref placed.ShapeB, b);
        var localA = rotationA.RotateBack(normal);
        var localB = ConvexRotation.From(found.Pose.OrientationB).RotateBack(normal);
        depth = Double3.Dot(found.Pose.OffsetB, normal) + b.Reference.CoreExtent(localB) + b.Reference.Rounding +
            a.Reference.CoreExtent(-localA) + a.Reference.Rounding;
        sizes = a.Reference.OuterRadius + a.Reference.Middle.Length + b.Reference.OuterRadius + b.Reference.Middle.Length + found.Pose.OffsetB.Length();
        return placed;
    }

    [Theory, MemberData(nameof(Pairs))]
    public void Depths_are_those_of_the_reference(ConvexKind kindA, ConvexKind kindB)
    {
        var random = new ConvexRandom(ConvexPoses.DevelopmentSeed, (ulong)((int)kindA * 6 + (int)kindB));
        for (int i = 0; i < CaseCount; ++i)
        {
            var placed = Create(kindA, kindB, i, random, out var normal, out var depth, out var sizes);
            Assert.InRange(placed.DepthAlong(normal), depth - DepthRounding * sizes, depth + DepthRounding * sizes);
        }
    }

    /// <summary>What is said to be deeper without a test is so for the test, which looks along faces too; and it is said of what is much deeper.</summary>
    [Theory, MemberData(nameof(Pairs))]
    public void What_is_deeper_for_sure_is_so_for_the_test(ConvexKind kindA, ConvexKind kindB)
    {
        var random = new ConvexRandom(ConvexPoses.DevelopmentSeed, (ulong)(300 + (int)kindA * 6 + (int)kindB));
        var tests = new DirectedTests();
        var isDeeper = new bool[CaseCount];
        for (int i = 0; i < CaseCount; ++i)
        {
            var placed = Create(kindA, kindB, i, random, out var normal, out var depth, out var sizes);
            // From what is not known to what must be.
            var greatest = (float)(depth - sizes * (i % 10) * .01);
            isDeeper[i] = placed.AreDeeper(normal, greatest);
            Assert.False(isDeeper[i] && i % 10 == 0, $"{i}");
            Assert.True(isDeeper[i] || i % 10 < 6, $"{i}");
            tests.Add(placed, normal, greatest, (float)sizes, i, pool);
        }
        tests.Execute();
        for (int i = 0; i < CaseCount; ++i)
            Assert.False(isDeeper[i] && tests[i].IsWithinDepth, $"{i}");
        tests.Dispose(pool);
    }

    /// <summary>A ball in a corner has no way out of the floor to its side, nor up out of the wall: nobody has to look for one.</summary>
    [Fact]
    public void A_ball_in_a_corner_of_boxes_asks_for_no_test()
    {
        var memory = new SeamMemory();
        var ball = new Sphere(.3f);
        Box[] boxes = [new(10, 1, 10), new(1, 10, 10)];
        Vector3[] normals = [Vector3.UnitY, Vector3.UnitX];
        var (results, placed) = (new ChildResult[boxes.Length], new PlacedChildren[boxes.Length]);
        for (int i = 0; i < boxes.Length; ++i)
        {
            var depth = .001f * (i + 1);
            fixed (Box* box = &boxes[i])
            {
                Place(ref placed[i], &ball, Box.Id, box, -(ball.Radius + .5f - depth) * normals[i]);
            }
            results[i].Children = new(0, i);
            results[i].Manifold.Count = 1;
            results[i].Manifold.Normal = normals[i];
            results[i].Manifold.Contact0 = new() { Offset = -ball.Radius * normals[i], Depth = depth };
        }
        Agree(ref memory, results, placed);
        Assert.Equal((1, 1), (results[0].Manifold.Count, results[1].Manifold.Count));
        Assert.Equal((normals[0], normals[1]), (results[0].Manifold.Normal, results[1].Manifold.Normal));
        Assert.Equal(0, memory.Tests.FoundCount);
        memory.Dispose(pool);
    }

    /// <summary>A ball on one of two triangles of a floor is beside the other, whose edge is near: nothing is looked at for that.</summary>
    [Fact]
    public void A_ball_beside_an_edge_asks_for_no_test()
    {
        var memory = new SeamMemory();
        var ball = new Sphere(.3f);
        Triangle[] triangles = [new(new(0, 0, 0), new(1, 0, 0), new(0, 0, 1)), new(new(1, 0, 0), new(1, 0, 1), new(0, 0, 1))];
        var (results, placed) = (new ChildResult[triangles.Length], new PlacedChildren[triangles.Length]);
        var center = new Vector3(.4f, .29f, .4f);
        for (int i = 0; i < triangles.Length; ++i)
        {
            fixed (Triangle* triangle = &triangles[i])
            {
                Place(ref placed[i], &ball, Triangle.Id, triangle, -center, new() { Cosines = Vector3.One });
            }
            var nearest = i == 0 ? center with { Y = 0 } : new Vector3(.5f, 0, .5f);
            results[i].Children = new(0, i);
            results[i].Manifold.Count = 1;
            results[i].Manifold.Normal = Vector3.Normalize(center - nearest);
            results[i].Manifold.Contact0 = new() { Offset = nearest - center, Depth = ball.Radius - (center - nearest).Length() };
        }
        Agree(ref memory, results, placed);
        Assert.Equal((1, 0), (results[0].Manifold.Count, results[1].Manifold.Count));
        Assert.Equal(0, memory.Tests.FoundCount);
        memory.Dispose(pool);
    }

    static void Place(ref PlacedChildren placed, Sphere* ball, int type, void* shape, Vector3 offset, TriangleCone cone = default) =>
        placed.Write(new ChildShapes
        {
            TypeA = Sphere.Id,
            ShapeA = ball,
            TypeB = type,
            ShapeB = shape,
            OffsetB = offset,
            OrientationA = Quaternion.Identity,
            OrientationB = Quaternion.Identity,
            ConeB = cone,
        }, moverIsB: false, .1f);

    void Agree(ref SeamMemory memory, ChildResult[] results, PlacedChildren[] placed)
    {
        fixed (ChildResult* first = results)
        fixed (PlacedChildren* places = placed)
        {
            memory.Add(first, places, results.Length, owner: 0, leavesToNeighbours: false, pool);
            SeamRounds.Run(ref memory, DefaultTypes.CreateDefaultCollisionTaskRegistry(), pool);
        }
    }
}
