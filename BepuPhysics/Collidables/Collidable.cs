namespace BepuPhysics.Collidables;

/// <summary>Shape and collision state of a body.</summary>
public struct Collidable
{
    /// <summary>Shape of the body, if it has one. To be changed by <see cref="BodyReference.SetShape"/>.</summary>
    public TypedIndex Shape { readonly get; internal set; }
    /// <summary>Continuous detection.</summary>
    public ContinuousDetection Continuity;
    /// <summary>Least speculative margin, m.</summary>
    public float MinimumSpeculativeMargin;
    /// <summary>Greatest speculative margin, m.</summary>
    public float MaximumSpeculativeMargin;
    /// <summary>Distance within which the current step looks for contacts, m; set by each step from the velocity.</summary>
    public float SpeculativeMargin;
    /// <summary>Index of the body's leaf in the broad phase; -1 for a body without a shape.</summary>
    public int BroadPhaseIndex;
}
