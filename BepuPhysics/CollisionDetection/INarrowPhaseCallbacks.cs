using BepuPhysics.Collidables;

namespace BepuPhysics.CollisionDetection;

/// <summary>Decides which pairs collide and what their surfaces are made of.</summary>
/// <remarks>
/// Implement this with a struct: the narrow phase is compiled for it, so calls are direct and usually inlined. Methods with a worker index
/// are called from worker threads, in no particular order; do not change the simulation from inside them.
/// Implement <see cref="ISurfaceCallbacks{TSelf}"/> instead for surfaces that bounce.
/// <para>
/// What they say is checked. A value that cannot be simulated ends the step with an <see cref="System.InvalidOperationException"/> that
/// names the pair and the value, before anything is stored of it; no body has moved then, and the next step may follow. So it is with an
/// exception that a callback throws.
/// </para>
/// </remarks>
public interface INarrowPhaseCallbacks
{
    /// <summary>Chooses the material of a pair whose contacts were found, and may change them.</summary>
    /// <remarks>
    /// Friction must be finite and not negative; recovery not negative; frequency and damping of the spring from 0 to 1e13. Contacts that
    /// were changed must be no more than 4, with a normal of unit length, depths and offsets up to 1e13 m. Of pairs that have none, or are not
    /// to have any, nothing is asked.
    /// <para>
    /// Where several children of a compound touch, this is a <see cref="NonconvexContactManifold"/> of the deepest contacts, deepest first.
    /// Places, depths and normals that were changed are taken over, and so is what was removed; contacts of two children have one normal, and
    /// what was not shown stays as it is.
    /// </para>
    /// </remarks>
    /// <returns>Whether the contacts push the bodies apart.</returns>
    bool ConfigureContactManifold<TManifold>(int workerIndex, CollidablePair pair, ref TManifold manifold, out PairMaterialProperties pairMaterial)
        where TManifold : unmanaged, IContactManifold<TManifold>;

    /// <summary>Whether to look for contacts of a pair whose bounds overlap.</summary>
    /// <param name="workerIndex">Index of the calling worker.</param>
    /// <param name="a">First collidable; never a static.</param>
    /// <param name="b">Second collidable.</param>
    /// <param name="speculativeMargin">Distance within which contacts are looked for, m; may be changed, to 0 to 1e13.</param>
    bool AllowContactGeneration(int workerIndex, CollidableReference a, CollidableReference b, ref float speculativeMargin);

    /// <summary>Whether to look for contacts between two children of compounds.</summary>
    /// <remarks>
    /// Asked after the pair as a whole was allowed, in the order of the indices, of those that may touch: not of a triangle of a mesh that is apart by
    /// more than the margin, nor of one that is not touched and near which there is only what is its neighbour's.
    /// A shape without children has the index 0. Of a compound with children
    /// that are made of children themselves, indices are those of convex pieces: <see cref="Compound.FindPiece"/> says what they belong to.
    /// </remarks>
    bool AllowContactGeneration(int workerIndex, CollidablePair pair, int childIndexA, int childIndexB);

    /// <summary>May change the contacts between two children of compounds, which are in the frame of the pair's A.</summary>
    /// <remarks>Asked for each two that were allowed, with contacts or without, in no particular order, before the pair as a whole.</remarks>
    /// <returns>Whether the contacts are kept.</returns>
    bool ConfigureContactManifold(int workerIndex, CollidablePair pair, int childIndexA, int childIndexB, ref ConvexContactManifold manifold);

    /// <summary>Whether the two methods about children do anything but to say yes. True unless the callbacks say otherwise.</summary>
    /// <remarks>
    /// Where they do not, a compound or a mesh that has hardly moved keeps its contacts for up to 16 steps without a look at its children, as two convex
    /// shapes do: a terrain on which most things rest costs less than half. The method about the pair as a whole is asked in each step all the same.
    /// A ball is not tested with triangles that it touches beyond a neighbour only then, and nobody is asked about these.
    /// </remarks>
    static virtual bool DecidesOnChildren => true;

    /// <summary>Called once, when the simulation has been created.</summary>
    void Initialize(Simulation simulation);

    /// <summary>Called once, when the simulation is disposed.</summary>
    void Dispose();

    /// <summary>Whether the callbacks implement <see cref="ISurfaceCallbacks{TSelf}"/>.</summary>
    internal static virtual bool HasSurfaces => false;

    /// <summary>What <see cref="ISurfaceCallbacks{TSelf}"/> says of a pair; nothing where the callbacks do not implement it.</summary>
    internal static virtual SurfaceProperties SurfaceOf<TCallbacks, TManifold>(
        ref TCallbacks callbacks, int workerIndex, in CollidablePair pair, ref TManifold manifold)
        where TCallbacks : struct, INarrowPhaseCallbacks where TManifold : unmanaged, IContactManifold<TManifold> => default;
}
