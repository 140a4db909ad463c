using System.Numerics;
using Demos.Scenes;

namespace Demos.Towers.Structures;

/// <summary>What all structures stand on.</summary>
static class Ground
{
    /// <summary>Density of all parts, kg/m3.</summary>
    public const float Density = 1000;

    const float HalfWidth = 100;

    /// <summary>A scene with a floor whose surface is at y = 0.</summary>
    public static SceneDescription Create(string name)
    {
        var scene = new SceneDescription { Name = name, Damping = 0 };
        scene.AddStatic(scene.AddBox(HalfWidth, 1, HalfWidth), new Vector3(0, -1, 0));
        return scene;
    }

    /// <summary>Adds a box by its size, with the mass that its volume has.</summary>
    public static void AddBox(this SceneDescription scene, Vector3 size, Vector3 center, Quaternion? orientation = null) =>
        scene.AddDynamic(scene.AddBox(size.X / 2, size.Y / 2, size.Z / 2), size.X * size.Y * size.Z * Density, center, orientation);

    /// <summary>A turn about z, which takes x towards y.</summary>
    public static Quaternion Tilt(float radians) => new(0, 0, float.Sin(radians / 2), float.Cos(radians / 2));
}
