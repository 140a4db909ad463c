using System;
using System.Numerics;
using System.Runtime.CompilerServices;
using BepuPhysics.Collidables;
using BepuUtilities;

namespace BepuPhysics.CollisionDetection;

/// <summary>A cylinder's end, as a regular polygon with its corners on the rim, or the line of its side that faces the direction.</summary>
// The polygon is fixed to the cylinder, so that a contact keeps its corner while the cylinder rests. It lacks 2 % of the radius in the
// middles of its sides; where the contact of a tilted cylinder lies there, the pair's own witness stands in for it.
public readonly struct CylinderFeature : IContactFeature<CylinderWide>
{
    const int CapVertexCount = 16;

    // Sines of 22.5 degrees times 0 to 19; the cosines start at the fourth.
    static ReadOnlySpan<float> Sines =>
    [
        0, 0.38268343f, 0.70710678f, 0.92387953f, 1, 0.92387953f, 0.70710678f, 0.38268343f,
        0, -0.38268343f, -0.70710678f, -0.92387953f, -1, -0.92387953f, -0.70710678f, -0.38268343f,
        0, 0.38268343f, 0.70710678f, 0.92387953f,
    ];

    /// <inheritdoc/>
    public static int MaximumVertexCount => CapVertexCount;

    /// <inheritdoc/>
    public static bool IsRound => true;

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.NoInlining)]
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
        if (Vector.EqualsAny(isCap & ~done, new Vector<int>(-1)))
        {
            // From Z towards X is counter-clockwise seen from +Y. The polygon of the other end is its mirror image.
            var capY = shape.HalfLength * sign;
            var radiusX = shape.Radius * sign;
            var y = Wide.Select(isCap, capY, -shape.HalfLength);
            for (int i = 0; i < CapVertexCount; ++i)
            {
                Unsafe.Add(ref vertices, i) = new(
                    Wide.Select(isCap, radiusX * new Vector<float>(Sines[i]), sideX),
                    y,
                    Wide.Select(isCap, shape.Radius * new Vector<float>(Sines[i + CapVertexCount / 4]), sideZ));
            }
            Unsafe.Add(ref vertices, 1).Y = Wide.Select(isCap, capY, shape.HalfLength);
        }
        else
        {
            vertices = new(sideX, -shape.HalfLength, sideZ);
            Unsafe.Add(ref vertices, 1) = new(sideX, shape.HalfLength, sideZ);
        }
        feature.VertexCount = Wide.Select(isCap, new Vector<int>(CapVertexCount), new Vector<int>(2));
        feature.PlaneNormal = new(
            Wide.Select(isCap, zero, direction.X), Wide.Mask(isCap, sign), Wide.Select(isCap, zero, direction.Z));
        // 0 and 1 are the ends, 2 is the side.
        feature.Id = Wide.Select(isCap, Vector.LessThan(sign, zero) & Vector<int>.One, new Vector<int>(2));
        feature.Margin = zero;
        feature.Roundness = Wide.Select(isCap, zero, shape.Radius);
        feature.Size = Vector.SquareRoot(shape.Radius * shape.Radius + shape.HalfLength * shape.HalfLength);
    }
}
