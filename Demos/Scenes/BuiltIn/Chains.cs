using System.Numerics;

namespace Demos.Scenes.BuiltIn;

/// <summary>Links of 1 kg that hang in a row, with a load at the end that is many times as heavy: rigid links do not stretch.</summary>
static class Chains
{
    const int Links = 100;
    const float HalfLink = .1f;

    public static BuiltInScene Hundredfold { get; } = new("chain", "100 links of 1 kg hang with 100 kg at the end", _ => Create("chain", 100));

    public static BuiltInScene Thousandfold { get; } = new("chain-1000", "100 links of 1 kg hang with 1,000 kg at the end", _ => Create("chain-1000", 1000));

    static SceneDescription Create(string name, float load)
    {
        var scene = new SceneDescription { Name = name, Steps = 600 };
        int link = scene.AddCapsule(HalfLink / 2, HalfLink / 2), ball = scene.AddSphere(HalfLink);
        scene.Bodies.Add(new SceneBody { Kind = SceneBodyKind.Kinematic, Children = [], Group = -1 });
        for (int i = 0; i <= Links; ++i)
        {
            bool isLoad = i == Links;
            scene.AddDynamic(isLoad ? ball : link, isLoad ? load : 1, new Vector3(0, -(2 * i + 1) * HalfLink, 0),
                linearVelocity: isLoad ? new Vector3(.5f, 0, .25f) : default, group: -1);
            scene.Joints.Add(new SceneJoint
            {
                Kind = SceneJointKind.Ball,
                BodyA = i,
                BodyB = i + 1,
                AnchorA = i == 0 ? Vector3.Zero : new Vector3(0, -HalfLink, 0),
                AnchorB = new Vector3(0, HalfLink, 0),
            });
        }
        return scene;
    }
}
