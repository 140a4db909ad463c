namespace BepuPhysics;

/// <summary>Whether all joints of a structure are solved at once, besides one after the other by sweeps.</summary>
public enum DirectJointsMode
{
    /// <summary>By sweeps alone.</summary>
    Off,
    /// <summary>All at once, wherever joints connect bodies to chains, trees, or loops of up to a thousand joints.</summary>
    Always,
}
