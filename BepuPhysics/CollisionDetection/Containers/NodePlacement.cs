using System.Numerics;
using BepuPhysics.Trees;
using BepuUtilities;

namespace BepuPhysics.CollisionDetection;

/// <summary>Puts boxes of a container that moves into the frame of another.</summary>
/// <remarks>A box around a turned box, and as <see cref="RelativeMotionWide.Widen"/> around its places within the step.</remarks>
readonly struct NodePlacement
{
    readonly Matrix3x3 axes;
    readonly Vector3 position, sweepBelow, sweepAbove;
    readonly float angle, arc, margin, limit;

    public NodePlacement(ref RelativeMotionWide motions, int lane)
    {
        axes = Matrix3x3.FromQuaternion(Lanes.Read<Quaternion, QuaternionWide>(ref motions.Orientation, lane));
        position = Lanes.Read<Vector3, Vector3Wide>(ref motions.Position, lane);
        var sweep = Lanes.Read<Vector3, Vector3Wide>(ref motions.Sweep, lane);
        sweepBelow = Exact.Max(-sweep, Vector3.Zero);
        sweepAbove = Exact.Max(sweep, Vector3.Zero);
        angle = MathHelper.Min(2, motions.Angle[lane]);
        arc = motions.Arc[lane];
        margin = motions.Margin[lane];
        limit = motions.Limit[lane];
    }

    /// <summary>A node in the frame of the other container.</summary>
    public readonly NodeChild Place(in NodeChild node)
    {
        var center = (node.Min + node.Max) * .5f;
        var half = node.Max - center;
        var radius = Exact.Length(center) + Exact.Length(half);
        var place = position + Matrix3x3.TransposeTimes(axes, center);
        var extent = Vector3.Abs(axes.X) * half.X + Vector3.Abs(axes.Y) * half.Y + Vector3.Abs(axes.Z) * half.Z;
        var turning = new Vector3(MathHelper.Min(angle * radius + arc, limit));
        var margins = new Vector3(margin + radius * RelativeMotionWide.Rounding);
        var result = node;
        result.Min = place - extent - Exact.Max(margins, turning + sweepBelow);
        result.Max = place + extent + Exact.Max(margins, turning + sweepAbove);
        return result;
    }
}
