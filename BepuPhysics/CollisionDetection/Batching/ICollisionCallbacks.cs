using System;
using System.Numerics;

namespace BepuPhysics.CollisionDetection;

/// <summary>Receives the results of a <see cref="CollisionBatcher{TCallbacks}"/>, on the thread that adds to it or flushes it.</summary>
/// <remarks>Implement this with a struct: the batcher is compiled for it. Do not add pairs to the batcher from inside.</remarks>
public interface ICollisionCallbacks
{
    /// <summary>Whether two children of a compound pair are to be tested. Called in the order of the children.</summary>
    /// <param name="pairId">Id that the pair was added with.</param>
    /// <param name="childA">Index of the child of A; zero where A has none.</param>
    /// <param name="childB">Index of the child of B; zero where B has none.</param>
    bool AllowCollisionTesting(int pairId, int childA, int childB);

    /// <summary>
    /// Two children of a compound pair were tested, or it is known without a test what they touch at; the contacts may be changed. Called
    /// in no particular order, before the pair is completed.
    /// </summary>
    /// <param name="pairId">Id that the pair was added with.</param>
    /// <param name="childA">Index of the child of A; zero where A has none.</param>
    /// <param name="childB">Index of the child of B; zero where B has none.</param>
    /// <param name="manifold">Contacts of the children, in the frame of A.</param>
    void OnChildPairCompleted(int pairId, int childA, int childB, ref ConvexContactManifold manifold);

    /// <summary>A pair was tested. Called once for every pair, with no contacts where there are none.</summary>
    /// <remarks>
    /// Where several children touch it is a <see cref="NonconvexContactManifold"/> of the deepest contacts, deepest first; otherwise a
    /// <see cref="ConvexContactManifold"/>.
    /// </remarks>
    /// <param name="pairId">Id that the pair was added with.</param>
    /// <param name="manifold">Contacts of the pair.</param>
    void OnPairCompleted<TManifold>(int pairId, ref TManifold manifold) where TManifold : unmanaged, IContactManifold<TManifold>;

    /// <summary>Whether contacts of children may be changed, or are looked at. Where not, those of triangles that only neighbours have are not found.</summary>
    internal static virtual bool ChangesChildren => true;

    /// <summary>The children of some pairs come soon: what is remembered of them may be loaded.</summary>
    /// <param name="callbacks">The callbacks.</param>
    /// <param name="pairIds">Ids that the pairs were added with.</param>
    /// <param name="areTested">Whether the tests of these have been made, which their histories are for.</param>
    internal static virtual void PrefetchChildren<TCallbacks>(ref TCallbacks callbacks, ReadOnlySpan<int> pairIds, bool areTested)
        where TCallbacks : struct, ICollisionCallbacks
    { }

    /// <summary>The children of a pair come next.</summary>
    internal static virtual void BeginChildren<TCallbacks>(ref TCallbacks callbacks, int pairId) where TCallbacks : struct, ICollisionCallbacks { }

    /// <summary>Says what is known of two children whose test keeps a history.</summary>
    /// <param name="callbacks">The callbacks.</param>
    /// <param name="pairId">Id that the pair was added with.</param>
    /// <param name="ids">Which children they are.</param>
    /// <param name="children">The two shapes.</param>
    /// <param name="speculativeMargin">Greatest distance at which contacts are wanted, m.</param>
    /// <param name="history">Reference to their history.</param>
    /// <param name="manifold">Contacts in the frame of A's child, where they are known without a test.</param>
    /// <returns>Whether they are.</returns>
    internal static virtual bool Recall<TCallbacks>(ref TCallbacks callbacks, int pairId, ChildIds ids, in ChildShapes children,
        float speculativeMargin, out int history, ref ConvexContactManifold manifold) where TCallbacks : struct, ICollisionCallbacks
    {
        history = PairInput.NoHistory;
        return false;
    }

    /// <summary>Says what patches the pair had in the last step.</summary>
    internal static virtual void RecallPatches<TCallbacks>(ref TCallbacks callbacks, int pairId, out KnownPatches known)
        where TCallbacks : struct, ICollisionCallbacks => known = default;

    /// <summary>Whether the children of a pair are wanted after they were joined (<see cref="KnownPatches.KeepsChildren"/>).</summary>
    internal static virtual bool KeepsChildren<TCallbacks>(ref TCallbacks callbacks, int pairId) where TCallbacks : struct, ICollisionCallbacks => false;

    /// <summary>Says how deep the contacts of these patches came to be in the last step, and how the shapes moved in it.</summary>
    internal static virtual void RecallMotion<TCallbacks>(ref TCallbacks callbacks, int pairId, out LastMotion motion)
        where TCallbacks : struct, ICollisionCallbacks => motion = default;

    /// <summary>All children of a pair are complete.</summary>
    /// <param name="callbacks">The callbacks.</param>
    /// <param name="pairId">Id that the pair was added with.</param>
    /// <param name="offsetB">Position of B less that of A.</param>
    /// <param name="results">The patches that were made of the contacts, then the children in their order; or these alone, with their contacts.</param>
    internal static virtual void OnChildrenCompleted<TCallbacks>(ref TCallbacks callbacks, int pairId, Vector3 offsetB, Span<ChildResult> results)
        where TCallbacks : struct, ICollisionCallbacks
    {
        var view = new ContactView(results, offsetB);
        if (view.IsConvex)
            callbacks.OnPairCompleted(pairId, ref view.Convex);
        else
            callbacks.OnPairCompleted(pairId, ref view.Nonconvex);
    }
}
