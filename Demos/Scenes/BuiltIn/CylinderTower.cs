using System.Numerics;

namespace Demos.Scenes.BuiltIn;

/// <summary>Forty cylinders on each other: caps that must carry a weight without rocking.</summary>
static class CylinderTower
{
    const int Height = 40;

    public static BuiltInScene Scene { get; } = new("cylinder-tower", "40 cylinders on each other; they stand with 16 substeps", _ => Create());

    static SceneDescription Create()
    {
        var scene = new SceneDescription { Name = Scene.Name, Steps = 600, Damping = 0 };
        int cylinder = scene.AddCylinder(1, 0.25f);
        int ground = scene.AddBox(100, 1, 100);
        scene.AddStatic(ground, new Vector3(0, -1, 0));
        for (int i = 0; i < Height; ++i)
            scene.AddDynamic(cylinder, 1, new Vector3(0, 0.25f + i * 0.5f, 0));
        return scene;
    }
}
