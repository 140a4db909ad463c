using System.Numerics;
using System.Runtime.CompilerServices;
using BepuPhysics.Collidables;
using BepuUtilities;

namespace BepuPhysics.CollisionDetection;

/// <summary>The face of a box that a direction leaves it through at the least angle to its normal.</summary>
public readonly struct BoxFeature : IContactFeature<BoxWide>
{
    /// <inheritdoc/>
    public static int MaximumVertexCount => 4;

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void Find(in BoxWide shape, in Vector3Wide direction, Vector<int> done, ref Vector3Wide vertices,
        out ContactFeatureWide feature)
    {
        var absolute = Vector3Wide.Abs(direction);
        var useX = Vector.GreaterThanOrEqual(absolute.X, absolute.Y) & Vector.GreaterThanOrEqual(absolute.X, absolute.Z);
        var useY = Vector.AndNot(Vector.GreaterThanOrEqual(absolute.Y, absolute.Z), useX);
        var useZ = ~(useX | useY);
        var along = Wide.Select(useX, direction.X, Wide.Select(useY, direction.Y, direction.Z));
        var sign = Wide.CopySign(Vector<float>.One, along);

        // The middle of the face, and from there to the middles of two sides: axis times u is v. On the side that looks along a negative
        // axis u is turned, so that the corners run the other way around it.
        var middle = new Vector3Wide(
            Wide.Mask(useX, shape.HalfWidth * sign), Wide.Mask(useY, shape.HalfHeight * sign), Wide.Mask(useZ, shape.HalfLength * sign));
        var u = new Vector3Wide(
            Wide.Mask(useZ, shape.HalfWidth * sign), Wide.Mask(useX, shape.HalfHeight * sign), Wide.Mask(useY, shape.HalfLength * sign));
        var v = new Vector3Wide(
            Wide.Mask(useY, shape.HalfWidth), Wide.Mask(useZ, shape.HalfHeight), Wide.Mask(useX, shape.HalfLength));
        var front = middle + v;
        var back = middle - v;
        vertices = back - u;
        Unsafe.Add(ref vertices, 1) = back + u;
        Unsafe.Add(ref vertices, 2) = front + u;
        Unsafe.Add(ref vertices, 3) = front - u;

        feature.VertexCount = new Vector<int>(4);
        feature.PlaneNormal = new(Wide.Mask(useX, sign), Wide.Mask(useY, sign), Wide.Mask(useZ, sign));
        feature.Id = (useY & new Vector<int>(2)) | (useZ & new Vector<int>(4)) |
            (Vector.LessThan(along, Vector<float>.Zero) & Vector<int>.One);
        feature.Margin = Vector<float>.Zero;
        feature.Roundness = Vector<float>.Zero;
        feature.Size = new Vector3Wide(shape.HalfWidth, shape.HalfHeight, shape.HalfLength).Length();
    }
}
