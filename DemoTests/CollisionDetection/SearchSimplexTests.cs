using System;
using System.Numerics;
using BepuPhysics.CollisionDetection;
using BepuUtilities;
using Demos.References;
using Xunit;

namespace DemoTests.CollisionDetection;

/// <summary>The closest point of a simplex, where rounding is hardest on it: in triangles that are thousands of times as long as wide.</summary>
public class SearchSimplexTests
{
    // Of the largest shapes the search works with, in its own units, a few times; what it tolerates there is a millionth at the least.
    const float Length = 2.5f;
    const double Tolerance = 1e-6;

    [Theory]
    [InlineData(3e-1f), InlineData(1e-2f), InlineData(1e-3f), InlineData(3e-4f)]
    public void A_needle_is_as_far_from_the_target_as_it_is(float width)
    {
        var random = new Random(1);
        for (int i = 0; i < 2000; ++i)
        {
            var target = default(Vector3Wide);
            var vertices = new SearchVertex[3];
            var expected = new double[Vector<float>.Count];
            var tipIsNew = (i & 1) == 0;
            for (int lane = 0; lane < Vector<float>.Count; ++lane)
            {
                // The tip is at one end, and the two other corners are a width apart at the other.
                var tip = Direction(random) * Length;
                var other = -tip + Direction(random) * width;
                var third = other + Vector3.Normalize(Vector3.Cross(tip, Direction(random))) * width;
                var inside = tip + (other - tip) * (.2f + .3f * random.NextSingle()) + (third - tip) * (.2f + .3f * random.NextSingle());
                var normal = Vector3.Normalize(Vector3.Cross(other - tip, third - other));
                var above = inside + normal * (1e-3f + .1f * random.NextSingle());
                Vector3Wide.WriteSlot(above, lane, ref target);
                Vector3Wide.WriteSlot(tipIsNew ? tip : third, lane, ref vertices[0].Point);
                Vector3Wide.WriteSlot(other, lane, ref vertices[1].Point);
                Vector3Wide.WriteSlot(tipIsNew ? third : tip, lane, ref vertices[2].Point);
                expected[lane] = Height(above, tip, other, third);
            }
            var simplex = new SearchSimplex { A = vertices[1], B = vertices[2], C = vertices[2] };
            simplex.Add(vertices[0], target, Vector<int>.AllBitsSet, Vector<int>.Zero, 2, out var offset, out _);
            for (int lane = 0; lane < Vector<float>.Count; ++lane)
            {
                Vector3Wide.ReadSlot(ref offset, lane, out var found);
                // The direction is free to lean over to a side of the needle, which is next to nothing farther away.
                Assert.InRange(((Double3)found).Length, expected[lane] - Tolerance, expected[lane] + Tolerance);
            }
        }
    }

    // Simplices that a triangle and a cylinder ended with, slivers all but on a line, of which rounding put the point a hundredth away.
    [Theory]
    [InlineData(new[] { -1.0672928f, -.9277656f, .5508149f }, new[] { -1.0671666f, -.9276491f, .55074465f }, new[] { .55258733f, .4803447f, -.28517947f },
        new[] { -4.1740027e-8f, -2.2139699e-7f, -4.5378928e-7f }, 0)]
    [InlineData(new[] { -.44146004f, .1598867f, .2876452f }, new[] { 1.0429051f, -.3791618f, -.6795317f }, new[] { 1.0430456f, -.3792187f, -.67965853f },
        new[] { 0f, 0f, 0f }, 4.10825e-4)]
    public void Weights_of_slivers_are_those_of_the_closest_point(float[] a, float[] b, float[] c, float[] target, double distance)
    {
        var simplex = default(SearchSimplex);
        simplex.A.Point = Vector3Wide.Broadcast(new(a));
        simplex.B.Point = Vector3Wide.Broadcast(new(b));
        simplex.C.Point = Vector3Wide.Broadcast(new(c));
        var weights = simplex.GetWeights(Vector3Wide.Broadcast(new(target)));
        Double3 found = default;
        for (int i = 0; i < 3; ++i)
        {
            double weight = (i == 0 ? weights.X : i == 1 ? weights.Y : weights.Z)[0];
            Assert.InRange(weight, 0, 1);
            found += (Double3)new Vector3(i == 0 ? a : i == 1 ? b : c) * weight;
        }
        Assert.Equal(1, weights.X[0] + weights.Y[0] + weights.Z[0], 1e-6);
        Assert.InRange((found - new Vector3(target)).Length, 0, distance + 2 * Tolerance);
    }

    // In the simplex of a hull's corner the weights are one and two zeros, whose signs are those of the way to the target.
    [Fact]
    public void Weights_of_points_have_the_same_bits_beside_triangles_that_the_target_is_beside_of()
    {
        var triangle = new SearchSimplex();
        triangle.A.Point = Vector3Wide.Broadcast(new(-3, 0, 0));
        triangle.B.Point = Vector3Wide.Broadcast(new(-2, 0, 0));
        triangle.C.Point = Vector3Wide.Broadcast(new(-3, 1, 0));
        var isPoint = Vector.Equals(Vector<int>.Indices & Vector<int>.One, Vector<int>.Zero);
        for (int signs = 0; signs < 8; ++signs)
        {
            var corner = new Vector3((signs & 1) == 0 ? .3f : -.3f, (signs & 2) == 0 ? .5f : -.5f, (signs & 4) == 0 ? .7f : -.7f);
            var point = new SearchSimplex();
            point.A.Point = point.B.Point = point.C.Point = Vector3Wide.Broadcast(corner);
            var mixed = triangle;
            mixed.A.Keep(Vector.OnesComplement(isPoint), point.A);
            mixed.B.Keep(Vector.OnesComplement(isPoint), point.B);
            mixed.C.Keep(Vector.OnesComplement(isPoint), point.C);
            var alone = point.GetWeights(Vector3Wide.Zero);
            var beside = mixed.GetWeights(Vector3Wide.Zero);
            Assert.Equal(Bits(alone), Bits(beside));
        }

        static int[] Bits(Vector3Wide weights) =>
            [BitConverter.SingleToInt32Bits(weights.X[0]), BitConverter.SingleToInt32Bits(weights.Y[0]), BitConverter.SingleToInt32Bits(weights.Z[0])];
    }

    // Over the plane of the triangle as its corners were rounded.
    static double Height(Vector3 point, Vector3 a, Vector3 b, Vector3 c)
    {
        var normal = Double3.Cross((Double3)b - a, (Double3)c - a);
        return Math.Abs(Double3.Dot((Double3)point - a, normal)) / normal.Length;
    }

    static Vector3 Direction(Random random)
    {
        while (true)
        {
            var v = new Vector3(random.NextSingle() - .5f, random.NextSingle() - .5f, random.NextSingle() - .5f);
            if (v.LengthSquared() is > .01f and < .25f)
                return Vector3.Normalize(v);
        }
    }
}
