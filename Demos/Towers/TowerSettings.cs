using BepuPhysics;

namespace Demos.Towers;

/// <summary>How long steps are.</summary>
enum StepPattern
{
    /// <summary>All alike.</summary>
    Even,
    /// <summary>From a half to twice the length, by lot.</summary>
    Random,
}

/// <summary>How a structure is watched; nothing in here changes what it is but the offset and the push.</summary>
sealed record TowerSettings
{
    /// <summary>Time that it is watched, s.</summary>
    public float Seconds { get; init; } = 20;

    /// <summary>Length of a step, s.</summary>
    public float StepDuration { get; init; } = 1 / 60f;

    public StepPattern Steps { get; init; }

    public int Substeps { get; init; } = 4;

    /// <summary>Velocity iterations per substep.</summary>
    public int Iterations { get; init; } = 1;

    /// <summary>Relaxations per substep.</summary>
    public int Relaxations { get; init; }

    /// <summary>Whether loads are handed down to the ground in one go.</summary>
    public LoadPathMode LoadPath { get; init; } = LoadPathMode.WhereNeeded;

    /// <summary>How far parts are out of place at most, m.</summary>
    public float Offset { get; init; }

    /// <summary>Chooses the offsets and the lengths of steps.</summary>
    public int Seed { get; init; } = 1;

    /// <summary>Speed that the topmost part gets after two seconds, m/s along x; along z where a structure is thinner that way.</summary>
    public float Push { get; init; }

    public int Threads { get; init; } = 1;
}
