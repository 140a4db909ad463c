namespace BepuPhysics.CollisionDetection;

/// <summary>Receives the results of a <see cref="CollisionBatcher{TCallbacks}"/>, on the thread that adds to it or flushes it.</summary>
/// <remarks>Implement this with a struct: the batcher is compiled for it. Do not add pairs to the batcher from inside.</remarks>
public interface ICollisionCallbacks
{
    /// <summary>A pair was tested. Called once for every pair, with no contacts where there are none.</summary>
    /// <param name="pairId">Id that the pair was added with.</param>
    /// <param name="manifold">Contacts of the pair.</param>
    void OnPairCompleted<TManifold>(int pairId, ref TManifold manifold) where TManifold : unmanaged, IContactManifold<TManifold>;

    /// <summary>Two children of a compound pair were tested; the contacts may be changed.</summary>
    /// <param name="pairId">Id that the pair was added with.</param>
    /// <param name="childA">Index of the child of A; zero where A has none.</param>
    /// <param name="childB">Index of the child of B; zero where B has none.</param>
    /// <param name="manifold">Contacts of the children.</param>
    void OnChildPairCompleted(int pairId, int childA, int childB, ref ConvexContactManifold manifold);

    /// <summary>Whether two children of a compound pair are to be tested.</summary>
    /// <param name="pairId">Id that the pair was added with.</param>
    /// <param name="childA">Index of the child of A; zero where A has none.</param>
    /// <param name="childB">Index of the child of B; zero where B has none.</param>
    bool AllowCollisionTesting(int pairId, int childA, int childB);
}
