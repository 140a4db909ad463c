using System;
using System.Collections.Generic;
using System.Linq;
using System.Numerics;
using System.Threading;
using System.Threading.Tasks;
using BepuPhysics.Collidables;
using BepuUtilities.Memory;
using Xunit;
using Xunit.Abstractions;

namespace DemoTests.Collidables;

/// <summary>Whatever points there are, there is a closed convex hull around them, or a reason why not.</summary>
/// <remarks>A thousand inputs; with the environment variable PHYSICS_FULL_TESTS, a hundred thousand.</remarks>
public class ConvexHullFuzzTests(ITestOutputHelper output)
{
    static int Count => Environment.GetEnvironmentVariable("PHYSICS_FULL_TESTS") is { Length: > 0 } ? 100_000 : 1000;

    [Fact]
    public void AnyPointsHaveAHullOrAReason()
    {
        var faults = new SortedDictionary<int, string>();
        var refusals = new int[Enum.GetValues<HullFailure>().Length];
        double farthest = 0, mostLacking = 0;
        Parallel.For(0, Count, () => new BufferPool(), (seed, _, pool) =>
        {
            var points = Generate(seed, out var kind);
            string? fault = null;
            try
            {
                var exists = ConvexHullHelper.TryCreateShape(points, pool, out var center, out var hull, out var failure);
                Interlocked.Increment(ref refusals[(int)failure]);
                if (exists)
                {
                    var checker = new HullChecker(hull);
                    fault = checker.FindFault();
                    // What the centre was rounded by in the world is no fault of the hull.
                    var outside = checker.FarthestOutside(points, center) - 1.1e-7 * center.Length() / checker.Size;
                    if (outside > 1e-4)
                        fault ??= $"a point is {outside:e2} sizes outside";
                    // Grown by this much around its centre the hull would hold all points, so its volume lacks no more than three times that.
                    var lacking = outside * checker.Size / checker.Planes.Min(plane => plane.Offset);
                    if (lacking > 0.01 / 3)
                        fault ??= $"the volume may be {3 * lacking:e2} off";
                    lock (faults)
                    {
                        farthest = Math.Max(farthest, outside);
                        mostLacking = Math.Max(mostLacking, 3 * lacking);
                    }
                    hull.Dispose(pool);
                }
                else if (failure == HullFailure.None || hull.Data.Allocated)
                {
                    fault = "refused without a reason";
                }
                pool.AssertEmpty();
            }
            catch (Exception exception) when (exception is not OutOfMemoryException)
            {
                fault = exception.ToString();
            }
            if (fault is not null)
            {
                lock (faults)
                    faults.Add(seed, $"{kind}, {points.Length} points: {fault}");
            }
            return pool;
        }, pool => pool.Dispose());
        output.WriteLine($"{Count} inputs, at most {farthest:e2} sizes outside, volume at most {mostLacking:e2} off; " +
            string.Join(", ", Enum.GetValues<HullFailure>().Select(failure => $"{failure} {refusals[(int)failure]}")));
        Assert.True(faults.Count == 0, $"{faults.Count} faults:\n{string.Join('\n', faults.Take(20).Select(f => $"{f.Key}: {f.Value}"))}");
    }

    /// <summary>Shapes that users have and worse, turned, doubled, squeezed, moved.</summary>
    internal static Vector3[] Generate(int seed, out string kind)
    {
        var random = new Random(seed);
        var count = (int)Math.Pow(10, 0.5 + 2.5 * random.NextDouble());
        var coarse = random.Next(2, 30);
        (kind, var points) = random.Next(16) switch
        {
            0 => ("cloud", Make(_ => HullInputs.InCube(random))),
            1 => ("ball surface", Make(_ => Vector3.Normalize(HullInputs.InCube(random)))),
            2 => ("lattice", Make(_ => Rounded(HullInputs.InCube(random), coarse))),
            3 => ("noisy cube", HullInputs.NoisyCube(count + 8, MathF.Pow(10, random.Next(-9, -2)), random)),
            4 => ("prism", HullInputs.Prism(count + 3, random.NextSingle() + 0.1f)),
            5 => ("even sphere", HullInputs.Sphere(count + 4)),
            6 => ("grid", HullInputs.Grid(random.Next(2, 9))),
            7 => ("plane", Make(_ => HullInputs.InCube(random) * new Vector3(1, 0, 1))),
            8 => ("line", Make(_ => new Vector3(1, 2, 3) * random.NextSingle())),
            9 => ("almost plane", Make(_ => HullInputs.InCube(random) * new Vector3(1, MathF.Pow(10, -8 + 6 * (seed % 7) / 6f), 1))),
            10 => ("needle", Make(_ => HullInputs.InCube(random) * new Vector3(1e-4f, 1, 2e-4f))),
            11 => ("cone", [.. HullInputs.Prism(count + 3, 1).Select(p => p.Y > 0 ? Vector3.UnitY : p)]),
            12 => ("clusters", Make(i => Vector3.Normalize(new Vector3(i % 5 - 2, i % 3 - 1, i % 7 - 3.1f)) +
                MathF.Pow(10, -2 - seed % 6) * HullInputs.InCube(random))),
            13 => ("capsule", [.. HullInputs.Sphere(count + 8).Select(p => p + new Vector3(0, p.Y > 0 ? 1 : -1, 0))]),
            14 => ("spiral", Make(i => new Vector3(MathF.Pow(0.97f, i), MathF.Pow(0.94f, i), MathF.Pow(0.91f, i)))),
            _ => ("few", Enumerable.Range(0, random.Next(0, 9)).Select(_ => Rounded(HullInputs.InCube(random), 2)).ToArray()),
        };
        if (random.Next(2) == 0)
        {
            kind += ", turned";
            points = HullInputs.Turned(points, HullInputs.Turn(random));
        }
        if (random.Next(4) == 0)
        {
            kind += ", squeezed";
            points = HullInputs.Turned(HullInputs.Scaled(points, new(1, MathF.Pow(10, -4 * random.NextSingle()), 1)), HullInputs.Turn(random));
        }
        if (random.Next(4) == 0)
        {
            var noise = MathF.Pow(10, random.Next(-9, -3));
            kind += $", doubled with noise {noise}";
            points = [.. points.SelectMany(p => Enumerable.Range(0, 3).Select(i => p + i * noise * HullInputs.InCube(random)))];
        }
        var scale = MathF.Pow(10, random.Next(-3, 4));
        points = HullInputs.Scaled(points, new(scale));
        if (random.Next(3) == 0)
        {
            var offset = HullInputs.InCube(random) * MathF.Pow(10, random.Next(-1, 5));
            kind += $", scaled by {scale}, moved by {offset}";
            points = HullInputs.Moved(points, offset);
        }
        return points;

        Vector3[] Make(Func<int, Vector3> make) => [.. Enumerable.Range(0, count).Select(make)];
    }

    static Vector3 Rounded(Vector3 p, int steps) => new(MathF.Round(p.X * steps), MathF.Round(p.Y * steps), MathF.Round(p.Z * steps));
}
