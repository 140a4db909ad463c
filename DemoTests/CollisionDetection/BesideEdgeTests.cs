using System;
using System.Collections.Generic;
using System.Linq;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using Demos.Accuracy;
using Demos.References;
using DemoTests.Support;
using Xunit;
using Xunit.Abstractions;

namespace DemoTests.CollisionDetection;

/// <summary>Shapes that are apart beside edges and corners, where neither a face nor two crossing edges show their distance.</summary>
public class BesideEdgeTests(ITestOutputHelper output)
{
    const float Margin = .15f;

    /// <summary>Pairs of shapes with corners, or none but around a segment, that are tested in closed form.</summary>
    public static TheoryData<ConvexKind, ConvexKind> PairsWithoutSearch()
    {
        var data = new TheoryData<ConvexKind, ConvexKind>();
        foreach (var a in Enum.GetValues<ConvexKind>())
            foreach (var b in Enum.GetValues<ConvexKind>())
                if (a <= b && b != ConvexKind.Cylinder && ConvexPairLibrary.Supports(a, b) && !ConvexPairLibrary.Searches(a, b))
                    data.Add(a, b);
        return data;
    }

    /// <summary>Distance, place and normal of what is nearest, against the reference; 6,000 poses a pair.</summary>
    [Theory]
    [MemberData(nameof(PairsWithoutSearch))]
    public void Nearest_features_within_the_margin_have_their_contact(ConvexKind a, ConvexKind b)
    {
        const int shapeCount = 40, posesPerShape = 150;
        using var library = new ConvexPairLibrary();
        var random = new ConvexRandom(20261122, (ulong)((int)a * 6 + (int)b));
        var pairs = new List<(ConvexPairShape A, ConvexPairShape B, ConvexPose Pose, float Margin)>();
        for (int i = 0; i < shapeCount; ++i)
        {
            var shapeA = library.Create(Create(a, random));
            var shapeB = library.Create(Create(b, random));
            for (int j = 0; j < posesPerShape; ++j)
                pairs.Add((shapeA, shapeB, Beside(shapeA.Shape, shapeB.Shape, random), Margin));
        }
        var manifolds = library.Run(pairs);
        int near = 0, unseen = 0, ghosts = 0;
        double worstDepth = 0, worstNormal = 0, worstPlace = 0;
        for (int i = 0; i < pairs.Count; ++i)
        {
            var (reference, pose, offset, found) = ConvexPoses.Measure(pairs[i].A.Shape, pairs[i].B.Shape, pairs[i].Pose);
            double tolerance = 1e-5 * (reference.Size + reference.LargerSize);
            // What overlaps is tested elsewhere; triangles have a front and a back there.
            if (found.Depth > -tolerance)
                continue;
            near += found.Depth > -Margin ? 1 : 0;
            ref var manifold = ref manifolds[i];
            if (manifold.Count == 0)
            {
                unseen += found.Depth > -Margin + tolerance ? 1 : 0;
                continue;
            }
            ghosts += found.Depth < -Margin - tolerance ? 1 : 0;
            double deepest = double.MinValue;
            for (int j = 0; j < manifold.Count; ++j)
                deepest = Math.Max(deepest, manifold[j].Depth);
            var toA = ConvexRotation.From(pose.OrientationA);
            worstDepth = Math.Max(worstDepth, Math.Abs(deepest - found.Depth) / tolerance);
            worstNormal = Math.Max(worstNormal, (reference.DepthAlong(toA.RotateBack(manifold.Normal), offset) - found.Depth) / tolerance);
            for (int j = 0; j < manifold.Count; ++j)
            {
                var place = toA.RotateBack(manifold[j].Offset);
                var placeInB = reference.Rotation.RotateBack(place - offset);
                double outside = Math.Max(reference.A.SignedDistance(place), reference.B.SignedDistance(placeInB));
                worstPlace = Math.Max(worstPlace, (outside + manifold[j].Depth * .5) / tolerance);
            }
        }
        output.WriteLine($"{a}-{b}: {near} near, {unseen} unseen, {ghosts} ghosts; in tolerances: " +
            $"depth {worstDepth:g3}, normal {worstNormal:g3}, place {worstPlace:g3}");
        Assert.True(near > 1000);
        Assert.Equal((0, 0), (unseen, ghosts));
        // A corner of the overlap may stand for the nearest point: a triangle's from 2e-4 of the smaller size on, a box's from 5e-4.
        Assert.InRange(worstDepth, 0, b == ConvexKind.Triangle ? 20 : b == ConvexKind.Box && a == b ? 60 : 1);
        Assert.InRange(worstNormal, 0, b == ConvexKind.Box && a == b ? 60 : 1);
        // Contacts of faces lie beside them by a border.
        Assert.InRange(worstPlace, 0, 10);
    }

