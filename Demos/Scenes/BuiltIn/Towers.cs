using System.Numerics;

namespace Demos.Scenes.BuiltIn;

/// <summary>Towers of single boxes, from 2 to 20 high: how far a solver carries a weight. They stand, or they do not.</summary>
static class Towers
{
    public static BuiltInScene Scene { get; } = new("towers", "towers of 2 to 20 boxes that have to stand", _ => Create());

    static SceneDescription Create()
    {
        var scene = new SceneDescription { Name = Scene.Name, Steps = 600, Damping = 0 };
        int box = scene.AddBox(0.5f, 0.5f, 0.5f);
        int ground = scene.AddBox(100, 1, 100);
        scene.AddStatic(ground, new Vector3(0, -1, 0));
        for (int height = 2; height <= 20; ++height)
        {
            for (int i = 0; i < height; ++i)
                scene.AddDynamic(box, 1, new Vector3((height - 11) * 3, i + 0.5f, 0));
        }
        return scene;
    }
}
