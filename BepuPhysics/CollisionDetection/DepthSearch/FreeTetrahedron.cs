using System.Numerics;
using System.Runtime.CompilerServices;
using BepuUtilities;

namespace BepuPhysics.CollisionDetection;

/// <summary>A lower bound of the depth that costs no support point, for all lanes at once.</summary>
/// <remarks>
/// The depth in any direction is at least the radius of a ball about the origin that lies in the Minkowski difference, and so in the
/// tetrahedron of any four of its points. Three are the simplex that the descent ended with. The fourth is known as well: the difference
/// contains a ball about the offset of the centres, as large as the balls inside of both shapes together.
/// </remarks>
static class FreeTetrahedron
{
    /// <summary>Lanes in which no direction can be less deep than a bound; zero or more.</summary>
    [MethodImpl(MethodImplOptions.NoInlining)]
    public static Vector<int> Certifies(in SearchDescent descent, in SearchFrame frame, Vector<float> bound)
    {
        var a = descent.Simplex.A.Point;
        var b = descent.Simplex.B.Point;
        var c = descent.Simplex.C.Point;
        var apex = frame.Center - descent.Direction * frame.Inner;
        return IsBeyond(a, b, c, apex, bound) & IsBeyond(a, b, apex, c, bound) & IsBeyond(b, c, apex, a, bound) &
            IsBeyond(c, a, apex, b, bound);
    }

    /// <summary>Whether the plane of a side is at least at a distance from the origin, which is on its inner side.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static Vector<int> IsBeyond(in Vector3Wide a, in Vector3Wide b, in Vector3Wide c, in Vector3Wide opposite, Vector<float> bound)
    {
        var e1 = b - a;
        var e2 = c - a;
        var normal = Vector3Wide.Cross(e1, e2);
        var squared = normal.LengthSquared();
        var offset = Vector3Wide.Dot(normal, a);
        var outward = Vector3Wide.Dot(normal, a - opposite);
        var scaledOffset = Wide.Select(Vector.LessThan(outward, Vector<float>.Zero), -offset, offset);
        return Vector.GreaterThan(squared, e1.LengthSquared() * e2.LengthSquared() * new Vector<float>(SearchTolerances.SquaredSineOfPlane)) &
            Vector.GreaterThanOrEqual(scaledOffset, bound * Vector.SquareRoot(squared));
    }
}
