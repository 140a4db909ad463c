using System.Numerics;
using System.Runtime.CompilerServices;
using BepuPhysics.Collidables;
using BepuUtilities;

namespace BepuPhysics.CollisionDetection;

/// <summary>The segment of a capsule.</summary>
public readonly struct CapsuleFeature : IContactFeature<CapsuleWide>
{
    /// <inheritdoc/>
    public static int MaximumVertexCount => 2;

    /// <inheritdoc/>
    public static bool IsRound => true;

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void Find(in CapsuleWide shape, in Vector3Wide direction, Vector<int> done, ref Vector3Wide vertices,
        out ContactFeatureWide feature)
    {
        var zero = Vector<float>.Zero;
        vertices = new(zero, -shape.HalfLength, zero);
        Unsafe.Add(ref vertices, 1) = new(zero, shape.HalfLength, zero);
        feature.VertexCount = new Vector<int>(2);
        feature.PlaneNormal = new(direction.X, zero, direction.Z);
        feature.Id = Vector<int>.Zero;
        feature.Margin = shape.Radius;
        feature.Roundness = shape.Radius;
        feature.Size = shape.HalfLength + shape.Radius;
    }
}
