using System.Numerics;
using System.Runtime.CompilerServices;
using BepuPhysics.Collidables;
using BepuUtilities;

namespace BepuPhysics.CollisionDetection;

/// <summary>The least depth of a box and a triangle: what is known of it, and the search for it. Everything is in the box's frame.</summary>
// Overlapping, the axes that count are the normals of box and triangle and the nine cross products of their edges (Gottschalk et al., as for
// boxes). In the box's frame the product m of its axis e_i and an edge r has a zero; along it the edge is a point, the corner opposite to it
// is component i of r x (from the edge to the corner) away, and the middle between the two lies at that of r x middle: computed from the very
// numbers that m consists of, so m may be as short as rounding allows. Axes are compared by |depth| depth / m.m, which needs no root.
// Apart, the nearest points may be on an edge and a corner, too, or on two corners. The distance of each of the triangle's edges from the box
// covers that.
struct BoxTriangleAxes
{
    // Depth up to which the nearest points are looked for, by the smaller shape.
    const float ShallowTolerance = 1e-4f;

    /// <summary>The triangle.</summary>
    public PlacedTriangleWide Triangle;
    /// <summary>Unit normal from the triangle to the box.</summary>
    public Vector3Wide Normal;
    /// <summary>Depth along the normal, negative where the shapes are apart.</summary>
    public Vector<float> Depth;
    /// <summary>A point of the box's surface that is as deep.</summary>
    public Vector3Wide PointOnBox;

    /// <summary>Length of the smaller shape.</summary>
    Vector<float> size;
    EdgeSearch edges;
    NearestSearch nearest;

    /// <summary>Lanes where the nearest points could show more.</summary>
    public readonly Vector<int> MayBeApart
    {
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        get => Vector.LessThan(Depth, size * new Vector<float>(ShallowTolerance));
    }

    /// <summary>Finds the axis of least depth.</summary>
    /// <param name="box">Boxes.</param>
    [MethodImpl(MethodImplOptions.NoInlining)]
    public void FindLeastDepth(in BoxWide box)
    {
        edges.Score = new Vector<float>(float.MaxValue);
        edges.BoxAxis = Vector<int>.Zero;
        edges.Start = Triangle.A;
        edges.Edge = Triangle.AB;
        edges.Middle = Vector<float>.Zero;
        edges.Test(box, Triangle.A, Triangle.AB, -Triangle.CA);
        edges.Test(box, Triangle.B, Triangle.BC, -Triangle.AB);
        edges.Test(box, Triangle.C, Triangle.CA, -Triangle.BC);
        size = Wide.Min(box.HalfWidth + box.HalfHeight + box.HalfLength, Triangle.GetSize());
        Choose(box);
    }

    [MethodImpl(MethodImplOptions.NoInlining)]
    void Choose(in BoxWide box)
    {
        var zero = Vector<float>.Zero;
        var one = Vector<float>.One;
        // The box's faces. Depth and twice the middle of the triangle along the best one.
        var least = Vector3Wide.Min(Vector3Wide.Min(Triangle.A, Triangle.B), Triangle.C);
        var greatest = Vector3Wide.Max(Vector3Wide.Max(Triangle.A, Triangle.B), Triangle.C);
        var depth = box.HalfWidth + Wide.Min(greatest.X, -least.X);
        var middle = greatest.X + least.X;
        var depthY = box.HalfHeight + Wide.Min(greatest.Y, -least.Y);
        var useY = Vector.LessThan(depthY, depth);
        depth = Wide.Select(useY, depthY, depth);
        middle = Wide.Select(useY, greatest.Y + least.Y, middle);
        var depthZ = box.HalfLength + Wide.Min(greatest.Z, -least.Z);
        var useZ = Vector.LessThan(depthZ, depth);
        depth = Wide.Select(useZ, depthZ, depth);
        middle = Wide.Select(useZ, greatest.Z + least.Z, middle);
        useY = Vector.AndNot(useY, useZ);
        var sign = Wide.Select(Vector.GreaterThan(middle, zero), -one, one);
        var normal = new Vector3Wide(Wide.Mask(~(useY | useZ), sign), Wide.Mask(useY, sign), Wide.Mask(useZ, sign));

        // The triangle's. A box that is as deep from either side leaves by the front.
        Triangle.Project(Triangle.Front, out var lowest, out var highest);
        var front = Vector3Wide.Abs(Triangle.Front);
        var depthFront = box.HalfWidth * front.X + box.HalfHeight * front.Y + box.HalfLength * front.Z + Wide.Min(highest, -lowest);
        var useFront = Vector.LessThan(depthFront, depth) & Vector.GreaterThan(front.X + front.Y + front.Z, new Vector<float>(0.5f));
        depth = Wide.Select(useFront, depthFront, depth);
        var faceNormal = Vector3Wide.Select(Vector.LessThanOrEqual(highest, -lowest), Triangle.Front, -Triangle.Front);
        normal = Vector3Wide.Select(useFront, faceNormal, normal);

        // Edges.
        var edgeDepth = Wide.CopySign(Vector.SquareRoot(Vector.Abs(edges.Score)), edges.Score);
        var useEdge = Vector.LessThan(edgeDepth + size * new Vector<float>(PairTolerances.EdgeAdvantage), depth);
        depth = Wide.Select(useEdge, edgeDepth, depth);
        normal = Vector3Wide.Select(useEdge, edges.GetNormal(), normal);
        Normal = normal;
        Depth = depth;

        // On the triangle's face the deepest is a corner of the box, else it is something of the triangle's.
        var corner = new Vector3Wide(-Wide.CopySign(box.HalfWidth, normal.X), -Wide.CopySign(box.HalfHeight, normal.Y),
            -Wide.CopySign(box.HalfLength, normal.Z));
        var way = normal * depth;
        var onTriangle = Vector3Wide.Select(useEdge, edges.GetPlace(corner + way), Triangle.GetSupport(normal));
        PointOnBox = Vector3Wide.Select(Vector.AndNot(useFront, useEdge), corner, onTriangle - way);
    }

