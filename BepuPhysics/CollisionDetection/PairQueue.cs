using System.Runtime.CompilerServices;
using BepuPhysics.Collidables;
using BepuUtilities.Memory;

namespace BepuPhysics.CollisionDetection;

/// <summary>Overlapping pairs on their way to their test, for as long as it takes to load what is known of them.</summary>
/// <remarks>
/// The tree finds pairs in the order of space, the cache holds them in the order of time: each lookup would wait for memory, three times
/// one after the other. Here each pair asks for the next of the three while others are tested. Tests are in the order of the pairs.
/// </remarks>
unsafe struct PairQueue
{
    const int Length = 32;
    // Pairs between two stages of one pair.
    const int StageLength = 8;

    [InlineArray(Length)]
    struct Ring
    {
        CollidablePair first;
    }

    [InlineArray(Length)]
    struct Elements
    {
        int first;
    }

    [InlineArray(Length)]
    struct Margins
    {
        float first;
    }

    Ring pairs;
    Margins margins;
    // Index in the cache that a pair most likely has.
    Elements elements;
    // Unsigned, so that a place in the ring is a mask.
    uint added;
    uint taken;

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static int Place(uint index) => (int)(index % Length);

    /// <summary>Forgets all pairs.</summary>
    public void Clear() => added = taken = 0;

    /// <summary>Adds a pair. There must be room: <see cref="TryTake"/> after each.</summary>
    public void Add(in PairCache cache, Bodies bodies, Statics statics, CollidablePair pair, float margin)
    {
        pairs[Place(added)] = pair;
        margins[Place(added)] = margin;
        cache.Pairs.PrefetchSlot(pair);
        if (added - taken >= StageLength)
        {
            var second = added - StageLength;
            ref var pairInTable = ref pairs[Place(second)];
            elements[Place(second)] = cache.Pairs.PrefetchElement(pairInTable);
            PrefetchPose(bodies, statics, pairInTable.A);
            PrefetchPose(bodies, statics, pairInTable.B);
        }
        if (added - taken >= 2 * StageLength && elements[Place(added - 2 * StageLength)] >= 0)
        {
            ref var cached = ref cache.Pairs.Values[elements[Place(added - 2 * StageLength)]];
            if (cached.IsOfChildren)
            {
                cache.Manifolds.Prefetch(cached.FirstManifold);
                if (cached.CarriedPatchCount > 0)
                {
                    cache.Parents.Prefetch(cached.Single.History);
                    cache.Parents.PrefetchRest(cached.Single.History, ParentHistory.ByteCountOf(cached.CarriedPatchCount));
                }
            }
            else if (cached.Single.History >= 0)
            {
                cache.Histories.Prefetch(cached.Single.History);
                if (cached.Single.HasConstraint)
                    cache.Histories.PrefetchRest(cached.Single.History);
            }
        }
        ++added;
    }

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static void PrefetchPose(Bodies bodies, Statics statics, CollidableReference collidable)
    {
        if (collidable.Mobility == CollidableMobility.Static)
        {
            Prefetch.Read(statics.StaticsBuffer.Memory + statics.Indices[collidable.Slot]);
            return;
        }
        ref var location = ref bodies.Locations[collidable.Slot];
        ref var set = ref bodies.SetOf(location);
        Prefetch.Read(set.MotionStates.Memory + location.Index);
        Prefetch.Read(set.Collidables.Memory + location.Index);
    }

    /// <summary>Takes the oldest pair when its turn has come.</summary>
    /// <param name="pair">The pair.</param>
    /// <param name="guess">Its index in the cache, or that of another; negative where it is in none.</param>
    /// <param name="margin">What was added with it.</param>
    public bool TryTake(out CollidablePair pair, out int guess, out float margin)
    {
        pair = pairs[Place(taken)];
        margin = margins[Place(taken)];
        guess = elements[Place(taken)];
        if (added - taken < 3 * StageLength)
            return false;
        ++taken;
        return true;
    }

    /// <summary>Takes the oldest pair whether its turn has come or not; false when there is none.</summary>
    public bool TryTakeLast(out CollidablePair pair, out float margin)
    {
        pair = pairs[Place(taken)];
        margin = margins[Place(taken)];
        if (added == taken)
            return false;
        ++taken;
        return true;
    }
}
