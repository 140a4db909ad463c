using System;
using System.Numerics;
using System.Runtime.CompilerServices;
using BepuUtilities;
using BepuUtilities.Memory;

namespace BepuPhysics.Collidables;

/// <summary>A flat triangle whose corners may be anywhere around the origin of its frame.</summary>
/// <remarks>
/// <para>One-sided unless <see cref="TwoSided"/> is set: the front is the side from which A, B, C follow each other clockwise, that to which
/// (C - A) x (B - A) points. Rays and contacts meet the front only.</para>
/// <para>A body turns around the origin of its shape, so a triangle that is to be a body of its own is centred: each corner less
/// (A + B + C) / 3. Corners are rounded relative to the farthest one.</para>
/// <para>The height over the longest edge is at least 1e-6 m and at least 1e-5 of that edge: a thinner triangle has no normal that floats
/// can tell.</para>
/// </remarks>
/// <param name="a">First corner; coordinates up to 1e7 m, checked when the shape is added.</param>
/// <param name="b">Second corner.</param>
/// <param name="c">Third corner.</param>
public struct Triangle(Vector3 a, Vector3 b, Vector3 c) : IConvexShape
{
    /// <summary>Type id of triangles.</summary>
    public const int Id = 3;

    /// <summary>Least height over the longest edge, as a part of that edge.</summary>
    const double MinimumThickness = 1e-5;

    /// <summary>First corner, m.</summary>
    public Vector3 A = a;
    /// <summary>Second corner, m.</summary>
    public Vector3 B = b;
    /// <summary>Third corner, m.</summary>
    public Vector3 C = c;

    /// <summary>All bits set where the triangle has two sides.</summary>
    internal int TwoSidedMask;

    /// <summary>Whether rays and contacts meet the back as well as the front; false unless it is set.</summary>
    public bool TwoSided
    {
        readonly get => TwoSidedMask != 0;
        set => TwoSidedMask = value ? -1 : 0;
    }

    /// <inheritdoc/>
    public static int TypeId => Id;

    /// <inheritdoc/>
    public static ShapeBatch CreateShapeBatch(BufferPool pool, int initialCapacity, Shapes shapes) =>
        new ConvexShapeBatch<Triangle, TriangleWide>(pool, initialCapacity);

    /// <inheritdoc/>
    public readonly void Validate()
    {
        CheckCorner(A, nameof(A));
        CheckCorner(B, nameof(B));
        CheckCorner(C, nameof(C));
        // In doubles, where neither the smallest nor the largest squares leave the range.
        double abX = (double)B.X - A.X, abY = (double)B.Y - A.Y, abZ = (double)B.Z - A.Z;
        double acX = (double)C.X - A.X, acY = (double)C.Y - A.Y, acZ = (double)C.Z - A.Z;
        if (IsThin(abX, abY, abZ, acX, acY, acZ, out var longest, out var height))
        {
            throw new ArgumentException($"The corners {A}, {B}, {C} of a triangle make it {longest} m long and {height} m thick; " +
                $"the least thickness is {ShapeLimits.MinimumSize} m and {MinimumThickness} of the length.");
        }
    }

    /// <summary>Whether a triangle is too thin to have a normal.</summary>
    /// <param name="abX">From corner A to B.</param>
    /// <param name="abY">From corner A to B.</param>
    /// <param name="abZ">From corner A to B.</param>
    /// <param name="acX">From corner A to C.</param>
    /// <param name="acY">From corner A to C.</param>
    /// <param name="acZ">From corner A to C.</param>
    /// <param name="longest">Length of the longest edge, m.</param>
    /// <param name="height">Height over it, m.</param>
    internal static bool IsThin(double abX, double abY, double abZ, double acX, double acY, double acZ, out double longest, out double height)
    {
        double bcX = acX - abX, bcY = acY - abY, bcZ = acZ - abZ;
        double x = abY * acZ - abZ * acY, y = abZ * acX - abX * acZ, z = abX * acY - abY * acX;
        longest = Math.Sqrt(Math.Max(
            abX * abX + abY * abY + abZ * abZ, Math.Max(acX * acX + acY * acY + acZ * acZ, bcX * bcX + bcY * bcY + bcZ * bcZ)));
        height = longest > 0 ? Math.Sqrt(x * x + y * y + z * z) / longest : 0;
        return height < ShapeLimits.MinimumSize || height < longest * MinimumThickness;
    }

