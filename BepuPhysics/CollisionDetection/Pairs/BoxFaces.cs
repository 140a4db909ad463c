using System.Numerics;
using System.Runtime.CompilerServices;
using BepuPhysics.Collidables;
using BepuUtilities;

namespace BepuPhysics.CollisionDetection;

/// <summary>The faces of two boxes that look at each other, seen along the normal.</summary>
// Projected along the normal onto the plane of A's face, A's face is a rectangle |x| <= HalfX, |y| <= HalfY around the origin, and B's
// is a parallelogram Center + s EdgeS + t EdgeT with s and t from -1 to 1. Depth along the normal is linear in s and t. Both faces look
// along the normal at 55 degrees or less, so neither projection degenerates.
struct BoxFaces
{
    // Part of the smaller face by which a point beside a face still counts as over it. Edges that coincide, as those of boxes of one
    // size in a stack do, would otherwise be inside or outside by rounding, and contacts would come and go.
    const float BorderTolerance = 1e-5f;

    /// <summary>A's axes in the world.</summary>
    public Matrix3x3Wide AxesA;
    /// <summary>B's axes in A's frame.</summary>
    public Matrix3x3Wide AxesB;
    /// <summary>B's centre in A's frame.</summary>
    public Vector3Wide OffsetB;
    /// <summary>Unit normal in A's frame, from B to A.</summary>
    public Vector3Wide Normal;
    /// <summary>Depth along the normal.</summary>
    public Vector<float> PairDepth;

    /// <summary>A's axis that its face looks along.</summary>
    public Vector<int> FaceIsX, FaceIsY;
    /// <summary>Height of A's face along that axis, signed.</summary>
    public Vector<float> FaceHeight;
    /// <summary>Half extents of A's face.</summary>
    public Vector<float> HalfX, HalfY;
    /// <summary>Middle of B's face.</summary>
    public Vector<float> CenterX, CenterY, CenterDepth;
    /// <summary>From the middle of B's face to the middle of its side s = 1.</summary>
    public Vector<float> EdgeSX, EdgeSY, EdgeSDepth;
    /// <summary>From the middle of B's face to the middle of its side t = 1.</summary>
    public Vector<float> EdgeTX, EdgeTY, EdgeTDepth;
    /// <summary>Length by which a point beside a face still counts as over it.</summary>
    public Vector<float> Border;
    /// <summary>Half extents of B's face.</summary>
    public Vector<float> HalfS, HalfT;
    /// <summary>Bits of a feature id that name the two faces.</summary>
    public Vector<int> FaceFeature;

