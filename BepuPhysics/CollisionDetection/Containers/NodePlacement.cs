using System.Numerics;
using BepuPhysics.Collidables;
using BepuPhysics.Trees;
using BepuUtilities;

namespace BepuPhysics.CollisionDetection;

/// <summary>Puts boxes of a container that moves into the frame of another.</summary>
/// <remarks>
/// <para>A box around a turned box, and as <see cref="RelativeMotionWide.Widen"/> around its places within the step. There the mover is a
/// body of some size. Here it may be a level whose nodes are hundreds of metres from its centre, around which, as seen from a car that turns,
/// all of it turns by metres in a step; but what is near the car hardly moves.</para>
/// <para>So the way of a node is bounded once more, with the terms of that type's remarks: q = E x, x = p + u t + R r. Its centre r sets out
/// at u + wM x r - wC x (p + r), and |q''| is no greater than |wM|^2 |r| + 2 |wC| |x'| + |wC|^2 |x|, half of which by t^2 is how far it is
/// from a straight way at most. Other points of the node are turned around it by |wM - wC| t at most. The places are in both bounds.</para>
/// </remarks>
readonly struct NodePlacement
{
    readonly Matrix3x3 axes;
    readonly Vector3 position, sweepBelow, sweepAbove;
    readonly float angle, arc, margin, limit;
    // Within the step, in the frame of the container: the translation, what the two turn by, and how much.
    readonly Vector3 way, turnContainer, turnMover;
    readonly float wayLength, angleContainer, angleMover;

    /// <param name="motions">Of the bundle of the pair.</param>
    /// <param name="lane">Lane of the pair.</param>
    /// <param name="pair">The pair.</param>
    /// <param name="moverIsA">Whether the mover is the A of the pair, as the caller has it.</param>
    /// <param name="dt">Length of the step, s.</param>
    public NodePlacement(ref RelativeMotionWide motions, int lane, in ParentPair pair, bool moverIsA, float dt)
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

        ref readonly var motion = ref pair.Motion;
        var (mover, container) = moverIsA ? (motion.A, motion.B) : (motion.B, motion.A);
        var orientation = moverIsA ? pair.OrientationB : pair.OrientationA;
        way = Exact.RotateByInverse((mover.Linear - container.Linear) * dt, orientation);
        turnContainer = Exact.RotateByInverse(container.Angular * dt, orientation);
        turnMover = Exact.RotateByInverse(mover.Angular * dt, orientation);
        wayLength = Exact.Length(way);
        angleContainer = Exact.Length(turnContainer);
        angleMover = Exact.Length(turnMover);
    }

    /// <summary>A node in the frame of the other container.</summary>
    public readonly NodeChild Place(in NodeChild node)
    {
        var center = (node.Min + node.Max) * .5f;
        var half = node.Max - center;
        float halfLength = Exact.Length(half), centerLength = Exact.Length(center);
        var radius = centerLength + halfLength;
        var arm = Matrix3x3.TransposeTimes(axes, center);
        var place = position + arm;
        var extent = Vector3.Abs(axes.X) * half.X + Vector3.Abs(axes.Y) * half.Y + Vector3.Abs(axes.Z) * half.Z;
        var turning = new Vector3(MathHelper.Min(angle * radius + arc, limit));
        var margins = new Vector3(margin + radius * RelativeMotionWide.Rounding);

        var start = way + Exact.Cross(turnMover, arm) - Exact.Cross(turnContainer, place);
        var speed = wayLength + angleMover * centerLength;
        var curve = angleMover * angleMover * centerLength + 2 * angleContainer * speed +
            angleContainer * angleContainer * (Exact.Length(place) + speed);
        var bend = new Vector3(angle * halfLength + .5f * curve);

        // Where anything is beyond all numbers, the second is left.
        var below = Exact.Min(Exact.Max(-start, Vector3.Zero) + bend, turning + sweepBelow);
        var above = Exact.Min(Exact.Max(start, Vector3.Zero) + bend, turning + sweepAbove);
        var result = node;
        result.Min = place - extent - Exact.Max(margins, below);
        result.Max = place + extent + Exact.Max(margins, above);
        return result;
    }

    /// <summary>What a node lies in where it is now, with the margin, in the frame of the other container.</summary>
    public readonly ShapeOutline Outline(in NodeChild node)
    {
        var center = (node.Min + node.Max) * .5f;
        var half = node.Max - center;
        var radius = Exact.Length(center) + Exact.Length(half);
        var outline = new ShapeOutline { Center = position + Matrix3x3.TransposeTimes(axes, center), Radius = margin + radius * RelativeMotionWide.Rounding };
        outline.Margin = outline.Radius;
        outline.SetBox(axes, half);
        return outline;
    }
}
