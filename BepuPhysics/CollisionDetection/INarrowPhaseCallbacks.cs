using BepuPhysics.Collidables;

namespace BepuPhysics.CollisionDetection;

/// <summary>Decides which pairs collide and what their surfaces are made of.</summary>
/// <remarks>
/// Implement this with a struct: the narrow phase is compiled for it, so calls are direct and usually inlined. Methods with a worker index
/// are called from worker threads, in no particular order; do not change the simulation from inside them.
/// Implement <see cref="ISurfaceCallbacks{TSelf}"/> instead for surfaces that bounce.
/// </remarks>
public interface INarrowPhaseCallbacks
{
    /// <summary>Chooses the material of a pair whose contacts were found, and may change them.</summary>
    /// <returns>Whether the contacts push the bodies apart.</returns>
    bool ConfigureContactManifold<TManifold>(int workerIndex, CollidablePair pair, ref TManifold manifold, out PairMaterialProperties pairMaterial)
        where TManifold : unmanaged, IContactManifold<TManifold>;

    /// <summary>Whether to look for contacts of a pair whose bounds overlap.</summary>
    /// <param name="workerIndex">Index of the calling worker.</param>
    /// <param name="a">First collidable; never a static.</param>
    /// <param name="b">Second collidable.</param>
    /// <param name="speculativeMargin">Distance within which contacts are looked for, m; may be changed.</param>
    bool AllowContactGeneration(int workerIndex, CollidableReference a, CollidableReference b, ref float speculativeMargin);

    /// <summary>Whether to look for contacts between two children of compounds.</summary>
    bool AllowContactGeneration(int workerIndex, CollidablePair pair, int childIndexA, int childIndexB);

    /// <summary>May change the contacts between two children of compounds.</summary>
    /// <returns>Whether the contacts are kept.</returns>
    bool ConfigureContactManifold(int workerIndex, CollidablePair pair, int childIndexA, int childIndexB, ref ConvexContactManifold manifold);

    /// <summary>Called once, when the simulation has been created.</summary>
    void Initialize(Simulation simulation);

    /// <summary>Called once, when the simulation is disposed.</summary>
    void Dispose();

    /// <summary>What <see cref="ISurfaceCallbacks{TSelf}"/> says of a pair; nothing where the callbacks do not implement it.</summary>
    internal static virtual SurfaceProperties SurfaceOf<TCallbacks, TManifold>(
        ref TCallbacks callbacks, int workerIndex, in CollidablePair pair, ref TManifold manifold)
        where TCallbacks : struct, INarrowPhaseCallbacks where TManifold : unmanaged, IContactManifold<TManifold> => default;
}
