using System.Runtime.CompilerServices;
using BepuPhysics;
using BepuPhysics.Collidables;

namespace Demos.Engine;

/// <summary>Handles as small numbers: here they are slots, each with a generation beside it.</summary>
static class EngineHandles
{
    public static int Number(BodyHandle handle) => handle.Slot;

    public static int Number(StaticHandle handle) => handle.Slot;

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static int Number(CollidableReference collidable) => collidable.Slot;

    /// <summary>The body that has a number now.</summary>
    public static bool TryGetHandle(Bodies bodies, int number, out BodyHandle handle) => bodies.TryGetHandle(number, out handle);
}
