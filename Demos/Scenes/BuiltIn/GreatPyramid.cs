using System.Numerics;

namespace Demos.Scenes.BuiltIn;

/// <summary>One pyramid of 5,050 boxes: a single island, 100 layers deep.</summary>
static class GreatPyramid
{
    public static BuiltInScene Scene { get; } = new("great-pyramid", "one pyramid of 5,050 boxes", _ => Create());

    static SceneDescription Create()
    {
        var scene = new SceneDescription { Name = Scene.Name };
        int box = scene.AddBox(0.5f, 0.5f, 0.5f);
        int ground = scene.AddBox(200, 1, 200);
        scene.AddStatic(ground, new Vector3(0, -1, 0));
        Pyramids.AddPyramid(scene, box, 100, 0);
        return scene;
    }
}