    /// <summary>A's axes in the order that makes the axis of its face the last.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static Vector3Wide Turn(Vector<int> useX, Vector<int> useY, in Vector3Wide v) => new(
        Wide.Select(useX, v.Y, Wide.Select(useY, v.Z, v.X)),
        Wide.Select(useX, v.Z, Wide.Select(useY, v.X, v.Y)),
        Wide.Select(useX, v.X, Wide.Select(useY, v.Y, v.Z)));

    /// <summary>Chooses the faces and projects them.</summary>
    [MethodImpl(MethodImplOptions.NoInlining)]
    public void Project(in BoxWide a, in BoxWide b)
    {
        // B's face and its two edges, in A's frame.
        var along = AxesB * Normal;
        var absolute = Vector3Wide.Abs(along);
        var useX = Vector.GreaterThanOrEqual(absolute.X, absolute.Y) & Vector.GreaterThanOrEqual(absolute.X, absolute.Z);
        var useY = Vector.AndNot(Vector.GreaterThanOrEqual(absolute.Y, absolute.Z), useX);
        var extents = Turn(useX, useY, new(b.HalfWidth, b.HalfHeight, b.HalfLength));
        var alongFace = Wide.Select(useX, along.X, Wide.Select(useY, along.Y, along.Z));
        var faceAxis = Vector3Wide.Select(useX, AxesB.X, Vector3Wide.Select(useY, AxesB.Y, AxesB.Z));
        var center = OffsetB + faceAxis * Wide.CopySign(extents.Z, alongFace);
        var edgeS = Vector3Wide.Select(useX, AxesB.Y, Vector3Wide.Select(useY, AxesB.Z, AxesB.X)) * extents.X;
        var edgeT = Vector3Wide.Select(useX, AxesB.Z, Vector3Wide.Select(useY, AxesB.X, AxesB.Y)) * extents.Y;
        HalfS = extents.X;
        HalfT = extents.Y;
        FaceFeature = FeatureOf(useX, useY, alongFace) << 4;

        // A's face, which looks against the normal.
        absolute = Vector3Wide.Abs(Normal);
        useX = Vector.GreaterThanOrEqual(absolute.X, absolute.Y) & Vector.GreaterThanOrEqual(absolute.X, absolute.Z);
        useY = Vector.AndNot(Vector.GreaterThanOrEqual(absolute.Y, absolute.Z), useX);
        FaceIsX = useX;
        FaceIsY = useY;
        extents = Turn(useX, useY, new(a.HalfWidth, a.HalfHeight, a.HalfLength));
        var normal = Turn(useX, useY, Normal);
        HalfX = extents.X;
        HalfY = extents.Y;
        FaceHeight = Wide.CopySign(extents.Z, -normal.Z);
        FaceFeature |= FeatureOf(useX, useY, normal.Z) << 7;
        Border = Wide.Min(HalfX + HalfY, HalfS + HalfT) * new Vector<float>(BorderTolerance);

        var inverse = Vector<float>.One / normal.Z;
        center = Turn(useX, useY, center);
        CenterDepth = (center.Z - FaceHeight) * inverse;
        CenterX = center.X - normal.X * CenterDepth;
        CenterY = center.Y - normal.Y * CenterDepth;
        edgeS = Turn(useX, useY, edgeS);
        EdgeSDepth = edgeS.Z * inverse;
        EdgeSX = edgeS.X - normal.X * EdgeSDepth;
        EdgeSY = edgeS.Y - normal.Y * EdgeSDepth;
        edgeT = Turn(useX, useY, edgeT);
        EdgeTDepth = edgeT.Z * inverse;
        EdgeTX = edgeT.X - normal.X * EdgeTDepth;
        EdgeTY = edgeT.Y - normal.Y * EdgeTDepth;
    }

    /// <summary>0 to 5: an axis and the side of the face on it.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static Vector<int> FeatureOf(Vector<int> useX, Vector<int> useY, Vector<float> side) =>
        Wide.Select(useX, Vector<int>.Zero, Wide.Select(useY, new Vector<int>(2), new Vector<int>(4))) |
        (Vector.LessThan(side, Vector<float>.Zero) & Vector<int>.One);

    /// <summary>Finds the corners of the overlap of the two faces, twelve at most, of which eight at most exist.</summary>
    // Around B's face: of each side, the part that is over A's face. Its start is a corner of the overlap, and its end is one where it was
    // cut off; where it was not, it is the start of the next side. Then A's corners that are under B's face; those near its border
    // may be corners of B's, or cuts, as well.
    [MethodImpl(MethodImplOptions.NoInlining)]
    public readonly void FindCandidates(ref ContactCandidates candidates)
    {
        var one = Vector<float>.One;
        AddSides(ref candidates, 0, 4, CenterX, CenterY, CenterDepth, EdgeSX, EdgeSY, EdgeSDepth, EdgeTX, EdgeTY, EdgeTDepth);
        AddSides(ref candidates, 2, 6, CenterX, CenterY, CenterDepth, EdgeTX, EdgeTY, EdgeTDepth, -EdgeSX, -EdgeSY, -EdgeSDepth);

        var inverse = one / (EdgeSX * EdgeTY - EdgeSY * EdgeTX);
        // A side that lies outside of A's face by more than the border is not over it, so a corner that is inside by as much has to be
        // found here; from half the border on it is, twice rather than not at all.
        var half = Border * new Vector<float>(0.5f);
        var limitS = (HalfS - half) / HalfS;
        var limitT = (HalfT - half) / HalfT;
        AddCorner(ref candidates, 8, -HalfX, -HalfY, inverse, limitS, limitT);
        AddCorner(ref candidates, 9, HalfX, -HalfY, inverse, limitS, limitT);
        AddCorner(ref candidates, 10, HalfX, HalfY, inverse, limitS, limitT);
        AddCorner(ref candidates, 11, -HalfX, HalfY, inverse, limitS, limitT);
    }

    /// <summary>Adds what is over A's face of the two sides of B's that are parallel to one of its edges.</summary>
    // Called for (S, T) with the sides t = -1 and t = 1, and turned by a quarter, for (T, -S), with s = 1 and s = -1. The second of two
    // opposite sides runs backwards, so that the four follow each other around the face.
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    readonly void AddSides(ref ContactCandidates candidates, int backIndex, int frontIndex,
        Vector<float> centerX, Vector<float> centerY, Vector<float> centerDepth,
        Vector<float> alongX, Vector<float> alongY, Vector<float> alongDepth,
        Vector<float> acrossX, Vector<float> acrossY, Vector<float> acrossDepth)
    {
        // A side that moves less than half the border's tolerance across a face's edge counts as parallel to it.
        var floor = Border * new Vector<float>(0.5f);
        var inverseX = Vector<float>.One / Wide.CopySign(Wide.Max(Vector.Abs(alongX), floor), alongX);
        var inverseY = Vector<float>.One / Wide.CopySign(Wide.Max(Vector.Abs(alongY), floor), alongY);
        var reachX = (HalfX + Border) * Vector.Abs(inverseX);
        var reachY = (HalfY + Border) * Vector.Abs(inverseY);
        AddSide(ref candidates, backIndex, centerX - acrossX, centerY - acrossY, centerDepth - acrossDepth,
            alongX, alongY, alongDepth, inverseX, inverseY, reachX, reachY);
        AddSide(ref candidates, frontIndex, centerX + acrossX, centerY + acrossY, centerDepth + acrossDepth,
            -alongX, -alongY, -alongDepth, -inverseX, -inverseY, reachX, reachY);
    }

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static void AddSide(ref ContactCandidates candidates, int index,
        Vector<float> middleX, Vector<float> middleY, Vector<float> middleDepth,
        Vector<float> alongX, Vector<float> alongY, Vector<float> alongDepth,
        Vector<float> inverseX, Vector<float> inverseY, Vector<float> reachX, Vector<float> reachY)
    {
        var one = Vector<float>.One;
        var crossingX = middleX * inverseX;
        var crossingY = middleY * inverseY;
        var start = Wide.Max(-one, Wide.Max(-crossingX - reachX, -crossingY - reachY));
        var end = Wide.Min(one, Wide.Min(reachX - crossingX, reachY - crossingY));
        var isOver = Vector.LessThanOrEqual(start, end);
        ref var first = ref candidates.At(index);
        first.X = middleX + alongX * start;
        first.Y = middleY + alongY * start;
        first.Depth = Wide.Select(isOver, middleDepth + alongDepth * start, new Vector<float>(IContactCandidate.None));
        ref var second = ref candidates.At(index + 1);
        second.X = middleX + alongX * end;
        second.Y = middleY + alongY * end;
        var isCutOff = isOver & Vector.LessThan(end, one);
        second.Depth = Wide.Select(isCutOff, middleDepth + alongDepth * end, new Vector<float>(IContactCandidate.None));
    }

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    readonly void AddCorner(ref ContactCandidates candidates, int index, Vector<float> x, Vector<float> y, Vector<float> inverse,
        Vector<float> limitS, Vector<float> limitT)
    {
        var fromCenterX = x - CenterX;
        var fromCenterY = y - CenterY;
        var s = (fromCenterX * EdgeTY - fromCenterY * EdgeTX) * inverse;
        var t = (EdgeSX * fromCenterY - EdgeSY * fromCenterX) * inverse;
        var isUnder = Vector.LessThan(Vector.Abs(s), limitS) & Vector.LessThan(Vector.Abs(t), limitT);
        ref var corner = ref candidates.At(index);
        corner.X = x;
        corner.Y = y;
        corner.Depth = Wide.Select(isUnder, CenterDepth + s * EdgeSDepth + t * EdgeTDepth, new Vector<float>(IContactCandidate.None));
    }

    /// <summary>A point of B's face that is near to A's, for faces that overlap by no more than rounding.</summary>
    [MethodImpl(MethodImplOptions.NoInlining)]
    public readonly void FindNearestPoint(out Vector<float> x, out Vector<float> y)
    {
        var one = Vector<float>.One;
        var fromCenterX = Wide.Clamp(CenterX, -HalfX, HalfX) - CenterX;
        var fromCenterY = Wide.Clamp(CenterY, -HalfY, HalfY) - CenterY;
        var inverse = one / (EdgeSX * EdgeTY - EdgeSY * EdgeTX);
        var s = Wide.Clamp((fromCenterX * EdgeTY - fromCenterY * EdgeTX) * inverse, -one, one);
        var t = Wide.Clamp((EdgeSX * fromCenterY - EdgeSY * fromCenterX) * inverse, -one, one);
        x = CenterX + s * EdgeSX + t * EdgeTX;
        y = CenterY + s * EdgeSY + t * EdgeTY;
    }
}
