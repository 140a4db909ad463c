using System.Numerics;
using BepuUtilities;

namespace BepuPhysics.CollisionDetection;

/// <summary>A bundle of pairs of which one is a container and the other moves in its frame.</summary>
struct ParentMotionWide
{
    public Vector3Wide Offset, Linear, AngularContainer, AngularMover;
    public QuaternionWide OrientationContainer, OrientationMover;
    public Vector<float> Margin, Limit;

    /// <summary>Writes a pair to a lane.</summary>
    /// <param name="pair">The pair.</param>
    /// <param name="moverIsA">Whether the mover is the A of the pair, as the caller has it.</param>
    /// <param name="lane">The lane.</param>
    public void Write(in ParentPair pair, bool moverIsA, int lane)
    {
        ref readonly var motion = ref pair.Motion;
        Lanes.Write(moverIsA ? -pair.OffsetB : pair.OffsetB, ref Offset, lane);
        Lanes.Write(moverIsA ? motion.A.Linear - motion.B.Linear : motion.B.Linear - motion.A.Linear, ref Linear, lane);
        Lanes.Write(moverIsA ? motion.B.Angular : motion.A.Angular, ref AngularContainer, lane);
        Lanes.Write(moverIsA ? motion.A.Angular : motion.B.Angular, ref AngularMover, lane);
        Lanes.Write(moverIsA ? pair.OrientationB : pair.OrientationA, ref OrientationContainer, lane);
        Lanes.Write(moverIsA ? pair.OrientationA : pair.OrientationB, ref OrientationMover, lane);
        GatherScatter.Get(ref Margin, lane) = pair.SpeculativeMargin;
        GatherScatter.Get(ref Limit, lane) = motion.MaximumExpansion;
    }
}

/// <summary>Where a mover is in the frame of a container, and how far it gets there within a step.</summary>
/// <remarks>
/// <para>In axes that turn with the container, a point r of the mover is at q(t) = E(t) (p + u t + R(t) r): p is the mover's centre less the
/// container's, u its velocity less the container's, R what the mover turns and E what the container turns back. So
/// q(t) - q(0) = u t + (E(t) - 1) (p + u t) + (E(t) R(t) - 1) r. The first is a translation; the second is no longer than an arc of |wC| t
/// on the circle of p + u t, nor than twice its radius; E R turns by |wM - wC| t at most, and the third is no longer than that arc on the
/// circle of r.</para>
/// <para>A box is that of the mover as it is, widened by the margin, together with that of all its places within the step. Tests look at the
/// mover as it is, so more is not needed.</para>
/// </remarks>
struct RelativeMotionWide
{
    /// <summary>Centre of the mover in the frame of the container.</summary>
    public Vector3Wide Position;
    /// <summary>From the frame of the mover to that of the container.</summary>
    public QuaternionWide Orientation;
    /// <summary>Translation within the step in the frame of the container, limited.</summary>
    public Vector3Wide Sweep;
    /// <summary>Greatest way by the turning of the container.</summary>
    public Vector<float> Arc;
    /// <summary>Angle that the mover turns at most relative to the container.</summary>
    public Vector<float> Angle;
    public Vector<float> Margin, Limit;

    // A place is rounded when the mover is turned into the container's frame, a child's box when it is made: by a few units in the last place of
    // the greatest coordinate.
    public const float Rounding = 1e-6f;

    public RelativeMotionWide(in ParentMotionWide parents, float dt)
    {
        var toContainer = QuaternionWide.Conjugate(parents.OrientationContainer);
        Position = toContainer * parents.Offset;
        Orientation = QuaternionWide.Concatenate(parents.OrientationMover, toContainer);
        Limit = parents.Limit;
        var time = new Vector<float>(dt);
        var translation = toContainer * (parents.Linear * time);
        var distance = Position.Length();
        var turning = Wide.Min(new Vector<float>(2), parents.AngularContainer.Length() * time);
        Arc = turning * (distance + translation.Length());
        Angle = (parents.AngularMover - parents.AngularContainer).Length() * time;
        var limits = new Vector3Wide(Limit, Limit, Limit);
        Sweep = Vector3Wide.Max(-limits, Vector3Wide.Min(limits, translation));
        Margin = parents.Margin + distance * new Vector<float>(Rounding);
    }

    /// <summary>Box around the mover, its places within the step and what is within its margin.</summary>
    /// <param name="maximumRadius">Distance from the mover's centre to its farthest point.</param>
    /// <param name="maximumAngularExpansion">Greatest way by the turning of the mover.</param>
    /// <param name="min">Lower corners relative to the mover's centre; then in the frame of the container.</param>
    /// <param name="max">Upper corners relative to the mover's centre; then in the frame of the container.</param>
    public readonly void Widen(Vector<float> maximumRadius, Vector<float> maximumAngularExpansion, ref Vector3Wide min, ref Vector3Wide max)
    {
        // Where anything is beyond all numbers, the limit is left.
        var turning = Wide.Min(Wide.Min(Angle * maximumRadius, maximumAngularExpansion) + Arc, Limit);
        var margin = Margin + maximumRadius * new Vector<float>(Rounding);
        var zero = Vector3Wide.Zero;
        var turnings = new Vector3Wide(turning, turning, turning);
        var margins = new Vector3Wide(margin, margin, margin);
        min = Position + min - Vector3Wide.Max(margins, turnings + Vector3Wide.Max(zero, -Sweep));
        max = Position + max + Vector3Wide.Max(margins, turnings + Vector3Wide.Max(zero, Sweep));
    }
}
