using System;
using System.Numerics;
using System.Runtime.CompilerServices;

namespace BepuPhysics.CollisionDetection;

/// <summary>The contacts of a pair of several manifolds as callbacks see them: those of the only child that has some, or the deepest of all.</summary>
unsafe ref struct ContactView
{
    readonly Span<ChildResult> results;
    // The result that a convex view shows; none, or several that are shown together.
    readonly int only;
    Origins origins;
    readonly int originCount;
    ConvexContactManifold none;

    /// <summary>None of the results has contacts; several have.</summary>
    public const int Nothing = -1, Several = -2;

    /// <summary>The contacts of several children, deepest first.</summary>
    public NonconvexContactManifold Nonconvex;

    // Where a contact is shown from.
    struct Origin
    {
        public int Result;
        public int Contact;
        public int FeatureId;
    }

    [InlineArray(NonconvexContactManifold.MaximumContactCount)]
    struct Origins
    {
        Origin first;
    }

    public ContactView(Span<ChildResult> results, Vector3 offsetB)
    {
        this.results = results;
        only = FindOnly(results);
        none.OffsetB = Nonconvex.OffsetB = offsetB;
        if (!IsConvex)
            originCount = ShowDeepest();
    }

    /// <summary>Whether no more than one child has contacts.</summary>
    public readonly bool IsConvex => only != Several;

    /// <summary>Index of the only result that has contacts, <see cref="Nothing"/> or <see cref="Several"/>.</summary>
    public static int FindOnly(ReadOnlySpan<ChildResult> results)
    {
        var only = Nothing;
        for (int i = 0; i < results.Length; ++i)
        {
            if (results[i].Manifold.Count == 0)
                continue;
            if (only != Nothing)
                return Several;
            only = i;
        }
        return only;
    }

    /// <summary>The contacts of the only child that has some, or none; changes are those of the child.</summary>
    [System.Diagnostics.CodeAnalysis.UnscopedRef]
    public ref ConvexContactManifold Convex => ref only >= 0 ? ref results[only].Manifold : ref none;

    // Of contacts of one depth the first comes first.
    int ShowDeepest()
    {
        var count = 0;
        for (int i = 0; i < results.Length; ++i)
        {
            for (int j = 0; j < results[i].Manifold.Count; ++j)
            {
                var place = count;
                while (place > 0 && Depth(origins[place - 1]) < results[i].Manifold.GetDepth(j))
                    --place;
                if (place == NonconvexContactManifold.MaximumContactCount)
                    continue;
                count = Math.Min(count + 1, NonconvexContactManifold.MaximumContactCount);
                for (int k = count - 1; k > place; --k)
                    origins[k] = origins[k - 1];
                origins[place] = new() { Result = i, Contact = j };
            }
        }
        for (int i = 0; i < count; ++i)
        {
            ref var result = ref results[origins[i].Result];
            ref var contact = ref NonconvexContactManifold.GetNonconvexContactReference(ref Nonconvex, i);
            result.Manifold.GetContact(origins[i].Contact, out contact);
            contact.FeatureId = origins[i].FeatureId = Mix(contact.FeatureId, result.Children);
        }
        Nonconvex.Count = count;
        return count;
    }

    readonly float Depth(in Origin origin) => results[origin.Result].Manifold.GetDepth(origin.Contact);

    // Those of patches are mixed already.
    static int Mix(int featureId, ChildIds children) => children.IsPatch ? featureId : children.Mix(featureId);

    /// <summary>
    /// Takes over what was changed in a nonconvex view: places, depths, normals, and what was removed. Contacts are known by their feature
    /// ids; contacts of one child have one normal, that of the last that is shown.
    /// </summary>
    public readonly void TakeOver()
    {
        var kept = 0;
        for (int i = 0; i < Nonconvex.Count; ++i)
        {
            Nonconvex.GetContact(i, out var contact);
            var origin = Find(contact.FeatureId, kept);
            if (origin < 0)
                continue;
            kept |= 1 << origin;
            ref var manifold = ref results[origins[origin].Result].Manifold;
            ref var target = ref ConvexContactManifold.GetConvexContactReference(ref manifold, origins[origin].Contact);
            target.Offset = contact.Offset;
            target.Depth = contact.Depth;
            manifold.Normal = contact.Normal;
        }
        // The last contacts of each child first: what is removed is replaced by the last.
        for (int contact = ConvexContactManifold.MaximumContactCount - 1; contact >= 0; --contact)
        {
            for (int i = 0; i < originCount; ++i)
            {
                if (origins[i].Contact == contact && (kept & 1 << i) == 0)
                    ConvexContactManifold.FastRemoveAt(ref results[origins[i].Result].Manifold, contact);
            }
        }
    }

    readonly int Find(int featureId, int taken)
    {
        for (int i = 0; i < originCount; ++i)
        {
            if (origins[i].FeatureId == featureId && (taken & 1 << i) == 0)
                return i;
        }
        return -1;
    }
}
