namespace BepuPhysics;

/// <summary>Whether all joints of a structure are solved at once, besides one after the other by sweeps.</summary>
public enum DirectJointsMode
{
    /// <summary>By sweeps alone.</summary>
    Off,
    /// <summary>All at once, wherever joints connect bodies to chains, trees, or loops of up to a thousand joints.</summary>
    Always,
    /// <summary>
    /// All at once where sweeps do not hold the joints of a structure, and by sweeps where they do: a joint that is off by more than half a hundredth of
    /// its size, or of a radian, asks for it, for its whole structure, until its load is one that sweeps bear.
    /// </summary>
    WhereNeeded,
}
