using System.Diagnostics.CodeAnalysis;
using System.Numerics;
using System.Runtime.CompilerServices;
using System.Runtime.InteropServices;
using BepuUtilities;

namespace BepuPhysics.Collidables;

/// <summary>A shape in a compound, and where it is. Its first 28 bytes are laid out as a <see cref="RigidPose"/>.</summary>
/// <param name="pose">Pose of the child in the frame of the compound.</param>
/// <param name="shapeIndex">Name of the child's shape.</param>
[StructLayout(LayoutKind.Sequential, Size = 32)]
public struct CompoundChild(in RigidPose pose, TypedIndex shapeIndex)
{
    /// <summary>Rotation from the child's frame to that of the compound; of unit length, to 1e-5. The constructor takes rounding out.</summary>
    public Quaternion LocalOrientation = Normalized(pose.Orientation);
    /// <summary>Position of the child's centre in the frame of the compound, m; each coordinate up to 1e7.</summary>
    public Vector3 LocalPosition = pose.Position;
    /// <summary>Name of the child's shape. What may be a child says <see cref="Compound"/>.</summary>
    public TypedIndex ShapeIndex = shapeIndex;

    // What is no rotation stays what it is, to be refused by name.
    static Quaternion Normalized(Quaternion value) =>
        UnitTolerance.Holds(Exact.Dot(value, value), UnitTolerance.Described) ? Exact.Normalize(value) : value;

    /// <summary>Pose of the child, to be read or changed where it is.</summary>
    /// <remarks>Change its fields, not all of it at once: a pose is padded, and the shape lies where its padding would be.</remarks>
    [UnscopedRef]
    public ref RigidPose AsPose() => ref Unsafe.As<Quaternion, RigidPose>(ref LocalOrientation);
}
