using System;
using System.Collections.Generic;
using Demos.References;

namespace DemoTests.Support;

/// <summary>Frictionless spheres without gravity, from impact to impact, each at the instant at which it happens, in double precision.</summary>
sealed class SphereImpactOracle(double restitution)
{
    sealed class Ball
    {
        public double Radius;
        public double Mass;
        public Double3 Position;
        public Double3 Velocity;
    }

    readonly List<Ball> balls = [];

    public int ImpactCount { get; private set; }

    /// <summary>Shortest time between two impacts in which one ball takes part.</summary>
    public double ShortestInterval { get; private set; } = double.PositiveInfinity;

    public Double3 Velocity(int ball) => balls[ball].Velocity;

    public void Add(double radius, double mass, Double3 position, Double3 velocity) =>
        balls.Add(new() { Radius = radius, Mass = mass, Position = position, Velocity = velocity });

    public void Run(double seconds)
    {
        double now = 0;
        var last = new double[balls.Count];
        Array.Fill(last, double.NegativeInfinity);
        while (true)
        {
            double first = double.PositiveInfinity;
            (int a, int b) pair = default;
            for (int i = 0; i < balls.Count; ++i)
            {
                for (int j = 0; j < i; ++j)
                {
                    double time = TimeToImpact(balls[i], balls[j]);
                    if (time < first)
                        (first, pair) = (time, (i, j));
                }
            }
            double advance = Math.Min(first, seconds - now);
            foreach (var ball in balls)
                ball.Position += ball.Velocity * advance;
            now += advance;
            if (first > advance)
                return;
            ShortestInterval = Math.Min(ShortestInterval, now - Math.Max(last[pair.a], last[pair.b]));
            last[pair.a] = last[pair.b] = now;
            Bounce(balls[pair.a], balls[pair.b]);
            ++ImpactCount;
        }
    }

    static double TimeToImpact(Ball a, Ball b)
    {
        var offset = a.Position - b.Position;
        var velocity = a.Velocity - b.Velocity;
        double along = Double3.Dot(offset, velocity);
        double square = velocity.LengthSquared;
        double reach = a.Radius + b.Radius;
        double discriminant = along * along - square * (offset.LengthSquared - reach * reach);
        if (along >= 0 || discriminant < 0)
            return double.PositiveInfinity;
        return Math.Max(0, (-along - Math.Sqrt(discriminant)) / square);
    }

    void Bounce(Ball a, Ball b)
    {
        var normal = a.Position - b.Position;
        normal *= 1 / normal.Length;
        double approach = Double3.Dot(a.Velocity - b.Velocity, normal);
        double impulse = -(1 + restitution) * approach / (1 / a.Mass + 1 / b.Mass);
        a.Velocity += normal * (impulse / a.Mass);
        b.Velocity -= normal * (impulse / b.Mass);
    }
}
