using System.Numerics;

namespace Demos.Scenes;

/// <summary>How a body takes part in the simulation. The values are those of the scene file.</summary>
public enum SceneBodyKind
{
    Static = 0,

    /// <summary>Keeps its velocities whatever touches it.</summary>
    Kinematic = 1,
    Dynamic = 2,
}

/// <summary>One shape of a body, placed in the body's frame.</summary>
public readonly record struct SceneChild(int Shape, Vector3 Position, Quaternion Orientation)
{
    /// <summary>Whether the child's frame is the body's frame.</summary>
    public bool IsAtIdentity => Position == Vector3.Zero && Orientation == Quaternion.Identity;
}

/// <summary>A body as the scene file describes it.</summary>
public sealed class SceneBody
{
    public required SceneBodyKind Kind { get; init; }

    /// <summary>The body's shapes; empty for a kinematic body that only holds joints.</summary>
    public required SceneChild[] Children { get; init; }

    /// <summary>Kilograms; without meaning for a body that is not dynamic.</summary>
    public float Mass { get; init; }

    public Vector3 Position { get; init; }

    public Quaternion Orientation { get; init; } = Quaternion.Identity;

    /// <summary>Metres per second, of the body's origin.</summary>
    public Vector3 LinearVelocity { get; init; }

    /// <summary>Radians per second, in world axes.</summary>
    public Vector3 AngularVelocity { get; init; }

    /// <summary>0 collides with all, a positive group not with its own members, -1 with nothing.</summary>
    public int Group { get; init; }

    /// <summary>Line of the scene file, from 1, or 0 when the body did not come from a file.</summary>
    public int Line { get; init; }

    /// <summary>Whether the body needs a shape that is made of others.</summary>
    public bool IsCompound => Children.Length > 1 || (Children.Length == 1 && !Children[0].IsAtIdentity);
}
