using System;
using System.Numerics;
using System.Runtime.CompilerServices;
using BepuUtilities;
using BepuUtilities.Diagnostics;

namespace BepuPhysics.CollisionDetection;

/// <summary>The contacts of two convex shapes, up to four with one normal.</summary>
public struct ConvexContactManifold : IContactManifold<ConvexContactManifold>
{
    /// <summary>Position of B less that of A, m.</summary>
    public Vector3 OffsetB;
    /// <summary>Number of contacts, 0 to 4.</summary>
    public int Count;
    /// <summary>Unit normal of all contacts in world axes, from B to A. Means nothing without contacts.</summary>
    public Vector3 Normal;
    /// <summary>First contact.</summary>
    public ConvexContact Contact0;
    /// <summary>Second contact.</summary>
    public ConvexContact Contact1;
    /// <summary>Third contact.</summary>
    public ConvexContact Contact2;
    /// <summary>Fourth contact.</summary>
    public ConvexContact Contact3;

    /// <summary>Contacts that fit.</summary>
    internal const int MaximumContactCount = 4;

    readonly int IContactManifold<ConvexContactManifold>.Count => Count;

    /// <inheritdoc/>
    public readonly bool Convex => true;

    /// <inheritdoc/>
    public Contact this[int index]
    {
        readonly get
        {
            GetContact(index, out var contact);
            return contact;
        }
        set
        {
            ref var contact = ref GetConvexContactReference(ref this, index);
            contact.Offset = value.Offset;
            contact.Depth = value.Depth;
            contact.FeatureId = value.FeatureId;
            Normal = value.Normal;
        }
    }

    /// <inheritdoc/>
    public readonly int GetFeatureId(int index) => Read(index).FeatureId;

    /// <inheritdoc/>
    public readonly float GetDepth(int index) => Read(index).Depth;

    /// <summary>Depth of the deepest contact, m; of no contacts there is none, and it means nothing.</summary>
    internal readonly float GreatestDepth
    {
        get
        {
            var depth = Contact0.Depth;
            for (int i = 1; i < Count; ++i)
                depth = MathHelper.Max(depth, Read(i).Depth);
            return depth;
        }
    }

    /// <inheritdoc/>
    public readonly Vector3 GetNormal(int index) => Normal;

    /// <inheritdoc/>
    public readonly Vector3 GetOffset(int index) => Read(index).Offset;

    /// <inheritdoc/>
    public readonly void GetContact(int index, out Vector3 offset, out Vector3 normal, out float depth, out int featureId)
    {
        ref readonly var contact = ref Read(index);
        offset = contact.Offset;
        normal = Normal;
        depth = contact.Depth;
        featureId = contact.FeatureId;
    }

    /// <inheritdoc/>
    public readonly void GetContact(int index, out Contact contactData) =>
        GetContact(index, out contactData.Offset, out contactData.Normal, out contactData.Depth, out contactData.FeatureId);

    /// <summary>Removes a contact; the last one takes its index.</summary>
    public static void FastRemoveAt(ref ConvexContactManifold manifold, int index)
    {
        var last = manifold.Count - 1;
        GetConvexContactReference(ref manifold, index) = GetConvexContactReference(ref manifold, last);
        manifold.Count = last;
    }

    /// <inheritdoc/>
    public static ref float GetDepthReference(ref ConvexContactManifold manifold, int index) =>
        ref GetConvexContactReference(ref manifold, index).Depth;

    /// <inheritdoc/>
    public static ref Vector3 GetNormalReference(ref ConvexContactManifold manifold, int index) => ref manifold.Normal;

    /// <inheritdoc/>
    public static ref Vector3 GetOffsetReference(ref ConvexContactManifold manifold, int index) =>
        ref GetConvexContactReference(ref manifold, index).Offset;

    /// <inheritdoc/>
    public static ref int GetFeatureIdReference(ref ConvexContactManifold manifold, int index) =>
        ref GetConvexContactReference(ref manifold, index).FeatureId;

    /// <inheritdoc/>
    public static ref Contact GetNonconvexContactReference(ref ConvexContactManifold manifold, int index) =>
        throw new InvalidOperationException("The contacts of a convex manifold have no normals of their own.");

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static ref ConvexContact GetConvexContactReference(ref ConvexContactManifold manifold, int index)
    {
        Check.That((uint)index < MaximumContactCount);
        return ref Unsafe.Add(ref manifold.Contact0, index);
    }

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    [System.Diagnostics.CodeAnalysis.UnscopedRef]
    internal readonly ref readonly ConvexContact Read(int index) => ref GetConvexContactReference(ref Unsafe.AsRef(in this), index);
}
