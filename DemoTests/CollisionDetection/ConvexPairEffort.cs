using System;
using System.Collections.Generic;
using System.Globalization;

namespace DemoTests.CollisionDetection;

/// <summary>What searches took: support points, descents that came to their limit, polytopes.</summary>
sealed class ConvexPairEffort
{
    readonly List<int> evaluations = [];

    /// <summary>Descents that ended at their limit of steps.</summary>
    public int CapCount { get; private set; }

    /// <summary>Searches that expanded a polytope to show that no direction is better.</summary>
    public int PolytopeCount { get; private set; }

    /// <summary>Polytopes that ended at their limit, and so show nothing.</summary>
    public int LimitCount { get; private set; }

    public int SearchCount => evaluations.Count;

    /// <summary>Support points of each shape, those of polytopes with them.</summary>
    public double Mean
    {
        get
        {
            var sum = 0L;
            foreach (var count in evaluations)
                sum += count;
            return (double)sum / Math.Max(1, evaluations.Count);
        }
    }

    public int Percentile(double share)
    {
        evaluations.Sort();
        return evaluations.Count == 0 ? 0 : evaluations[Math.Min(evaluations.Count - 1, (int)(share * evaluations.Count))];
    }

    public void Add(in SearchOutcome outcome)
    {
        evaluations.Add(outcome.Evaluations + outcome.ExpansionEvaluations);
        CapCount += outcome.Caps;
        PolytopeCount += outcome.Expansions;
        LimitCount += outcome.Limits;
    }

    public const string Columns = "searches | evaluations mean | p99 | most | caps | polytopes | limits |";

    public override string ToString() => string.Create(CultureInfo.InvariantCulture,
        $"{SearchCount} | {Mean:f2} | {Percentile(.99)} | {Percentile(1)} | {CapCount} | {PolytopeCount} | {LimitCount} |");
}
