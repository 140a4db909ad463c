using System.Numerics;

namespace Demos.Scenes.BuiltIn;

/// <summary>A floor at height zero with four walls.</summary>
static class Pit
{
    /// <summary>Adds a pit with its middle above the origin.</summary>
    public static void Add(SceneDescription scene, float halfWidth)
    {
        const float halfHeight = 20;
        int floor = scene.AddBox(20, 1, 20);
        int wallX = scene.AddBox(1, halfHeight, halfWidth + 2);
        int wallZ = scene.AddBox(halfWidth, halfHeight, 1);
        scene.AddStatic(floor, new Vector3(0, -1, 0));
        scene.AddStatic(wallX, new Vector3(-halfWidth - 1, halfHeight, 0));
        scene.AddStatic(wallX, new Vector3(halfWidth + 1, halfHeight, 0));
        scene.AddStatic(wallZ, new Vector3(0, halfHeight, -halfWidth - 1));
        scene.AddStatic(wallZ, new Vector3(0, halfHeight, halfWidth + 1));
    }
}
