using System.Numerics;

namespace Demos.Scenes.BuiltIn;

/// <summary>A sheet of spheres that hangs by its corners: joints and nothing else.</summary>
static class ClothLattice
{
    const int Width = 128;
    const float Spacing = 1.75f;

    public static BuiltInScene Scene { get; } = new(
        "cloth-lattice", "16,384 spheres linked by 64,770 ball joints, no contacts", _ => Create());

    static SceneDescription Create()
    {
        var scene = new SceneDescription { Name = Scene.Name, Steps = 120 };
        int sphere = scene.AddSphere(0.5f);
        for (int i = 0; i < Width; ++i)
        {
            for (int j = 0; j < Width; ++j)
            {
                bool isCorner = i is 0 or Width - 1 && j is 0 or Width - 1;
                scene.Bodies.Add(new SceneBody
                {
                    Kind = isCorner ? SceneBodyKind.Kinematic : SceneBodyKind.Dynamic,
                    Children = [new SceneChild(sphere, Vector3.Zero, Quaternion.Identity)],
                    Mass = isCorner ? 0 : 1,
                    Position = new Vector3((i - 63.5f) * Spacing, 0, (j - 63.5f) * Spacing),
                    Group = -1,
                });
            }
        }
        for (int i = 0; i < Width; ++i)
        {
            for (int j = 0; j < Width; ++j)
            {
                int body = i * Width + j;
                if (i < Width - 1)
                    Link(scene, body, body + Width, new Vector3(1, 0, 0));
                if (j < Width - 1)
                    Link(scene, body, body + 1, new Vector3(0, 0, 1));
                if (i < Width - 1 && j < Width - 1)
                    Link(scene, body, body + Width + 1, new Vector3(1, 0, 1));
                if (i > 0 && j < Width - 1)
                    Link(scene, body, body - Width + 1, new Vector3(-1, 0, 1));
            }
        }
        return scene;
    }

    static void Link(SceneDescription scene, int a, int b, Vector3 direction) => scene.Joints.Add(new SceneJoint
    {
        Kind = SceneJointKind.Ball,
        BodyA = a,
        BodyB = b,
        AnchorA = direction * (Spacing / 2),
        AnchorB = direction * (-Spacing / 2),
    });
}
