using System.Numerics;
using System.Runtime.CompilerServices;
using BepuUtilities;

namespace BepuPhysics.Constraints;

/// <summary>An axis that is fixed to A, and where along it a point of B is.</summary>
// distance = n (pB - pA), n the axis, pA and pB the points in the world. n turns with A, so that A's arm ends where B's point is:
//   distance' = n (vB + wB x rB - vA - wA x rA) + (wA x n) (pB - pA) = n (vB - vA) + (rB x n) wB - ((pB - xA) x n) wA
struct AxisThroughPoints
{
    /// <summary>The axis in the world.</summary>
    internal Vector3Wide Direction;
    /// <summary>How far B's point is from A's along the axis, m.</summary>
    internal Vector<float> Distance;
    readonly Vector3Wide offsetA, offsetB;

    /// <summary>The axis for points and a direction in the bodies' frames.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    internal AxisThroughPoints(in TwoBodies bodies, in Vector3Wide localOffsetA, in Vector3Wide localOffsetB, in Vector3Wide localAxisA)
    {
        offsetB = bodies.B.Orientation * localOffsetB;
        // The positions are subtracted first: far from the origin their difference is still exact.
        offsetA = (bodies.B.Position - bodies.A.Position) + offsetB;
        Direction = bodies.A.Orientation * localAxisA;
        Distance = Vector3Wide.Dot(Direction, offsetA - bodies.A.Orientation * localOffsetA);
    }

    /// <summary>A row whose velocity is what the distance loses.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    internal readonly void RowTo(out LinearRow row)
    {
        row.Direction = Direction;
        row.AngularA = Vector3Wide.Cross(offsetA, Direction);
        row.AngularB = Vector3Wide.Cross(offsetB, Direction);
        row.Distance = Distance;
    }
}
