using System;
using System.Numerics;

namespace Demos.Scenes.BuiltIn;

/// <summary>Rings of boxes with a hole in their middle, dropped over pegs.</summary>
static class Washer
{
    const int Side = 6, Height = 14, BoxCount = 8;
    const float Spacing = 3, HoleRadius = .3f, OuterRadius = .8f, HalfThickness = .08f;

    public static BuiltInScene Scene { get; } = new("washer", "504 rings of 8 boxes dropped on 36 pegs, by --seed", Create);

    static SceneDescription Create(int seed)
    {
        var scene = new SceneDescription { Name = Scene.Name, Steps = 600 };
        var random = new SceneRandom(seed);
        int floor = scene.AddBox(20, 1, 20);
        int peg = scene.AddCylinder(.2f, 2);
        // The boxes meet at their outer edges and overlap further in.
        int part = scene.AddBox((OuterRadius - HoleRadius) / 2, HalfThickness, OuterRadius * (float)Math.Tan(Math.PI / BoxCount));
        var ring = new SceneChild[BoxCount];
        for (int i = 0; i < BoxCount; ++i)
        {
            double angle = 2 * Math.PI * i / BoxCount;
            float radius = (OuterRadius + HoleRadius) / 2;
            ring[i] = new SceneChild(part, new Vector3(radius * (float)Math.Cos(angle), 0, -radius * (float)Math.Sin(angle)), AroundY(angle));
        }
        scene.AddStatic(floor, new Vector3(0, -1, 0));
        for (int x = 0; x < Side; ++x)
        {
            for (int z = 0; z < Side; ++z)
            {
                var foot = new Vector3((x - (Side - 1) / 2f) * Spacing, 0, (z - (Side - 1) / 2f) * Spacing);
                scene.AddStatic(peg, foot + new Vector3(0, 2, 0));
                for (int i = 0; i < Height; ++i)
                {
                    scene.Bodies.Add(new SceneBody
                    {
                        Kind = SceneBodyKind.Dynamic,
                        Children = ring,
                        Mass = 1,
                        Position = foot + new Vector3(random.Next(-.08f, .08f), 4.3f + .4f * i, random.Next(-.08f, .08f)),
                        Orientation = AroundY(random.Next() * 2 * Math.PI),
                    });
                }
            }
        }
        return scene;
    }

    static Quaternion AroundY(double angle) => new(0, (float)Math.Sin(angle / 2), 0, (float)Math.Cos(angle / 2));
}