    /// <summary>The best of the axes across edges so far.</summary>
    struct EdgeSearch
    {
        /// <summary>Depth times its magnitude.</summary>
        public Vector<float> Score;
        /// <summary>0, 1 or 2: the box's axis.</summary>
        public Vector<int> BoxAxis;
        /// <summary>The triangle's edge and where it starts.</summary>
        public Vector3Wide Start, Edge;
        /// <summary>Where the middle of the triangle is along the axis.</summary>
        public Vector<float> Middle;

        /// <summary>Tests one of the triangle's edges with all of the box's axes.</summary>
        /// <param name="box">Boxes.</param>
        /// <param name="start">Start of the edge.</param>
        /// <param name="edge">From there to its end.</param>
        /// <param name="toOpposite">From the start to the opposite corner.</param>
        [MethodImpl(MethodImplOptions.NoInlining)]
        public void Test(in BoxWide box, in Vector3Wide start, in Vector3Wide edge, in Vector3Wide toOpposite)
        {
            var half = toOpposite * new Vector<float>(0.5f);
            var middle = Vector3Wide.Cross(edge, start + half);
            var extent = Vector3Wide.Abs(Vector3Wide.Cross(edge, half)) - Vector3Wide.Abs(middle);
            var absolute = Vector3Wide.Abs(edge);
            var squares = edge * edge;
            var floor = (squares.X + squares.Y + squares.Z) * new Vector<float>(PairTolerances.ParallelBoxEdge);
            var score = Rate(box.HalfHeight * absolute.Z + box.HalfLength * absolute.Y + extent.X, squares.Y + squares.Z, floor);
            var scoreY = Rate(box.HalfLength * absolute.X + box.HalfWidth * absolute.Z + extent.Y, squares.Z + squares.X, floor);
            var scoreZ = Rate(box.HalfWidth * absolute.Y + box.HalfHeight * absolute.X + extent.Z, squares.X + squares.Y, floor);
            var useY = Vector.LessThan(scoreY, score);
            score = Wide.Select(useY, scoreY, score);
            var along = Wide.Select(useY, middle.Y, middle.X);
            var boxAxis = useY & Vector<int>.One;
            var useZ = Vector.LessThan(scoreZ, score);
            score = Wide.Select(useZ, scoreZ, score);
            along = Wide.Select(useZ, middle.Z, along);
            boxAxis = Wide.Select(useZ, new Vector<int>(2), boxAxis);
            var better = Vector.LessThan(score, Score);
            Score = Wide.Select(better, score, Score);
            BoxAxis = Wide.Select(better, boxAxis, BoxAxis);
            Middle = Wide.Select(better, along, Middle);
            Start = Vector3Wide.Select(better, start, Start);
            Edge = Vector3Wide.Select(better, edge, Edge);
        }

        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        static Vector<float> Rate(Vector<float> scaledDepth, Vector<float> squaredLength, Vector<float> floor) => Wide.Select(
            Vector.GreaterThan(squaredLength, floor), scaledDepth * Vector.Abs(scaledDepth) / squaredLength, new Vector<float>(float.MaxValue));

        /// <summary>Unit cross product of the two edges, towards the box.</summary>
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        public readonly Vector3Wide GetNormal()
        {
            var useX = Vector.Equals(BoxAxis, Vector<int>.Zero);
            var useY = Vector.Equals(BoxAxis, Vector<int>.One);
            var zero = Vector<float>.Zero;
            var edge = Vector3Wide.Select(Vector.GreaterThan(Middle, zero), -Edge, Edge);
            return Vector3Wide.Normalize(new(
                Wide.Select(useX, zero, Wide.Select(useY, edge.Z, -edge.Y)),
                Wide.Select(useX, -edge.Z, Wide.Select(useY, zero, edge.X)),
                Wide.Select(useX, edge.Y, Wide.Select(useY, -edge.X, zero))));
        }