    /// <summary>
    /// A box 40 to 150 times as large has coordinates whose rounding turns a way of some millimetres so far that its other end overlaps.
    /// </summary>
    [Fact]
    public void Short_ways_to_large_boxes_separate_them_as_well_as_any_axis()
    {
        using var library = new ConvexPairLibrary();
        var random = new ConvexRandom(20261126, 0);
        var pairs = new List<(ConvexPairShape A, ConvexPairShape B, ConvexPose Pose, float Margin)>();
        for (int i = 0; i < 200; ++i)
        {
            var small = library.Create(Create(ConvexKind.Box, random));
            var large = library.Create(ConvexGenerator.Create(ConvexKind.Box, ConvexForm.Fat, random.Next(40, 60), random));
            for (int j = 0; j < 100; ++j)
                pairs.Add((small, large, Beside(small.Shape, large.Shape, random, .005), Margin));
        }
        var manifolds = library.Run(pairs);
        int near = 0;
        double worst = 0;
        for (int i = 0; i < pairs.Count; ++i)
        {
            var (reference, pose, offset, found) = ConvexPoses.Measure(pairs[i].A.Shape, pairs[i].B.Shape, pairs[i].Pose);
            // Rounding of the larger box, as everywhere in these tests, alone may hide what is nearer.
            if (found.Depth > -2e-6 * reference.LargerSize)
                continue;
            ++near;
            ref var manifold = ref manifolds[i];
            Assert.NotEqual(0, manifold.Count);
            var normal = ConvexRotation.From(pose.OrientationA).RotateBack(manifold.Normal);
            worst = Math.Max(worst, reference.DepthAlong(normal, offset) - found.AxisDepth);
        }
        output.WriteLine($"{near} near; the normal separates by up to {worst * 1000:f3} mm less than the best axis");
        Assert.True(near > 1000);
        // What an axis is kept for: 5e-4 of the half extents of the smaller box and 2e-6 of those of the larger one, each a box of an outer
        // radius of at most 1 and 60; and rounding at 60 m.
        Assert.InRange(worst, 0, (5e-4 * 1 + 2e-6 * 60) * Math.Sqrt(3) + 5e-5);
    }

    [Theory]
    [InlineData(1.02f, 1.02f, 0, .0282843f, 2)]
    [InlineData(1.02f, 1.02f, 1.02f, .0346410f, 1)]
    [InlineData(1.02f, 1.02f, .5f, .0282843f, 2)]
    [InlineData(1.1f, 1.02f, 0, .1019804f, 2)]
    [InlineData(-1.02f, 0, 1.02f, .0282843f, 2)]
    public void Unit_boxes_side_by_side_see_each_other_across_their_edges(float x, float y, float z, float distance, int count)
    {
        using var library = new ConvexPairLibrary();
        var box = library.Create(ConvexShape.Box(1, 1, 1));
        var manifold = library.Run([(box, box, new(new(x, y, z), Quaternion.Identity, Quaternion.Identity), Margin)])[0];
        Assert.Equal(count, manifold.Count);
        for (int i = 0; i < count; ++i)
            Assert.Equal(-distance, manifold[i].Depth, 1e-5);
    }

