using System;
using System.Numerics;

namespace Demos.Scenes.BuiltIn;

/// <summary>
/// Boxes, capsules and spheres on planks, each steeper than the one before. With friction 0.5 a box holds on those whose tangent is
/// below one half and slides on the others, whatever its size and mass; spheres and capsules roll.
/// </summary>
static class Slope
{
    /// <summary>Tangents of the planks' angles: five that hold a box, three that do not.</summary>
    static readonly double[] tangents = [0.1, 0.25, 0.4, 0.45, 0.48, 0.52, 0.55, 0.7];

    public static BuiltInScene Scene { get; } = new(
        "slope", "boxes on planks about the angle of friction; five of eight hold", _ => Create());

    static SceneDescription Create()
    {
        var scene = new SceneDescription { Name = Scene.Name, Steps = 120, Damping = 0 };
        int plank = scene.AddBox(40, 0.5f, 2);
        int smallBox = scene.AddBox(0.25f, 0.25f, 0.25f);
        int flatBox = scene.AddBox(1, 0.25f, 0.5f);
        int sphere = scene.AddSphere(0.5f);
        int capsule = scene.AddCapsule(0.25f, 0.5f);
        // The capsule lies across the plank.
        float quarter = (float)Math.Sqrt(0.5);
        var lying = new Quaternion(quarter, 0, 0, quarter);
        for (int i = 0; i < tangents.Length; ++i)
        {
            Frame(tangents[i], out Quaternion tilt, out Vector3 along, out Vector3 up);
            var center = new Vector3(0, 0, (i - 3.5f) * 6);
            scene.AddStatic(plank, center, tilt);
            scene.AddDynamic(smallBox, 1, center + along * -9 + up * 0.75f, tilt);
            scene.AddDynamic(flatBox, 5, center + along * -3 + up * 0.75f, tilt);
            scene.AddDynamic(sphere, 2, center + along * 3 + up * 1, tilt);
            scene.AddDynamic(capsule, 2, center + along * 9 + up * 0.75f, Turn(lying, tilt));
        }
        return scene;
    }

    /// <summary>The plank's frame: x rises, and the rotation about z has the given tangent.</summary>
    static void Frame(double tangent, out Quaternion tilt, out Vector3 along, out Vector3 up)
    {
        double cosine = 1 / Math.Sqrt(1 + tangent * tangent), sine = tangent * cosine;
        tilt = new Quaternion(0, 0, (float)Math.Sqrt((1 - cosine) / 2), (float)Math.Sqrt((1 + cosine) / 2));
        along = new Vector3((float)cosine, (float)sine, 0);
        up = new Vector3((float)-sine, (float)cosine, 0);
    }

    /// <summary>The product of a rotation about x and one about z, written out: the framework's is not the same bits everywhere.</summary>
    static Quaternion Turn(Quaternion aboutX, Quaternion aboutZ) =>
        new(aboutZ.W * aboutX.X, aboutZ.Z * aboutX.X, aboutZ.Z * aboutX.W, aboutZ.W * aboutX.W);
}
