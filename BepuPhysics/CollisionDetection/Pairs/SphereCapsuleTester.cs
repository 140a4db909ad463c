using System.Numerics;
using System.Runtime.CompilerServices;
using BepuPhysics.Collidables;
using BepuUtilities;

namespace BepuPhysics.CollisionDetection;

/// <summary>Sphere against capsule: one contact on the line from the sphere's centre to the nearest point of the capsule's segment.</summary>
public readonly struct SphereCapsuleTester : IPairTester<SphereWide, CapsuleWide, Few1<ContactWide>>
{
    /// <inheritdoc/>
    public static bool NeedsOrientationA => false;

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void Test(in SphereWide a, in CapsuleWide b, in PairPoseWide pose, Vector<float> speculativeMargin,
        out ConvexManifoldWide<Few1<ContactWide>> manifold)
    {
        Unsafe.SkipInit(out manifold);
        var axis = QuaternionWide.TransformUnitY(pose.OrientationB);
        var along = Wide.Clamp(-Vector3Wide.Dot(axis, pose.OffsetB), -b.HalfLength, b.HalfLength);
        var offset = -pose.OffsetB - axis * along;
        var distance = offset.Length();
        // A centre on the segment leaves by the shortest way, across the axis: any direction across is one.
        manifold.Normal = Vector3Wide.Select(
            Vector.GreaterThan(distance, Vector<float>.Zero), offset * (Vector<float>.One / distance), QuaternionWide.TransformUnitX(pose.OrientationB));
        manifold.Contacts[0].WriteFromSphere(manifold.Normal, a.Radius, a.Radius + b.Radius - distance, speculativeMargin);
    }
}
