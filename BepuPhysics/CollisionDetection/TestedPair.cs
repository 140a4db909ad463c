namespace BepuPhysics.CollisionDetection;

/// <summary>A pair that waits for its contacts.</summary>
struct TestedPair
{
    public CollidablePair Pair;
    /// <summary>Index in the cache; negative for a pair that is not in it.</summary>
    public int CacheIndex;
    /// <summary>Of a pair with children: the first of its manifolds of the last step. These stay until changes are made, after all pairs are tested.</summary>
    public int FirstManifold;
    /// <summary>Contact constraint that the pair has; means nothing where there is none.</summary>
    public ConstraintHandle Constraint;
    /// <summary>Type id of that constraint; <see cref="CachedManifold.NoConstraint"/> where there is none.</summary>
    public int ConstraintTypeId;
    /// <summary>Whether tests of the pair's shapes keep histories, and whether the pair has one.</summary>
    public bool KeepsHistory, HasHistory;

    /// <summary>Whether one of the two is a sensor, so that the pair has no constraint.</summary>
    public bool IsSensor;

    /// <summary>Whether A touched several things in the last step that do not give way.</summary>
    public bool IsAtSeam;

    /// <summary>Of a pair with children: whether its patches may be carried along, and whether they are.</summary>
    public bool MayCarry, IsCarried;

    /// <summary>Of a pair with children: whether one turns too fast as the other sees it to be carried along, however large it is.</summary>
    public bool TurnsFast;

    /// <summary>Whether impacts of the pair are made exactly (<see cref="ThinImpacts"/>, <see cref="CornerHits"/>, and what is fast).</summary>
    public bool IsExact;

    /// <summary>What is fast, and comes nearer by less than this in a substep, has no impact: the solver stops it as it stops all that rests, m.</summary>
    public float LeastHit;

    /// <summary>Whether the pair is tested where it will touch; then its contacts are those of that time.</summary>
    public bool IsImpact;

    /// <summary>Whether contacts may run around the rims of cylinders.</summary>
    public bool MayHaveRims;

    /// <summary>Whether A has corners and edges on which it may turn.</summary>
    public bool MayPivot;

    /// <summary>Whether A is round, and may roll along a curved surface that stands.</summary>
    public bool MayRoll;

    /// <summary>Time at which it will touch, s from the beginning of the step.</summary>
    public float ImpactTime;

    /// <summary>Greatest distance at which a contact exists, m.</summary>
    public float SpeculativeMargin;

    /// <summary>Whether the pair's constraint can be written in place.</summary>
    /// <param name="typeId">Type id of the constraint that the pair is to have.</param>
    // A pair whose shapes have become such as keep a history gets it with the changes.
    public readonly bool KeepsConstraint(int typeId) => ConstraintTypeId == typeId && (HasHistory || !KeepsHistory);
}
