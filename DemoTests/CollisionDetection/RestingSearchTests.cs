using System;
using System.Collections.Generic;
using System.Linq;
using System.Numerics;
using BepuUtilities.Memory;
using Demos.References;
using DemoTests.Support;
using Xunit;

namespace DemoTests.CollisionDetection;

/// <summary>
/// Cylinders that rest on a face, or nearly: the search goes straight to where they are least deep. That the depth is right is told by the reference,
/// which knows nothing of faces that rest.
/// </summary>
public class RestingSearchTests
{
    public enum Side { End, Line }

    const int Count = 128;
    // Part of the smaller size by which a descent may stop beside its target.
    const double StopTolerance = 2.1e-5;

    public static TheoryData<ConvexKind, Side, Side> Pairs => new()
    {
        { ConvexKind.Box, Side.End, Side.End }, { ConvexKind.Box, Side.End, Side.Line },
        { ConvexKind.Triangle, Side.End, Side.End }, { ConvexKind.Triangle, Side.End, Side.Line },
        { ConvexKind.Cylinder, Side.End, Side.End }, { ConvexKind.Cylinder, Side.End, Side.Line },
        { ConvexKind.Cylinder, Side.Line, Side.End }, { ConvexKind.Cylinder, Side.Line, Side.Line },
    };

    [Theory, MemberData(nameof(Pairs))]
    public void What_rests_takes_one_support_point(ConvexKind kind, Side sideA, Side sideB)
    {
        var outcomes = Search(kind, sideA, sideB, 3e-3, out _);

        Assert.InRange(outcomes.Count(outcome => outcome.Evaluations == 1), Count * 97 / 100, Count);
    }

    [Theory, MemberData(nameof(Pairs))]
    public void What_rests_has_the_least_depth(ConvexKind kind, Side sideA, Side sideB)
    {
        // Flat to rounding, as bodies come to rest; on edges; leaning so far that it hardly counts as resting, and farther.
        foreach (var tilt in new[] { 0, 1e-7, 1e-5, 1e-3, 0.02, 0.06, 0.2 })
        {
            var outcomes = Search(kind, sideA, sideB, tilt, out var cases);
            for (int i = 0; i < Count; ++i)
            {
                var (reference, _, offset, expected) = cases[i];
                var label = $"tilt {tilt}, {i}: {outcomes[i]}, expected {expected.Depth} along {expected.Normal}";
                Assert.True(outcomes[i].Near, label);
                Double3 normal = outcomes[i].Normal;
                var excess = reference.DepthAlong(normal * (1 / normal.Length), offset) - expected.Depth;
                Assert.True(excess < StopTolerance * reference.Size, $"{label}: {excess} too deep");
                Assert.True(Math.Abs(outcomes[i].Depth - excess - expected.Depth) < 2e-6, label);
            }
        }
    }

    static SearchOutcome[] Search(ConvexKind kind, Side sideA, Side sideB, double tilt, out List<ConvexCase> cases)
    {
        using var pool = new BufferPool();
        var random = new ConvexRandom(ConvexPoses.DevelopmentSeed, (ulong)((int)kind * 4 + (int)sideA * 2 + (int)sideB));
        List<DepthSearchShape> a = [], b = [];
        cases = [];
        while (cases.Count < Count)
        {
            var shapeA = NextShape(kind, random);
            var shapeB = ConvexShape.Cylinder(Next(random, 0.4, 0.8), Next(random, 0.8, 1.6));
            if (TryPlace(shapeA, sideA, shapeB, sideB, tilt, random) is not ConvexCase placed)
                continue;
            a.Add(DepthSearchShapes.Create(shapeA, pool));
            b.Add(DepthSearchShapes.Create(shapeB, pool));
            cases.Add(placed);
        }
        return DepthSearchShape.Find(a, b, [.. cases.Select(SearchPlace.Of)], [.. cases.Select(_ => 0.1f)]);
    }

    static float Next(ConvexRandom random, double min, double max) => (float)random.Next(min, max);

