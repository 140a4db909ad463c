using System;
using System.Collections.Generic;
using System.Linq;
using System.Numerics;
using System.Threading.Tasks;
using Demos.References;
using Xunit;
using Xunit.Abstractions;

namespace DemoTests.Support;

/// <summary>The reference against closed forms, against all pairs of edges, and against samples of all directions.</summary>
public class ConvexReferenceTests(ITestOutputHelper output)
{
    static readonly bool isFull = Environment.GetEnvironmentVariable("PHYSICS_FULL_TESTS") is { Length: > 0 };

    static ConvexCase[] CreateCases(ConvexKind kindA, ConvexKind kindB, int countPerRegime)
    {
        var regimes = Enum.GetValues<ConvexRegime>();
        var random = new ConvexRandom(ConvexPoses.DevelopmentSeed, (ulong)((int)kindA * 6 + (int)kindB));
        return [.. Enumerable.Range(0, countPerRegime * regimes.Length).Select(i =>
        {
            var (sizeA, sizeB) = ConvexPoses.NextSizes(random);
            var a = ConvexGenerator.Create(kindA, ConvexGenerator.NextForm(random), sizeA, random);
            var b = ConvexGenerator.Create(kindB, ConvexGenerator.NextForm(random), sizeB, random);
            return ConvexPoses.Create(a, b, regimes[i % regimes.Length], random);
        })];
    }

    static IEnumerable<(ConvexKind A, ConvexKind B)> Pairs =>
        from a in Enum.GetValues<ConvexKind>() from b in Enum.GetValues<ConvexKind>() where a <= b select (a, b);

    /// <summary>The middle of a face is on the border of the two triangles that it consists of, which is no edge of the box.</summary>
    [Fact]
    public void A_ball_over_the_middle_of_a_boxs_face_is_as_far_as_the_face()
    {
        var random = new ConvexRandom(20261126, 0);
        for (int i = 0; i < 2000; ++i)
        {
            var ball = ConvexShape.Sphere((float)random.Next(.1, 200));
            var box = ConvexShape.Box((float)random.Next(.1, 200), (float)random.Next(.1, 200), (float)random.Next(.1, 200));
            var rotation = ConvexRotation.From(random.Next(2) == 0 ? random.NextAligned() : random.NextOrientation());
            var gap = random.Next(.001, 10);
            var height = new[] { box.Vertices.Max(v => v.X), box.Vertices.Max(v => v.Y), box.Vertices.Max(v => v.Z) };
            var face = random.Next(3);
            Double3[] axes = [new(1, 0, 0), new(0, 1, 0), new(0, 0, 1)];
            var offset = rotation.Rotate(axes[face]) * (height[face] + ball.OuterRadius + gap);
            Assert.Equal(-gap, new ConvexReference(ball, box, rotation).Find(offset).Depth, 1e-10);
        }
    }

    [Fact]
    public void Samples_of_all_directions_find_nothing_less_and_come_ever_closer()
    {
        var count = isFull ? 200 : 4;
        var worstBelow = 0.0;
        foreach (var (a, b) in Pairs)
        {
            var cases = CreateCases(a, b, count);
            double[] coarse = new double[cases.Length], fine = new double[cases.Length];
            Enumerate(cases);
            Parallel.For(0, cases.Length, i =>
            {
                var pair = cases[i];
                coarse[i] = (ConvexSampling.FindDepth(pair.Reference, pair.LocalOffsetB, 3000, out _) - pair.Depth.Depth) / pair.Reference.Size;
                fine[i] = (ConvexSampling.FindDepth(pair.Reference, pair.LocalOffsetB, 12000, out _) - pair.Depth.Depth) / pair.Reference.Size;
            });
            var before = Environment.CpuUsage.UserTime;
            Enumerate(cases);
            var enumerated = (Environment.CpuUsage.UserTime - before).TotalMicroseconds / cases.Length;
            worstBelow = Math.Max(worstBelow, -Math.Min(coarse.Min(), fine.Min()));
            output.WriteLine($"{a}-{b}: least {Math.Min(coarse.Min(), fine.Min()):e1}; 3,000 samples {Describe(coarse)}, 12,000 samples "
                + $"{Describe(fine)}; {enumerated:f0} us of processor time when run alone");
        }
        // Rounding of sums of sizes that differ by up to 100, and the last step of the descent.
        Assert.True(worstBelow < 1e-10, $"{worstBelow}");

        static void Enumerate(ConvexCase[] cases)
        {
            foreach (var pair in cases)
                new ConvexReference(pair.Reference.A, pair.Reference.B, pair.Reference.Rotation).Find(pair.LocalOffsetB);
        }

        static string Describe(double[] errors)
        {
            Array.Sort(errors);
            return $"p50 {errors[errors.Length / 2]:e1} p99 {errors[errors.Length * 99 / 100]:e1} worst {errors[^1]:e1}";
        }
    }