    static void CheckCorner(Vector3 corner, string field)
    {
        const float Limit = ShapeLimits.MaximumSize;
        if (!(MathF.Abs(corner.X) <= Limit && MathF.Abs(corner.Y) <= Limit && MathF.Abs(corner.Z) <= Limit))
            throw new ArgumentOutOfRangeException(field, corner, $"The coordinates of corner {field} of a triangle must be from {-Limit} to {Limit} m.");
    }

    /// <inheritdoc/>
    public readonly void ComputeBounds(Quaternion orientation, out Vector3 min, out Vector3 max) =>
        OneLane.ComputeBounds<Triangle, TriangleWide>(this, orientation, out min, out max);

    /// <inheritdoc/>
    /// <remarks>
    /// The origin need not be on the triangle. Where it is not, a turn carries the surface farther than its radius: by the distance between
    /// the two as well, which is no more than that to the centroid.
    /// </remarks>
    public readonly void ComputeAngularExpansionData(out float maximumRadius, out float maximumAngularExpansion)
    {
        Lanes.Broadcast<Triangle, TriangleWide>(this).GetExpansion(out var radius, out var expansion);
        maximumRadius = radius[0];
        maximumAngularExpansion = expansion[0];
    }

    /// <summary>Inverse mass and inverse inertia of a sheet of even thickness, next to nothing, around the origin of its frame.</summary>
    /// <remarks>Around its centre of mass if the triangle is centred, as it should be for a body of its own.</remarks>
    /// <param name="mass">Mass, kg; finite and positive.</param>
    /// <exception cref="ArgumentException">
    /// The triangle is not valid, or the mass is not positive or so extreme that an inverse leaves the range of a float.
    /// </exception>
    public readonly BodyInertia ComputeInertia(float mass)
    {
        Validate();
        // Second moments of a triangle per mass: (aa' + bb' + cc' + ss') / 12 with s = a + b + c. The moments of inertia are their trace
        // less themselves. In doubles, because the inverse of a thin triangle's tensor cancels.
        double sX = (double)A.X + B.X + C.X, sY = (double)A.Y + B.Y + C.Y, sZ = (double)A.Z + B.Z + C.Z;
        double xx = SumOfProducts(A.X, A.X, B.X, B.X, C.X, C.X, sX, sX), yx = SumOfProducts(A.Y, A.X, B.Y, B.X, C.Y, C.X, sY, sX);
        double yy = SumOfProducts(A.Y, A.Y, B.Y, B.Y, C.Y, C.Y, sY, sY), zx = SumOfProducts(A.Z, A.X, B.Z, B.X, C.Z, C.X, sZ, sX);
        double zz = SumOfProducts(A.Z, A.Z, B.Z, B.Z, C.Z, C.Z, sZ, sZ), zy = SumOfProducts(A.Z, A.Y, B.Z, B.Y, C.Z, C.Y, sZ, sY);
        var tensor = new InertiaTensor { XX = yy + zz, YX = -yx, YY = xx + zz, ZX = -zx, ZY = -zy, ZZ = xx + yy };
        var inertia = ShapeLimits.InvertInertia(mass, (float)tensor.XX, (float)tensor.YY, (float)tensor.ZZ);
        inertia.InverseInertiaTensor = tensor.Invert(mass).ToFloats();
        return inertia;
    }

