using System;
using System.Linq;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuUtilities.Memory;
using Demos.References;
using Xunit;

namespace DemoTests.Collidables;

/// <summary>Inverse inertia of needles, blades and plates, at any angle and anywhere, against exact hulls and integrals in double precision.</summary>
public sealed class ThinHullInertiaTests : IDisposable
{
    readonly BufferPool pool = new();

    public void Dispose() => pool.Clear();

    [Theory]
    [InlineData(1)]
    [InlineData(2)]
    [InlineData(3)]
    public void WhatIsAcceptedIsRightToAPercent(int seed)
    {
        var random = new Random(seed);
        int accepted = 0, refused = 0;
        for (int i = 0; i < 400; ++i)
        {
            var aspect = Math.Pow(10, 6 * random.NextDouble());
            var points = Thin(random, aspect, Math.Pow(10, 6 * random.NextDouble() - 3), random.Next(3) * random.Next(1000));
            if (!ConvexHullHelper.TryCreateShape(points, pool, out _, out var hull, out _))
                continue;
            BodyInertia inertia;
            try
            {
                inertia = hull.ComputeInertia(1.5f);
            }
            catch (ArgumentException)
            {
                ++refused;
                hull.Dispose(pool);
                continue;
            }
            ++accepted;
            var error = RelativeError(new ExactHull(points), 1.5, inertia.InverseInertiaTensor);
            Assert.True(error <= 0.01, $"Hull {i} of seed {seed}, 1:{aspect:0}: off by {error:0.0000}.");
            hull.Dispose(pool);
        }
        Assert.True(accepted > 200, $"{accepted} accepted, {refused} refused.");
        pool.AssertEmpty();
    }

    /// <summary>The hulls that games have: nothing up to 1:1,000 is refused, at any angle, up to a thousand times its length away.</summary>
    [Theory]
    [InlineData(1)]
    [InlineData(30)]
    [InlineData(300)]
    [InlineData(1000)]
    [InlineData(2000)]
    [InlineData(4000)]
    public void NothingIsRefusedThatGamesHave(double aspect)
    {
        var random = new Random(17);
        for (int i = 0; i < 200; ++i)
        {
            var points = Thin(random, aspect, 1, aspect <= 1000 ? random.Next(2) * 0.1 * random.Next(10) : 0);
            var hull = new ConvexHull(points, pool, out _);
            var error = RelativeError(new ExactHull(points), 7, hull.ComputeInertia(7).InverseInertiaTensor);
            Assert.True(error <= 0.01, $"Hull {i}: off by {error:0.0000}.");
            hull.Dispose(pool);
        }
    }

    /// <summary>Entries at their nearest floats would be off by more: the search is what makes the difference.</summary>
    [Fact]
    public void NearestFloatsWouldNotDo()
    {
        var random = new Random(3);
        int needed = 0;
        for (int i = 0; i < 100; ++i)
        {
            var points = Thin(random, 2000, 1, 0);
            var inverse = new ExactHull(points).InverseInertia(1);
            var nearest = new BepuUtilities.Symmetric3x3((float)inverse[0], (float)inverse[1], (float)inverse[2],
                (float)inverse[3], (float)inverse[4], (float)inverse[5]);
            if (RelativeError(new ExactHull(points), 1, nearest) > 0.01)
                ++needed;
        }
        Assert.True(needed > 20, $"{needed} of 100");
    }

    // A polytope of 6 to 12 points, made thin in one direction or in two, turned, and moved by a number of its lengths.
    static Vector3[] Thin(Random random, double aspect, double size, double distance)
    {
        var scale = new Double3(1, random.Next(3) switch { 0 => 1, 1 => 1 / aspect, _ => Math.Pow(aspect, -random.NextDouble()) }, 1 / aspect);
        var turn = DoubleQuaternion.Normalize(random.Next(4) == 0 ? Quaternion.Identity : HullInputs.Turn(random));
        var offset = (Double3)HullInputs.InCube(random) * (distance * size);
        var body = random.Next(3) switch
        {
            0 => HullInputs.Box(1, 1, 1),
            1 => HullInputs.Prism(random.Next(3, 7), 1),
            _ => [.. Enumerable.Range(0, random.Next(6, 13)).Select(_ => HullInputs.InCube(random))],
        };
        return [.. body.Select(p => (turn.Rotate(Double3.Scale(p, scale) * size) + offset).ToVector3())];
    }

    // With I = L L^T the inertia and T what should be its inverse: how far L^T T L is from the unit matrix.
    static double RelativeError(ExactHull hull, double mass, in BepuUtilities.Symmetric3x3 tensor)
    {
        var i = hull.Inertia(mass);
        var a = Math.Sqrt(i[0]);
        double b = i[1] / a, d = i[3] / a, c = Math.Sqrt(i[2] - b * b), e = (i[4] - d * b) / c, f = Math.Sqrt(i[5] - d * d - e * e);
        double[,] lower = { { a, 0, 0 }, { b, c, 0 }, { d, e, f } };
        double[,] t = { { tensor.XX, tensor.YX, tensor.ZX }, { tensor.YX, tensor.YY, tensor.ZY }, { tensor.ZX, tensor.ZY, tensor.ZZ } };
        var sum = 0.0;
        for (int row = 0; row < 3; ++row)
        {
            for (int column = 0; column < 3; ++column)
            {
                var entry = row == column ? -1.0 : 0;
                for (int j = 0; j < 3; ++j)
                {
                    for (int k = 0; k < 3; ++k)
                        entry += lower[j, row] * t[j, k] * lower[k, column];
                }
                sum += entry * entry;
            }
        }
        return Math.Sqrt(sum);
    }
}
