using System.Runtime.CompilerServices;
using BepuPhysics.Collidables;
using BepuPhysics.CollisionDetection;

namespace BepuPhysics.Characters;

/// <summary>Narrow phase callbacks of a game, and besides what characters need of them.</summary>
/// <param name="characters">The characters.</param>
/// <param name="inner">The callbacks of the game.</param>
public struct CharacterNarrowPhaseCallbacks<TCallbacks>(CharacterControllers characters, TCallbacks inner) : INarrowPhaseCallbacks
    where TCallbacks : struct, INarrowPhaseCallbacks
{
    /// <summary>The characters.</summary>
    public readonly CharacterControllers Characters = characters;

    /// <summary>The callbacks of the game.</summary>
    public TCallbacks Inner = inner;

    /// <inheritdoc/>
    public static bool DecidesOnChildren => TCallbacks.DecidesOnChildren;

    /// <inheritdoc/>
    /// <exception cref="System.InvalidOperationException">The characters belong to another simulation.</exception>
    public void Initialize(Simulation simulation)
    {
        Characters.Initialize(simulation);
        Inner.Initialize(simulation);
    }

    /// <inheritdoc/>
    public bool AllowContactGeneration(int workerIndex, CollidableReference a, CollidableReference b, ref float speculativeMargin) =>
        Inner.AllowContactGeneration(workerIndex, a, b, ref speculativeMargin);

    /// <inheritdoc/>
    public bool ConfigureContactManifold<TManifold>(int workerIndex, CollidablePair pair, ref TManifold manifold, out PairMaterialProperties pairMaterial)
        where TManifold : unmanaged, IContactManifold<TManifold>
    {
        if (!Inner.ConfigureContactManifold(workerIndex, pair, ref manifold, out pairMaterial))
            return false;
        Characters.TryReportContacts(pair, ref manifold, workerIndex, ref pairMaterial);
        return true;
    }

    /// <inheritdoc/>
    public bool AllowContactGeneration(int workerIndex, CollidablePair pair, int childIndexA, int childIndexB) =>
        Inner.AllowContactGeneration(workerIndex, pair, childIndexA, childIndexB);

    /// <inheritdoc/>
    public bool ConfigureContactManifold(int workerIndex, CollidablePair pair, int childIndexA, int childIndexB, ref ConvexContactManifold manifold) =>
        Inner.ConfigureContactManifold(workerIndex, pair, childIndexA, childIndexB, ref manifold);

    /// <inheritdoc/>
    public void Dispose() => Inner.Dispose();

    static bool INarrowPhaseCallbacks.HasSurfaces => TCallbacks.HasSurfaces;

    static SurfaceProperties INarrowPhaseCallbacks.SurfaceOf<TOuter, TManifold>(
        ref TOuter callbacks, int workerIndex, in CollidablePair pair, ref TManifold manifold)
    {
        ref var inner = ref Unsafe.As<TOuter, CharacterNarrowPhaseCallbacks<TCallbacks>>(ref callbacks).Inner;
        return TCallbacks.SurfaceOf(ref inner, workerIndex, pair, ref manifold);
    }
}
