using System.Numerics;

namespace Demos.Scenes.BuiltIn;

/// <summary>A city of statics in which everything sleeps, beside a place where some balls roll for ever.</summary>
static class SettledCity
{
    const int Width = 316;
    const int MovingCount = 200;

    public static BuiltInScene Scene { get; } = new(
        "settled-city", "99,856 statics, as many boxes asleep on them, and 200 balls that roll", _ => Create("settled-city", Width));

    /// <summary>What moves in it, alone.</summary>
    public static BuiltInScene Alone { get; } = new("city-alone", "the 200 balls of settled-city without the city", _ => Create("city-alone", 0));

    /// <param name="name">Name of the scene.</param>
    /// <param name="width">Statics in a row; zero for the balls alone.</param>
    public static SceneDescription Create(string name, int width)
    {
        const float plaza = 400;
        var scene = new SceneDescription { Name = name, Sleep = true, Damping = 0, Steps = 600 };
        int ground = scene.AddBox(plaza, 1, plaza);
        int ball = scene.AddSphere(0.5f);
        int house = scene.AddBox(1, 2, 1);
        int box = scene.AddBox(0.4f, 0.4f, 0.4f);
        scene.AddStatic(ground, new Vector3(0, -1, -plaza - 20));
        for (int i = 0; i < MovingCount; ++i)
        {
            var place = new Vector3(ManyStatics.Place(i % 20, 20, 4), 0.5f, -60 - i / 20 * 4);
            scene.AddDynamic(ball, 1, place, linearVelocity: new Vector3(0, 0, -3), angularVelocity: new Vector3(-6, 0, 0));
        }
        for (int i = 0; i < width * width; ++i)
        {
            var place = new Vector3(ManyStatics.Place(i % width, width, 3), -2, i / width * 3);
            scene.AddStatic(house, place);
            scene.AddDynamic(box, 1, place + new Vector3(0, 2.4f, 0));
        }
        return scene;
    }
}
