using System.Numerics;

namespace Demos.Scenes.BuiltIn;

/// <summary>A net of knots that hangs by its four sides, into which a heavy ball falls.</summary>
static class RopeNet
{
    const int Width = 25;
    const float Spacing = .4f;

    public static BuiltInScene Scene { get; } = new("rope-net", "a net of 625 knots, held at its sides, catches a ball of 50 kg", _ => Create());

    static SceneDescription Create()
    {
        var scene = new SceneDescription { Name = Scene.Name, Steps = 480 };
        int knot = scene.AddSphere(.1f), ball = scene.AddSphere(.8f);
        for (int i = 0; i < Width * Width; ++i)
        {
            int x = i % Width, z = i / Width;
            bool isHeld = x is 0 or Width - 1 || z is 0 or Width - 1;
            scene.Bodies.Add(new SceneBody
            {
                Kind = isHeld ? SceneBodyKind.Kinematic : SceneBodyKind.Dynamic,
                Children = [new SceneChild(knot, Vector3.Zero, Quaternion.Identity)],
                Mass = isHeld ? 0 : .5f,
                Position = new Vector3(x - (Width - 1) / 2, 0, z - (Width - 1) / 2) * Spacing,
                Group = 1,
            });
            if (x > 0 && !(isHeld && IsHeld(i - 1)))
                Tie(scene, i - 1, i, Vector3.UnitX);
            if (z > 0 && !(isHeld && IsHeld(i - Width)))
                Tie(scene, i - Width, i, Vector3.UnitZ);
        }
        scene.AddDynamic(ball, 50, new Vector3(0, 2, 0));
        return scene;
    }

    static bool IsHeld(int knot) => knot % Width is 0 or Width - 1 || knot / Width is 0 or Width - 1;

    static void Tie(SceneDescription scene, int a, int b, Vector3 direction) => scene.Joints.Add(new SceneJoint
    {
        Kind = SceneJointKind.Ball,
        BodyA = a,
        BodyB = b,
        AnchorA = direction * (Spacing / 2),
        AnchorB = direction * (-Spacing / 2),
    });
}
