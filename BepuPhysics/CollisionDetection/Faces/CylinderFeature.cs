using System.Numerics;
using System.Runtime.CompilerServices;
using BepuPhysics.Collidables;
using BepuUtilities;

namespace BepuPhysics.CollisionDetection;

/// <summary>A cylinder's end, as a disc with corners around its rim, or the line of its side that faces the direction.</summary>
// The corners are fixed to the cylinder, so that a contact keeps its corner while the cylinder rests. Where the contact of a tilted cylinder lies
// between two of them, the pair's own witness stands in for it.
public readonly struct CylinderFeature : IContactFeature<CylinderWide>
{
    /// <inheritdoc/>
    public static int MaximumVertexCount => FaceDisc.CornerCount;

    /// <inheritdoc/>
    public static bool IsRound => true;

    /// <inheritdoc/>
    public static bool IsDisc => true;

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Vector<float> DiscRadius(in CylinderWide shape) => shape.Radius;

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void Find(in CylinderWide shape, in Vector3Wide direction, Vector<int> done, ref Vector3Wide vertices,
        out ContactFeatureWide feature)
    {
        var zero = Vector<float>.Zero;
        var acrossSquared = direction.X * direction.X + direction.Z * direction.Z;
        // At 45 degrees both are at the same angle to the direction.
        var isCap = Vector.GreaterThanOrEqual(direction.Y * direction.Y, acrossSquared);
        var sign = Wide.CopySign(Vector<float>.One, direction.Y);
        var toSide = shape.Radius * Wide.DivideOrZero(Vector<float>.One, Vector.SquareRoot(acrossSquared));
        var sideX = direction.X * toSide;
        var sideZ = direction.Z * toSide;
        vertices = new(Wide.Select(isCap, zero, sideX), Wide.Select(isCap, shape.HalfLength * sign, -shape.HalfLength), Wide.Select(isCap, zero, sideZ));
        Unsafe.Add(ref vertices, 1) = new(sideX, shape.HalfLength, sideZ);
        feature.VertexCount = Wide.Select(isCap, new Vector<int>(FaceDisc.CornerCount), new Vector<int>(2));
        feature.PlaneNormal = new(
            Wide.Select(isCap, zero, direction.X), Wide.Mask(isCap, sign), Wide.Select(isCap, zero, direction.Z));
        // 0 and 1 are the ends, 2 is the side.
        feature.Id = Wide.Select(isCap, Vector.LessThan(sign, zero) & Vector<int>.One, new Vector<int>(2));
        feature.Margin = zero;
        feature.Roundness = Wide.Select(isCap, zero, shape.Radius);
        feature.Size = Vector.SquareRoot(shape.Radius * shape.Radius + shape.HalfLength * shape.HalfLength);
    }
}
