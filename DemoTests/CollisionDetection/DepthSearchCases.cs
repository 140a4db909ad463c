using System;
using System.Collections.Generic;
using System.Numerics;
using DemoTests.Support;

namespace DemoTests.CollisionDetection;

/// <summary>How two shapes lie.</summary>
enum DepthRegime
{
    /// <summary>Middles apart by 0 to 0.4 of both radii.</summary>
    Deep,
    /// <summary>One middle on the other.</summary>
    Concentric,
    /// <summary>1 to 4 cm of a metre.</summary>
    Shallow,
    /// <summary>Within 0.1 mm of a metre.</summary>
    Touching,
    /// <summary>2 to 150 mm of a metre.</summary>
    Apart,
}

/// <summary>A pair, where it is, and what its depth is.</summary>
sealed record DepthSearchCase(
    DepthSearchShape A, DepthSearchShape B, SearchPlace Place, ConvexReference Reference, DepthRegime Regime, ConvexDepth Expected)
{
    public Double3 Offset => Place.Offset;

    /// <summary>Makes pairs that lie in one way.</summary>
    public static List<DepthSearchCase> Create(string kindA, string kindB, DepthRegime regime, int count, ulong seed, float scale = 1)
    {
        var random = new PairRandom(seed);
        List<DepthSearchCase> cases = [];
        while (cases.Count < count)
        {
            var a = DepthSearchShapes.Create(kindA, ref random, scale);
            var b = DepthSearchShapes.Create(kindB, ref random, scale);
            var orientation = random.NextOrientation();
            var reference = new ConvexReference(a.Reference, b.Reference, ConvexRotation.From(orientation));
            var offset = Choose(reference, regime, ref random, scale);
            if (offset is not { } place)
                continue;
            var expected = reference.Find(place);
            cases.Add(new(a, b, new(place, orientation), reference, regime, expected));
        }
        return cases;
    }

    static Vector3? Choose(ConvexReference reference, DepthRegime regime, ref PairRandom random, float scale)
    {
        Double3 direction = random.NextDirection();
        var center = reference.ConcentricOffset;
        var radii = reference.A.OuterRadius + reference.B.OuterRadius;
        if (regime == DepthRegime.Concentric)
            return ToSingle(center);
        if (regime == DepthRegime.Deep)
            return ToSingle(center + direction * (radii * random.Next(0, 0.4)));
        var target = regime switch
        {
            DepthRegime.Shallow => random.Next(0.01, 0.04),
            DepthRegime.Touching => random.Next(-1e-4, 1e-4),
            _ => -random.Next(0.002, 0.15),
        } * scale;
        // Half of them along one direction until the depth is right, which mostly meets faces; half of them along the normal from far away,
        // which mostly meets corners and edges. Where another normal becomes the best one, again.
        var offset = center + direction * radii;
        var keepsDirection = random.Next(2) == 0;
        for (int i = 0; i < 20; ++i)
        {
            var (depth, normals, _) = reference.Find(offset);
            if (Math.Abs(depth - target) < 2e-6 * scale)
                return ToSingle(offset);
            var slope = Double3.Dot(normals[0], direction);
            if (keepsDirection && slope > -0.05)
                return null;
            offset += keepsDirection ? direction * ((target - depth) / slope) : normals[0] * (target - depth);
        }
        return null;
    }

    static Vector3 ToSingle(Double3 v) => new((float)v.X, (float)v.Y, (float)v.Z);
}
