using System.Collections.Generic;
using BepuPhysics.Collidables;

namespace BepuPhysics.CollisionDetection;

/// <summary>The contacts of a listened pair after a step, as a manifold of the deepest four.</summary>
struct ContactSnapshot
{
    public CollidablePair Pair;
    public bool Touches;
    /// <summary>Whether all contacts share a normal.</summary>
    public bool IsConvex;
    public NonconvexContactManifold Contacts;

    /// <summary>The order of pairs.</summary>
    public static int Compare(in ContactSnapshot a, in ContactSnapshot b) => ListenedPair.Compare(new() { Pair = a.Pair }, new() { Pair = b.Pair });

    /// <summary>The contacts, which share a normal.</summary>
    public readonly ConvexContactManifold ToConvex()
    {
        var result = new ConvexContactManifold { OffsetB = Contacts.OffsetB, Count = Contacts.Count, Normal = Contacts.GetNormal(0) };
        for (int i = 0; i < Contacts.Count; ++i)
            result[i] = Contacts[i];
        return result;
    }

    /// <summary>Adds a contact, in the place of the shallowest if there is no room and that one is shallower.</summary>
    internal void Add(in Contact contact)
    {
        if (Contacts.Count < NonconvexContactManifold.MaximumContactCount)
        {
            Contacts[Contacts.Count++] = contact;
            return;
        }
        int shallowest = 0;
        for (int i = 1; i < Contacts.Count; ++i)
        {
            if (Contacts.GetDepth(i) < Contacts.GetDepth(shallowest))
                shallowest = i;
        }
        if (contact.Depth > Contacts.GetDepth(shallowest))
            Contacts[shallowest] = contact;
    }
}

public sealed unsafe partial class CollisionEvents
{
    /// <summary>
    /// Lists all pairs that are listened to for <see cref="EventMask.Persist"/> and have contacts that are awake, touching or not, as the last step
    /// has left them.
    /// </summary>
    /// <param name="snapshots">Takes them, in the order of pairs.</param>
    /// <param name="statics">Where statics are.</param>
    internal void AddSnapshots(List<ContactSnapshot> snapshots, Statics statics)
    {
        world.ReadUnread();
        if (!isPersistingTold)
            return;
        for (int i = 0; i < pairs.Count; ++i)
        {
            ref var pair = ref pairs[i];
            if (pair.IsSensor || pair.ManifoldCount == 0 || (pair.Mask & EventMask.Persist) == 0)
                continue;
            var snapshot = new ContactSnapshot
            {
                Pair = pair.Pair,
                Touches = pair.Touches,
                IsConvex = pair.ManifoldCount == 1,
            };
            var place = places[pair.FirstManifold];
            snapshot.Contacts.OffsetB = place.OffsetB;
            if (pair.Pair.B.Mobility == CollidableMobility.Static && statics.StaticExists(pair.Pair.B.StaticHandle))
                snapshot.Contacts.OffsetB = statics[pair.Pair.B.StaticHandle].Pose.Position - place.CenterOfA;
            for (int j = pair.FirstManifold; j < pair.FirstManifold + pair.ManifoldCount; ++j)
            {
                ref var manifold = ref manifolds[j];
                for (int k = manifold.FirstContact; k < manifold.FirstContact + manifold.ContactCount; ++k)
                {
                    ref var contact = ref contacts[k];
                    snapshot.Add(new()
                    {
                        Offset = contact.Position - place.CenterOfA,
                        Depth = contact.Depth,
                        Normal = contact.Normal,
                        FeatureId = contact.FeatureId,
                    });
                }
            }
            snapshots.Add(snapshot);
        }
    }
}
