using System;
using System.Runtime.CompilerServices;

namespace BepuPhysics.CollisionDetection;

/// <summary>Narrow phase callbacks that also say what surfaces do besides friction and stiffness: whether they bounce.</summary>
/// <typeparam name="TSelf">The struct that implements this.</typeparam>
/// <remarks>
/// In the place of <see cref="INarrowPhaseCallbacks"/>, as in <c>struct Contacts : ISurfaceCallbacks&lt;Contacts&gt;</c>. Callbacks that do not
/// implement this are not asked, and pay nothing.
/// </remarks>
// An interface method with a body would box the callbacks that do not implement it, and a field of the material would break every game that
// fills in a material field by field. So the narrow phase calls a static method, which is empty unless this interface replaces it.
public interface ISurfaceCallbacks<TSelf> : INarrowPhaseCallbacks where TSelf : struct, ISurfaceCallbacks<TSelf>
{
    /// <summary>Called for a pair whose contacts push, after its material was chosen. Called from worker threads.</summary>
    /// <remarks>
    /// Pairs that wake since something has touched their island are not tested in that step. They keep their materials, and this is called for each of their
    /// manifolds, as worker 0, with the contacts with which they fell asleep.
    /// </remarks>
    SurfaceProperties GetSurface<TManifold>(int workerIndex, CollidablePair pair, ref TManifold manifold)
        where TManifold : unmanaged, IContactManifold<TManifold>;

    static bool INarrowPhaseCallbacks.HasSurfaces => true;

    static SurfaceProperties INarrowPhaseCallbacks.SurfaceOf<TCallbacks, TManifold>(
        ref TCallbacks callbacks, int workerIndex, in CollidablePair pair, ref TManifold manifold)
    {
        if (typeof(TCallbacks) != typeof(TSelf))
            throw new InvalidOperationException($"{typeof(TCallbacks)} implements ISurfaceCallbacks of {typeof(TSelf)}, not of itself.");
        return Unsafe.As<TCallbacks, TSelf>(ref callbacks).GetSurface(workerIndex, pair, ref manifold);
    }
}
