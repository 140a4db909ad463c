using System;
using System.Numerics;
using BepuPhysics;
using BepuUtilities;
using BepuUtilities.Memory;
using Demos.References;
using DemoTests.Support;
using Xunit;

namespace DemoTests.Scenes;

/// <summary>Which inverse inertia tensors are accepted: those without a negative principal moment, by eigenvalues in double precision.</summary>
public sealed class InertiaDefinitenessTests : IDisposable
{
    readonly BufferPool pool = new();
    readonly Simulation simulation;

    public InertiaDefinitenessTests() => simulation = EmptySimulation.Create(pool);

    public void Dispose()
    {
        simulation.Dispose();
        pool.Clear();
    }

    /// <summary>All three minors of two rows are positive, and turning it about (1, 1, 1) gives energy for nothing.</summary>
    [Fact]
    public void ATensorWhoseMinorsHideANegativeMomentIsRefused()
    {
        var tensor = new Symmetric3x3(1, -0.9f, 1, -0.9f, -0.9f, 1);
        Assert.False(Accepts(tensor));
        Assert.True(Accepts(new Symmetric3x3(1, 0.9f, 1, 0.9f, 0.9f, 1)));
    }

    [Theory]
    [InlineData(1)]
    [InlineData(2)]
    [InlineData(3)]
    public void WhatIsAcceptedIsWhatHasNoNegativeEigenvalue(int seed)
    {
        var random = new Random(seed);
        int accepted = 0, refused = 0;
        for (int i = 0; i < 3000; ++i)
        {
            // Moments of both signs and of very different sizes, at any angle.
            var size = Math.Pow(10, random.NextDouble() * 20 - 8);
            double[] moments = [Moment(), Moment(), Moment()];
            var turn = DoubleQuaternion.Normalize(new Quaternion(Part(), Part(), Part(), Part()));
            var tensor = Turned(moments, turn);
            var least = Math.Min(moments[0], Math.Min(moments[1], moments[2]));
            var trace = moments[0] + moments[1] + moments[2];
            // Neither answer is wrong for what rounding alone decides.
            if (least < 0 && least > -1e-5 * Math.Abs(trace))
                continue;
            var accepts = Accepts(tensor);
            Assert.True(accepts == least >= 0, $"{seed}, {i}: moments {moments[0]}, {moments[1]}, {moments[2]}");
            accepted += accepts ? 1 : 0;
            refused += accepts ? 0 : 1;

            double Moment() => size * Math.Pow(10, -9 * random.NextDouble()) * (random.Next(6) == 0 ? -1 : 1);
        }
        Assert.True(accepted > 500 && refused > 500, $"{accepted} accepted, {refused} refused");

        float Part() => random.NextSingle() - 0.5f;
    }

    /// <summary>Locked axes are exact zeros that a turn in floats makes roundings of either sign.</summary>
    [Fact]
    public void LockedAxesAndRodsAreAcceptedAtAnyAngle()
    {
        var random = new Random(9);
        for (int i = 0; i < 5000; ++i)
        {
            var diagonal = new Vector3(Moment(), Moment(), Moment());
            var turn = Quaternion.Normalize(new(Part(), Part(), Part(), Part()));
            var tensor = Symmetric3x3.RotateInverseInertia(Symmetric3x3.Diagonal(diagonal.X, diagonal.Y, diagonal.Z), turn);
            // Rounding may leave a negative entry of the diagonal, which is refused: nothing is so thin by accident.
            if (tensor.XX >= 0 && tensor.YY >= 0 && tensor.ZZ >= 0)
                Assert.True(Accepts(tensor), $"{i}: {diagonal} turned by {turn}");
        }

        float Part() => random.NextSingle() - 0.5f;
        float Moment() => random.Next(3) switch { 0 => 0, 1 => 1, _ => MathF.Pow(10, -8 * random.NextSingle()) };
    }

    [Fact]
    public void NumbersThatAreNoneAreRefused()
    {
        foreach (var bad in (float[])[float.NaN, float.PositiveInfinity, float.NegativeInfinity, 1e30f, -1])
        {
            for (int entry = 0; entry < 6; ++entry)
            {
                Span<float> entries = [1, 0, 1, 0, 0, 1];
                entries[entry] = bad;
                var tensor = new Symmetric3x3(entries[0], entries[1], entries[2], entries[3], entries[4], entries[5]);
                // A product of -1 beside moments of 1 makes one of them zero: just possible.
                Assert.Equal(bad == -1 && entry is 1 or 3 or 4 && bad == -1, Accepts(tensor));
            }
        }
        Assert.False(Accepts(new Symmetric3x3(0, 1, 0, 0, 0, 0)));
        // Products of these lose their digits below the least normal float, or are zero.
        Assert.False(Accepts(Symmetric3x3.Diagonal(0, 1e-36f, 0)));
        Assert.False(Accepts(Symmetric3x3.Diagonal(float.Epsilon, float.Epsilon, float.Epsilon)));
        Assert.True(Accepts(default));
    }

    bool Accepts(in Symmetric3x3 tensor)
    {
        var hash = simulation.StateHash();
        try
        {
            var description = BodyDescription.CreateDynamic(
                RigidPose.Identity, new BodyInertia { InverseMass = 1, InverseInertiaTensor = tensor }, default, new(0.01f));
            simulation.Bodies.Remove(simulation.Bodies.Add(description));
            return true;
        }
        catch (ArgumentException)
        {
            Assert.Equal(hash, simulation.StateHash());
            Assert.Equal(0, simulation.Bodies.CountBodies());
            return false;
        }
    }

    static Symmetric3x3 Turned(double[] moments, DoubleQuaternion turn)
    {
        Double3[] axes = [turn.Rotate(new(1, 0, 0)), turn.Rotate(new(0, 1, 0)), turn.Rotate(new(0, 0, 1))];
        var sums = new double[6];
        for (int i = 0; i < 3; ++i)
        {
            var (x, y, z) = (axes[i].X, axes[i].Y, axes[i].Z);
            double[] products = [x * x, y * x, y * y, z * x, z * y, z * z];
            for (int j = 0; j < 6; ++j)
                sums[j] += moments[i] * products[j];
        }
        return new((float)sums[0], (float)sums[1], (float)sums[2], (float)sums[3], (float)sums[4], (float)sums[5]);
    }
}
