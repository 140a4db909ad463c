namespace Demos.Running;

/// <summary>Whether loads are handed down to the ground in one go, in words that every engine of the runner is asked in.</summary>
public enum LoadPathChoice
{
    /// <summary>By sweeps alone.</summary>
    Off,
    /// <summary>Where a substep has left a velocity.</summary>
    WhereNeeded,
    /// <summary>In each substep.</summary>
    Always,
}
