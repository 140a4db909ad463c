using System;
using System.Numerics;
using Demos.Scenes;

namespace Demos.Towers;

/// <summary>Something built of loose parts that stands by itself, or does not.</summary>
/// <param name="name">Word by which it is chosen.</param>
/// <param name="summary">What it is, in a line.</param>
/// <param name="create">Builds it on the ground at y = 0, with all parts exactly in place.</param>
sealed class Structure(string name, string summary, Func<SceneDescription> create)
{
    /// <summary>Word by which it is chosen.</summary>
    public string Name { get; } = name;

    /// <summary>What it is, in a line.</summary>
    public string Summary { get; } = summary;

    /// <summary>Parts may be moved along these axes and stay apart from their neighbours: 1 where that is so, 0 where not.</summary>
    public Vector3 FreeAxes { get; init; } = new(1, 0, 1);

    /// <summary>Direction in which its topmost part is pushed.</summary>
    public Vector3 PushAxis => FreeAxes.X > 0 ? Vector3.UnitX : Vector3.UnitZ;

    /// <summary>Length that offsets are multiplied with: 1, or less for what is built of small parts.</summary>
    public float Scale { get; init; } = 1;

    /// <summary>Whether it stands, in the truth of rigid bodies.</summary>
    public bool Stands { get; init; } = true;

    /// <summary>Whether it is built in less than a thousand parts, so that a run of it takes seconds.</summary>
    public bool IsSmall { get; init; } = true;

    /// <summary>Builds it.</summary>
    /// <param name="offset">How far parts are out of place at most, along each axis that is free, m.</param>
    /// <param name="seed">Chooses how far each is.</param>
    public SceneDescription Build(float offset, int seed)
    {
        SceneDescription exact = create();
        if (offset == 0)
            return exact;
        float way = offset * Scale;
        var random = new SceneRandom(seed);
        var moved = new SceneDescription { Name = exact.Name, Friction = exact.Friction, Damping = exact.Damping };
        moved.Shapes.AddRange(exact.Shapes);
        foreach (SceneBody body in exact.Bodies)
        {
            if (body.Kind != SceneBodyKind.Dynamic)
            {
                moved.Bodies.Add(body);
                continue;
            }
            var moves = new Vector3(random.Next(-way, way), 0, random.Next(-way, way)) * FreeAxes;
            moved.AddDynamic(body.Children[0].Shape, body.Mass, body.Position + moves, body.Orientation);
        }
        return moved;
    }
}
