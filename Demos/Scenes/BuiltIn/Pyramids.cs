using System;
using System.Numerics;

namespace Demos.Scenes.BuiltIn;

/// <summary>20 pyramids side by side: many islands of the same kind.</summary>
static class Pyramids
{
    public const string Name = "pyramids";

    public static BuiltInScene Scene { get; } = new(Name, "20 pyramids of 210 boxes", _ => Create());

    static SceneDescription Create()
    {
        var scene = new SceneDescription { Name = Name };
        int box = scene.AddBox(0.5f, 0.5f, 0.5f);
        int ground = scene.AddBox(200, 1, 200);
        scene.AddStatic(ground, new Vector3(0, -1, 0));
        for (int i = 0; i < 20; ++i)
            AddPyramid(scene, box, 20, (i - 9.5f) * 5);
        return scene;
    }

    /// <summary>Stacks unit boxes of a kilogram, 0.1 m between neighbours.</summary>
    public static void AddPyramid(SceneDescription scene, int box, int baseCount, float z)
    {
        for (int row = 0; row < baseCount; ++row)
        {
            int count = baseCount - row;
            for (int i = 0; i < count; ++i)
            {
                // Computed and rounded as the scene files are, so that both start from the same bits.
                double x = Math.Round((i - (count - 1) * 0.5) * 1.1, 7);
                scene.AddDynamic(box, 1, new Vector3((float)x, row + 0.5f, z));
            }
        }
    }
}
