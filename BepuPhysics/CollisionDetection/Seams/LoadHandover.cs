using System.Numerics;
using BepuPhysics.Constraints.Contact;
using BepuUtilities;
using BepuUtilities.Collections;
using BepuUtilities.Memory;

namespace BepuPhysics.CollisionDetection;

/// <summary>Hands what the contacts of a body with several statics carried to those that it has now, as if all were those of one pair.</summary>
/// <remarks>
/// A contact gets what the one with its feature carried; one that is new takes over from the nearest that is gone; what is left then is shared by all. Within
/// a pair that is what its constraint does itself. So only pairs that gave or took something are told what they take over.
/// </remarks>
struct LoadHandover(BufferPool pool)
{
    // Cosine of the greatest angle between contacts that take over from each other, as of patches of one pair.
    const float LeastCosine = 0.9f;

    const int InitialCapacity = 16;
    const int Nobody = -1;

    struct OldPoint
    {
        public Vector3 Arm;
        public float Impulse;
        public int Owner;
        public int Feature;
        public bool IsGiven;
    }

    struct NewPoint
    {
        public Vector3 Place, Arm;
        public float Impulse;
        public int Owner;
        public int Feature;
        public bool HasReceived;
    }

    /// <summary>A constraint of the last step.</summary>
    struct Source
    {
        public ContactPatch Patch;
        public int Heir;
        public bool HasGiven;
    }

    /// <summary>A manifold of this step.</summary>
    struct Heir
    {
        public Vector3 Normal, OffsetB;
        public int Source, FirstPoint, Count;
        public float Load;
        public bool Touches, IsChanged;
    }

    QuickList<OldPoint> oldPoints = new(InitialCapacity, pool);
    QuickList<NewPoint> newPoints = new(InitialCapacity, pool);
    QuickList<Source> sources = new(InitialCapacity, pool);
    QuickList<Heir> heirs = new(InitialCapacity, pool);

    /// <summary>Forgets the last body.</summary>
    public void Begin() => oldPoints.Count = newPoints.Count = sources.Count = heirs.Count = 0;

    /// <summary>Adds a constraint of the last step.</summary>
    /// <returns>Its number.</returns>
    public int AddSource(in ContactPatch patch, BufferPool pool)
    {
        // The impulses of an impact are no load, and who takes over from what lands does not know of it.
        var hasLanded = ContactMaterialWide.HasLanded(patch.Landing);
        for (int i = 0; i < patch.Count; ++i)
            oldPoints.Add(new() { Arm = patch.Arms[i], Impulse = hasLanded ? 0 : patch.Normals[i], Feature = patch.Features[i], Owner = sources.Count }, pool);
        sources.Add(new() { Patch = patch, Heir = Nobody }, pool);
        if (hasLanded)
        {
            ref var landed = ref sources[sources.Count - 1].Patch;
            landed.Friction = default;
            landed.Twist = 0;
        }
        return sources.Count - 1;
    }

    /// <summary>Adds a manifold of this step.</summary>
    /// <param name="manifold">Its contacts.</param>
    /// <param name="source">Number of the constraint that it goes on as; negative for one that is new.</param>
    /// <param name="pool">Source of memory.</param>
    public void AddHeir(in ConvexContactManifold manifold, int source, BufferPool pool)
    {
        var heir = new Heir
        {
            Normal = manifold.Normal,
            OffsetB = manifold.OffsetB,
            Source = source,
            FirstPoint = newPoints.Count,
            Count = manifold.Count,
        };
        for (int i = 0; i < manifold.Count; ++i)
        {
            var contact = ConvexContactManifold.GetConvexContactReference(ref System.Runtime.CompilerServices.Unsafe.AsRef(in manifold), i);
            heir.Touches |= contact.Depth >= 0;
            newPoints.Add(new() { Place = contact.Offset, Arm = contact.Offset, Feature = contact.FeatureId, Owner = heirs.Count }, pool);
        }
        if (source >= 0)
            sources[source].Heir = heirs.Count;
        heirs.Add(heir, pool);
    }

    /// <summary>Finds who takes over what.</summary>
    /// <returns>Whether a manifold takes over anything from another.</returns>
    public bool Run()
    {
        GiveByFeature();
        GiveToNearest();
        ShareRest();
        var changes = false;
        foreach (ref var source in sources.AsSpan())
        {
            if (source.HasGiven && source.Heir >= 0)
                heirs[source.Heir].IsChanged = true;
        }
        foreach (ref var heir in heirs.AsSpan())
            changes |= heir.IsChanged;
        return changes;
    }

