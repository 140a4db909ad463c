using System.Runtime.CompilerServices;
using BepuPhysics;
using BepuPhysics.Collidables;

namespace Demos.Engine;

/// <summary>Handles as small numbers, which they are there.</summary>
static class EngineHandles
{
    public static int Number(BodyHandle handle) => handle.Value;

    public static int Number(StaticHandle handle) => handle.Value;

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static int Number(CollidableReference collidable) =>
        collidable.Mobility == CollidableMobility.Static ? collidable.StaticHandle.Value : collidable.BodyHandle.Value;

    public static bool TryGetHandle(Bodies bodies, int number, out BodyHandle handle)
    {
        handle = new BodyHandle(number);
        return bodies.BodyExists(handle);
    }
}
