using System;
using System.Numerics;

namespace Demos.Scenes.BuiltIn;

/// <summary>Ragdolls in a tube of boxes that turns around its length, with a ledge that lifts them.</summary>
static class RagdollTube
{
    readonly record struct Part(int Shape, Vector3 Position, float Mass);

    readonly record struct Link(int A, int B, Vector3 Place, float Swing, float MinimumTwist, float MaximumTwist);

    public static BuiltInScene Scene { get; } = new("ragdoll-tube", "64 ragdolls of 11 parts in a turning tube of 7 boxes, by --seed", Create);

    static SceneDescription Create(int seed)
    {
        var scene = new SceneDescription { Name = Scene.Name, Steps = 600, Friction = .6f };
        AddTube(scene);
        Part[] parts = CreateParts(scene);
        var random = new SceneRandom(seed);
        int group = 0;
        for (int x = 0; x < 4; ++x)
        {
            for (int y = 0; y < 2; ++y)
            {
                for (int z = 0; z < 8; ++z)
                    AddRagdoll(scene, parts, new Vector3((x - 1.5f) * 1.6f, -1.7f + 3.4f * y, (z - 3.5f) * 2.8f), random.Next() * 2 * Math.PI, ++group);
            }
        }
        return scene;
    }

    static void AddTube(SceneDescription scene)
    {
        int floor = scene.AddBox(5, .5f, 12), side = scene.AddBox(.5f, 4, 12), end = scene.AddBox(5, 5, .5f), ledge = scene.AddBox(.25f, 1, 12);
        scene.Bodies.Add(new SceneBody
        {
            Kind = SceneBodyKind.Kinematic,
            AngularVelocity = new Vector3(0, 0, .5f),
            Children =
            [
                At(floor, 0, -4.5f, 0), At(floor, 0, 4.5f, 0), At(side, -4.5f, 0, 0), At(side, 4.5f, 0, 0),
                At(end, 0, 0, -12.5f), At(end, 0, 0, 12.5f), At(ledge, 0, -3, 0),
            ],
        });
    }

    static SceneChild At(int shape, float x, float y, float z) => new(shape, new Vector3(x, y, z), Quaternion.Identity);

    static Part[] CreateParts(SceneDescription scene)
    {
        int upperArm = scene.AddCapsule(.06f, .1f), lowerArm = scene.AddCapsule(.05f, .12f);
        int upperLeg = scene.AddCapsule(.08f, .15f), lowerLeg = scene.AddCapsule(.07f, .17f);
        return
        [
            new(scene.AddBox(.17f, .1f, .1f), new Vector3(0, 0, 0), 8), new(scene.AddBox(.2f, .25f, .12f), new Vector3(0, .38f, 0), 16),
            new(scene.AddCapsule(.1f, .05f), new Vector3(0, .82f, 0), 4),
            new(upperArm, new Vector3(-.27f, .44f, 0), 2.5f), new(upperArm, new Vector3(.27f, .44f, 0), 2.5f),
            new(lowerArm, new Vector3(-.27f, .1f, 0), 2), new(lowerArm, new Vector3(.27f, .1f, 0), 2),
            new(upperLeg, new Vector3(-.1f, -.36f, 0), 7), new(upperLeg, new Vector3(.1f, -.36f, 0), 7),
            new(lowerLeg, new Vector3(-.1f, -.85f, 0), 5), new(lowerLeg, new Vector3(.1f, -.85f, 0), 5),
        ];
    }

    static readonly Link[] links =
    [
        new(0, 1, new Vector3(0, .115f, 0), .3f, -.4f, .4f), new(1, 2, new Vector3(0, .66f, 0), .5f, -.5f, .5f),
        new(1, 3, new Vector3(-.27f, .57f, 0), 1.4f, -.8f, .8f), new(1, 4, new Vector3(.27f, .57f, 0), 1.4f, -.8f, .8f),
        new(3, 5, new Vector3(-.27f, .275f, 0), 1.4f, -.4f, .4f), new(4, 6, new Vector3(.27f, .275f, 0), 1.4f, -.4f, .4f),
        new(0, 7, new Vector3(-.1f, -.115f, 0), 1, -.4f, .4f), new(0, 8, new Vector3(.1f, -.115f, 0), 1, -.4f, .4f),
        new(7, 9, new Vector3(-.1f, -.6f, 0), 1.2f, -.2f, .2f), new(8, 10, new Vector3(.1f, -.6f, 0), 1.2f, -.2f, .2f),
    ];

    static void AddRagdoll(SceneDescription scene, Part[] parts, Vector3 place, double angle, int group)
    {
        int first = scene.Bodies.Count;
        var (sin, cos) = ((float)Math.Sin(angle), (float)Math.Cos(angle));
        var turn = new Quaternion(0, (float)Math.Sin(angle / 2), 0, (float)Math.Cos(angle / 2));
        foreach (Part part in parts)
        {
            Vector3 p = part.Position;
            scene.Bodies.Add(new SceneBody
            {
                Kind = SceneBodyKind.Dynamic,
                Children = [new SceneChild(part.Shape, Vector3.Zero, Quaternion.Identity)],
                Mass = part.Mass,
                Position = place + new Vector3(cos * p.X + sin * p.Z, p.Y, cos * p.Z - sin * p.X),
                Orientation = turn,
                Group = group,
            });
        }
        foreach (Link link in links)
        {
            scene.Joints.Add(new SceneJoint
            {
                Kind = SceneJointKind.Rag,
                BodyA = first + link.A,
                BodyB = first + link.B,
                AnchorA = link.Place - parts[link.A].Position,
                AnchorB = link.Place - parts[link.B].Position,
                MaximumSwing = link.Swing,
                MinimumTwist = link.MinimumTwist,
                MaximumTwist = link.MaximumTwist,
            });
        }
    }
}
