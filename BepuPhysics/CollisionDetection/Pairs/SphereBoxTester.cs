using System.Numerics;
using System.Runtime.CompilerServices;
using BepuPhysics.Collidables;
using BepuUtilities;

namespace BepuPhysics.CollisionDetection;

/// <summary>
/// Sphere against box: one contact on the line from the sphere's centre to the nearest point of the box; a centre inside the box leaves
/// by the nearest face, of equally near ones by the first of X, Y, Z.
/// </summary>
public readonly struct SphereBoxTester : IPairTester<SphereWide, BoxWide, Few1<ContactWide>>
{
    /// <inheritdoc/>
    public static bool NeedsOrientationA => false;

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void Test(in SphereWide a, in BoxWide b, in PairPoseWide pose, Vector<float> speculativeMargin,
        out ConvexManifoldWide<Few1<ContactWide>> manifold)
    {
        Unsafe.SkipInit(out manifold);
        var axes = Matrix3x3Wide.FromQuaternion(pose.OrientationB);
        var center = axes * -pose.OffsetB;
        var outside = new Vector3Wide(
            center.X - Wide.Clamp(center.X, -b.HalfWidth, b.HalfWidth),
            center.Y - Wide.Clamp(center.Y, -b.HalfHeight, b.HalfHeight),
            center.Z - Wide.Clamp(center.Z, -b.HalfLength, b.HalfLength));
        var distance = outside.Length();
        var outsideNormal = outside * (Vector<float>.One / distance);

        // Inside, the distance to each face is exact: box and centre are of one magnitude near the face that counts.
        var depthX = b.HalfWidth - Vector.Abs(center.X);
        var depthY = b.HalfHeight - Vector.Abs(center.Y);
        var depthZ = b.HalfLength - Vector.Abs(center.Z);
        var depth = Wide.Min(depthX, Wide.Min(depthY, depthZ));
        var useX = Vector.Equals(depth, depthX);
        var useY = Vector.AndNot(Vector.Equals(depth, depthY), useX);
        var useZ = ~(useX | useY);
        var insideNormal = new Vector3Wide(
            Wide.Mask(useX, Wide.Sign(center.X)), Wide.Mask(useY, Wide.Sign(center.Y)), Wide.Mask(useZ, Wide.Sign(center.Z)));

        // Squares of the smallest distances underflow to zero: such a centre is on the surface, and the face's normal is as good.
        var isOutside = Vector.GreaterThan(distance, Vector<float>.Zero);
        var localNormal = Vector3Wide.Select(isOutside, outsideNormal, insideNormal);
        manifold.Normal = Matrix3x3Wide.TransposeTimes(axes, localNormal);
        manifold.Contacts[0].WriteFromSphere(
            manifold.Normal, a.Radius, a.Radius + Wide.Select(isOutside, -distance, depth), speculativeMargin);
    }
}