    static double SumOfProducts(double a0, double a1, double b0, double b1, double c0, double c1, double s0, double s1) =>
        (a0 * a1 + b0 * b1 + c0 * c1 + s0 * s1) * (1.0 / 12);

    /// <summary>Finds where a ray passes through the triangle.</summary>
    /// <remarks>A ray within the triangle's plane misses it. Where triangles share corners and pose, no ray passes between them.</remarks>
    /// <param name="pose">Pose of the shape.</param>
    /// <param name="origin">Start of the ray in the world, m.</param>
    /// <param name="direction">Direction of the ray, of any length; zero hits nothing.</param>
    /// <param name="t">At a hit, the point is origin + direction * t, and t is at least zero. Zero without a hit.</param>
    /// <param name="normal">At a hit, the unit normal of the side that was met: it opposes the direction. Zero without a hit.</param>
    /// <returns>Whether the ray hits the front, or either side of a two-sided triangle.</returns>
    public readonly bool RayTest(in RigidPose pose, Vector3 origin, Vector3 direction, out float t, out Vector3 normal) =>
        OneLane.RayTest<Triangle, TriangleWide>(this, pose, origin, direction, out t, out normal);
}

/// <summary>A bundle of triangles.</summary>
public struct TriangleWide : IShapeWide<Triangle>
{
    /// <inheritdoc cref="Triangle.A"/>
    public Vector3Wide A;
    /// <inheritdoc cref="Triangle.B"/>
    public Vector3Wide B;
    /// <inheritdoc cref="Triangle.C"/>
    public Vector3Wide C;
    /// <summary>All bits set where the triangle has two sides.</summary>
    public Vector<int> TwoSidedMask;

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public readonly void GetBounds(in QuaternionWide orientation,
        out Vector<float> maximumRadius, out Vector<float> maximumAngularExpansion, out Vector3Wide min, out Vector3Wide max)
    {
        GetExpansion(out maximumRadius, out maximumAngularExpansion);
        var axes = Matrix3x3Wide.FromQuaternion(orientation);
        var a = Matrix3x3Wide.TransposeTimes(axes, A);
        var b = Matrix3x3Wide.TransposeTimes(axes, B);
        var c = Matrix3x3Wide.TransposeTimes(axes, C);
        min = Vector3Wide.Min(Vector3Wide.Min(a, b), c);
        max = Vector3Wide.Max(Vector3Wide.Max(a, b), c);
    }

    // The reach of a shape along a direction is at most its radius, and at least the negated distance of the origin from it. What a turn
    // can add is their difference. The distance is no more than that from the centroid, and exact if that is the origin.
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    internal readonly void GetExpansion(out Vector<float> maximumRadius, out Vector<float> maximumAngularExpansion)
    {
        maximumRadius = Vector.SquareRoot(Wide.Max(Wide.Max(A.LengthSquared(), B.LengthSquared()), C.LengthSquared()));
        maximumAngularExpansion = maximumRadius + (A + B + C).Length() * new Vector<float>(1f / 3);
    }

    /// <inheritdoc/>
    // Seen along the ray the triangle is flat, and the areas between the ray and its edges have one sign where it is hit. In two dimensions
    // an area is the difference of two products: rounding can make it zero, but never turn its sign, and a shared edge gives the same two
    // products to both its triangles. So one of them is hit (Woop and others, "Watertight Ray/Triangle Intersection", JCGT 2013).
    public readonly void RayTest(
        in RigidPoseWide pose, in RayWide ray, out Vector<int> hitMask, out Vector<float> t, out Vector3Wide normal)
    {
        var axes = Matrix3x3Wide.FromQuaternion(pose.Orientation);
        var line = new CenteredRayWide(ray, pose.Position);
        line.ToLocal(axes);
        Vector3Wide.BuildOrthonormalBasis(line.Direction, out var x, out var y);
        Meet(line, x, y, out var front, out var back, out var place);
        var meets = front | back;
        line.Resolve(place, Wide.Select(meets, place, new Vector<float>(float.NaN)), out hitMask, out _, out t);
        var faceNormal = GetNormal();
        normal = Vector3Wide.Mask(hitMask, Matrix3x3Wide.TransposeTimes(axes, Vector3Wide.Select(back, -faceNormal, faceNormal)));
    }