    [Fact]
    public void Bounds_from_points_of_the_difference_show_that_nothing_is_less()
    {
        var count = 0;
        var shown = 0;
        foreach (var (a, b) in Pairs)
        {
            foreach (var pair in CreateCases(a, b, isFull ? 100 : 5))
            {
                var reference = pair.Reference;
                var rounding = reference.A.Rounding + reference.B.Rounding;
                // Directions that are written down in doubles are off by 1e-16, and sizes differ by up to 100.
                var limit = pair.Depth.Depth - rounding - 1e-9 * reference.LargerSize;
                var gap = 1e-6 * reference.Size;
                var isShown = ConvexBranching.Search(Support, () => limit - gap, m => Assert.Fail($"{a}-{b}: {pair.Pose}, less along {m}"), 0, 3000);
                ++count;
                shown += isShown ? 1 : 0;

                Double3 Support(Double3 m) => Farthest(reference.A, m)
                    - reference.Rotation.Rotate(Farthest(reference.B, -reference.Rotation.RotateBack(m))) - pair.LocalOffsetB;
            }
        }
        output.WriteLine($"{shown} of {count}");
        // Spheres and capsules in one point, and round shapes around one axis, are as deep along whole circles, and there is no end of bounds.
        Assert.True(shown > .95 * count, $"{shown} of {count}");

        // Of the core, as the radius around it is the same in all directions.
        static Double3 Farthest(ConvexShape shape, Double3 m)
        {
            if (!shape.IsCylinder)
                return shape.Vertices.MaxBy(v => Double3.Dot(v, m));
            var across = Math.Sqrt(m.X * m.X + m.Z * m.Z);
            var scale = across > 0 ? shape.Radius / across : 0;
            return new(m.X * scale, Math.CopySign(shape.HalfLength, m.Y), m.Z * scale);
        }
    }

    [Fact]
    public void Pairs_of_edges_that_cannot_meet_are_left_out_without_loss()
    {
        var worst = 0.0;
        foreach (var (a, b) in Pairs.Where(p => p.A is ConvexKind.Box or ConvexKind.Hull && p.B is ConvexKind.Box or ConvexKind.Hull))
        {
            foreach (var pair in CreateCases(a, b, isFull ? 300 : 5))
            {
                var all = new ConvexPolytopes(pair.Reference.A, pair.Reference.B, pair.Reference.Rotation, true);
                var depth = all.Find(pair.LocalOffsetB, new(0)).AxisDepth;
                worst = Math.Max(worst, Math.Abs(pair.Depth.AxisDepth - depth) / pair.Reference.Size);
            }
        }
        Assert.True(worst < 1e-12, $"{worst}");
    }

    [Fact]
    public void The_distance_of_features_is_the_depth_along_its_normal()
    {
        // Both ways bound the distance, one from above and one from below: where they agree neither can be wrong.
        var worst = 0.0;
        foreach (var (a, b) in Pairs)
        {
            foreach (var pair in CreateCases(a, b, isFull ? 300 : 5))
            {
                var along = pair.Reference.DepthAlong(pair.Depth.Normal, pair.LocalOffsetB);
                var distance = pair.Reference.A.Rounding + pair.Reference.B.Rounding - pair.Depth.Depth;
                // The direction of a distance that is nearly nothing is not known.
                if (Math.Abs(distance) > 1e-6 * pair.Reference.LargerSize)
                    worst = Math.Max(worst, Math.Abs(along - pair.Depth.Depth) / pair.Reference.Size);
            }
        }
        // Ten digits of a direction are left at a distance of a millionth, and sizes differ by up to 100.
        Assert.True(worst < 1e-8, $"{worst}");
    }

    [Fact]
    public void A_box_made_of_points_is_the_same_box()
    {
        var random = new ConvexRandom(5);
        for (int i = 0; i < 200; ++i)
        {
            var box = ConvexGenerator.Create(ConvexKind.Box, ConvexGenerator.NextForm(random), 1, random);
            var hull = ConvexShape.Hull([.. box.Vertices.Select(ConvexGenerator.ToVector)]);
            Assert.Equal((6, 12), (hull.FaceNormals.Length, hull.Edges.Length));
            var other = ConvexGenerator.Create((ConvexKind)random.Next(6), ConvexGenerator.NextForm(random), 1, random);
            var pair = ConvexPoses.Create(other, box, (ConvexRegime)random.Next(6), random);
            var withHull = new ConvexReference(other, hull, pair.Reference.Rotation).Find(pair.LocalOffsetB);
            Assert.Equal(pair.Depth.Depth, withHull.Depth, 1e-12);
            var point = random.NextDirection() * random.Next(0, 2);
            Assert.Equal(box.SignedDistance(point), hull.SignedDistance(point), 1e-12);
        }
    }

