using System;
using System.Numerics;

namespace Demos.Scenes.BuiltIn;

/// <summary>Spheres, capsules and boxes of many sizes in random poses, dropped into a pit: all pairs of shapes, and chaos enough that
/// one wrong bit shows soon.</summary>
static class Pile
{
    const int Columns = 8;
    const int Layers = 16;
    const float Spacing = 1.25f;
    const float PitHalfWidth = 6;

    public static BuiltInScene Scene { get; } = new("pile", "1,024 spheres, capsules and boxes in a pit, by --seed", Create);

    static SceneDescription Create(int seed)
    {
        var random = new SceneRandom(seed);
        var scene = new SceneDescription { Name = Scene.Name, Steps = 400 };
        Pit.Add(scene, PitHalfWidth);
        const int sizeCount = 4;
        int firstShape = scene.Shapes.Count;
        float[] masses = new float[3 * sizeCount];
        for (int i = 0; i < sizeCount; ++i)
        {
            Vector3 size = new(random.Next(0.2f, 0.45f), random.Next(0.2f, 0.45f), random.Next(0.2f, 0.45f));
            scene.AddBox(size.X, size.Y, size.Z);
            masses[3 * i] = 8 * size.X * size.Y * size.Z;
            (float radius, float halfLength) = (random.Next(0.15f, 0.3f), random.Next(0.15f, 0.35f));
            scene.AddCapsule(radius, halfLength);
            masses[3 * i + 1] = MathF.PI * radius * radius * (4 / 3f * radius + 2 * halfLength);
            float sphereRadius = random.Next(0.25f, 0.5f);
            scene.AddSphere(sphereRadius);
            masses[3 * i + 2] = MathF.PI * 4 / 3f * sphereRadius * sphereRadius * sphereRadius;
        }
        for (int i = 0; i < Layers * Columns * Columns; ++i)
        {
            int x = i % Columns, z = i / Columns % Columns, y = i / (Columns * Columns);
            int shape = (int)(random.Next() * masses.Length);
            var position = new Vector3((x - (Columns - 1) * 0.5f) * Spacing, 1 + y * Spacing, (z - (Columns - 1) * 0.5f) * Spacing);
            scene.AddDynamic(firstShape + shape, masses[shape], position, random.NextRotation());
        }
        return scene;
    }
}
