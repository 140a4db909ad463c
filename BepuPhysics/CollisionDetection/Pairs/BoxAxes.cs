using System.Numerics;
using System.Runtime.CompilerServices;
using BepuPhysics.Collidables;
using BepuUtilities;

namespace BepuPhysics.CollisionDetection;

/// <summary>Finds the separating axis of least depth of two boxes.</summary>
// S. Gottschalk, M. Lin, D. Manocha, OBBTree (SIGGRAPH 1996): of two boxes, the axes that count are the three normals of each and the nine
// cross products of their edges. In A's frame the cross product m of A's axis e and B's axis r has a zero, A's extent along it is two
// products, and B's extent is h' |r x r'| + h'' |r x r''|, component e: computed from the very numbers that m consists of, so that m may be
// as short as rounding allows. An identity would give |r''| for |r x r'|; it holds to rounding only, which a short m multiplies.
// Axes are compared by depth |depth| m.m / m.m, which needs no root: nine roots become one.
static class BoxAxes
{
    /// <summary>Finds the axis of least depth.</summary>
    /// <param name="a">First boxes.</param>
    /// <param name="b">Second boxes.</param>
    /// <param name="axesB">B's axes in A's frame.</param>
    /// <param name="offsetB">B's centre in A's frame.</param>
    /// <param name="depth">Depth along the axis, negative where it separates the boxes.</param>
    /// <param name="normal">Unit axis in A's frame, from B to A.</param>
    [MethodImpl(MethodImplOptions.NoInlining)]
    public static void FindLeastDepth(in BoxWide a, in BoxWide b, in Matrix3x3Wide axesB, in Vector3Wide offsetB,
        out Vector<float> depth, out Vector3Wide normal)
    {
        // |r x r'| for the three pairs of B's axes.
        var xy = Vector3Wide.Abs(Vector3Wide.Cross(axesB.X, axesB.Y));
        var yz = Vector3Wide.Abs(Vector3Wide.Cross(axesB.Y, axesB.Z));
        var zx = Vector3Wide.Abs(Vector3Wide.Cross(axesB.Z, axesB.X));
        EdgeSearch edges;
        edges.Score = new Vector<float>(float.MaxValue);
        edges.AxisA = Vector<int>.Zero;
        edges.AxisB = axesB.X;
        edges.Test(a, axesB.X, offsetB, xy * b.HalfHeight + zx * b.HalfLength);
        edges.Test(a, axesB.Y, offsetB, yz * b.HalfLength + xy * b.HalfWidth);
        edges.Test(a, axesB.Z, offsetB, zx * b.HalfWidth + yz * b.HalfHeight);
        FindLeastFaceDepth(a, b, axesB, offsetB, out depth, out normal);

        var edgeNormal = edges.Normal();
        var edgeDepth = Wide.CopySign(Vector.SquareRoot(Vector.Abs(edges.Score)), edges.Score);
        var size = Wide.Min(a.HalfWidth + a.HalfHeight + a.HalfLength, b.HalfWidth + b.HalfHeight + b.HalfLength);
        var useEdge = Vector.LessThan(edgeDepth + size * new Vector<float>(PairTolerances.EdgeAdvantage), depth);
        depth = Wide.Select(useEdge, edgeDepth, depth);
        normal = Vector3Wide.Select(useEdge, edgeNormal, normal);
        normal = Vector3Wide.Select(Vector.GreaterThan(Vector3Wide.Dot(normal, offsetB), Vector<float>.Zero), -normal, normal);
    }

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static void FindLeastFaceDepth(in BoxWide a, in BoxWide b, in Matrix3x3Wide axesB, in Vector3Wide offsetB,
        out Vector<float> depth, out Vector3Wide normal)
    {
        var x = Vector3Wide.Abs(axesB.X);
        var y = Vector3Wide.Abs(axesB.Y);
        var z = Vector3Wide.Abs(axesB.Z);
        var one = Vector<float>.One;
        var depthY = a.HalfHeight + b.HalfWidth * x.Y + b.HalfHeight * y.Y + b.HalfLength * z.Y - Vector.Abs(offsetB.Y);
        var depthZ = a.HalfLength + b.HalfWidth * x.Z + b.HalfHeight * y.Z + b.HalfLength * z.Z - Vector.Abs(offsetB.Z);
        depth = a.HalfWidth + b.HalfWidth * x.X + b.HalfHeight * y.X + b.HalfLength * z.X - Vector.Abs(offsetB.X);
        var useY = Vector.LessThan(depthY, depth);
        depth = Wide.Select(useY, depthY, depth);
        var useZ = Vector.LessThan(depthZ, depth);
        depth = Wide.Select(useZ, depthZ, depth);
        useY = Vector.AndNot(useY, useZ);
        normal = new(Wide.Mask(~(useY | useZ), one), Wide.Mask(useY, one), Wide.Mask(useZ, one));
        TryFaceOfB(b.HalfWidth, a, axesB.X, x, offsetB, ref depth, ref normal);
        TryFaceOfB(b.HalfHeight, a, axesB.Y, y, offsetB, ref depth, ref normal);
        TryFaceOfB(b.HalfLength, a, axesB.Z, z, offsetB, ref depth, ref normal);
    }

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static void TryFaceOfB(Vector<float> halfExtent, in BoxWide a, in Vector3Wide axis, in Vector3Wide absolute, in Vector3Wide offsetB,
        ref Vector<float> depth, ref Vector3Wide normal)
    {
        var faceDepth = halfExtent + a.HalfWidth * absolute.X + a.HalfHeight * absolute.Y + a.HalfLength * absolute.Z -
            Vector.Abs(Vector3Wide.Dot(axis, offsetB));
        var better = Vector.LessThan(faceDepth, depth);
        depth = Wide.Select(better, faceDepth, depth);
        normal = Vector3Wide.Select(better, axis, normal);
    }

