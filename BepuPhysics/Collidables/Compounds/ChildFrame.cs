using System.Numerics;
using BepuPhysics.Trees;
using BepuUtilities;

namespace BepuPhysics.Collidables;

/// <summary>Brings boxes from the frame of a compound to that of a child and back: boxes around turned boxes.</summary>
readonly struct ChildFrame
{
    readonly Vector3 position;
    readonly Quaternion orientation;

    // Of a quaternion that is as far from unit length as a child's may be, the conjugate undoes the rotation to 8e-5.
    const float InverseRounding = 1e-4f;
    // A few units in the last place.
    const float Rounding = 1e-6f;
    // Beyond anything that has a place, and small enough to be squared.
    const float Farthest = 1e15f;

    public ChildFrame(in CompoundChild child) => (position, orientation) = (child.LocalPosition, child.LocalOrientation);

    /// <summary>A box around a box of the compound's frame.</summary>
    public readonly void ToChild(ref Vector3 min, ref Vector3 max)
    {
        var farthest = new Vector3(Farthest);
        min = Exact.Max(min, -farthest) - position;
        max = Exact.Min(max, farthest) - position;
        Turn(Exact.Conjugate(orientation), InverseRounding, ref min, ref max);
    }

    /// <summary>A node around a node of the child's frame.</summary>
    public readonly void ToCompound(ref NodeChild node)
    {
        Turn(orientation, Rounding, ref node.Min, ref node.Max);
        var rounding = Vector3.Abs(position) * Rounding;
        node.Min += position - rounding;
        node.Max += position + rounding;
    }

    static void Turn(in Quaternion turn, float rounding, ref Vector3 min, ref Vector3 max)
    {
        var axes = Matrix3x3.FromQuaternion(turn);
        var center = (min + max) * .5f;
        var half = max - center;
        var place = Matrix3x3.TransposeTimes(axes, center);
        var extent = Vector3.Abs(axes.X) * half.X + Vector3.Abs(axes.Y) * half.Y + Vector3.Abs(axes.Z) * half.Z;
        extent += new Vector3((Exact.Length(center) + Exact.Length(half)) * rounding);
        min = place - extent;
        max = place + extent;
    }
}
