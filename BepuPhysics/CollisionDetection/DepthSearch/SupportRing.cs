using System.Numerics;
using System.Runtime.CompilerServices;
using BepuUtilities;

namespace BepuPhysics.CollisionDetection;

struct SupportRing
{
    const float LeastSquaredSine = 1e-6f;
    const float GreatestTangent = 0.5f;

    public Vector3Wide Normal, TangentX, TangentY;
    public SearchVertex Vertex0, Vertex1, Vertex2, Vertex3;
    public Vector3Wide Top, Bottom;
    public Vector<int> Mask;
    Vector<float> bound, squaredBound, normalScale, tangentLength;

    [MethodImpl(MethodImplOptions.NoInlining)]
    public Vector<int> Start(in SearchWalk walk, in SearchFrame frame, Vector<int> mask)
    {
        var one = Vector<float>.One;
        Normal = walk.Direction;
        var sign = Wide.CopySign(one, Normal.Z);
        var inverse = -one / (sign + Normal.Z);
        var mixed = Normal.X * Normal.Y * inverse;
        var across = new Vector3Wide(mixed, sign + Normal.Y * Normal.Y * inverse, -Normal.Y);
        ref readonly var simplex = ref walk.Simplex;
        var edge = simplex.B.Point - simplex.A.Point;
        var squaredEdge = edge.LengthSquared();
        TakeLonger(simplex.C.Point - simplex.B.Point, ref edge, ref squaredEdge);
        TakeLonger(simplex.A.Point - simplex.C.Point, ref edge, ref squaredEdge);
        var along = edge - Normal * Vector3Wide.Dot(edge, Normal);
        var squaredAlong = along.LengthSquared();
        var hasEdge = Vector.GreaterThan(squaredAlong, squaredEdge * new Vector<float>(0.5f)) & Vector.GreaterThan(squaredEdge, new Vector<float>(1e-12f));
        TangentX = Vector3Wide.Select(hasEdge, along * (one / Vector.SquareRoot(squaredAlong)), across);
        var weights = walk.Simplex.GetWeights(walk.Target());
        Top = walk.Simplex.A.Point * weights.X + walk.Simplex.B.Point * weights.Y + walk.Simplex.C.Point * weights.Z;
        Bottom = frame.Center - Normal * frame.Inner;
        bound = walk.Depth - frame.CertificateSlack;
        squaredBound = bound * bound;
        var tangent = Wide.Min(Vector.SquareRoot(frame.CertificateSlack * new Vector<float>(2) / walk.Depth), new Vector<float>(GreatestTangent));
        normalScale = one / Vector.SquareRoot(one + tangent * tangent);
        TangentX *= tangent;
        tangentLength = tangent;
        return Mask = mask & Vector.LessThan(walk.Depth, frame.CertificateSlack * new Vector<float>(500));
    }

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public void Turn()
    {
        TangentY = Vector3Wide.Cross(Normal, Vertex0.Point - Vertex2.Point);
        var length = TangentY.Length();
        var has = Vector.GreaterThan(length, new Vector<float>(1e-6f));
        TangentY = Vector3Wide.Select(has, TangentY * (tangentLength / length), Vector3Wide.Cross(Normal, TangentX));
    }

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static void TakeLonger(in Vector3Wide other, ref Vector3Wide edge, ref Vector<float> squaredEdge)
    {
        var squaredOther = other.LengthSquared();
        var isLonger = Vector.GreaterThan(squaredOther, squaredEdge);
        edge = Vector3Wide.Select(isLonger, other, edge);
        squaredEdge = Wide.Select(isLonger, squaredOther, squaredEdge);
    }

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public readonly Vector3Wide Direction(in Vector3Wide tangent) => (Normal + tangent) * normalScale;

    [MethodImpl(MethodImplOptions.NoInlining)]
    public readonly Vector<int> HasTop() => HasTop(Vertex0.Point, Vertex1.Point) & HasTop(Vertex1.Point, Vertex2.Point) &
        HasTop(Vertex2.Point, Vertex3.Point) & HasTop(Vertex3.Point, Vertex0.Point);

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    readonly Vector<int> HasTop(in Vector3Wide from, in Vector3Wide to) => IsBeyond(Top, from, to) | AreEqual(from, to);

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public readonly Vector<int> IsBeyond(in Vector3Wide a, in Vector3Wide b, in Vector3Wide c)
    {
        var e1 = b - a;
        var e2 = c - a;
        var normal = Vector3Wide.Cross(e1, e2);
        var squared = normal.LengthSquared();
        var offset = Vector3Wide.Dot(normal, a);
        return Vector.GreaterThan(squared, e1.LengthSquared() * e2.LengthSquared() * new Vector<float>(LeastSquaredSine)) &
            Vector.GreaterThan(offset, Vector<float>.Zero) & Vector.GreaterThanOrEqual(offset * offset, squaredBound * squared);
    }

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Vector<int> AreEqual(in Vector3Wide a, in Vector3Wide b) =>
        Vector.Equals(a.X, b.X) & Vector.Equals(a.Y, b.Y) & Vector.Equals(a.Z, b.Z);
}
