using System.Numerics;
using System.Runtime.CompilerServices;
using BepuUtilities;

namespace BepuPhysics.CollisionDetection;

/// <summary>A flat face of each shape of a bundle: its plane, and its corners in it.</summary>
public struct SearchFace
{
    /// <summary>Unit normal out of the shape.</summary>
    public Vector3Wide Normal;
    /// <summary>Unit axes across the normal.</summary>
    public Vector3Wide AxisX, AxisY;
    /// <summary>Height of the plane along the normal, m.</summary>
    public Vector<float> Height;
    /// <summary>
    /// Corners by their coordinates along the axes, counter-clockwise from the first axis to the second; as many as
    /// <see cref="ISupport{TShapeWide}.FaceVertexCount"/>. The end of a cylinder has none.
    /// </summary>
    public Vector2Wide Corner0, Corner1, Corner2, Corner3;

    /// <summary>Coordinates of a point along the axes.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public readonly Vector2Wide Place(in Vector3Wide point) => new(Vector3Wide.Dot(point, AxisX), Vector3Wide.Dot(point, AxisY));

    /// <summary>The vector across the normal that has the given coordinates.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    internal readonly Vector3Wide Across(in Vector2Wide place) => AxisX * place.X + AxisY * place.Y;

    /// <summary>The unit vector whose slope against the normal is the given one.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    internal readonly Vector3Wide Tilt(in Vector2Wide slope) =>
        (Normal + Across(slope)) * (Vector<float>.One / Vector.SquareRoot(Vector<float>.One + slope.LengthSquared()));

    /// <summary>Corner by index.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    internal readonly Vector2Wide Corner(int index) => Unsafe.Add(ref Unsafe.AsRef(in Corner0), index);
}
