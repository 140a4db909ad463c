using BepuPhysics.CollisionDetection;

namespace Benchmarks.Pairs.Shared;

/// <summary>Reads the contacts of pairs, as a game would, and counts them.</summary>
struct PairTally() : ICollisionCallbacks
{
    public int Contacts;

    /// <summary>Greatest depth that was met, m; less than any number without contacts.</summary>
    public float Depth = float.NegativeInfinity;

    public readonly bool AllowCollisionTesting(int pairId, int childA, int childB) => true;

    public readonly void OnChildPairCompleted(int pairId, int childA, int childB, ref ConvexContactManifold manifold)
    {
    }

    public void OnPairCompleted<TManifold>(int pairId, ref TManifold manifold) where TManifold : unmanaged, IContactManifold<TManifold>
    {
        int count = manifold.Count;
        Contacts += count;
        for (int i = 0; i < count; ++i)
        {
            float depth = manifold.GetDepth(i);
            if (depth > Depth)
                Depth = depth;
        }
    }
}
