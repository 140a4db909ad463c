using System.Numerics;

namespace Demos.Scenes.BuiltIn;

/// <summary>A ground of many static boxes with small boxes on them: what a world costs in which nothing happens.</summary>
static class ManyStatics
{
    const int GroundWidth = 96;
    const int BodyWidth = 64;

    public static BuiltInScene Scene { get; } = new("many-statics", "9,216 statics, and 4,096 boxes that fall asleep on them", _ => Create());

    static SceneDescription Create()
    {
        var scene = new SceneDescription { Name = Scene.Name, Sleep = true };
        int tile = scene.AddBox(1, 0.5f, 1);
        int box = scene.AddBox(0.5f, 0.5f, 0.5f);
        for (int i = 0; i < GroundWidth * GroundWidth; ++i)
            scene.AddStatic(tile, new Vector3(Place(i % GroundWidth, GroundWidth, 2), -0.5f, Place(i / GroundWidth, GroundWidth, 2)));
        for (int i = 0; i < BodyWidth * BodyWidth; ++i)
            scene.AddDynamic(box, 1, new Vector3(Place(i % BodyWidth, BodyWidth, 3), 0.5f, Place(i / BodyWidth, BodyWidth, 3)));
        return scene;
    }

    /// <summary>Place of one of a row of things, the middle of which is at zero.</summary>
    internal static float Place(int index, int count, float spacing) => (index - (count - 1) * 0.5f) * spacing;
}
