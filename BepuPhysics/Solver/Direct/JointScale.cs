using System;
using BepuUtilities;

namespace BepuPhysics.Constraints;

/// <summary>What the error of a joint is judged by: how large its bodies are, and how they move.</summary>
struct JointScale
{
    // Speed, in sizes or radians per second, below which a body rests.
    const float RestSpeed = 1;

    /// <summary>
    /// Square of the length by which an error along directions is judged: the least radius of gyration of its bodies about where it holds them.
    /// </summary>
    // Infinite where no body of it is moved and turned.
    public float SizeSquared;
    /// <summary>Square of the greatest angular speed of its bodies, rad2/s2.</summary>
    public float TurnSquared;
    /// <summary>Square of the greatest speed of its bodies about where it holds them, m2/s2: that of their radii of gyration.</summary>
    public float SpeedSquared;
    /// <summary>What a gap of unit length that turns with a body has of that body's own speed, by the part of its motion that its arm makes, 1/m.</summary>
    public float Leverage;
    /// <summary>Whether all of its bodies rest.</summary>
    public bool Rests;

    /// <summary>Whether one of its bodies turns.</summary>
    public readonly bool Turns => TurnSquared > RestSpeed * RestSpeed;

    /// <summary>Of a joint of a bundle whose errors are known.</summary>
    internal static JointScale Of(TypeProcessor processor, ref TypeBatch batch, int index, in JointErrorWide errors, int lane, in BodySet set)
    {
        JointScale scale = default;
        scale.SizeSquared = float.PositiveInfinity;
        scale.Rests = true;
        for (int slot = 0; slot < processor.BodiesPerConstraint; ++slot)
        {
            var reference = processor.BodyReference(ref batch, index, slot);
            ref var velocity = ref set.MotionStates[reference & EncodedBody.IndexMask].Velocity;
            var arm = slot == 0 ? errors.ArmASquared[lane] : errors.ArmBSquared[lane];
            var turn = Exact.LengthSquared(velocity.Angular);
            var size = arm;
            var isDynamic = (reference & EncodedBody.KinematicFlag) == 0;
            if (isDynamic)
            {
                ref var inertia = ref set.LocalInertias[reference & EncodedBody.IndexMask];
                ref var inverse = ref inertia.InverseInertiaTensor;
                var trace = inverse.XX + inverse.YY + inverse.ZZ;
                // What nothing turns has its arm, or nothing to be judged by.
                if (trace > 0)
                    size += 3 * inertia.InverseMass / trace;
                if (size > 0)
                    scale.SizeSquared = MathHelper.Min(scale.SizeSquared, size);
            }
            scale.TurnSquared = MathHelper.Max(scale.TurnSquared, turn);
            scale.SpeedSquared = MathHelper.Max(scale.SpeedSquared, size * turn);
            if (turn > RestSpeed * RestSpeed && size > 0)
                scale.Leverage = MathHelper.Max(scale.Leverage, arm / (size * MathF.Sqrt(size)));
            scale.Rests &= turn <= RestSpeed * RestSpeed && Exact.LengthSquared(velocity.Linear) <= RestSpeed * RestSpeed * size;
        }
        return scale;
    }
}
