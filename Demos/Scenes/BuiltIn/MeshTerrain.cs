using System;
using System.Numerics;

namespace Demos.Scenes.BuiltIn;

/// <summary>The shapes of the shape pile dropped on hills of triangles.</summary>
static class MeshTerrain
{
    /// <summary>Cells of a square metre on each side of the hills, two triangles each.</summary>
    const int CellCount = 256;
    const int Layers = 5, Columns = 20;
    const float Spacing = 2;

    public static BuiltInScene Scene { get; } = new(
        "mesh-terrain", "2,000 boxes, capsules, spheres, cylinders and hulls on hills of 131,072 triangles, by --seed", Create);

    static SceneDescription Create(int seed)
    {
        var random = new SceneRandom(seed);
        var scene = new SceneDescription { Name = Scene.Name, Steps = 600, Friction = .6f };
        float[] masses = ShapePile.AddPalette(scene, random);
        scene.AddStatic(AddHills(scene), Vector3.Zero);
        for (int i = 0; i < Layers * Columns * Columns; ++i)
        {
            int z = i % Columns, x = i / Columns % Columns, y = i / (Columns * Columns);
            var position = new Vector3((x - (Columns - 1) * .5f) * Spacing, 5 + y * Spacing, (z - (Columns - 1) * .5f) * Spacing);
            scene.AddDynamic(i % masses.Length, masses[i % masses.Length], position, random.NextRotation());
        }
        return scene;
    }

    static int AddHills(SceneDescription scene)
    {
        const int Row = CellCount + 1;
        var vertices = new Vector3[Row * Row];
        var indices = new int[6 * CellCount * CellCount];
        for (int i = 0; i < vertices.Length; ++i)
        {
            double x = i / Row - CellCount / 2, z = i % Row - CellCount / 2;
            vertices[i] = new((float)x, (float)(Math.Sin(.2 * x) + Math.Sin(.17 * z + 1) + Math.Sin(.11 * (x + z))), (float)z);
        }
        for (int cell = 0; cell < CellCount * CellCount; ++cell)
        {
            int a = cell / CellCount * Row + cell % CellCount, b = a + 1, c = a + Row, d = c + 1;
            // Counter-clockwise seen from above.
            ReadOnlySpan<int> corners = [a, b, c, b, d, c];
            corners.CopyTo(indices.AsSpan(6 * cell));
        }
        return scene.AddMesh(vertices, indices);
    }
}
