namespace BepuPhysics;

/// <summary>Whether loads are handed down to the ground in one go, besides by sweeps over the contacts.</summary>
public enum LoadPathMode
{
    /// <summary>By sweeps alone.</summary>
    Off,
    /// <summary>Where a substep has left bodies that rest on others with a velocity.</summary>
    WhereNeeded,
    /// <summary>
    /// In each substep, wherever bodies rest on others; and structures of up to 512 bodies that tip over turn as one and fall in their time. While one of some
    /// hundred bodies does, a step takes tens of times as long.
    /// </summary>
    Always,
}
