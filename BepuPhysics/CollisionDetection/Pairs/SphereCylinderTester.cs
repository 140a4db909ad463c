using System.Numerics;
using System.Runtime.CompilerServices;
using BepuPhysics.Collidables;
using BepuUtilities;

namespace BepuPhysics.CollisionDetection;

/// <summary>
/// Sphere against cylinder: one contact on the line from the sphere's centre to the nearest point of the cylinder; a centre inside the
/// cylinder leaves by the nearer of the side and an end, by the end where they are equally near.
/// </summary>
public readonly struct SphereCylinderTester : IPairTester<SphereWide, CylinderWide, Few1<ContactWide>>
{
    /// <inheritdoc/>
    public static bool NeedsOrientationA => false;

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void Test(in SphereWide a, in CylinderWide b, in PairPoseWide pose, Vector<float> speculativeMargin,
        out ConvexManifoldWide<Few1<ContactWide>> manifold)
    {
        Unsafe.SkipInit(out manifold);
        var zero = Vector<float>.Zero;
        var axes = Matrix3x3Wide.FromQuaternion(pose.OrientationB);
        var center = axes * -pose.OffsetB;
        var fromAxis = Vector.SquareRoot(center.X * center.X + center.Z * center.Z);
        // All sides are equally far from the axis: there the way out is along X.
        var hasSide = Vector.GreaterThan(fromAxis, zero);
        var inverse = Vector<float>.One / fromAxis;
        var sideX = Wide.Select(hasSide, center.X * inverse, Vector<float>.One);
        var sideZ = Wide.Mask(hasSide, center.Z * inverse);

        // In the plane through the axis and the centre the cylinder is a rectangle.
        var beyondSide = fromAxis - b.Radius;
        var beyondEnd = Vector.Abs(center.Y) - b.HalfLength;
        var end = Wide.Sign(center.Y);
        var outsideSide = Wide.Max(beyondSide, zero);
        var outsideEnd = Wide.Max(beyondEnd, zero);
        var distance = Vector.SquareRoot(outsideSide * outsideSide + outsideEnd * outsideEnd);
        // Squares of the smallest distances underflow to zero: such a centre is on the surface, and the normal there is as good.
        var isOutside = Vector.GreaterThan(distance, zero);
        var inverseDistance = Vector<float>.One / distance;
        var useSide = Vector.GreaterThan(beyondSide, beyondEnd);
        var alongSide = Wide.Select(isOutside, outsideSide * inverseDistance, Wide.Mask(useSide, Vector<float>.One));
        var alongEnd = Wide.Select(isOutside, outsideEnd * inverseDistance, Wide.Select(useSide, zero, Vector<float>.One));
        manifold.Normal = Matrix3x3Wide.TransposeTimes(axes, new Vector3Wide(sideX * alongSide, end * alongEnd, sideZ * alongSide));
        var outward = Wide.Select(isOutside, distance, Wide.Max(beyondSide, beyondEnd));
        manifold.Contacts[0].WriteFromSphere(manifold.Normal, a.Radius, a.Radius - outward, speculativeMargin);
    }
}
