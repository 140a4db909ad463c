using System.Numerics;

namespace Demos.Scenes.BuiltIn;

/// <summary>Hulls of 16 to 32 corners, dropped into a pit 14 m wide: what the search for the depth of two hulls costs.</summary>
static class HullPile
{
    const int Columns = 10;
    const int Layers = 20;
    const int ShapeCount = 64;
    const float Spacing = 1.3f;

    public static BuiltInScene Scene { get; } = new("hull-pile", "2,000 hulls of 16 to 32 corners in a pit, by --seed", Create);

    static SceneDescription Create(int seed)
    {
        var random = new SceneRandom(seed);
        var scene = new SceneDescription { Name = Scene.Name, Steps = 600 };
        Pit.Add(scene, 7);
        int firstShape = scene.Shapes.Count;
        var masses = new float[ShapeCount];
        for (int i = 0; i < ShapeCount; ++i)
            scene.AddHull(RandomHull.Create(random, 16 + i % 17, random.Next(0.45f, 0.6f), out masses[i]));
        for (int i = 0; i < Layers * Columns * Columns; ++i)
        {
            int z = i % Columns, x = i / Columns % Columns, y = i / (Columns * Columns);
            var position = new Vector3((x - (Columns - 1) * 0.5f) * Spacing, 1 + y * Spacing, (z - (Columns - 1) * 0.5f) * Spacing);
            scene.AddDynamic(firstShape + i % ShapeCount, masses[i % ShapeCount], position, random.NextRotation());
        }
        return scene;
    }
}
