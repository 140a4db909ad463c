using System;
using System.Numerics;
using BepuPhysics.Collidables;
using BepuPhysics.CollisionDetection;
using BepuUtilities;
using Xunit;

namespace DemoTests.CollisionDetection.Seams;

/// <summary>What is found of three edges at once has the bits that it has edge by edge.</summary>
public class TriangleSurfaceTests
{
    readonly Random random = new(5);

    float Next() => random.NextSingle() * 2 - 1;

    Vector3 NextVector() => new(Next(), Next(), Next());

    Triangle NextTriangle(int kind) => kind switch
    {
        // A sliver, and one without a surface.
        0 => new(new(0, 0, 5), new(0, 0, -5), new(.01f * Next(), 0, Next())),
        1 => new(default, Vector3.UnitX, 2 * Vector3.UnitX),
        _ => new(3 * NextVector(), 3 * NextVector(), 3 * NextVector()),
    };

    TriangleCone NextCone()
    {
        var cone = new TriangleCone { FreeMask = random.Next(8) };
        for (int edge = 0; edge < 3; ++edge)
        {
            var angle = random.Next(3) == 0 ? 0 : random.NextSingle() * MathF.PI;
            cone.Cosines[edge] = MathF.Cos(angle);
            cone.Sines[edge] = angle == 0 ? 0 : MathF.Sin(angle);
        }
        return cone;
    }

    [Fact]
    public void Edges_side_by_side_are_as_alone()
    {
        var violatedCount = 0;
        for (int round = 0; round < 20_000; ++round)
        {
            var triangle = NextTriangle(round % 20);
            var orientation = Quaternion.Normalize(new(NextVector(), Next()));
            var cone = NextCone();
            var surface = new TriangleSurface(triangle, orientation);
            surface.Bound(cone);
            var edges = new Vector3[3];
            for (int edge = 0; edge < 3; ++edge)
                edges[edge] = Exact.Rotate(Corner(triangle, (edge + 1) % 3) - Corner(triangle, edge), orientation);
            var face = Exact.Cross(edges[0], edges[2]);
            var normal = Exact.Normalize(face);
            Assert.Equal((face, normal), (surface.Face, surface.Normal));
            var bounds = new Vector3[3];
            for (int edge = 0; edge < 3; ++edge)
            {
                var outwards = Exact.Normalize(Exact.Cross(normal, edges[edge]));
                bounds[edge] = (cone.FreeMask >> edge & 1) != 0 ? default : outwards * cone.Cosines[edge] - normal * cone.Sines[edge];
            }
            var direction = Exact.Normalize(NextVector());
            var expected = Violated(edges, bounds, direction);
            Assert.Equal(expected, surface.Violated(direction));
            violatedCount += expected == default ? 0 : 1;
        }
        Assert.InRange(violatedCount, 2_000, 18_000);
    }

    static Vector3 Corner(in Triangle triangle, int index) => index == 0 ? triangle.A : index == 1 ? triangle.B : triangle.C;

    // The bound that a direction is farthest beyond, of those edges that have the farthest point.
    static Vector3 Violated(Vector3[] edges, Vector3[] bounds, Vector3 direction)
    {
        Span<float> reaches = [0, Exact.Dot(direction, edges[0]), Exact.Dot(direction, -edges[2])];
        var farthest = MathHelper.Max(0, MathHelper.Max(reaches[1], reaches[2])) -
            TriangleSurface.Beyond * MathHelper.Max(Exact.Length(edges[0]), Exact.Length(edges[2]));
        var (most, bound) = (TriangleSurface.Beyond, default(Vector3));
        for (int edge = 0; edge < 3; ++edge)
        {
            var (start, end, opposite) = (reaches[edge], reaches[(edge + 1) % 3], reaches[(edge + 2) % 3]);
            var beyond = Exact.Dot(direction, bounds[edge]);
            if ((opposite < farthest || (start >= farthest && end >= farthest)) && beyond > most)
                (most, bound) = (beyond, bounds[edge]);
        }
        return bound;
    }
}
