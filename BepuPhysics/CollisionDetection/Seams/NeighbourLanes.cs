using System.Numerics;
using System.Runtime.CompilerServices;
using BepuPhysics.Collidables;
using BepuUtilities;

namespace BepuPhysics.CollisionDetection;

/// <summary>Along which direction a triangle of a surface is touched.</summary>
enum TouchedSide
{
    /// <summary>Along the normal that the test has found: it is beyond no neighbour's.</summary>
    Own,
    /// <summary>Along another.</summary>
    Turned,
    /// <summary>Along none: what touches is over a neighbour, and nobody has to test that.</summary>
    Neighbours,
}

/// <summary>The direction of least depth out of a triangle of those that its neighbours leave.</summary>
struct TouchedDirection
{
    /// <summary>What has become of the normal.</summary>
    public TouchedSide Side;
    /// <summary>Unit direction out of the triangle, where it is another one.</summary>
    public Vector3 Direction;
}

/// <summary>Triangles of surfaces that other shapes touch, a lane for each: how <see cref="TriangleNeighbours"/> keeps their normals within bounds.</summary>
/// <remarks>
/// What is touched from beyond a neighbour's normal is touched along the direction of least depth of those that there are. How deep two shapes are in each
/// other along a direction is a sum of reaches, in closed form, by the operations of <see cref="ShapeReach"/>. Shapes of several types lie side by side: of
/// their reaches those terms are zero that a type does not have.
/// </remarks>
unsafe partial struct NeighbourLanes
{
    const int LongestVector = 16;
    // Bounds that meet at a corner are gone over until none is left, or it is seen that they cannot all be met.
    const int MaximumClampCount = 4;

    // The corners, from the triangle's centre, and the triangle's rotation to the world.
    Vector3Wide a, b, c;
    QuaternionWide orientation;
    // Direction out of the triangle along which it is touched; centre of the triangle less that of the other shape, m.
    Vector3Wide direction, center;
    Vector3Wide cosines, sines;
    Vector<int> freeMask;
    Vector<float> margin;
    // The other shape: its rotation; half widths of a box, of which the length of a capsule or a cylinder is Y; radius of a cylinder; of a sphere or capsule.
    QuaternionWide otherOrientation;
    Vector3Wide half;
    Vector<float> discRadius, radius, otherSize;
    Vector<int> otherType;
    // The corners of the other, where that is a triangle too.
    Vector3Wide otherA, otherB, otherC;
    fixed ulong hulls[LongestVector];
    fixed int owners[LongestVector];
    int count;
    // A bit for each type that there is.
    int types;

    // An edge; the direction in the triangle's plane out of it; the bound of directions, zero where there is none.
    struct Edge
    {
        public Vector3Wide Way, Outwards, Bound, Corner;
        public Vector<float> Cosine, Sine;
    }

    struct Shape
    {
        public Edge AB, BC, CA;
        public Vector3Wide Normal, X, Y, Z;
        public Vector<float> Size;
    }

    struct Best
    {
        public Vector3Wide Direction;
        public Vector<float> Depth;
    }

    /// <summary>Begins without a triangle; lanes without one hold anything.</summary>
    public void Clear() => count = types = 0;

    /// <summary>Whether there is no room for another triangle.</summary>
    public readonly bool IsFull => count == Vector<float>.Count;

    /// <summary>Adds a triangle of a surface.</summary>
    /// <param name="placed">The two shapes.</param>
    /// <param name="normal">Unit normal along which they touch, from B to A.</param>
    /// <param name="isA">Whether the triangle is A.</param>
    /// <param name="owner">Where the direction goes.</param>
    public void Add(in PlacedChildren placed, in Vector3 normal, bool isA, int owner)
    {
        var lane = count++;
        owners[lane] = owner;
        ref readonly var own = ref isA ? ref placed.ShapeA : ref placed.ShapeB;
        ref readonly var other = ref isA ? ref placed.ShapeB : ref placed.ShapeA;
        var triangle = own.Read<Triangle>();
        Lanes.Write(triangle.A, ref a, lane);
        Lanes.Write(triangle.B, ref b, lane);
        Lanes.Write(triangle.C, ref c, lane);
        Lanes.Write(isA ? placed.OrientationA : placed.OrientationB, ref orientation, lane);
        Lanes.Write(isA ? -normal : normal, ref direction, lane);
        Lanes.Write(isA ? -placed.OffsetB : placed.OffsetB, ref center, lane);
        ref readonly var cone = ref isA ? ref placed.ConeA : ref placed.ConeB;
        Lanes.Write(cone.Cosines, ref cosines, lane);
        Lanes.Write(cone.Sines, ref sines, lane);
        GatherScatter.Get(ref freeMask, lane) = cone.FreeMask;
        GatherScatter.Get(ref margin, lane) = placed.SpeculativeMargin;
        var type = isA ? placed.TypeB : placed.TypeA;
        types |= 1 << type;
        GatherScatter.Get(ref otherType, lane) = type;
        Lanes.Write(isA ? placed.OrientationB : placed.OrientationA, ref otherOrientation, lane);
        AddShape(type, other, lane);
    }

