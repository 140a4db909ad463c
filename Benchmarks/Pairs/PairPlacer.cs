using System;
using System.Numerics;
using Benchmarks.Pairs.Shared;
using BepuPhysics.CollisionDetection;

namespace Benchmarks.Pairs;

/// <summary>Places pairs of shapes at wanted depths, which this engine measures.</summary>
sealed class PairPlacer(PairWorld world, PairSolid[] solids, Random random)
{
    /// <summary>Attempts after which a case is given up.</summary>
    const int MaximumAttempts = 200;

    /// <summary>Metres; contacts are wanted wherever the shapes are.</summary>
    const float AnyDistance = 100;

    /// <summary>How far a shape is at least to the front of a triangle, as a cosine.</summary>
    const float FrontCosine = 0.3f;

    /// <summary>Places a pair of two kinds; null if that does not come about.</summary>
    /// <param name="regime">How.</param>
    /// <param name="a">Draws the first shape.</param>
    /// <param name="b">Draws the second shape.</param>
    public PairPlacement? TryPlace(PairRegime regime, Func<int> a, Func<int> b)
    {
        for (int attempt = 0; attempt < MaximumAttempts; ++attempt)
        {
            int first = a(), second = b();
            PairPlacement? placement = regime == PairRegime.Resting ? TryRest(first, second) : TryFree(regime, first, second);
            if (placement is PairPlacement placed && world.Test([placed], 1) > 0 == (regime != PairRegime.Missed))
                return placed;
        }
        return null;
    }

    PairPlacement? TryFree(PairRegime regime, int a, int b)
    {
        var pair = new PairPlacement(a, b, default, PairGeometry.NextRotation(random), PairGeometry.NextRotation(random));
        Vector3 direction = PairGeometry.NextDirection(random);
        if (!IsInFront(solids[a], pair.OrientationA, direction) || !IsInFront(solids[b], pair.OrientationB, -direction))
            return null;
        float size = MathF.Min(solids[a].Size, solids[b].Size);
        float depth = regime switch
        {
            PairRegime.Shallow => PairGeometry.Next(random, 0, 0.04f) * size,
            PairRegime.Apart => -PairGeometry.Next(random, 0.1f, 0.9f) * world.Margin,
            PairRegime.Missed => -PairGeometry.Next(random, 1.1f, 3) * world.Margin,
            _ => 0,
        };
        if (TryReach(pair, direction, depth) is not PairPlacement placed)
            return null;
        if (regime != PairRegime.Deep)
            return placed;
        PairPlacement deep = placed with { OffsetB = placed.OffsetB * PairGeometry.Next(random, 0.3f, 0.7f) };
        return Depth(deep) > 0.1f * size ? deep : null;
    }

    PairPlacement? TryRest(int a, int b)
    {
        PairSolid.Feature sideA = solids[a].NextFeature(random), sideB = solids[b].NextFeature(random);
        Vector3 up = PairGeometry.NextDirection(random), tangent = PairGeometry.NextTangent(random, up);
        // Lines lie along each other, or they would meet in a point. Half of the others have parallel edges, as what is stacked.
        bool isParallel = (sideA.IsLine && sideB.IsLine) || random.Next(2) == 0;
        Vector3 tangentB = isParallel ? tangent : PairGeometry.NextTangent(random, up);
        Quaternion orientationA = Rest(sideA, up, tangent), orientationB = Rest(sideB, -up, tangentB);
        if (random.Next(2) == 0)
        {
            var tilt = Quaternion.CreateFromAxisAngle(PairGeometry.NextTangent(random, up), PairGeometry.Next(random, 0, 2e-3f));
            orientationB = Quaternion.Normalize(Quaternion.Concatenate(orientationB, tilt));
        }
        float size = MathF.Min(solids[a].Size, solids[b].Size);
        Vector3 aside = PairGeometry.NextTangent(random, up) * PairGeometry.Next(random, 0, 0.3f * size);
        float depth = PairGeometry.Next(random, 0, 0.01f) * size;
        // Two triangles that lie in each other have each other behind them.
        if (solids[a].Front is not null && solids[b].Front is not null)
            depth = -depth;
        return TryReach(new PairPlacement(a, b, aside, orientationA, orientationB), up, depth);
    }

    Quaternion Rest(PairSolid.Feature side, Vector3 normal, Vector3 tangent) => PairGeometry.Align(
        side.Normal, side.Tangent ?? PairGeometry.NextTangent(random, side.Normal), normal, tangent);

    static bool IsInFront(PairSolid solid, Quaternion orientation, Vector3 direction) =>
        solid.Front is not Vector3 front || Vector3.Dot(Vector3.Transform(front, orientation), direction) > FrontCosine;

    /// <summary>Moves B along a direction to where the pair has a depth; null if it has that nowhere.</summary>
    // From outside inwards to the first step that is deep enough: farther in, a triangle may have no contacts, for it has one side.
    PairPlacement? TryReach(PairPlacement pair, Vector3 direction, float depth)
    {
        const int Steps = 24;
        PairPlacement At(float distance) => pair with { OffsetB = pair.OffsetB + distance * direction };
        float range = solids[pair.A].Radius + solids[pair.B].Radius + 4 * world.Margin;
        float outside = range, inside = range;
        for (int step = 1; step <= Steps && inside == outside; ++step)
        {
            inside = range * (Steps - step) / Steps;
            if (!(Depth(At(inside)) >= depth))
                outside = inside;
        }
        if (inside == outside)
            return null;
        for (int i = 0; i < Steps; ++i)
        {
            float middle = 0.5f * (inside + outside);
            if (Depth(At(middle)) >= depth)
                inside = middle;
            else
                outside = middle;
        }
        PairPlacement placed = At(inside);
        // Where contacts begin at another depth, as at the edge of a triangle's front, there is no place with this one.
        return MathF.Abs(Depth(placed) - depth) < 1e-3f ? placed : null;
    }

    float Depth(PairPlacement pair)
    {
        var batcher = new CollisionBatcher<PairTally>(world.Pool, world.Shapes, world.Registry, PairWorld.Dt, new PairTally());
        batcher.Add(world.Shape(pair.A), world.Shape(pair.B), pair.OffsetB, pair.OrientationA, pair.OrientationB, AnyDistance, new(0));
        batcher.Flush();
        return batcher.Callbacks.Depth;
    }
}
