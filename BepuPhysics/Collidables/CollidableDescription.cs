using System;

namespace BepuPhysics.Collidables;

/// <summary>Shape and collision settings of a body, as a user describes them.</summary>
/// <param name="shape">Shape of the body; the default is none.</param>
/// <param name="minimumSpeculativeMargin">Least speculative margin, m.</param>
/// <param name="maximumSpeculativeMargin">Greatest speculative margin, m.</param>
/// <param name="continuity">Continuous detection.</param>
public struct CollidableDescription(TypedIndex shape, float minimumSpeculativeMargin, float maximumSpeculativeMargin, ContinuousDetection continuity)
{
    /// <summary>Shape of the body; the default is none.</summary>
    public TypedIndex Shape = shape;
    /// <summary>Continuous detection.</summary>
    public ContinuousDetection Continuity = continuity;
    /// <summary>Least speculative margin, m.</summary>
    public float MinimumSpeculativeMargin = minimumSpeculativeMargin;
    /// <summary>Greatest speculative margin, m.</summary>
    public float MaximumSpeculativeMargin = maximumSpeculativeMargin;

    /// <summary>Limits the margin, with discrete detection.</summary>
    public CollidableDescription(TypedIndex shape, float minimumSpeculativeMargin, float maximumSpeculativeMargin)
        : this(shape, minimumSpeculativeMargin, maximumSpeculativeMargin, ContinuousDetection.Discrete) { }
    /// <summary>Limits the margin from above.</summary>
    public CollidableDescription(TypedIndex shape, float maximumSpeculativeMargin, ContinuousDetection continuity)
        : this(shape, 0, maximumSpeculativeMargin, continuity) { }
    /// <summary>Does not limit the margin.</summary>
    public CollidableDescription(TypedIndex shape, ContinuousDetection continuity) : this(shape, float.MaxValue, continuity) { }
    /// <summary>Does not limit the margin, with passive detection.</summary>
    public CollidableDescription(TypedIndex shape) : this(shape, ContinuousDetection.Passive) { }
    /// <summary>Limits the margin from above, with discrete detection.</summary>
    public CollidableDescription(TypedIndex shape, float maximumSpeculativeMargin)
        : this(shape, maximumSpeculativeMargin, ContinuousDetection.Discrete) { }

    /// <summary>Does not limit the margin, with passive detection.</summary>
    public static implicit operator CollidableDescription(TypedIndex shape) => new(shape);

    internal readonly void Validate()
    {
        Continuity.Validate(nameof(Continuity));
        if (!(MinimumSpeculativeMargin >= 0) || !(MaximumSpeculativeMargin >= MinimumSpeculativeMargin) ||
            !(MinimumSpeculativeMargin <= Limits.MaximumMinimumSpeculativeMargin))
        {
            throw new ArgumentException(
                $"{nameof(MinimumSpeculativeMargin)} ({MinimumSpeculativeMargin}) and " +
                $"{nameof(MaximumSpeculativeMargin)} ({MaximumSpeculativeMargin}) must be in order and not negative, " +
                $"the first at most {Limits.MaximumMinimumSpeculativeMargin} m.",
                nameof(MinimumSpeculativeMargin));
        }
    }
}
