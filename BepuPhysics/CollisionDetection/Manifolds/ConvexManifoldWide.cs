using BepuUtilities;

namespace BepuPhysics.CollisionDetection;

/// <summary>The contacts of a bundle of convex pairs.</summary>
/// <typeparam name="TContacts">As many contacts as a pair can have.</typeparam>
public struct ConvexManifoldWide<TContacts> where TContacts : unmanaged, IFew<ContactWide>
{
    /// <summary>Unit normal of all contacts of a pair in world axes, from B to A; means nothing where no contact exists.</summary>
    public Vector3Wide Normal;
    /// <summary>The contacts; those that exist need not be the first.</summary>
    public TContacts Contacts;
}
