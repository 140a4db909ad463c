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
public readonly unsafe struct SphereTriangleTester : IPairTester<SphereWide, TriangleWide, Few1<ContactWide>>
{
    /// <summary>What the steps of the test hand on, in the triangle's axes, from the sphere's centre.</summary>
    struct Scratch
    {
        public Matrix3x3Wide Axes;
        public Vector3Wide A, B, C;
        public Vector3Wide AB, BC, CA;
        public Vector3Wide Front;
        /// <summary>Where the centre is not over the face, and where it is beside an inner part of one of the edges.</summary>
        public Vector<int> Outside, BesideEdge;
        /// <summary>To the nearest edge.</summary>
        public Vector3Wide Offset;
        public Vector<float> SquaredDistance;
    }

    /// <inheritdoc/>
    public static bool NeedsOrientationA => false;

    /// <inheritdoc/>
    // Step by step, each a method of its own: all at once has many times as many values as there are registers.
    [MethodImpl(MethodImplOptions.NoInlining)]
    public static void Test(in SphereWide a, in TriangleWide b, in PairPoseWide pose, Vector<float> speculativeMargin,
        out ConvexManifoldWide<Few1<ContactWide>> manifold)
    {
        Unsafe.SkipInit(out manifold);
        var memory = stackalloc byte[AlignedScratch.SizeFor<Scratch>()];
        ref var scratch = ref AlignedScratch.Align<Scratch>(memory);
        Place(b, pose, ref scratch);
        VisitEdge(scratch.A, scratch.AB, ref scratch);
        VisitEdge(scratch.B, scratch.BC, ref scratch);
        VisitEdge(scratch.C, scratch.CA, ref scratch);

        var zero = Vector<float>.Zero;
        var front = scratch.Front;
        var height = -Vector3Wide.Dot(front, scratch.A);
        var distance = Wide.Select(scratch.Outside, Vector.SquareRoot(scratch.SquaredDistance), Vector.Abs(height));
        var faceNormal = Vector3Wide.Select(Vector.LessThan(height, zero), -front, front);
        // A centre on an edge has no direction from there, and the face's is as good.
        var useEdge = scratch.Outside & Vector.GreaterThan(distance, zero);
        var normal = Vector3Wide.Select(useEdge, scratch.Offset * (new Vector<float>(-1f) / distance), faceNormal);
        manifold.Normal = Matrix3x3Wide.TransposeTimes(scratch.Axes, normal);
        manifold.Contacts[0].WriteFromSphere(manifold.Normal, a.Radius, a.Radius - distance, speculativeMargin);
        // A triangle without area has no front, and no contacts.
        manifold.Contacts[0].Exists &= (b.TwoSidedMask | Vector.GreaterThanOrEqual(height, zero)) &
            Vector.GreaterThan(front.LengthSquared(), new Vector<float>(0.5f));
    }

    [MethodImpl(MethodImplOptions.NoInlining)]
    static void Place(in TriangleWide triangle, in PairPoseWide pose, ref Scratch scratch)
    {
        var axes = Matrix3x3Wide.FromQuaternion(pose.OrientationB);
        var offset = axes * pose.OffsetB;
        scratch.Axes = axes;
        scratch.A = triangle.A + offset;
        scratch.B = triangle.B + offset;
        scratch.C = triangle.C + offset;
        scratch.AB = triangle.B - triangle.A;
        scratch.BC = triangle.C - triangle.B;
        scratch.CA = triangle.A - triangle.C;
        scratch.Front = triangle.GetNormal();
        scratch.Outside = scratch.BesideEdge = Vector<int>.Zero;
        scratch.Offset = Vector3Wide.Zero;
        scratch.SquaredDistance = new Vector<float>(float.MaxValue);
    }

    /// <summary>Tries one edge.</summary>
    /// <param name="start">First corner of the edge; the corners follow each other clockwise around the front.</param>
    /// <param name="edge">From there to the next corner.</param>
    /// <param name="scratch">What was found so far.</param>
    // The regions that are beside an inner part of each edge do not overlap, so a centre in one of them has that edge as the nearest, however
    // the distances are rounded: near a corner those are equal to the square of what the normals differ by.
    [MethodImpl(MethodImplOptions.NoInlining)]
    static void VisitEdge(in Vector3Wide start, in Vector3Wide edge, ref Scratch scratch)
    {
        var zero = Vector<float>.Zero;
        // An edge without length is its corner.
        var inverse = Wide.DivideOrZero(Vector<float>.One, edge.LengthSquared());
        var isOutside = Vector.LessThan(Vector3Wide.Dot(Vector3Wide.Cross(scratch.Front, edge), start), zero);
        var place = Wide.Clamp(-Vector3Wide.Dot(start, edge) * inverse, zero, Vector<float>.One);
        var offset = start + edge * place;
        // To an inner point of the edge the way is across it. What is left along it is rounding, which counts near the edge.
        var inner = Vector.GreaterThan(place, zero) & Vector.LessThan(place, Vector<float>.One);
        offset -= edge * Wide.Mask(inner, Vector3Wide.Dot(offset, edge) * inverse);
        var squared = offset.LengthSquared();
        var isBeside = isOutside & inner;
        var nearer = isBeside | Vector.AndNot(Vector.LessThan(squared, scratch.SquaredDistance), scratch.BesideEdge);
        scratch.Offset = Vector3Wide.Select(nearer, offset, scratch.Offset);
        scratch.SquaredDistance = Wide.Select(nearer, squared, scratch.SquaredDistance);
        scratch.Outside |= isOutside;
        scratch.BesideEdge |= isBeside;
    }
}