    void AddShape(int type, in ShapeCopy shape, int lane)
    {
        Vector3 widths = default;
        var (disc, ball, size) = (0f, 0f, 0f);
        hulls[lane] = 0;
        switch (type)
        {
            case Sphere.Id:
                ball = size = shape.Read<Sphere>().Radius;
                break;
            case Capsule.Id:
                var capsule = shape.Read<Capsule>();
                (ball, widths.Y, size) = (capsule.Radius, capsule.HalfLength, capsule.Radius + capsule.HalfLength);
                break;
            case Box.Id:
                var box = shape.Read<Box>();
                widths = new(box.HalfWidth, box.HalfHeight, box.HalfLength);
                size = widths.X + widths.Y + widths.Z;
                break;
            case Cylinder.Id:
                var cylinder = shape.Read<Cylinder>();
                (disc, widths.Y, size) = (cylinder.Radius, cylinder.HalfLength, cylinder.Radius + cylinder.HalfLength);
                break;
            case Triangle.Id:
                var triangle = shape.Read<Triangle>();
                Lanes.Write(triangle.A, ref otherA, lane);
                Lanes.Write(triangle.B, ref otherB, lane);
                Lanes.Write(triangle.C, ref otherC, lane);
                break;
            default:
                var hull = shape.Read<ConvexHull>().Header;
                hulls[lane] = (ulong)hull;
                size = hull->OuterRadius;
                break;
        }
        Lanes.Write(widths, ref half, lane);
        GatherScatter.Get(ref discRadius, lane) = disc;
        GatherScatter.Get(ref radius, lane) = ball;
        GatherScatter.Get(ref otherSize, lane) = size;
    }

    /// <summary>Finds the directions of all triangles that were added, and forgets these.</summary>
    /// <param name="found">Receives them, each where it was said.</param>
    public void Find(TouchedDirection* found)
    {
        var lanes = 0;
        for (int i = 0; i < count; ++i)
            found[owners[i]].Side = TouchedSide.Own;
        var beyond = FindBeyond(out var shape, out var bound) & (uint)((1ul << count) - 1);
        if (beyond != 0)
        {
            var mask = Vector<int>.Zero;
            for (lanes = (int)beyond; lanes != 0; lanes &= lanes - 1)
                GatherScatter.Get(ref mask, BitOperations.TrailingZeroCount(lanes)) = -1;
            FindLeast(ref shape, mask, bound, out var best);
            var none = Wide.Bits(HasNone(shape, best));
            for (lanes = (int)beyond; lanes != 0; lanes &= lanes - 1)
            {
                var lane = BitOperations.TrailingZeroCount(lanes);
                ref var target = ref found[owners[lane]];
                target.Side = (none >> lane & 1) != 0 ? TouchedSide.Neighbours : TouchedSide.Turned;
                target.Direction = Lanes.Read<Vector3, Vector3Wide>(ref best.Direction, lane);
            }
        }
        Clear();
    }

    // A bit for each lane whose direction is beyond a neighbour's.
    [MethodImpl(MethodImplOptions.NoInlining)]
    readonly uint FindBeyond(out Shape shape, out Vector3Wide bound)
    {
        Unsafe.SkipInit(out shape);
        shape.AB.Way = orientation * (b - a);
        shape.BC.Way = orientation * (c - b);
        shape.CA.Way = orientation * (a - c);
        var face = Vector3Wide.Cross(shape.AB.Way, shape.CA.Way);
        var isFace = IsFaceNormal(face, direction);
        if (Has(Triangle.Id))
            isFace |= IsFaceOfOther();
        shape.Normal = Vector3Wide.Normalize(face);
        SetBound(ref shape.AB, shape.Normal, cosines.X, sines.X, 1);
        SetBound(ref shape.BC, shape.Normal, cosines.Y, sines.Y, 2);
        SetBound(ref shape.CA, shape.Normal, cosines.Z, sines.Z, 4);
        shape.Size = Wide.Max(shape.AB.Way.Length(), shape.CA.Way.Length());
        var isBehind = Vector.LessThan(Vector3Wide.Dot(direction, shape.Normal), new Vector<float>(-TriangleFeature.BehindSine));
        return Wide.Bits(Vector.AndNot(Vector.AndNot(Violated(shape, direction, out bound), isFace), isBehind));
    }

