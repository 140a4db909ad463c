using System.Numerics;

namespace Demos.Scenes;

/// <summary>The joints that a scene file can name.</summary>
public enum SceneJointKind
{
    /// <summary>Two anchors stay together.</summary>
    Ball,

    /// <summary>As <see cref="Ball"/>, with a limit to swing and to twist about local +y, both zero as the bodies were placed.</summary>
    Rag,
}

/// <summary>A joint between two bodies as the scene file describes it.</summary>
public sealed class SceneJoint
{
    public required SceneJointKind Kind { get; init; }

    public required int BodyA { get; init; }

    public required int BodyB { get; init; }

    /// <summary>Anchor in the frame of body A.</summary>
    public Vector3 AnchorA { get; init; }

    /// <summary>Anchor in the frame of body B.</summary>
    public Vector3 AnchorB { get; init; }

    /// <summary>Radians, 0 to pi.</summary>
    public float MaximumSwing { get; init; }

    /// <summary>Radians; the least twist of B against A.</summary>
    public float MinimumTwist { get; init; }

    /// <summary>Radians; the greatest twist of B against A.</summary>
    public float MaximumTwist { get; init; }

    /// <summary>Line of the scene file, from 1, or 0 when the joint did not come from a file.</summary>
    public int Line { get; init; }
}
