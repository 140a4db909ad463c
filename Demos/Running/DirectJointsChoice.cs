namespace Demos.Running;

/// <summary>Whether all joints of a structure are solved at once, in words that every engine of the runner is asked in.</summary>
public enum DirectJointsChoice
{
    /// <summary>By sweeps alone.</summary>
    Off,
    /// <summary>In each substep.</summary>
    Always,
    /// <summary>Where sweeps do not hold them.</summary>
    WhereNeeded,
}
