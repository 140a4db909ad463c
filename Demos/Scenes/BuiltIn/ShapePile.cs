using System;
using System.Numerics;

namespace Demos.Scenes.BuiltIn;

/// <summary>Boxes, capsules, spheres, cylinders and hulls in random poses, dropped on a plain: every pair of solid convex shapes.</summary>
static class ShapePile
{
    const int Columns = 16;
    const int KindCount = 5;
    const int SizeCount = 4;
    const float Spacing = 1.5f;

    public static BuiltInScene Scene { get; } = new(
        "shape-pile", "4,096 boxes, capsules, spheres, cylinders and hulls on a plain, by --seed", Create);

    static SceneDescription Create(int seed)
    {
        var random = new SceneRandom(seed);
        var scene = new SceneDescription { Name = Scene.Name, Steps = 600 };
        float[] masses = AddPalette(scene, random);
        int ground = scene.AddBox(200, 1, 200);
        scene.AddStatic(ground, new Vector3(0, -1, 0));
        for (int i = 0; i < Columns * Columns * Columns; ++i)
        {
            int z = i % Columns, x = i / Columns % Columns, y = i / (Columns * Columns);
            var position = new Vector3((x - (Columns - 1) * 0.5f) * Spacing, 1.5f + y * Spacing, (z - (Columns - 1) * 0.5f) * Spacing);
            scene.AddDynamic(i % masses.Length, masses[i % masses.Length], position, random.NextRotation());
        }
        return scene;
    }

    /// <summary>Adds four shapes of each kind, the kinds in turn, and returns their masses.</summary>
    public static float[] AddPalette(SceneDescription scene, SceneRandom random)
    {
        var masses = new float[SizeCount * KindCount];
        for (int i = 0; i < SizeCount; ++i)
            AddKinds(scene, random, i, masses.AsSpan(i * KindCount));
        return masses;
    }

    /// <summary>Adds one shape of each kind, and its mass at one kilogram per cubic metre.</summary>
    static void AddKinds(SceneDescription scene, SceneRandom random, int size, Span<float> masses)
    {
        var box = new Vector3(random.Next(0.25f, 0.42f), random.Next(0.25f, 0.42f), random.Next(0.25f, 0.42f));
        scene.AddBox(box.X, box.Y, box.Z);
        masses[0] = 8 * box.X * box.Y * box.Z;
        (float radius, float halfLength) = (random.Next(0.2f, 0.3f), random.Next(0.2f, 0.4f));
        scene.AddCapsule(radius, halfLength);
        masses[1] = MathF.PI * radius * radius * (4 / 3f * radius + 2 * halfLength);
        radius = random.Next(0.3f, 0.5f);
        scene.AddSphere(radius);
        masses[2] = MathF.PI * 4 / 3f * radius * radius * radius;
        (radius, halfLength) = (random.Next(0.25f, 0.42f), random.Next(0.2f, 0.42f));
        scene.AddCylinder(radius, halfLength);
        masses[3] = MathF.PI * radius * radius * 2 * halfLength;
        scene.AddHull(RandomHull.Create(random, 8 + 2 * size, random.Next(0.45f, 0.6f), out masses[4]));
    }
}
