using System.Numerics;

namespace Demos.Scenes.BuiltIn;

/// <summary>Boxes that fall from one height: with the command that takes them out in turn and adds them anew, rain that does not end.</summary>
static class Rain
{
    /// <summary>Bodies that are taken out and added in each step: each lives for 300 of them.</summary>
    public const int DropsPerStep = 10;

    const int DropCount = 300 * DropsPerStep;
    const int Width = 55;

    public static BuiltInScene Scene { get; } = new("rain", "3,000 boxes that fall; 'stages rain' adds and removes ten in each step", _ => Create());

    static SceneDescription Create()
    {
        const float height = 10;
        // Neighbours fall in neighbouring steps, so what lies where a drop comes down is an old one, or one beside it.
        const float spacing = 0.9f;
        var scene = new SceneDescription { Name = Scene.Name, Steps = 3000 };
        int ground = scene.AddBox(200, 1, 200);
        int box = scene.AddBox(0.5f, 0.4f, 0.3f);
        scene.AddStatic(ground, new Vector3(0, -1, 0));
        for (int i = 0; i < DropCount; ++i)
        {
            // Columns of the grid in steps of seven, so that those of one step do not touch each other.
            int place = i * 7 % DropCount;
            scene.AddDynamic(box, 1, new Vector3(
                ManyStatics.Place(place % Width, Width, spacing), height + i % 7, ManyStatics.Place(place / Width, Width, spacing)));
        }
        return scene;
    }
}
