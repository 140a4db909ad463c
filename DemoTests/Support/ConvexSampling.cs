using System;
using System.Collections.Concurrent;
using System.Collections.Generic;
using System.Linq;
using Demos.References;

namespace DemoTests.Support;

/// <summary>
/// The depth of two convex shapes by sampling directions and descending from every sample that is lower than its neighbours. It knows
/// nothing of features, and so checks <see cref="ConvexReference"/>, which knows nothing else.
/// </summary>
static class ConvexSampling
{
    const int NeighborCount = 7;
    // Some pairs are as deep along many directions, spheres in one point along all.
    const int MaximumStartCount = 40;

    static readonly ConcurrentDictionary<int, Grid> grids = [];

    sealed record Grid(Double3[] Directions, int[] Neighbors);

    public static double FindDepth(ConvexReference pair, Double3 offset, int count, out Double3 normal)
    {
        var grid = grids.GetOrAdd(count, Build);
        var values = new double[count];
        for (int i = 0; i < count; ++i)
            values[i] = pair.DepthAlong(grid.Directions[i], offset);
        var best = double.MaxValue;
        normal = default;
        var starts = new List<(double Value, int Index)>();
        for (int i = 0; i < count; ++i)
        {
            var lowest = true;
            for (int j = 0; j < NeighborCount && lowest; ++j)
                lowest = values[grid.Neighbors[i * NeighborCount + j]] >= values[i];
            if (lowest)
                starts.Add((values[i], i));
        }
        starts.Sort();
        foreach (var (start, i) in starts.Take(MaximumStartCount))
        {
            var direction = grid.Directions[i];
            var value = Descend(pair, offset, ref direction, start, Math.Sqrt(4 * Math.PI / count));
            if (value < best)
                (best, normal) = (value, direction);
        }
        return best;
    }

    /// <summary>Tries directions around the best one, which turn from round to round, as creases defeat those that stay.</summary>
    static double Descend(ConvexReference pair, Double3 offset, ref Double3 direction, double value, double step)
    {
        var turn = 0.0;
        var longest = step;
        while (step > 1e-10)
        {
            var t = Double3.Cross(direction, Math.Abs(direction.X) < 0.6 ? new(1, 0, 0) : new(0, 1, 0));
            t *= 1 / t.Length;
            var b = Double3.Cross(direction, t);
            var improved = false;
            for (int i = 0; i < 8; ++i)
            {
                turn += 2.399963229728653;
                var next = direction + (t * Math.Cos(turn) + b * Math.Sin(turn)) * step;
                next *= 1 / next.Length;
                var nextValue = pair.DepthAlong(next, offset);
                if (nextValue < value)
                {
                    (direction, value) = (next, nextValue);
                    improved = true;
                }
            }
            step = improved ? Math.Min(longest, step * 1.5) : step * 0.7;
        }
        return value;
    }

    static Grid Build(int count)
    {
        var directions = new Double3[count];
        for (int i = 0; i < count; ++i)
        {
            // Fibonacci lattice.
            var y = 1 - (2 * i + 1.0) / count;
            var ring = Math.Sqrt(1 - y * y);
            var angle = i * Math.PI * (3 - Math.Sqrt(5));
            directions[i] = new(ring * Math.Cos(angle), y, ring * Math.Sin(angle));
        }
        var neighbors = new int[count * NeighborCount];
        // Rows of constant height hold the neighbours: a band of rows is enough.
        var reach = 3 * Math.Sqrt(4 * Math.PI / count);
        var found = new List<(double Distance, int Index)>();
        for (int i = 0; i < count; ++i)
        {
            found.Clear();
            for (int j = Math.Max(0, i - (int)(reach * count)); j < Math.Min(count, i + (int)(reach * count)); ++j)
            {
                var distance = (directions[i] - directions[j]).Length;
                if (j != i && distance < reach)
                    found.Add((distance, j));
            }
            found.Sort();
            for (int j = 0; j < NeighborCount; ++j)
                neighbors[i * NeighborCount + j] = found[j].Index;
        }
        return new(directions, neighbors);
    }
}
