using System.Numerics;
using System.Runtime.CompilerServices;
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

    /// <summary>Marks all contacts of all pairs as not existing; what else is written to the manifold then means nothing.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    internal void RemoveContacts()
    {
        for (int i = 0; i < TContacts.Count; ++i)
            Contacts[i].Exists = Vector<int>.Zero;
    }
}
