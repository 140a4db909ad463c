using System;
using System.Collections.Generic;
using System.Numerics;
using Demos.Scenes;

namespace Demos.Towers.Structures;

/// <summary>One part on the other.</summary>
static class Stacks
{
    static readonly (string Name, Vector3 Size)[] proportions =
        [("cubes", Vector3.One), ("slim", new Vector3(.7f, 1, .7f)), ("flat", new Vector3(2, .5f, 1))];

    /// <summary>Stacks of boxes of three proportions, towers of cylinders and of hulls, and boxes that are each set off from the one below.</summary>
    public static IEnumerable<Structure> All()
    {
        foreach ((string name, Vector3 size) in proportions)
        {
            foreach (int count in new[] { 10, 20, 30, 50, 100 })
            {
                string full = $"{name}-{count}";
                yield return new(full, FormattableString.Invariant($"{count} boxes of {size.X:0.#} x {size.Y:0.#} x {size.Z:0.#} m"),
                    () => Boxes(full, size, count, 0));
            }
        }
        yield return new("cylinders-20", "20 cylinders of 2 x .5 m", () => Cylinders(20));
        yield return new("cylinders-40", "40 cylinders of 2 x .5 m", () => Cylinders(40));
        yield return new("hulls-10", "10 hulls by lot, cut flat below and above", () => Hulls(10));
        yield return new("hulls-20", "20 hulls by lot, cut flat below and above", () => Hulls(20));
        // Of n boxes that are each set off by d the upper n - 1 have their centre n d / 2 from the lowest one's: these lie beyond its edge.
        foreach (float step in new[] { .09f, .12f })
        {
            int count = (int)Math.Ceiling(1 / step) + 1;
            string name = FormattableString.Invariant($"offset-{step:.00}");
            yield return new(name, FormattableString.Invariant($"{count} cubes, each {step} m off the one below: they fall"),
                () => Boxes(name, Vector3.One, count, step))
            {
                Stands = false,
            };
        }
    }

    static SceneDescription Boxes(string name, Vector3 size, int count, float step)
    {
        SceneDescription scene = Ground.Create(name);
        for (int i = 0; i < count; ++i)
            scene.AddBox(size, new Vector3(i * step, (i + .5f) * size.Y, 0));
        return scene;
    }

    static SceneDescription Cylinders(int count)
    {
        const float radius = 1, height = .5f;
        SceneDescription scene = Ground.Create($"cylinders-{count}");
        int cylinder = scene.AddCylinder(radius, height / 2);
        for (int i = 0; i < count; ++i)
            scene.AddDynamic(cylinder, float.Pi * radius * radius * height * Ground.Density, new Vector3(0, (i + .5f) * height, 0));
        return scene;
    }

    static SceneDescription Hulls(int count)
    {
        const float height = .6f;
        SceneDescription scene = Ground.Create($"hulls-{count}");
        var random = new SceneRandom(1);
        for (int i = 0; i < count; ++i)
            scene.AddDynamic(scene.AddHull(FlatHull.Create(random, .5f, height)), height * Ground.Density, new Vector3(0, (i + .5f) * height, 0));
        return scene;
    }
}
