using System;
using System.Numerics;

namespace Demos.Scenes.BuiltIn;

/// <summary>Gears that are compounds of a hub and 36 teeth, all of them hulls, dropped in a heap.</summary>
static class GearsOfHulls
{
    const int ToothCount = 36, Side = 5, Layers = 4;
    const float HubRadius = .5f, Length = .12f, HalfThickness = .1f;

    public static BuiltInScene Scene { get; } = new("gears-of-hulls", "100 gears of 37 hulls each dropped in a heap, by --seed", Create);

    static SceneDescription Create(int seed)
    {
        var random = new SceneRandom(seed);
        var scene = new SceneDescription { Name = Scene.Name, Steps = 600, Sleep = true };
        int floor = scene.AddBox(20, 1, 20);
        int hub = scene.AddHull(Prism(ToothCount, HubRadius));
        int tooth = scene.AddHull(Tooth());
        var gear = new SceneChild[ToothCount + 1];
        gear[0] = new SceneChild(hub, Vector3.Zero, Quaternion.Identity);
        for (int i = 0; i < ToothCount; ++i)
        {
            double angle = 2 * Math.PI * i / ToothCount;
            var turn = new Quaternion(0, (float)Math.Sin(angle / 2), 0, (float)Math.Cos(angle / 2));
            gear[i + 1] = new SceneChild(tooth, new Vector3(HubRadius * (float)Math.Cos(angle), 0, -HubRadius * (float)Math.Sin(angle)), turn);
        }
        scene.AddStatic(floor, new Vector3(0, -1, 0));
        for (int i = 0; i < Side * Side * Layers; ++i)
        {
            var cell = new Vector3(i % Side - (Side - 1) / 2f, i / (Side * Side), i / Side % Side - (Side - 1) / 2f);
            scene.Bodies.Add(new SceneBody
            {
                Kind = SceneBodyKind.Dynamic,
                Children = gear,
                Mass = 1,
                Position = cell * 1.4f + new Vector3(0, 1, 0),
                Orientation = random.NextRotation(),
            });
        }
        return scene;
    }

    static Vector3[] Prism(int count, float radius)
    {
        var points = new Vector3[2 * count];
        for (int i = 0; i < points.Length; ++i)
        {
            double angle = 2 * Math.PI * (i / 2) / count;
            points[i] = new(radius * (float)Math.Cos(angle), i % 2 == 0 ? HalfThickness : -HalfThickness, radius * (float)Math.Sin(angle));
        }
        return points;
    }

    // Points out along x, and is narrower there. It begins a little inside of the hub.
    static Vector3[] Tooth()
    {
        var points = new Vector3[8];
        for (int i = 0; i < points.Length; ++i)
        {
            bool isTip = (i & 1) != 0;
            float halfWidth = isTip ? .012f : .025f;
            points[i] = new(isTip ? Length : -.02f, (i & 2) != 0 ? HalfThickness : -HalfThickness, (i & 4) != 0 ? halfWidth : -halfWidth);
        }
        return points;
    }
}
