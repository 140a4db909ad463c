using System.Numerics;

namespace BepuPhysics.CollisionDetection;

/// <summary>The contacts of a pair, whether they share a normal or not.</summary>
/// <remarks>Contact indices are from zero to <see cref="Count"/> - 1; they are checked in debug builds only.</remarks>
public interface IContactManifold<TManifold> where TManifold : struct, IContactManifold<TManifold>
{
    /// <summary>A contact with its normal. Setting one of a convex manifold sets the normal of all.</summary>
    Contact this[int index] { get; set; }

    /// <summary>Number of contacts: 0 to 4 with one normal, 0 to 8 otherwise.</summary>
    int Count { get; }

    /// <summary>Whether all contacts share one normal.</summary>
    bool Convex { get; }

    /// <summary>Place of a contact relative to A's centre, in world axes, m.</summary>
    Vector3 GetOffset(int contactIndex);

    /// <summary>Unit normal of a contact in world axes, from B to A.</summary>
    Vector3 GetNormal(int contactIndex);

    /// <summary>Penetration of a contact, m; negative where the surfaces are apart.</summary>
    float GetDepth(int contactIndex);

    /// <summary>Names the features that touch.</summary>
    int GetFeatureId(int contactIndex);

    /// <summary>A contact with its normal.</summary>
    void GetContact(int contactIndex, out Contact contactData);

    /// <summary>All parts of a contact.</summary>
    void GetContact(int contactIndex, out Vector3 offset, out Vector3 normal, out float depth, out int featureId);

    /// <summary>The place of a contact, to be changed.</summary>
    static abstract ref Vector3 GetOffsetReference(ref TManifold manifold, int contactIndex);

    /// <summary>The depth of a contact, to be changed.</summary>
    static abstract ref float GetDepthReference(ref TManifold manifold, int contactIndex);

    /// <summary>The normal of a contact, to be changed; in a convex manifold that of all contacts.</summary>
    static abstract ref Vector3 GetNormalReference(ref TManifold manifold, int contactIndex);

    /// <summary>The feature id of a contact, to be changed.</summary>
    static abstract ref int GetFeatureIdReference(ref TManifold manifold, int contactIndex);

    /// <summary>A contact of a convex manifold, to be changed.</summary>
    /// <exception cref="System.InvalidOperationException">The manifold is not convex.</exception>
    static abstract ref ConvexContact GetConvexContactReference(ref TManifold manifold, int contactIndex);

    /// <summary>A contact of a nonconvex manifold, to be changed.</summary>
    /// <exception cref="System.InvalidOperationException">The manifold is convex.</exception>
    static abstract ref Contact GetNonconvexContactReference(ref TManifold manifold, int contactIndex);
}
