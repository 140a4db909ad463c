using System;
using System.Globalization;
using System.Linq;
using System.Numerics;
using System.Text;
using Demos.Scenes;
using Demos.Scenes.BuiltIn;

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

    /// <summary>A built-in pile with fewer bodies, in a pit, so that all of them meet and none rolls away.</summary>
    /// <param name="name">"shape-pile" or "hull-pile".</param>
    /// <param name="columns">Bodies along each side of the pit.</param>
    /// <param name="layers">Bodies on each other.</param>
    public static SceneDescription Pile(string name, int columns, int layers)
    {
        var whole = SceneLibrary.Load(name, 1);
        const float spacing = 1.3f;
        var scene = new SceneDescription { Name = $"small {name}", Friction = whole.Friction, Damping = whole.Damping };
        scene.Shapes.AddRange(whole.Shapes);
        Demos.Scenes.BuiltIn.Pit.Add(scene, columns * spacing / 2 + .2f);
        var bodies = whole.Bodies.FindAll(body => body.Kind == SceneBodyKind.Dynamic);
        for (int i = 0; i < columns * columns * layers; ++i)
        {
            int x = i % columns, z = i / columns % columns, y = i / (columns * columns);
            var position = new Vector3(x - (columns - 1) * .5f, .8f + y, z - (columns - 1) * .5f) * spacing;
            scene.AddDynamic(bodies[i].Children[0].Shape, bodies[i].Mass, position, bodies[i].Orientation);
        }
        return scene;
    }

    /// <summary>Bodies of all kinds that fall, some of them so fast that rounding takes of their velocity.</summary>
    public static SceneDescription Fast(int seed)
    {
        var random = new Random(seed);
        var scene = new SceneDescription { Name = "fast bodies", Damping = 0 };
        int[] shapes = [scene.AddSphere(.5f), scene.AddBox(.4f, .3f, .5f), scene.AddCapsule(.3f, .4f), scene.AddCylinder(.4f, .3f)];
        scene.AddStatic(scene.AddBox(100, 1, 100), new Vector3(0, -1, 0));
        for (int i = 0; i < 37; ++i)
        {
            // A third is fast, of these some upwards and some into the floor.
            float speed = i % 3 == 0 ? MathF.Pow(10, 1.5f + 2.5f * random.NextSingle()) : 3;
            scene.AddDynamic(shapes[i % shapes.Length], 1, TestWorld.Scatter(random, 12) + new Vector3(0, 7, 0), TestWorld.Turn(random),
                TestWorld.Scatter(random, 2 * speed), TestWorld.Scatter(random, 10));
        }
        return scene;
    }

    /// <summary>Stacks that sleep, and a ball that wakes some of them.</summary>
    public static SceneDescription Wave() => WakingWave.Create("small-wave", stackCount: 200, width: 14);

    /// <summary>The first of the built-in scene of dynamic meshes on a mesh.</summary>
    public static SceneDescription Tori(int count)
    {
        var scene = SceneLibrary.Load("tori", 1);
        int kept = scene.Bodies.FindIndex(body => body.Kind == SceneBodyKind.Dynamic) + count;
        scene.Bodies.RemoveRange(kept, scene.Bodies.Count - kept);
        return scene;
    }

    /// <summary>The text of a scene without joints; every number comes back as it was.</summary>
    public static string Write(SceneDescription scene)
    {
        var text = new StringBuilder();
        text.Append(CultureInfo.InvariantCulture, $"scene 1 name {scene.Name.Replace(' ', '-')} steps {scene.Steps}");
        text.Append(CultureInfo.InvariantCulture, $" friction {scene.Friction} damping {scene.Damping} sleep {(scene.Sleep ? 1 : 0)}\n");
        text.Append(CultureInfo.InvariantCulture, $"shapes {scene.Shapes.Count}\n");
        foreach (var shape in scene.Shapes)
        {
            text.Append(shape.Word);
            switch (shape.Kind)
            {
                case SceneShapeKind.Box:
                    text.Append(Text(shape.Size));
                    break;
                case SceneShapeKind.Sphere:
                    text.Append(CultureInfo.InvariantCulture, $" {shape.Size.X}");
                    break;
                case SceneShapeKind.Hull:
                    text.Append(CultureInfo.InvariantCulture, $" {shape.Points.Length}").AppendJoin("", shape.Points.Select(Text));
                    break;
                default:
                    text.Append(CultureInfo.InvariantCulture, $" {shape.Size.X} {shape.Size.Y}");
                    break;
            }
            text.Append('\n');
        }
        text.Append(CultureInfo.InvariantCulture, $"bodies {scene.Bodies.Count}\n");
        foreach (var body in scene.Bodies)
        {
            text.Append(CultureInfo.InvariantCulture, $"{(int)body.Kind} 1 {body.Children[0].Shape} 0 0 0 0 0 0 1 {body.Mass}");
            text.Append(Text(body.Position)).Append(Text(body.Orientation));
            text.Append(Text(body.LinearVelocity)).Append(Text(body.AngularVelocity));
            text.Append(CultureInfo.InvariantCulture, $" {body.Group}\n");
        }
        return text.Append("joints 0\n").ToString();
    }

    static string Text(Vector3 v) => string.Create(CultureInfo.InvariantCulture, $" {v.X} {v.Y} {v.Z}");

    static string Text(Quaternion q) => string.Create(CultureInfo.InvariantCulture, $" {q.X} {q.Y} {q.Z} {q.W}");

    static void Link(SceneDescription scene, int width, int body, int x, int z)
    {
        if (x < 0 || x >= width || z >= width)
            return;
        int other = x * width + z;
        var half = (scene.Bodies[other].Position - scene.Bodies[body].Position) / 2;
        scene.Joints.Add(new SceneJoint { Kind = SceneJointKind.Ball, BodyA = body, BodyB = other, AnchorA = half, AnchorB = -half });
    }
}
