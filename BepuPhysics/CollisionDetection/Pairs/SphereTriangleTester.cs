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

        Search search;
        search.Outside = search.BesideEdge = Vector<int>.Zero;
        search.Offset = Vector3Wide.Zero;
        search.SquaredDistance = new Vector<float>(float.MaxValue);
        VisitEdge(b.A, b.B, front, center, ref search);
        VisitEdge(b.B, b.C, front, center, ref search);
        VisitEdge(b.C, b.A, front, center, ref search);

        var distance = Wide.Select(search.Outside, Vector.SquareRoot(search.SquaredDistance), Vector.Abs(height));
        var faceNormal = Vector3Wide.Select(Vector.LessThan(height, zero), -front, front);
        // A centre on an edge has no direction from there, and the face's is as good.
        var useEdge = search.Outside & Vector.GreaterThan(distance, zero);
        var normal = Vector3Wide.Select(useEdge, search.Offset * (Vector<float>.One / distance), faceNormal);
        manifold.Normal = Matrix3x3Wide.TransposeTimes(axes, normal);
        manifold.Contacts[0].WriteFromSphere(manifold.Normal, a.Radius, a.Radius - distance, speculativeMargin);
        // A triangle without area has no front, and no contacts.
        manifold.Contacts[0].Exists &= (b.TwoSidedMask | Vector.GreaterThanOrEqual(height, zero)) &
            Vector.GreaterThan(front.LengthSquared(), new Vector<float>(0.5f));
    }

    struct Search
    {
        /// <summary>Where the centre is not over the face, and where it is beside an inner part of one of the edges.</summary>
        public Vector<int> Outside, BesideEdge;
        /// <summary>From the nearest edge to the centre.</summary>
        public Vector3Wide Offset;
        public Vector<float> SquaredDistance;
    }

    // The regions that are beside an inner part of each edge do not overlap, so a centre in one of them has that edge as the nearest, however
    // the distances are rounded: near a corner those are equal to the square of what the normals differ by.
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static void VisitEdge(in Vector3Wide start, in Vector3Wide end, in Vector3Wide front, in Vector3Wide center, ref Search search)
    {
        var edge = new TriangleEdgeWide(start, end, front);
        var zero = Vector<float>.Zero;
        var fromStart = center - start;
        var outside = Vector.GreaterThan(Vector3Wide.Dot(edge.Outward, fromStart), zero);
        var along = Wide.Clamp(Vector3Wide.Dot(fromStart, edge.Direction), zero, edge.Length);
        var fromEdge = fromStart - edge.Direction * along;
        // From an inner point of the edge the way is across it. What is left along it is rounding, which counts near the edge.
        var inner = Vector.GreaterThan(along, zero) & Vector.LessThan(along, edge.Length);
        fromEdge -= edge.Direction * Wide.Mask(inner, Vector3Wide.Dot(fromEdge, edge.Direction));
        var squared = fromEdge.LengthSquared();
        var nearer = (outside & inner) | Vector.AndNot(Vector.LessThan(squared, search.SquaredDistance), search.BesideEdge);
        search.Offset = Vector3Wide.Select(nearer, fromEdge, search.Offset);
        search.SquaredDistance = Wide.Select(nearer, squared, search.SquaredDistance);
        search.Outside |= outside;
        search.BesideEdge |= outside & inner;
    }
}
