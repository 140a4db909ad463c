using System.Numerics;
using Demos.Scenes;

namespace DemoTests.Scenes;

/// <summary>Built-in scenes in sizes that a test can afford.</summary>
static class SmallScenes
{
    public static SceneDescription Pyramids(int count, int baseCount)
    {
        var scene = new SceneDescription { Name = "small pyramids" };
        int box = scene.AddBox(.5f, .5f, .5f);
        scene.AddStatic(scene.AddBox(100, 1, 100), new Vector3(0, -1, 0));
        for (int i = 0; i < count; ++i)
            Demos.Scenes.BuiltIn.Pyramids.AddPyramid(scene, box, baseCount, i * 5);
        return scene;
    }

    /// <summary>A sheet of spheres that hangs by its corners, with joints along the sides and the diagonals of its squares.</summary>
    public static SceneDescription Lattice(int width)
    {
        var scene = new SceneDescription { Name = "small lattice" };
        int sphere = scene.AddSphere(.5f);
        for (int i = 0; i < width * width; ++i)
        {
            (int x, int z) = (i / width, i % width);
            bool isCorner = (x == 0 || x == width - 1) && (z == 0 || z == width - 1);
            scene.Bodies.Add(new SceneBody
            {
                Kind = isCorner ? SceneBodyKind.Kinematic : SceneBodyKind.Dynamic,
                Children = [new SceneChild(sphere, Vector3.Zero, Quaternion.Identity)],
                Mass = isCorner ? 0 : 1,
                Position = new Vector3(2 * x, 0, 2 * z),
                Group = -1,
            });
        }
        for (int i = 0; i < width * width; ++i)
        {
            (int x, int z) = (i / width, i % width);
            Link(scene, width, i, x + 1, z);
            Link(scene, width, i, x, z + 1);
            Link(scene, width, i, x + 1, z + 1);
            Link(scene, width, i, x - 1, z + 1);
        }
        return scene;
    }

    static void Link(SceneDescription scene, int width, int body, int x, int z)
    {
        if (x < 0 || x >= width || z >= width)
            return;
        int other = x * width + z;
        var half = (scene.Bodies[other].Position - scene.Bodies[body].Position) / 2;
        scene.Joints.Add(new SceneJoint { Kind = SceneJointKind.Ball, BodyA = body, BodyB = other, AnchorA = half, AnchorB = -half });
    }
}
