using System.Numerics;
using System.Runtime.CompilerServices;
using BepuPhysics.Collidables;
using BepuUtilities;

namespace BepuPhysics.CollisionDetection;

/// <summary>Sphere against sphere: one contact on the line of the centres; along world Y where these coincide.</summary>
public readonly struct SphereSphereTester : IPairTester<SphereWide, SphereWide, Few1<ContactWide>>
{
    /// <inheritdoc/>
    public static bool NeedsOrientationA => false;

    /// <inheritdoc/>
    public static bool NeedsOrientationB => false;

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void Test(in SphereWide a, in SphereWide b, in PairPoseWide pose, Vector<float> speculativeMargin,
        out ConvexManifoldWide<Few1<ContactWide>> manifold)
    {
        Unsafe.SkipInit(out manifold);
        var distance = pose.OffsetB.Length();
        // Every direction is one of least penetration when the centres coincide.
        var up = new Vector3Wide(Vector<float>.Zero, Vector<float>.One, Vector<float>.Zero);
        manifold.Normal = Vector3Wide.Select(
            Vector.GreaterThan(distance, Vector<float>.Zero), pose.OffsetB * (new Vector<float>(-1f) / distance), up);
        manifold.Contacts[0].WriteFromSphere(manifold.Normal, a.Radius, a.Radius + b.Radius - distance, speculativeMargin);
    }
}