    // Along the triangle's normal, as faces touch. No bound leans towards the normal, so that what is as near to it is beyond none.
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static Vector<int> IsFaceNormal(in Vector3Wide face, in Vector3Wide direction)
    {
        const float beyond = TriangleSurface.Beyond;
        var along = Vector3Wide.Dot(direction, face);
        var across = Vector3Wide.Cross(direction, face);
        // All but the square of the sine of the angle between the two.
        return Vector.GreaterThan(along, Vector<float>.Zero) & Vector.LessThan(
            Vector3Wide.Dot(across, across), new Vector<float>(beyond * beyond / 4) * Vector3Wide.Dot(face, face));
    }

    // Two triangles that face each other do not meet any more once one has sunk into the other. What holds them then are the triangles beside them,
    // which stand on the face of the other mesh with their edges, along its normal.
    [MethodImpl(MethodImplOptions.NoInlining)]
    readonly Vector<int> IsFaceOfOther()
    {
        var face = Vector3Wide.Cross(otherOrientation * (otherB - otherA), otherOrientation * (otherA - otherC));
        return Vector.Equals(otherType, new Vector<int>(Triangle.Id)) & IsFaceNormal(face, -direction);
    }

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    readonly void SetBound(ref Edge edge, in Vector3Wide normal, Vector<float> cosine, Vector<float> sine, int bit)
    {
        var across = Vector3Wide.Cross(normal, edge.Way);
        edge.Outwards = across * Wide.DivideOrZero(Vector<float>.One, across.Length());
        var isBound = Vector.Equals(freeMask & new Vector<int>(bit), Vector<int>.Zero);
        edge.Bound = Vector3Wide.Mask(isBound, edge.Outwards * cosine - normal * sine);
        (edge.Cosine, edge.Sine) = (cosine, sine);
    }

    // Whether a direction is beyond a bound, and of those the one that it is farthest beyond.
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static Vector<int> Violated(in Shape shape, in Vector3Wide direction, out Vector3Wide bound)
    {
        var reachB = Vector3Wide.Dot(direction, shape.AB.Way);
        var reachC = Vector3Wide.Dot(direction, -shape.CA.Way);
        var zero = Vector<float>.Zero;
        var farthest = Wide.Max(zero, Wide.Max(reachB, reachC)) - new Vector<float>(TriangleSurface.Beyond) * shape.Size;
        var most = new Vector<float>(TriangleSurface.Beyond);
        var violated = Vector<int>.Zero;
        bound = Vector3Wide.Zero;
        Offer(shape.AB.Bound, direction, zero, reachB, reachC, farthest, ref most, ref violated, ref bound);
        Offer(shape.BC.Bound, direction, reachB, reachC, zero, farthest, ref most, ref violated, ref bound);
        Offer(shape.CA.Bound, direction, reachC, zero, reachB, farthest, ref most, ref violated, ref bound);
        return violated;
    }

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static void Offer(in Vector3Wide bound, in Vector3Wide direction, Vector<float> start, Vector<float> end, Vector<float> opposite,
        Vector<float> farthest, ref Vector<float> most, ref Vector<int> violated, ref Vector3Wide worst)
    {
        var beyond = Vector3Wide.Dot(bound, direction);
        var isAtEdge = Vector.LessThan(opposite, farthest) |
            (Vector.GreaterThanOrEqual(start, farthest) & Vector.GreaterThanOrEqual(end, farthest));
        var isWorse = isAtEdge & Vector.GreaterThan(beyond, most);
        most = Wide.Select(isWorse, beyond, most);
        worst = Vector3Wide.Select(isWorse, bound, worst);
        violated |= isWorse;
    }

    [MethodImpl(MethodImplOptions.NoInlining)]
    void FindLeast(ref Shape shape, Vector<int> beyond, Vector3Wide bound, out Best best)
    {
        shape.AB.Corner = orientation * a;
        shape.BC.Corner = orientation * b;
        shape.CA.Corner = orientation * c;
        PlaceOther(ref shape);
        best.Direction = shape.Normal;
        best.Depth = DepthAlong(shape, shape.Normal, beyond);
        var zero = Vector<float>.Zero;
        var bends = Vector.AndNot(beyond, Vector.Equals(sines.X, zero) & Vector.Equals(sines.Y, zero) & Vector.Equals(sines.Z, zero));
        if (Wide.Bits(bends) == 0)
            return;
        var clamped = direction;
        var turning = bends;
        for (int i = 0; i < MaximumClampCount && Wide.Bits(turning) != 0; ++i)
        {
            var next = Vector3Wide.Normalize(clamped - bound * Vector3Wide.Dot(clamped, bound));
            clamped = Vector3Wide.Select(turning, next, clamped);
            turning &= Violated(shape, clamped, out bound);
        }
        Offer(shape, clamped, Vector.AndNot(bends, turning), ref best);
        OfferNeighbour(shape, shape.AB, bends, ref best);
        OfferNeighbour(shape, shape.BC, bends, ref best);
        OfferNeighbour(shape, shape.CA, bends, ref best);
    }

