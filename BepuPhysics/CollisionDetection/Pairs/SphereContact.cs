using System.Numerics;
using System.Runtime.CompilerServices;
using BepuUtilities;

namespace BepuPhysics.CollisionDetection;

/// <summary>Contacts of a sphere that is A.</summary>
static class SphereContact
{
    /// <summary>Writes the only contact of a sphere.</summary>
    /// <param name="contact">Contact to write.</param>
    /// <param name="normal">Unit normal from B to the sphere.</param>
    /// <param name="radius">Radius of the sphere.</param>
    /// <param name="depth">Depth along the normal.</param>
    /// <param name="speculativeMargin">Greatest distance at which the contact exists.</param>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void WriteFromSphere(ref this ContactWide contact, in Vector3Wide normal, Vector<float> radius, Vector<float> depth,
        Vector<float> speculativeMargin)
    {
        contact.OffsetA = normal * (depth * new Vector<float>(0.5f) - radius);
        contact.Depth = depth;
        contact.FeatureId = Vector<int>.Zero;
        contact.Exists = Vector.GreaterThanOrEqual(depth, -speculativeMargin);
    }
}
