using BepuPhysics;
using BepuPhysics.Collidables;

namespace Demos.Accuracy;

/// <summary>Floors of the suite that bepuphysics2 has beyond the common ones: none.</summary>
static class EngineFloors
{
    public static readonly string[] Flat = [];

    public static bool TryAdd(AccuracyWorld world, string kind, RigidPose surface, in Triangle triangle) => false;
}
