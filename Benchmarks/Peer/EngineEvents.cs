using BepuPhysics;
using Demos.Scenes;

namespace Demos.Engine;

/// <summary>bepuphysics2 tells no events.</summary>
static class EngineEvents
{
    public static void ListenToAll(Simulation simulation) => throw new SceneException("this engine has no events to listen to");

    public static ulong Hash(Simulation simulation, ulong state) => state;
}