    // Its axes, or its corners.
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    readonly void PlaceOther(ref Shape shape)
    {
        var x = new Vector3Wide(Vector<float>.One, Vector<float>.Zero, Vector<float>.Zero);
        var y = new Vector3Wide(Vector<float>.Zero, Vector<float>.One, Vector<float>.Zero);
        var z = new Vector3Wide(Vector<float>.Zero, Vector<float>.Zero, Vector<float>.One);
        if (Has(Triangle.Id))
        {
            var isTriangle = Vector.Equals(otherType, new Vector<int>(Triangle.Id));
            x = Vector3Wide.Select(isTriangle, otherA, x);
            y = Vector3Wide.Select(isTriangle, otherB, y);
            z = Vector3Wide.Select(isTriangle, otherC, z);
        }
        (shape.X, shape.Y, shape.Z) = (otherOrientation * x, otherOrientation * y, otherOrientation * z);
    }

    readonly void OfferNeighbour(in Shape shape, in Edge edge, Vector<int> bends, ref Best best)
    {
        var zero = Vector<float>.Zero;
        var isBound = ~(Vector.Equals(edge.Bound.X, zero) & Vector.Equals(edge.Bound.Y, zero) & Vector.Equals(edge.Bound.Z, zero));
        Offer(shape, shape.Normal * edge.Cosine + edge.Outwards * edge.Sine, bends & isBound & Vector.GreaterThan(edge.Sine, zero), ref best);
    }

    readonly void Offer(in Shape shape, in Vector3Wide candidate, Vector<int> exists, ref Best best)
    {
        if (Wide.Bits(exists) == 0)
            return;
        var depth = DepthAlong(shape, candidate, exists);
        var isLess = exists & Vector.LessThan(depth, best.Depth);
        best.Direction = Vector3Wide.Select(isLess, candidate, best.Direction);
        best.Depth = Wide.Select(isLess, depth, best.Depth);
    }

    // By how much the two are in each other along a direction out of the triangle.
    [MethodImpl(MethodImplOptions.NoInlining)]
    readonly Vector<float> DepthAlong(in Shape shape, in Vector3Wide along, Vector<int> asked)
    {
        var reach = Wide.Max(
            Vector3Wide.Dot(shape.AB.Corner, along), Wide.Max(Vector3Wide.Dot(shape.BC.Corner, along), Vector3Wide.Dot(shape.CA.Corner, along)));
        return Vector3Wide.Dot(center, along) + reach + OtherAlong(shape, -along, asked);
    }

    // How far the other shape reaches along a direction from its centre, m.
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    readonly Vector<float> OtherAlong(in Shape shape, in Vector3Wide along, Vector<int> asked)
    {
        var reach = Vector.Abs(Vector3Wide.Dot(shape.Y, along)) * half.Y;
        if (Has(Box.Id))
        {
            reach = Vector.Abs(Vector3Wide.Dot(shape.X, along)) * half.X + reach;
            reach += Vector.Abs(Vector3Wide.Dot(shape.Z, along)) * half.Z;
        }
        if (Has(Cylinder.Id))
            reach += Vector3Wide.Cross(shape.Y, along).Length() * discRadius;
        reach += radius;
        if (Has(Triangle.Id))
            reach = Wide.Select(Vector.Equals(otherType, new Vector<int>(Triangle.Id)), CornersAlong(shape, along), reach);
        if (Has(ConvexHull.Id))
            MeasureHulls(along, Wide.Bits(asked), ref reach);
        return reach;
    }

    [MethodImpl(MethodImplOptions.NoInlining)]
    static Vector<float> CornersAlong(in Shape shape, in Vector3Wide along) => Wide.Max(
        Vector3Wide.Dot(shape.X, along), Wide.Max(Vector3Wide.Dot(shape.Y, along), Vector3Wide.Dot(shape.Z, along)));

    readonly bool Has(int type) => (types & 1 << type) != 0;

    [MethodImpl(MethodImplOptions.NoInlining)]
    readonly void MeasureHulls(Vector3Wide along, uint asked, ref Vector<float> reach)
    {
        var local = QuaternionWide.Conjugate(otherOrientation) * along;
        for (var lanes = asked & (uint)((1ul << count) - 1); lanes != 0; lanes &= lanes - 1)
        {
            var lane = BitOperations.TrailingZeroCount(lanes);
            if (hulls[lane] != 0)
                GatherScatter.Get(ref reach, lane) = ShapeReach.Along((HullHeader*)hulls[lane], Lanes.Read<Vector3, Vector3Wide>(ref local, lane));
        }
    }
}