    /// <summary>Two boxes, the one thrown at an edge of the other with an edge ahead.</summary>
    [Theory]
    [InlineData(0, 10)]
    [InlineData(0, 20)]
    [InlineData(.02f, 10)]
    [InlineData(.1f, 10)]
    [InlineData(.02f, 30)]
    public void Boxes_thrown_edge_to_edge_sink_in_no_deeper_than_hulls(float aside, float speed)
    {
        double boxes = 0, hulls = 0;
        // Where in a step they meet is a matter of chance.
        for (int i = 0; i < 16; ++i)
        {
            boxes = Math.Max(boxes, DeepestPenetration(false, aside, speed, i / 16f));
            hulls = Math.Max(hulls, DeepestPenetration(true, aside, speed, i / 16f));
        }
        output.WriteLine($"{aside} m aside at {speed} m/s: boxes {boxes:f4} m, hulls {hulls:f4} m");
        Assert.InRange(boxes, 0, hulls + .002);
    }

    static double DeepestPenetration(bool asHulls, float aside, float speed, float phase)
    {
        var settings = new AccuracySettings { Gravity = default };
        using var world = new AccuracyWorld(settings);
        var across = Vector3.Normalize(new Vector3(1, 1, 0));
        var along = new Vector3(-across.Y, across.X, 0);
        var start = across * (-1.6f - speed * settings.Dt * phase) + along * aside;
        var inertia = new Box(1, 1, 1).ComputeInertia(1);
        TypedIndex shape;
        if (asHulls)
        {
            Vector3[] points = [.. Enumerable.Range(0, 8).Select(i => new Vector3(i & 1, i >> 1 & 1, i >> 2) - new Vector3(.5f))];
            shape = world.Simulation.Shapes.Add(new ConvexHull(points, world.Simulation.BufferPool, out _));
        }
        else
            shape = world.Simulation.Shapes.Add(new Box(1, 1, 1));
        BodyHandle Add(Vector3 place, Vector3 velocity) => world.Bodies.Add(BodyDescription.CreateDynamic(
            new RigidPose(place), new BodyVelocity(velocity), inertia, new CollidableDescription(shape), new BodyActivityDescription(-1)));
        var still = Add(default, default);
        var thrown = Add(start, across * speed);
        var box = ConvexShape.Box(1, 1, 1);
        double deepest = 0;
        for (int step = 0; step < 40; ++step)
        {
            world.Step(settings.Dt);
            var a = world.Bodies[still].Pose;
            var b = world.Bodies[thrown].Pose;
            deepest = Math.Max(deepest, ConvexPoses.Measure(box, box, new(b.Position - a.Position, a.Orientation, b.Orientation)).Depth.Depth);
        }
        world.Bodies.Remove(still);
        world.Bodies.Remove(thrown);
        world.Simulation.Shapes.RemoveAndDispose(shape, world.Simulation.BufferPool);
        return deepest;
    }

    static ConvexShape Create(ConvexKind kind, ConvexRandom random) =>
        ConvexGenerator.Create(kind, ConvexForm.Fat, random.Next(.4, 1), random);

    /// <summary>A vertex, or a point of an edge, beside one of the other; half of the shapes with edges that are parallel.</summary>
    static ConvexPose Beside(ConvexShape a, ConvexShape b, ConvexRandom random, double farthest = 1.3 * Margin)
    {
        var orientationA = random.Next(2) == 0 ? Quaternion.Identity : random.NextOrientation();
        // Turned by whole eighths from a frame that is A's.
        var orientationB = random.Next(2) == 0 ? Quaternion.Normalize(orientationA * random.NextAligned()) : random.NextOrientation();
        var distance = random.Next(.001, farthest) + a.Rounding + b.Rounding;
        var offset = ConvexRotation.From(orientationA).Rotate(PointOf(a, random)) + random.NextDirection() * distance -
            ConvexRotation.From(orientationB).Rotate(PointOf(b, random));
        return new(ConvexGenerator.ToVector(offset), orientationA, orientationB);
    }

    static Double3 PointOf(ConvexShape shape, ConvexRandom random)
    {
        if (shape.Edges.Length == 0 || random.Next(2) == 0)
            return shape.Vertices[random.Next(shape.Vertices.Length)];
        var edge = shape.Edges[random.Next(shape.Edges.Length)];
        var part = random.Next();
        return shape.Vertices[edge.A] * (1 - part) + shape.Vertices[edge.B] * part;
    }
}
