using System;
using BepuPhysics.Collidables;
using BepuPhysics.CollisionDetection;
using BepuPhysics.Constraints;

namespace BepuPhysics;

/// <summary>Ready-made narrow phase callbacks: everything collides, with one material. The default material is rigid, with a friction of 0.5.</summary>
public struct DefaultNarrowPhaseCallbacks : ISurfaceCallbacks<DefaultNarrowPhaseCallbacks>
{
    // Set by every constructor: the default of a struct has no friction and never pushes anything out, which nobody means.
    readonly bool isConstructed;

    /// <summary>Material of all pairs.</summary>
    public PairMaterialProperties Material;

    /// <summary>What else there is to the surfaces of all pairs: whether they bounce. Nothing by default.</summary>
    public SurfaceProperties Surface;

    /// <summary>Everything collides; rigid contacts, a friction of 0.5.</summary>
    public DefaultNarrowPhaseCallbacks() : this(new PairMaterialProperties(0.5f, 2, SpringSettings.Rigid)) { }

    /// <summary>Everything collides, with one material.</summary>
    public DefaultNarrowPhaseCallbacks(PairMaterialProperties material)
    {
        Material = material;
        isConstructed = true;
    }

    /// <inheritdoc/>
    /// <exception cref="InvalidOperationException">These are the default of the struct, with nothing set.</exception>
    public readonly void Initialize(Simulation simulation)
    {
        if (!isConstructed && Material.FrictionCoefficient == 0 && Material.MaximumRecoveryVelocity == 0)
        {
            throw new InvalidOperationException(
                $"The narrow phase callbacks are default({nameof(DefaultNarrowPhaseCallbacks)}), without friction and recovery: " +
                $"make them with new {nameof(DefaultNarrowPhaseCallbacks)}().");
        }
    }

    /// <inheritdoc/>
    public readonly bool AllowContactGeneration(int workerIndex, CollidableReference a, CollidableReference b, ref float speculativeMargin) => true;

    /// <inheritdoc/>
    public readonly bool ConfigureContactManifold<TManifold>(int workerIndex, CollidablePair pair, ref TManifold manifold,
        out PairMaterialProperties pairMaterial)
        where TManifold : unmanaged, IContactManifold<TManifold>
    {
        pairMaterial = Material;
        return true;
    }

    /// <inheritdoc/>
    public static bool DecidesOnChildren => false;

    /// <inheritdoc/>
    public readonly bool AllowContactGeneration(int workerIndex, CollidablePair pair, int childIndexA, int childIndexB) => true;

    /// <inheritdoc/>
    public readonly bool ConfigureContactManifold(int workerIndex, CollidablePair pair, int childIndexA, int childIndexB,
        ref ConvexContactManifold manifold) => true;

    /// <inheritdoc/>
    public readonly SurfaceProperties GetSurface<TManifold>(int workerIndex, CollidablePair pair, ref TManifold manifold)
        where TManifold : unmanaged, IContactManifold<TManifold> => Surface;

    /// <inheritdoc/>
    public readonly void Dispose() { }
}
