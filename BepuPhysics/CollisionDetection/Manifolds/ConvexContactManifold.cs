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

    // Greatest gap for which arms end at the surfaces, over the arm.
    const float GreatestGap = 16;
    // Part of its arm by which the contact of what is round is beside the centre.
    const float RoundPart = 1e-2f;

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
    public readonly int GetFeatureId(int contactIndex) => Read(contactIndex).FeatureId;

    /// <inheritdoc/>
    public readonly float GetDepth(int contactIndex) => Read(contactIndex).Depth;

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

    /// <summary>Changes the depth of a contact whose place on A is right: it stays halfway between the surfaces, if these are near.</summary>
    /// <param name="index">Which contact.</param>
    /// <param name="change">What is added to its depth, m.</param>
    internal void AddDepth(int index, float change)
    {
        ref var contact = ref GetConvexContactReference(ref this, index);
        contact.Depth += change;
        if (!IsFar(contact, GreatestGap))
            contact.Offset += Normal * (0.5f * change);
    }

    /// <summary>Gap between the surfaces, m: zero where any contact touches, the mean of all contacts where none does.</summary>
    internal readonly float Gap
    {
        get
        {
            if (GreatestDepth >= 0)
                return 0;
            var gap = -Contact0.Depth;
            for (int i = 1; i < Count; ++i)
                gap -= Read(i).Depth;
            return gap / Count;
        }
    }

    /// <summary>Where a body is touched, relative to the centre of A: where the surfaces are apart, on that of A, elsewhere halfway between the two.</summary>
    // What is apart touches later in the step, where its surface is then. Halfway to the other may be far from that of a body that is small and fast: its
    // friction would turn it with a wrong arm, and whoever spins would come off the ground too slowly or too fast. Along the normal arms have no moment,
    // so the normal rows do not see it. What goes so far in a step that it may turn many times before it is found again is no farther from its halfway
    // contact than from the truth: with arms of its own it would gain energy. What is round has its surface there whichever way it has turned.
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    internal readonly Vector3 ArmOf(in ConvexContact contact) => contact.Depth < 0 ? ArmApart(contact) : contact.Offset;

    // Whether the gap is more than some number of arms.
    static bool IsFar(in ConvexContact contact, float count) =>
        contact.Depth < 0 && contact.Depth * contact.Depth > count * count * Exact.LengthSquared(contact.Offset);

    readonly Vector3 ArmApart(in ConvexContact contact)
    {
        // Halfway is no less than about half of the gap away: what is nearer is at the surface (AddDepth).
        if (IsFar(contact, GreatestGap / 2))
            return contact.Offset;
        var arm = contact.Offset - Normal * (0.5f * contact.Depth);
        var squared = Exact.LengthSquared(arm);
        if (contact.Depth * contact.Depth < GreatestGap * GreatestGap * squared)
            return arm;
        var along = Exact.Dot(arm, Normal);
        return squared - along * along < RoundPart * RoundPart * squared ? arm : contact.Offset;
    }

    /// <inheritdoc/>
    public readonly Vector3 GetNormal(int contactIndex) => Normal;

    /// <inheritdoc/>
    public readonly Vector3 GetOffset(int contactIndex) => Read(contactIndex).Offset;

    /// <inheritdoc/>
    public readonly void GetContact(int contactIndex, out Vector3 offset, out Vector3 normal, out float depth, out int featureId)
    {
        ref readonly var contact = ref Read(contactIndex);
        offset = contact.Offset;
        normal = Normal;
        depth = contact.Depth;
        featureId = contact.FeatureId;
    }

    /// <inheritdoc/>
    public readonly void GetContact(int contactIndex, out Contact contactData) =>
        GetContact(contactIndex, out contactData.Offset, out contactData.Normal, out contactData.Depth, out contactData.FeatureId);

    /// <summary>Removes a contact; the last one takes its index.</summary>
    public static void FastRemoveAt(ref ConvexContactManifold manifold, int index)
    {
        var last = manifold.Count - 1;
        GetConvexContactReference(ref manifold, index) = GetConvexContactReference(ref manifold, last);
        manifold.Count = last;
    }

    /// <inheritdoc/>
    public static ref float GetDepthReference(ref ConvexContactManifold manifold, int contactIndex) =>
        ref GetConvexContactReference(ref manifold, contactIndex).Depth;

    /// <inheritdoc/>
    public static ref Vector3 GetNormalReference(ref ConvexContactManifold manifold, int contactIndex) => ref manifold.Normal;

    /// <inheritdoc/>
    public static ref Vector3 GetOffsetReference(ref ConvexContactManifold manifold, int contactIndex) =>
        ref GetConvexContactReference(ref manifold, contactIndex).Offset;

    /// <inheritdoc/>
    public static ref int GetFeatureIdReference(ref ConvexContactManifold manifold, int contactIndex) =>
        ref GetConvexContactReference(ref manifold, contactIndex).FeatureId;

    /// <inheritdoc/>
    public static ref Contact GetNonconvexContactReference(ref ConvexContactManifold manifold, int contactIndex) =>
        throw new InvalidOperationException("The contacts of a convex manifold have no normals of their own.");

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static ref ConvexContact GetConvexContactReference(ref ConvexContactManifold manifold, int contactIndex)
    {
        Check.That((uint)contactIndex < MaximumContactCount);
        return ref Unsafe.Add(ref manifold.Contact0, contactIndex);
    }

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    [System.Diagnostics.CodeAnalysis.UnscopedRef]
    internal readonly ref readonly ConvexContact Read(int index) => ref GetConvexContactReference(ref Unsafe.AsRef(in this), index);
}