    /// <summary>A is a cylinder of radius 1/2 and length 2 around Y, at the origin; B as told, its centre at (x, y, z).</summary>
    [Theory]
    // Cylinder of radius 1/4 and length 1 around the same line: cap on cap, inside, apart.
    [InlineData("coaxial", 0, 0, 1.4, 0, 0.1)]
    [InlineData("coaxial", 0, 0, 1.75, 0, -0.25)]
    [InlineData("coaxial", 0, 0, 0, 0, 0.75)]
    // Beside each other; apart at the rims.
    [InlineData("parallel", 0, 0.7, 0.1, 0, 0.05)]
    [InlineData("parallel", 0, 0.9, 0.1, 0, -0.15)]
    [InlineData("parallel", 0, 1.05, 1.9, 0, -0.5)]
    // Axes that cross at 1.1 radians: side on side.
    [InlineData("crossing", 1.1, 0.7, 0, 0, 0.05)]
    [InlineData("crossing", 1.1, -0.8, 0, 0, -0.05)]
    // Axes at a right angle: the side of B on the cap of A.
    [InlineData("crossing", 1.5707963267948966, 0, 1.2, 0, 0.05)]
    [InlineData("crossing", 1.5707963267948966, 0, 1.3, 0, -0.05)]
    // Tilted by 0.3 above the middle of A's cap: the lowest point of B's rim is at 0.5 cos t + 0.25 sin t below its centre.
    [InlineData("crossing", 0.3, 0, 1.5, 0, 0.5 * 0.9553364891256061 + 0.25 * 0.2955202066613396 - 0.5)]
    // Boxes with sides of 1: on the cap, beside the side, inside, past the rim.
    [InlineData("box", 0, 0, 1.4, 0, 0.1)]
    [InlineData("box", 0, 0.9, 0.2, 0, 0.1)]
    [InlineData("box", 0, 0, 0, 0, 1.0)]
    [InlineData("box", 0, 1.3, 1.9, 0, -0.5)]
    // Turned about X: the edge of the box, 1/sqrt(2) from its centre, towards the cap, and along Z towards the side.
    [InlineData("box", 0.7853981633974483, 0, 1.6, 0, 0.10710678118654757)]
    [InlineData("box", 0.7853981633974483, 0, 0, 1.1, 0.10710678118654757)]
    public void Cylinders_agree_with_closed_forms(string other, double turn, double x, double y, double z, double depth)
    {
        var a = ConvexShape.Cylinder(0.5f, 2);
        var b = other == "box" ? ConvexShape.Box(1, 1, 1) : ConvexShape.Cylinder(0.25f, 1);
        var rotation = new ConvexRotation(new(1, 0, 0), new(0, Math.Cos(turn), Math.Sin(turn)), new(0, -Math.Sin(turn), Math.Cos(turn)));
        var found = new ConvexReference(a, b, rotation).Find(new(x, y, z));
        Assert.Equal(depth, found.Depth, 1e-9);
        // The other way around, in B's frame.
        var swapped = new ConvexReference(b, a, rotation.Transposed).Find(-rotation.RotateBack(new(x, y, z)));
        Assert.Equal(depth, swapped.Depth, 1e-9);
    }

    [Fact]
    public void All_of_several_least_normals_are_told()
    {
        var cubes = new ConvexReference(ConvexShape.Box(1, 1, 1), ConvexShape.Box(2, 2, 2), ConvexRotation.Identity).Find(Double3.Zero);
        Assert.Equal(1.5, cubes.Depth, 1e-12);
        Assert.Equal(6, cubes.Normals.Length);
        var above = new ConvexReference(ConvexShape.Box(1, 1, 1), ConvexShape.Box(1, 1, 1), ConvexRotation.Identity).Find(new(0, 0.9, 0));
        Assert.Equal(0.1, above.Depth, 1e-12);
        Assert.Equal(new Double3(0, -1, 0), Assert.Single(above.Normals));
    }

    [Fact]
    public void Points_are_inside_both_within_a_tolerance()
    {
        var pair = new ConvexReference(ConvexShape.Sphere(1), ConvexShape.Cylinder(1, 2), ConvexRotation.From(Quaternion.Identity));
        Assert.True(pair.InsideBoth(new(0.9, 0, 0), new(1.8, 0, 0), 1e-12));
        Assert.False(pair.InsideBoth(new(0.75, 0, 0), new(1.8, 0, 0), 1e-3));
        Assert.True(pair.InsideBoth(new(0.75, 0, 0), new(1.8, 0, 0), 0.0501));
    }
}
