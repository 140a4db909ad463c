using System.Numerics;

namespace Demos.Scenes;

/// <summary>The shapes that a scene file can name.</summary>
public enum SceneShapeKind
{
    Box,
    Sphere,
    Capsule,
    Cylinder,
    Hull,
    Mesh,
    Field,
}

/// <summary>A shape as the scene file describes it; no engine has seen it yet.</summary>
public sealed class SceneShape
{
    public required SceneShapeKind Kind { get; init; }

    /// <summary>Half extents of a box; distances of samples in X and Z of a field; otherwise radius in X and half length along local y in Y.</summary>
    public Vector3 Size { get; init; }

    /// <summary>Points of a hull, vertices of a mesh.</summary>
    public Vector3[] Points { get; init; } = [];

    /// <summary>Three vertex numbers for each triangle of a mesh, counter-clockwise seen from its front.</summary>
    public int[] Indices { get; init; } = [];

    /// <summary>Heights of a field, row by row along x.</summary>
    public float[] Heights { get; init; } = [];

    /// <summary>Number of samples in a row of a field.</summary>
    public int RowLength { get; init; }

    /// <summary>Line of the scene file, from 1, or 0 when the shape did not come from a file.</summary>
    public int Line { get; init; }

    /// <summary>The word that stands for the shape in a scene file.</summary>
    public string Word => WordOf(Kind);

    /// <summary>The word that stands for a kind of shape in a scene file.</summary>
    public static string WordOf(SceneShapeKind kind) => kind switch
    {
        SceneShapeKind.Box => "box",
        SceneShapeKind.Sphere => "sphere",
        SceneShapeKind.Capsule => "capsule",
        SceneShapeKind.Cylinder => "cylinder",
        SceneShapeKind.Hull => "hull",
        SceneShapeKind.Mesh => "mesh",
        _ => "field",
    };
}
