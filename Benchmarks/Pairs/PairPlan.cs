using System;
using System.Collections.Generic;
using System.IO;
using System.Linq;
using Benchmarks.Compare;
using Benchmarks.Pairs.Shared;
using BepuPhysics.CollisionDetection;

namespace Benchmarks.Pairs;

/// <summary>Makes the cases: the same for the same numbers drawn, whichever of them are asked for.</summary>
static class PairPlan
{
    /// <summary>Pairs of a case: whole bundles of every width.</summary>
    const int PlacementCount = 256;

    /// <summary>Shapes of a kind: as many as a game has, so that hulls stay in the second-level cache.</summary>
    const int ShapeCount = 16;

    const float Margin = 0.1f;

    /// <summary>Makes the cases that are asked for and possible.</summary>
    /// <param name="pairs">Pairs of kinds, such as box-hull14; hull stands for hulls of any size. None for all.</param>
    /// <param name="regimes">Names of regimes; none for all.</param>
    /// <param name="log">Gets a line for everything that is left out.</param>
    public static PairFile Create(string[] pairs, string[] regimes, TextWriter log)
    {
        CheckRegimes(regimes);
        PairSolid[] solids = Enum.GetValues<PairShapeKind>().SelectMany(CreateSolids).ToArray();
        var file = new PairFile(Margin, solids.Select(solid => solid.Shape).ToList(), []);
        var world = new PairWorld(file);
        var unknown = pairs.ToHashSet();
        foreach ((PairShapeKind a, PairShapeKind b) in AllPairs())
        {
            string name = $"{Name(a)}-{Name(b)}";
            string[] asking = Array.FindAll(pairs, pair => IsAskedFor(pair, a, b));
            unknown.ExceptWith(asking);
            if (pairs.Length > 0 && asking.Length == 0)
                continue;
            if (!world.Registry.TryGetTask(world.Shape((int)a * ShapeCount).Type, world.Shape((int)b * ShapeCount).Type, out CollisionTask? _))
            {
                log.WriteLine($"{name}: left out, because this engine does not test such pairs yet");
                continue;
            }
            foreach (PairRegime regime in Enum.GetValues<PairRegime>())
            {
                bool isAskedFor = regimes.Length == 0 || regimes.Contains(regime.ToString(), StringComparer.OrdinalIgnoreCase);
                if (isAskedFor && TryPlace(world, solids, a, b, regime, log) is PairPlacement[] placements)
                    file.Cases.Add(new PairCase(name, Lower(regime.ToString()), placements));
            }
        }
        if (unknown.Count > 0)
            throw new CompareException($"there is no pair '{string.Join("', '", unknown)}'; kinds are {string.Join(", ", Kinds)}, and hull");
        return file;
    }

    static IEnumerable<string> Kinds => Enum.GetValues<PairShapeKind>().Select(Name);

    static string Name(PairShapeKind kind) => Lower(kind.ToString());

    static string Lower(string name) => $"{char.ToLowerInvariant(name[0])}{name[1..]}";

    static IEnumerable<PairSolid> CreateSolids(PairShapeKind kind)
    {
        var random = new Random((int)kind);
        return Enumerable.Range(0, ShapeCount).Select(_ => PairSolid.Create(kind, random));
    }

    // Hulls of different sizes are one pair of types with those of one size.
    static IEnumerable<(PairShapeKind A, PairShapeKind B)> AllPairs() =>
        from a in Enum.GetValues<PairShapeKind>()
        from b in Enum.GetValues<PairShapeKind>()
        where a <= b && (a, b) != (PairShapeKind.Hull14, PairShapeKind.Hull32)
        select (a, b);

    static bool IsAskedFor(string pair, PairShapeKind a, PairShapeKind b)
    {
        string[] sides = pair.Split('-');
        return sides.Length == 2 &&
            ((IsNamed(a, sides[0]) && IsNamed(b, sides[1])) || (IsNamed(a, sides[1]) && IsNamed(b, sides[0])));
    }

    static bool IsNamed(PairShapeKind kind, string name) =>
        Name(kind) == name || (name == "hull" && kind >= PairShapeKind.Hull14);

    static void CheckRegimes(string[] regimes)
    {
        string[] known = Enum.GetNames<PairRegime>();
        foreach (string regime in regimes)
        {
            if (!known.Contains(regime, StringComparer.OrdinalIgnoreCase))
                throw new CompareException($"there is no regime '{regime}'; regimes are {string.Join(", ", known.Select(Lower))}");
        }
    }

    static PairPlacement[]? TryPlace(PairWorld world, PairSolid[] solids, PairShapeKind a, PairShapeKind b, PairRegime regime, TextWriter log)
    {
        if (regime == PairRegime.Resting && !(solids[(int)a * ShapeCount].CanRest && solids[(int)b * ShapeCount].CanRest))
            return null;
        // Each case draws numbers of its own, so that it is the same whatever else is asked for.
        var random = new Random(Seed(a, b, regime));
        var placer = new PairPlacer(world, solids, random);
        var placements = new PairPlacement[PlacementCount];
        for (int i = 0; i < PlacementCount; ++i)
        {
            if (placer.TryPlace(regime, () => NextShape(a, random), () => NextShape(b, random)) is not PairPlacement placement)
            {
                log.WriteLine($"{Name(a)}-{Name(b)} {Lower(regime.ToString())}: left out, because the wanted contacts did not come about");
                return null;
            }
            placements[i] = placement;
        }
        return placements;
    }

    static int NextShape(PairShapeKind kind, Random random) => (int)kind * ShapeCount + random.Next(ShapeCount);

    static int Seed(PairShapeKind a, PairShapeKind b, PairRegime regime) => ((int)a * 16 + (int)b) * 16 + (int)regime;
}
