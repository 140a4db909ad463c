using System;
using System.Numerics;

namespace Demos.Scenes.BuiltIn;

/// <summary>
/// Coins that are spun on their edges and must settle: the contact runs round the rim, ever faster, until the coin lies flat and still.
/// </summary>
static class Coins
{
    const int Rows = 6;

    public static BuiltInScene Scene { get; } = new("coins", "36 spinning coins that have to settle, by --seed", Create);

    static SceneDescription Create(int seed)
    {
        var random = new SceneRandom(seed);
        var scene = new SceneDescription { Name = Scene.Name, Steps = 900, Friction = 0.3f };
        const float radius = 0.5f;
        int coin = scene.AddCylinder(radius, 0.03f);
        scene.AddStatic(scene.AddBox(20, 1, 20), new Vector3(0, -1, 0));
        for (int i = 0; i < Rows * Rows; ++i)
        {
            // The axis lies along z but for a lean of 0.2 to 0.6 rad about x. Faster or more upright coins stand and spin for minutes.
            double half = Math.PI / 4 + random.Next(0.1f, 0.3f);
            var orientation = new Quaternion((float)Math.Sin(half), 0, 0, (float)Math.Cos(half));
            var position = new Vector3((i % Rows - (Rows - 1) * 0.5f) * 3, radius + 0.05f, (i / Rows - (Rows - 1) * 0.5f) * 3);
            scene.AddDynamic(coin, 0.2f, position, orientation, angularVelocity: new Vector3(0, random.Next(2, 6), 0));
        }
        return scene;
    }
}