        /// <summary>Where the triangle's edge passes the box's.</summary>
        /// <param name="target">A point of the box's edge, moved by the depth.</param>
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        public readonly Vector3Wide GetPlace(in Vector3Wide target)
        {
            var useX = Vector.Equals(BoxAxis, Vector<int>.Zero);
            var useY = Vector.Equals(BoxAxis, Vector<int>.One);
            var zero = Vector<float>.Zero;
            // Across the box's edge.
            var across = new Vector3Wide(
                Wide.Select(useX, zero, Edge.X), Wide.Select(useY, zero, Edge.Y), Wide.Mask(useX | useY, Edge.Z));
            var place = Wide.DivideOrZero(Vector3Wide.Dot(across, target - Start), across.LengthSquared());
            return Start + Edge * Wide.Clamp(place, zero, Vector<float>.One);
        }
    }

    /// <summary>Replaces the axis where the nearest points show that the shapes are farther apart.</summary>
    /// <param name="box">Boxes.</param>
    /// <param name="mask">All bits set where that is wanted.</param>
    [MethodImpl(MethodImplOptions.NoInlining)]
    public void FindNearest(in BoxWide box, Vector<int> mask)
    {
        nearest.SquaredDistance = new Vector<float>(float.MaxValue);
        nearest.Offset = nearest.PointOnBox = Vector3Wide.Zero;
        nearest.Visit(box, Triangle.A, Triangle.AB);
        nearest.Visit(box, Triangle.B, Triangle.BC);
        nearest.Visit(box, Triangle.C, Triangle.CA);
        // No axis shows more than the distance, and this one shows less unless the points are the nearest.
        var axis = Vector3Wide.Normalize(nearest.Offset);
        Triangle.Project(axis, out _, out var greatest);
        var absolute = Vector3Wide.Abs(axis);
        var depth = greatest + box.HalfWidth * absolute.X + box.HalfHeight * absolute.Y + box.HalfLength * absolute.Z;
        var better = mask & Vector.LessThan(depth, Depth - size * new Vector<float>(PairTolerances.NearestAdvantage)) &
            Vector.GreaterThan(absolute.X + absolute.Y + absolute.Z, new Vector<float>(0.5f));
        Depth = Wide.Select(better, depth, Depth);
        Normal = Vector3Wide.Select(better, axis, Normal);
        // Touching at corners, many axes show the same, but not the place.
        var isTouching = mask & Vector.LessThan(Vector.SquareRoot(nearest.SquaredDistance),
            Vector.Abs(Depth) + size * new Vector<float>(PairTolerances.SamePoints));
        PointOnBox = Vector3Wide.Select(better | isTouching, nearest.PointOnBox, PointOnBox);
    }

    /// <summary>The nearest points of the box and the edges so far.</summary>
    struct NearestSearch
    {
        public Vector<float> SquaredDistance;
        /// <summary>From the edge to the box, and there.</summary>
        public Vector3Wide Offset, PointOnBox;

        /// <summary>Finds the nearest points of the box and an edge.</summary>
        [MethodImpl(MethodImplOptions.NoInlining)]
        public void Visit(in BoxWide box, in Vector3Wide start, in Vector3Wide edge)
        {
            var extents = new Vector3Wide(box.HalfWidth, box.HalfHeight, box.HalfLength);
            BoxLine.FindNearest(start, edge, extents, Vector<float>.Zero, Vector<float>.One, out var place);
            var point = start + edge * place;
            var onBox = Clamp(extents, point);
            var offset = onBox - point;
            // From an inner point of the edge the way is across it. What is left along it is rounding, which a long edge multiplies.
            var isInner = Vector.GreaterThan(place, Vector<float>.Zero) & Vector.LessThan(place, Vector<float>.One);
            offset -= edge * Wide.Mask(isInner, Wide.DivideOrZero(Vector3Wide.Dot(offset, edge), edge.LengthSquared()));
            var squared = offset.LengthSquared();
            var nearer = Vector.LessThan(squared, SquaredDistance);
            SquaredDistance = Wide.Select(nearer, squared, SquaredDistance);
            Offset = Vector3Wide.Select(nearer, offset, Offset);
            PointOnBox = Vector3Wide.Select(nearer, onBox, PointOnBox);
        }

        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        static Vector3Wide Clamp(in Vector3Wide extents, in Vector3Wide point) =>
            Vector3Wide.Max(Vector3Wide.Min(point, extents), -extents);
    }
}