    /// <summary>The best of the edge axes so far.</summary>
    struct EdgeSearch
    {
        /// <summary>Depth times its magnitude.</summary>
        public Vector<float> Score;
        /// <summary>0, 1 or 2: A's axis.</summary>
        public Vector<int> AxisA;
        /// <summary>B's axis in A's frame.</summary>
        public Vector3Wide AxisB;

        /// <summary>Tests one of B's axes with all of A's.</summary>
        /// <param name="a">First boxes.</param>
        /// <param name="axis">B's axis r in A's frame.</param>
        /// <param name="offsetB">B's centre in A's frame.</param>
        /// <param name="extentB">B's extent along each e x r.</param>
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        public void Test(in BoxWide a, in Vector3Wide axis, in Vector3Wide offsetB, in Vector3Wide extentB)
        {
            var distance = Vector3Wide.Abs(Vector3Wide.Cross(axis, offsetB));
            var absolute = Vector3Wide.Abs(axis);
            var squares = axis * axis;
            var score = Rate(a.HalfHeight * absolute.Z + a.HalfLength * absolute.Y + extentB.X - distance.X, squares.Y + squares.Z);
            var scoreY = Rate(a.HalfLength * absolute.X + a.HalfWidth * absolute.Z + extentB.Y - distance.Y, squares.Z + squares.X);
            var scoreZ = Rate(a.HalfWidth * absolute.Y + a.HalfHeight * absolute.X + extentB.Z - distance.Z, squares.X + squares.Y);
            var useY = Vector.LessThan(scoreY, score);
            score = Wide.Select(useY, scoreY, score);
            var axisA = useY & Vector<int>.One;
            var useZ = Vector.LessThan(scoreZ, score);
            score = Wide.Select(useZ, scoreZ, score);
            axisA = Wide.Select(useZ, new Vector<int>(2), axisA);
            var better = Vector.LessThan(score, Score);
            Score = Wide.Select(better, score, Score);
            AxisA = Wide.Select(better, axisA, AxisA);
            AxisB = Vector3Wide.Select(better, axis, AxisB);
        }

        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        static Vector<float> Rate(Vector<float> scaledDepth, Vector<float> sineSquared) => Wide.Select(
            Vector.GreaterThan(sineSquared, new Vector<float>(PairTolerances.ParallelBoxEdge)),
            scaledDepth * Vector.Abs(scaledDepth) / sineSquared,
            new Vector<float>(float.MaxValue));

        /// <summary>Unit cross product of the two axes.</summary>
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        public readonly Vector3Wide Normal()
        {
            var useX = Vector.Equals(AxisA, Vector<int>.Zero);
            var useY = Vector.Equals(AxisA, Vector<int>.One);
            var zero = Vector<float>.Zero;
            var cross = new Vector3Wide(
                Wide.Select(useX, zero, Wide.Select(useY, AxisB.Z, -AxisB.Y)),
                Wide.Select(useX, -AxisB.Z, Wide.Select(useY, zero, AxisB.X)),
                Wide.Select(useX, AxisB.Y, Wide.Select(useY, -AxisB.X, zero)));
            return Vector3Wide.Normalize(cross);
        }
    }
}
