using System;
using System.Collections.Generic;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using Demos.References;

namespace Demos.Accuracy;

/// <summary>Cubes exactly on top of one another, and how far they are from where they were put.</summary>
sealed class Stack
{
    readonly AccuracyWorld world;
    readonly List<(BodyHandle Body, Double3 Start)> cubes = [];
    readonly double size;

    /// <param name="world">World to add to.</param>
    /// <param name="foot">Where the lowest cube touches the ground.</param>
    /// <param name="size">Edge length.</param>
    /// <param name="masses">One per cube, from below.</param>
    public Stack(AccuracyWorld world, Vector3 foot, float size, params ReadOnlySpan<float> masses)
    {
        this.world = world;
        this.size = size;
        for (int i = 0; i < masses.Length; ++i)
        {
            var body = world.AddDynamic(new Box(size, size, size), masses[i], new RigidPose(foot + new Vector3(0, (i + .5f) * size, 0)));
            cubes.Add((body, world.Position(body)));
        }
    }

    public static Stack OfEqual(AccuracyWorld world, int count, Vector3 foot = default, float size = 1, float mass = 1)
    {
        var masses = new float[count];
        Array.Fill(masses, mass);
        return new(world, foot, size, masses);
    }

    /// <summary>How much lower the topmost cube is, in metres.</summary>
    public double Loss => cubes[^1].Start.Y - world.Position(cubes[^1].Body).Y;

    /// <summary>The farthest sideways way of any cube, in metres.</summary>
    public double Drift
    {
        get
        {
            double farthest = 0;
            foreach (var (body, start) in cubes)
            {
                var way = world.Position(body) - start;
                farthest = Tally.Most(farthest, Math.Sqrt(way.X * way.X + way.Z * way.Z));
            }
            return farthest;
        }
    }

    public double RelativeLoss => Loss / size;

    public double RelativeDrift => Drift / size;
}
