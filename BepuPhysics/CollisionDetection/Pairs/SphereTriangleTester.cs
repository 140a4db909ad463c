using System.Numerics;
using System.Runtime.CompilerServices;
using BepuPhysics.Collidables;
using BepuUtilities;

namespace BepuPhysics.CollisionDetection;

/// <summary>Sphere against triangle: one contact on the line from the sphere's centre to the nearest point of the triangle.</summary>
/// <remarks>
/// A one-sided triangle meets only spheres whose centre is in front of its plane, or on it: a sphere that has passed through by more than
/// its radius is let go, and none is pulled to the back. The normal then never points behind the plane. On a two-sided triangle the normal
/// is towards the centre, on either side; a centre on the triangle leaves by the front.
/// </remarks>
public readonly struct SphereTriangleTester : IPairTester<SphereWide, TriangleWide, Few1<ContactWide>>
{
    /// <inheritdoc/>
    public static bool NeedsOrientationA => false;

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.NoInlining)]
    public static void Test(in SphereWide a, in TriangleWide b, in PairPoseWide pose, Vector<float> speculativeMargin,
        out ConvexManifoldWide<Few1<ContactWide>> manifold)
    {
        Unsafe.SkipInit(out manifold);
        var zero = Vector<float>.Zero;
        var axes = Matrix3x3Wide.FromQuaternion(pose.OrientationB);
        var center = axes * -pose.OffsetB;
        var front = b.GetNormal();
        var height = Vector3Wide.Dot(front, center - b.A);

        var outside = Vector<int>.Zero;
        var offset = Vector3Wide.Zero;
        var squaredDistance = new Vector<float>(float.MaxValue);
        Visit(b.A, b.B, front, center, ref outside, ref offset, ref squaredDistance);
        Visit(b.B, b.C, front, center, ref outside, ref offset, ref squaredDistance);
        Visit(b.C, b.A, front, center, ref outside, ref offset, ref squaredDistance);

        var distance = Wide.Select(outside, Vector.SquareRoot(squaredDistance), Vector.Abs(height));
        var faceNormal = Vector3Wide.Select(Vector.LessThan(height, zero), -front, front);
        // A centre on an edge has no direction from there, and the face's is as good.
        var useEdge = outside & Vector.GreaterThan(distance, zero);
        var normal = Vector3Wide.Select(useEdge, offset * (Vector<float>.One / distance), faceNormal);
        manifold.Normal = Matrix3x3Wide.TransposeTimes(axes, normal);
        manifold.Contacts[0].WriteFromSphere(manifold.Normal, a.Radius, a.Radius - distance, speculativeMargin);
        // A triangle without area has no front, and no contacts.
        manifold.Contacts[0].Exists &= (b.TwoSidedMask | Vector.GreaterThanOrEqual(height, zero)) &
            Vector.GreaterThan(front.LengthSquared(), new Vector<float>(0.5f));
    }

    /// <summary>Keeps the offset from the edge if it is the shortest so far.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static void Visit(in Vector3Wide start, in Vector3Wide end, in Vector3Wide front, in Vector3Wide center,
        ref Vector<int> outside, ref Vector3Wide offset, ref Vector<float> squaredDistance)
    {
        var edge = new TriangleEdgeWide(start, end, front);
        var zero = Vector<float>.Zero;
        var fromStart = center - start;
        outside |= Vector.GreaterThan(Vector3Wide.Dot(edge.Outward, fromStart), zero);
        var along = Wide.Clamp(Vector3Wide.Dot(fromStart, edge.Direction), zero, edge.Length);
        var fromEdge = fromStart - edge.Direction * along;
        // From an inner point of the edge the way is across it. What is left along it is rounding, which counts near the edge.
        var inner = Vector.GreaterThan(along, zero) & Vector.LessThan(along, edge.Length);
        fromEdge -= edge.Direction * Wide.Mask(inner, Vector3Wide.Dot(fromEdge, edge.Direction));
        var squared = fromEdge.LengthSquared();
        var nearer = Vector.LessThan(squared, squaredDistance);
        offset = Vector3Wide.Select(nearer, fromEdge, offset);
        squaredDistance = Wide.Select(nearer, squared, squaredDistance);
    }
}
