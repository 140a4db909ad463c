using System.Numerics;
using BepuPhysics.Collidables;
using BepuPhysics.Constraints.Contact;
using BepuUtilities.Collections;

namespace BepuPhysics.CollisionDetection;

/// <summary>A pair that somebody listens to: while it has contacts, or a sensor sees the other.</summary>
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
    /// <summary>Whether a contact was deeper than zero when collisions were detected.</summary>
    public bool Overlaps;
    /// <summary>Whether impulses are summed: not where nothing could be told that depends on them.</summary>
    public bool IsMeasured;
    /// <summary>Where the cache had it in the last step, as a guess where to look first.</summary>
    public int IndexInCache;
    /// <summary>Its manifolds in this step.</summary>
    public int FirstManifold, ManifoldCount;
    /// <summary>Greatest speed at which surfaces approach before the step, zero without manifolds.</summary>
    public float ApproachSpeed;
    /// <summary>Where the centre of A was when collisions were detected, and that of B relative to it.</summary>
    public Vector3 CenterOfA, OffsetB;
    /// <summary>Sum of the impulses of this step's bounces.</summary>
    public float BounceImpulse;

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

/// <summary>A contact constraint whose pair is listened to, for one step.</summary>
unsafe struct ListenedManifold
{
    public ConstraintHandle Constraint;
    /// <summary>What the cache remembers of it, which holds while the solver runs.</summary>
    public CachedManifold* Cached;
    public ChildIds Children;
    /// <summary>The first of its impulses while the solver runs; they lie a vector apart.</summary>
    public float* Impulses;
    public int ContactCount;
    public int FirstContact;
    /// <summary>Depths of the contacts when collisions were detected.</summary>
    public FourFloats Depths;
    /// <summary>Sums over the substeps: along the normal, contact by contact, and of friction.</summary>
    public FourFloats Normals;
    public Vector3 Friction;
}
