namespace BepuPhysics;

/// <summary>Chooses which sleeping bodies wake when a static that they may touch is added, moved, changed or removed.</summary>
public interface IStaticChangeAwakeningFilter
{
    /// <summary>Whether any body may wake. If not, none is looked for.</summary>
    bool AllowAwakening { get; }

    /// <summary>Whether a body wakes, with its island. Called before anything changes; the simulation may only be read.</summary>
    /// <param name="body">A body whose bounds meet those of the static, before or after the change.</param>
    bool ShouldAwaken(BodyReference body);
}

/// <summary>Wakes dynamic bodies only: what is done where no filter is passed.</summary>
public struct StaticsShouldntAwakenKinematics : IStaticChangeAwakeningFilter
{
    /// <inheritdoc/>
    public readonly bool AllowAwakening => true;

    /// <inheritdoc/>
    public readonly bool ShouldAwaken(BodyReference body) => !body.Kinematic;
}

/// <summary>Wakes nobody.</summary>
public struct StaticsShouldntAwakenBodies : IStaticChangeAwakeningFilter
{
    /// <inheritdoc/>
    public readonly bool AllowAwakening => false;

    /// <inheritdoc/>
    public readonly bool ShouldAwaken(BodyReference body) => false;
}
