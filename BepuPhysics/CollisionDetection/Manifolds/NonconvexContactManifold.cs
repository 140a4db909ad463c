using System;
using System.Numerics;
using System.Runtime.CompilerServices;
using BepuUtilities.Diagnostics;

namespace BepuPhysics.CollisionDetection;

/// <summary>The contacts of a pair of which one at least is not convex, up to eight, each with its own normal.</summary>
public unsafe struct NonconvexContactManifold : IContactManifold<NonconvexContactManifold>
{
    /// <summary>Position of B less that of A, m.</summary>
    public Vector3 OffsetB;
    /// <summary>Number of contacts, 0 to <see cref="MaximumContactCount"/>.</summary>
    public int Count;
    /// <summary>First contact.</summary>
    public Contact Contact0;
    /// <summary>Second contact.</summary>
    public Contact Contact1;
    /// <summary>Third contact.</summary>
    public Contact Contact2;
    /// <summary>Fourth contact.</summary>
    public Contact Contact3;
    /// <summary>Fifth contact.</summary>
    public Contact Contact4;
    /// <summary>Sixth contact.</summary>
    public Contact Contact5;
    /// <summary>Seventh contact.</summary>
    public Contact Contact6;
    /// <summary>Eighth contact.</summary>
    public Contact Contact7;

    /// <summary>Contacts that fit.</summary>
    public const int MaximumContactCount = 8;

    readonly int IContactManifold<NonconvexContactManifold>.Count => Count;

    /// <inheritdoc/>
    public readonly bool Convex => false;

    /// <inheritdoc/>
    public Contact this[int index]
    {
        readonly get => Read(index);
        set => GetNonconvexContactReference(ref this, index) = value;
    }

    /// <inheritdoc/>
    public readonly int GetFeatureId(int contactIndex) => Read(contactIndex).FeatureId;

    /// <inheritdoc/>
    public readonly float GetDepth(int contactIndex) => Read(contactIndex).Depth;

    /// <inheritdoc/>
    public readonly Vector3 GetNormal(int contactIndex) => Read(contactIndex).Normal;

    /// <inheritdoc/>
    public readonly Vector3 GetOffset(int contactIndex) => Read(contactIndex).Offset;

    /// <inheritdoc/>
    public readonly void GetContact(int contactIndex, out Vector3 offset, out Vector3 normal, out float depth, out int featureId)
    {
        ref readonly var contact = ref Read(contactIndex);
        offset = contact.Offset;
        normal = contact.Normal;
        depth = contact.Depth;
        featureId = contact.FeatureId;
    }

    /// <inheritdoc/>
    public readonly void GetContact(int contactIndex, out Contact contactData) => contactData = Read(contactIndex);

    /// <summary>Removes a contact; the last one takes its index.</summary>
    public static void FastRemoveAt(NonconvexContactManifold* manifold, int index)
    {
        var last = manifold->Count - 1;
        GetNonconvexContactReference(ref *manifold, index) = GetNonconvexContactReference(ref *manifold, last);
        manifold->Count = last;
    }

    /// <summary>Adds a contact of a convex part.</summary>
    public static void Add(NonconvexContactManifold* manifold, ref Vector3 normal, ref ConvexContact convexContact) =>
        Allocate(manifold) = new()
        {
            Offset = convexContact.Offset,
            Depth = convexContact.Depth,
            Normal = normal,
            FeatureId = convexContact.FeatureId,
        };

    /// <summary>Makes room for a contact, which the caller writes.</summary>
    /// <exception cref="InvalidOperationException">The manifold is full.</exception>
    public static ref Contact Allocate(NonconvexContactManifold* manifold)
    {
        if ((uint)manifold->Count >= MaximumContactCount)
            throw new InvalidOperationException($"A manifold has room for {MaximumContactCount} contacts.");
        return ref Unsafe.Add(ref manifold->Contact0, manifold->Count++);
    }

    /// <inheritdoc/>
    public static ref float GetDepthReference(ref NonconvexContactManifold manifold, int contactIndex) =>
        ref GetNonconvexContactReference(ref manifold, contactIndex).Depth;

    /// <inheritdoc/>
    public static ref Vector3 GetNormalReference(ref NonconvexContactManifold manifold, int contactIndex) =>
        ref GetNonconvexContactReference(ref manifold, contactIndex).Normal;

    /// <inheritdoc/>
    public static ref Vector3 GetOffsetReference(ref NonconvexContactManifold manifold, int contactIndex) =>
        ref GetNonconvexContactReference(ref manifold, contactIndex).Offset;

    /// <inheritdoc/>
    public static ref int GetFeatureIdReference(ref NonconvexContactManifold manifold, int contactIndex) =>
        ref GetNonconvexContactReference(ref manifold, contactIndex).FeatureId;

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static ref Contact GetNonconvexContactReference(ref NonconvexContactManifold manifold, int contactIndex)
    {
        Check.That((uint)contactIndex < MaximumContactCount);
        return ref Unsafe.Add(ref manifold.Contact0, contactIndex);
    }

    /// <inheritdoc/>
    public static ref ConvexContact GetConvexContactReference(ref NonconvexContactManifold manifold, int contactIndex) =>
        throw new InvalidOperationException("The contacts of a nonconvex manifold have normals of their own.");

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    [System.Diagnostics.CodeAnalysis.UnscopedRef]
    readonly ref readonly Contact Read(int index) => ref GetNonconvexContactReference(ref Unsafe.AsRef(in this), index);
}
