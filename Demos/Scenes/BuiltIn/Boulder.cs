using System.Numerics;

namespace Demos.Scenes.BuiltIn;

/// <summary>One body that touches very many at once: a flat boulder on a bed of pebbles.</summary>
static class Boulder
{
    const int Width = 71;
    const int PebbleCount = 5000;
    const float Radius = 0.25f;

    public static BuiltInScene Scene { get; } = new("boulder", "one boulder on 5,000 pebbles", _ => Create());

    static SceneDescription Create()
    {
        const float spacing = 2.1f * Radius;
        const float thickness = 2;
        var scene = new SceneDescription { Name = Scene.Name, Steps = 200 };
        int ground = scene.AddBox(200, 1, 200);
        int pebble = scene.AddSphere(Radius);
        const float halfWidth = Width * spacing / 2;
        int boulder = scene.AddBox(halfWidth, thickness / 2, halfWidth);
        scene.AddStatic(ground, new Vector3(0, -1, 0));
        for (int i = 0; i < PebbleCount; ++i)
            scene.AddDynamic(pebble, 1, new Vector3(ManyStatics.Place(i % Width, Width, spacing), Radius, ManyStatics.Place(i / Width, Width, spacing)));
        scene.AddDynamic(boulder, 10_000, new Vector3(0, 2 * Radius + thickness / 2, 0));
        return scene;
    }
}
