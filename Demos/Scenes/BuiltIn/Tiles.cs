using System;
using System.Numerics;

namespace Demos.Scenes.BuiltIn;

/// <summary>Balls and boxes sent across a floor of separate boxes: what a level of tiles costs, and whether its seams are felt.</summary>
static class Tiles
{
    const int FloorWidth = 100, RowCount = 45;
    const float RowSpacing = 2, HalfThickness = .25f;

    public static BuiltInScene Scene { get; } = new("tiles", "10,000 static boxes side by side, and 180 balls and boxes sent across, by --seed", Create);

    static SceneDescription Create(int seed)
    {
        var random = new SceneRandom(seed);
        var scene = new SceneDescription { Name = Scene.Name, Friction = .3f };
        int tile = scene.AddBox(.5f, HalfThickness, .5f);
        int ball = scene.AddSphere(.4f), box = scene.AddBox(.3f, .2f, .4f);
        for (int i = 0; i < FloorWidth * FloorWidth; ++i)
        {
            var place = new Vector3(ManyStatics.Place(i % FloorWidth, FloorWidth, 1), -HalfThickness, ManyStatics.Place(i / FloorWidth, FloorWidth, 1));
            scene.AddStatic(tile, place);
        }
        // Two rows along x, one from either side, and two along z that cross them later.
        for (int i = 0; i < RowCount; ++i)
        {
            float across = ManyStatics.Place(i, RowCount, RowSpacing);
            Send(scene, ball, .4f, new Vector3(-48, .4f, across), Vector3.UnitX * random.Next(5, 15), random);
            Send(scene, box, .2f, new Vector3(48, .2f, across + RowSpacing / 2), -Vector3.UnitX * random.Next(3, 15), random);
            Send(scene, box, .2f, new Vector3(across, .2f, -46), Vector3.UnitZ * random.Next(3, 15), random);
            Send(scene, ball, .4f, new Vector3(across + RowSpacing / 2, .4f, 46), -Vector3.UnitZ * random.Next(5, 15), random);
        }
        return scene;
    }

    static void Send(SceneDescription scene, int shape, float radius, Vector3 position, Vector3 velocity, SceneRandom random)
    {
        bool rolls = scene.Shapes[shape].Kind == SceneShapeKind.Sphere;
        double angle = random.Next() * Math.PI;
        var orientation = new Quaternion(0, (float)Math.Sin(angle / 2), 0, (float)Math.Cos(angle / 2));
        scene.AddDynamic(shape, 1, position, orientation, velocity, rolls ? Rolling(velocity, radius) : default);
    }

    // A ball that rolls turns about the axis across its way.
    static Vector3 Rolling(Vector3 velocity, float radius) => new(velocity.Z / radius, 0, -velocity.X / radius);
}
