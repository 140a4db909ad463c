using System.Numerics;

namespace Demos.Scenes.BuiltIn;

/// <summary>Stacks of three boxes as far as one sees, which sleep, and a ball that comes and ploughs through them.</summary>
static class WakingWave
{
    /// <summary>The scene in full, and small enough for tests.</summary>
    public static BuiltInScene Scene { get; } = new(
        "waking-wave", "99,999 boxes that sleep in stacks of three, and a ball that ploughs through", _ => Create("waking-wave", 33_333, 183));

    public static SceneDescription Create(string name, int stackCount, int width)
    {
        const float spacing = 2.5f;
        const float ballRadius = 3;
        // Far enough that all sleep before it arrives.
        const float distance = 160;
        var scene = new SceneDescription { Name = name, Sleep = true, Steps = 700 };
        int ground = scene.AddBox(2000, 1, 2000);
        int box = scene.AddBox(0.5f, 0.5f, 0.5f);
        int ball = scene.AddSphere(ballRadius);
        scene.AddStatic(ground, new Vector3(0, -1, 0));
        for (int i = 0; i < stackCount; ++i)
        {
            for (int height = 0; height < 3; ++height)
            {
                scene.AddDynamic(box, 1, new Vector3(
                    ManyStatics.Place(i % width, width, spacing), height + 0.5f, ManyStatics.Place(i / width, width, spacing)));
            }
        }
        var start = ManyStatics.Place(0, width, spacing) - distance;
        scene.AddDynamic(
            ball, 3000, new Vector3(start, ballRadius, 0.3f), linearVelocity: new Vector3(40, 0, 0), angularVelocity: new Vector3(0, 0, -40 / ballRadius));
        return scene;
    }
}
