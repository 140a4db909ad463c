using System.Numerics;
using BepuPhysics.Collidables;
using BepuUtilities.Collections;

namespace BepuPhysics.CollisionDetection;

/// <summary>A pair that somebody listens to: while it has contacts, or a sensor sees the other.</summary>
// 32 bytes: a step goes through all of them, and has no need of what they pushed as long as nothing is told.
struct ListenedPair
{
    public CollidablePair Pair;
    /// <summary>What either of the two is listened to for.</summary>
    public EventMask Mask;
    public bool IsSensor;
    /// <summary>Whether it touched in the last step that was completed.</summary>
    public bool Touches;
    /// <summary>Whether it has contacts, or is seen, in this step.</summary>
    public bool Exists;
    /// <summary>Whether it is one of a sensor, and none of the two is awake: nothing is told of it until one is.</summary>
    public bool IsAsleep;
    /// <summary>Whether it is one of a sensor and of a way that is swept, and whether that way has met the sensor in this step.</summary>
    public bool MayPass, HasPassed;
    /// <summary>Whether it is to be told of as one that persists.</summary>
    public bool Persists;
    /// <summary>Where the cache had it, as a guess where to look first.</summary>
    public int IndexInCache;
    /// <summary>Its manifolds in this step.</summary>
    public int FirstManifold, ManifoldCount;
    /// <summary>One more than where the sum of this step's bounces is, or 0 where there were none.</summary>
    public int Bounce;

    /// <summary>By slots, then by generations: whether slots were others' before does not change the order.</summary>
    public static int Compare(in ListenedPair a, in ListenedPair b)
    {
        const ulong ordering = (ulong)CollidableReference.OrderMask << 32 | CollidableReference.OrderMask;
        var keyA = Key(a.Pair);
        var keyB = Key(b.Pair);
        var bySlots = (keyA & ordering).CompareTo(keyB & ordering);
        if (bySlots != 0)
            return bySlots;
        return keyA != keyB ? keyA.CompareTo(keyB) : a.IsSensor.CompareTo(b.IsSensor);
    }

    static ulong Key(in CollidablePair pair) => (ulong)pair.A.Packed << 32 | pair.B.Packed;

    internal struct Order : IComparerRef<ListenedPair>
    {
        public readonly int Compare(ref ListenedPair a, ref ListenedPair b) => ListenedPair.Compare(a, b);
    }
}

/// <summary>What the bounces of a pair have pushed in a step, N s.</summary>
struct ListenedBounce
{
    /// <summary>Along the normals.</summary>
    public float Impulse;
    /// <summary>What friction pushed A with.</summary>
    public Vector3 Friction;
}

/// <summary>A contact constraint whose pair is listened to.</summary>
struct ListenedManifold
{
    public ConstraintHandle Constraint;
    /// <summary>The lane that it has in this step, counted through all bundles that are listened to.</summary>
    public int Lane;
    public int FirstContact, ContactCount;
}

/// <summary>Where a pair was when collisions were detected.</summary>
struct ListenedPlace
{
    public Vector3 CenterOfA;
    /// <summary>Position of B relative to A; zero for a static.</summary>
    public Vector3 OffsetB;
}