    void GiveByFeature()
    {
        foreach (ref var point in newPoints.AsSpan())
        {
            var source = heirs[point.Owner].Source;
            foreach (ref var old in oldPoints.AsSpan())
            {
                if (source < 0 || old.Owner != source || old.IsGiven || old.Feature != point.Feature)
                    continue;
                old.IsGiven = point.HasReceived = true;
                point.Impulse = old.Impulse;
                point.Arm = old.Arm;
                break;
            }
        }
    }

    // What does not touch yet takes over nothing from others: it may never touch.
    readonly bool MayTake(in Heir heir, int source) =>
        heir.Source == source || (heir.Touches && Exact.Dot(heir.Normal, sources[source].Patch.Normal) > LeastCosine);

    void GiveToNearest()
    {
        foreach (ref var point in newPoints.AsSpan())
        {
            if (point.HasReceived)
                continue;
            ref var heir = ref heirs[point.Owner];
            var (nearest, least) = (Nobody, float.MaxValue);
            for (int i = 0; i < oldPoints.Count; ++i)
            {
                ref var old = ref oldPoints[i];
                if (old.IsGiven || !MayTake(heir, old.Owner))
                    continue;
                var distance = Exact.DistanceSquared(old.Arm, point.Place);
                if (distance < least)
                    (nearest, least) = (i, distance);
            }
            if (nearest < 0)
                continue;
            ref var given = ref oldPoints[nearest];
            given.IsGiven = point.HasReceived = true;
            point.Impulse = given.Impulse;
            NoteGift(ref heir, given.Owner);
        }
    }

    readonly void NoteGift(ref Heir heir, int source)
    {
        if (heir.Source == source)
            return;
        heir.IsChanged = true;
        sources[source].HasGiven = true;
    }

    void ShareRest()
    {
        foreach (ref var old in oldPoints.AsSpan())
        {
            if (old.IsGiven || old.Impulse == 0)
                continue;
            var count = 0;
            foreach (ref var point in newPoints.AsSpan())
                count += MayTake(heirs[point.Owner], old.Owner) ? 1 : 0;
            foreach (ref var point in newPoints.AsSpan())
            {
                if (!MayTake(heirs[point.Owner], old.Owner))
                    continue;
                point.Impulse += old.Impulse / count;
                NoteGift(ref heirs[point.Owner], old.Owner);
            }
        }
    }

    /// <summary>What a manifold takes over, if that is not only from itself.</summary>
    /// <param name="heir">Number of the manifold.</param>
    /// <param name="load">What it takes over.</param>
    // Friction follows load.
    public readonly bool TryGet(int heir, out ContactPatch load)
    {
        ref var target = ref heirs[heir];
        load = default;
        if (!target.IsChanged)
            return false;
        var (all, own) = (0f, 0f);
        foreach (ref var point in newPoints.AsSpan())
        {
            all += heirs[point.Owner].IsChanged ? point.Impulse : 0;
            own += point.Owner == heir ? point.Impulse : 0;
        }
        load.Count = target.Count;
        load.Normal = target.Normal;
        load.OffsetB = target.OffsetB;
        if (target.Source >= 0)
        {
            load.WasHeld = sources[target.Source].Patch.WasHeld;
            load.Landing = sources[target.Source].Patch.Landing;
            load.Normal = sources[target.Source].Patch.Normal;
            load.OffsetB = sources[target.Source].Patch.OffsetB;
            load.KnowsB = sources[target.Source].Patch.KnowsB;
        }
        for (int i = 0; i < target.Count; ++i)
        {
            ref var point = ref newPoints[target.FirstPoint + i];
            load.Normals[i] = point.Impulse;
            load.Arms[i] = point.Arm;
            load.Features[i] = point.Feature;
        }
        if (own == 0)
            return true;
        foreach (ref var source in sources.AsSpan())
        {
            if (!source.HasGiven && (source.Heir < 0 || !heirs[source.Heir].IsChanged))
                continue;
            load.Friction += source.Patch.Friction * (own / all);
            load.Twist += source.Patch.HasTwist ? source.Patch.Twist * (own / all) : 0;
        }
        return true;
    }

    public void Dispose(BufferPool pool)
    {
        oldPoints.Dispose(pool);
        newPoints.Dispose(pool);
        sources.Dispose(pool);
        heirs.Dispose(pool);
    }
}