    static ConvexShape NextShape(ConvexKind kind, ConvexRandom random) => kind switch
    {
        ConvexKind.Box => ConvexShape.Box(Next(random, 1, 2), Next(random, 1, 2), Next(random, 1, 2)),
        ConvexKind.Cylinder => ConvexShape.Cylinder(Next(random, 0.4, 1), Next(random, 0.8, 2)),
        _ => ConvexShape.Triangle(new(Next(random, -1.5, -1), Next(random, -0.2, 0.2), Next(random, -1, -0.5)),
            new(Next(random, 1, 1.5), Next(random, -0.2, 0.2), Next(random, -1, -0.5)),
            new(Next(random, -0.5, 0.5), Next(random, -0.2, 0.2), Next(random, 0.8, 1.4))),
    };

    /// <summary>Puts the cylinder on the face or line of A, tilted; null where the two do not overlap as seen along the normal.</summary>
    static ConvexCase? TryPlace(ConvexShape a, Side sideA, ConvexShape b, Side sideB, double tilt, ConvexRandom random)
    {
        var (normal, along) = FaceOf(a, sideA, random);
        // The end looks down the normal, the line lies across it: beside A's line, or anyhow.
        var across = sideA == Side.Line && sideB == Side.Line ? along : Tangent(normal, random);
        var axis = sideB == Side.End ? (random.Next(2) == 0 ? normal : normal * -1) : across;
        axis += Tangent(axis, random) * tilt * random.Next(0, 1);
        var orientation = FromY(axis * (1 / axis.Length), random);
        var reference = new ConvexReference(a, b, ConvexRotation.Between(Quaternion.Identity, orientation));
        // Two lines lie along each other; beside each other, they would have another normal.
        var aside = sideA == Side.Line && sideB == Side.Line ? along : Tangent(normal, random);
        var offset = normal * 0.5 + aside * random.Next(-0.6, 0.6);
        // The normal of the depth goes from B to A.
        offset += normal * (reference.DepthAlong(normal * -1, offset) - random.Next(-0.002, 0.01));
        var placed = ConvexPoses.Measure(a, b, new ConvexPose(ConvexGenerator.ToVector(offset), Quaternion.Identity, orientation));
        // Beside an edge they are apart; and the search looks for the face where the centres are.
        var between = placed.LocalOffsetB - a.Middle;
        var facing = Double3.Dot(between, normal) / between.Length;
        return -Double3.Dot(placed.Depth.Normal, normal) > Math.Cos(2 * tilt + 1e-6) && facing > 0.75 && placed.Depth.Depth > -0.05 ? placed : null;
    }

    static (Double3 Normal, Double3 Along) FaceOf(ConvexShape a, Side side, ConvexRandom random)
    {
        if (a.Kind == ConvexKind.Triangle)
        {
            var front = Double3.Cross((Double3)a.Points[1] - (Double3)a.Points[0], (Double3)a.Points[2] - (Double3)a.Points[0]);
            return (front * ((random.Next(2) * 2 - 1) / front.Length), default);
        }
        var sign = random.Next(2) * 2 - 1;
        if (a.Kind == ConvexKind.Cylinder)
            return side == Side.End ? (new Double3(0, sign, 0), default) : (Tangent(new(0, 1, 0), random), new Double3(0, 1, 0));
        var index = random.Next(3);
        return (new Double3(index == 0 ? sign : 0, index == 1 ? sign : 0, index == 2 ? sign : 0), default);
    }

    static Double3 Tangent(Double3 normal, ConvexRandom random)
    {
        var tangent = Double3.Cross(normal, random.NextDirection());
        return tangent * (1 / tangent.Length);
    }

    static Quaternion FromY(Double3 axis, ConvexRandom random)
    {
        var y = ConvexGenerator.ToVector(axis);
        var x = ConvexGenerator.ToVector(Tangent(axis, random));
        var z = Vector3.Cross(x, y);
        return Quaternion.Normalize(Quaternion.CreateFromRotationMatrix(new Matrix4x4(
            x.X, x.Y, x.Z, 0, y.X, y.Y, y.Z, 0, z.X, z.Y, z.Z, 0, 0, 0, 0, 1)));
    }
}