    /// <summary>Where lines pass through the planes of the triangles, and whether inside of these.</summary>
    /// <param name="line">Lines in the frames of the triangles.</param>
    /// <param name="x">First axis across the line.</param>
    /// <param name="y">Second axis across the line.</param>
    /// <param name="front">All bits set where the line enters by the front.</param>
    /// <param name="back">All bits set where it enters by the back and that is a side.</param>
    /// <param name="place">Distance along the line, if it meets the triangle.</param>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    internal readonly void Meet(in CenteredRayWide line, in Vector3Wide x, in Vector3Wide y,
        out Vector<int> front, out Vector<int> back, out Vector<float> place)
    {
        var a = A - line.Closest;
        var b = B - line.Closest;
        var c = C - line.Closest;
        Vector<float> ax = Vector3Wide.Dot(a, x), ay = Vector3Wide.Dot(a, y);
        Vector<float> bx = Vector3Wide.Dot(b, x), by = Vector3Wide.Dot(b, y);
        Vector<float> cx = Vector3Wide.Dot(c, x), cy = Vector3Wide.Dot(c, y);
        // Twice the areas that the line's place has with two corners each, seen along it.
        var areaA = bx * cy - by * cx;
        var areaB = cx * ay - cy * ax;
        var areaC = ax * by - ay * bx;
        var sum = areaA + areaB + areaC;
        var zero = Vector<float>.Zero;
        front = Vector.GreaterThanOrEqual(areaA, zero) & Vector.GreaterThanOrEqual(areaB, zero) & Vector.GreaterThanOrEqual(areaC, zero) &
            Vector.GreaterThan(sum, zero);
        back = Vector.LessThanOrEqual(areaA, zero) & Vector.LessThanOrEqual(areaB, zero) & Vector.LessThanOrEqual(areaC, zero) &
            Vector.LessThan(sum, zero) & TwoSidedMask;
        place = (Vector3Wide.Dot(a, line.Direction) * areaA + Vector3Wide.Dot(b, line.Direction) * areaB +
            Vector3Wide.Dot(c, line.Direction) * areaC) / sum;
    }

    /// <summary>Unit normal of the front in the frame of the triangle.</summary>
    // The cross product of the edges that meet opposite the longest one. Its error in the direction of the longest edge would tilt the
    // plane of a thin triangle by more than its thickness, so that is taken out; what is left turns it around that edge.
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    internal readonly Vector3Wide GetNormal()
    {
        var ab = B - A;
        var bc = C - B;
        var ca = A - C;
        var squaredAB = ab.LengthSquared();
        var squaredBC = bc.LengthSquared();
        var squaredCA = ca.LengthSquared();
        var longestIsAB = Vector.GreaterThanOrEqual(squaredAB, squaredBC) & Vector.GreaterThanOrEqual(squaredAB, squaredCA);
        var longestIsBC = Vector.AndNot(Vector.GreaterThanOrEqual(squaredBC, squaredCA), longestIsAB);
        var longest = Vector3Wide.Select(longestIsAB, ab, Vector3Wide.Select(longestIsBC, bc, ca));
        var next = Vector3Wide.Select(longestIsAB, bc, Vector3Wide.Select(longestIsBC, ca, ab));
        var last = Vector3Wide.Select(longestIsAB, ca, Vector3Wide.Select(longestIsBC, ab, bc));
        var squaredLongest = Wide.Max(Wide.Max(squaredAB, squaredBC), squaredCA);
        var normal = Vector3Wide.Cross(last, next);
        return Vector3Wide.Normalize(normal - longest * Wide.DivideOrZero(Vector3Wide.Dot(normal, longest), squaredLongest));
    }
}
