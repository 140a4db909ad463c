using System;
using System.Numerics;

namespace Demos.Scenes.BuiltIn;

/// <summary>Dynamic meshes on a mesh: rings of triangles that fall over each other on a hollow of triangles.</summary>
static class Tori
{
    const int RingCount = 20, TubeCount = 10, CellCount = 24, Side = 3, Layers = 4;
    const float Radius = .5f, TubeRadius = .18f;

    public static BuiltInScene Scene { get; } = new("tori", "36 dynamic meshes of 400 triangles dropped on a mesh of 1,152, by --seed", Create);

    static SceneDescription Create(int seed)
    {
        var random = new SceneRandom(seed);
        var scene = new SceneDescription { Name = Scene.Name, Steps = 600 };
        int torus = AddTorus(scene);
        scene.AddStatic(AddHollow(scene), Vector3.Zero);
        for (int i = 0; i < Side * Side * Layers; ++i)
        {
            var cell = new Vector3(i % Side - (Side - 1) / 2f, i / (Side * Side), i / Side % Side - (Side - 1) / 2f);
            scene.AddDynamic(torus, 1, cell * 1.5f + new Vector3(0, 2, 0), random.NextRotation());
        }
        return scene;
    }

    static int AddTorus(SceneDescription scene)
    {
        var vertices = new Vector3[RingCount * TubeCount];
        var indices = new int[6 * vertices.Length];
        for (int i = 0; i < vertices.Length; ++i)
        {
            double ring = 2 * Math.PI * (i / TubeCount) / RingCount, tube = 2 * Math.PI * (i % TubeCount) / TubeCount;
            double distance = Radius + TubeRadius * Math.Cos(tube);
            vertices[i] = new((float)(distance * Math.Cos(ring)), (float)(TubeRadius * Math.Sin(tube)), (float)(distance * Math.Sin(ring)));
            int nextRing = (i / TubeCount + 1) % RingCount * TubeCount, nextTube = (i % TubeCount + 1) % TubeCount;
            int a = i, b = i / TubeCount * TubeCount + nextTube, c = nextRing + i % TubeCount, d = nextRing + nextTube;
            ReadOnlySpan<int> corners = [a, b, c, b, d, c];
            corners.CopyTo(indices.AsSpan(6 * i));
        }
        return scene.AddMesh(vertices, indices);
    }

    // A bowl of 12 m, a metre deep, so that nothing leaves it.
    static int AddHollow(SceneDescription scene)
    {
        const int Row = CellCount + 1;
        var vertices = new Vector3[Row * Row];
        var indices = new int[6 * CellCount * CellCount];
        for (int i = 0; i < vertices.Length; ++i)
        {
            float x = (i / Row - CellCount / 2) * .5f, z = (i % Row - CellCount / 2) * .5f;
            vertices[i] = new(x, (x * x + z * z) / 36, z);
        }
        for (int cell = 0; cell < CellCount * CellCount; ++cell)
        {
            int a = cell / CellCount * Row + cell % CellCount, b = a + 1, c = a + Row, d = c + 1;
            ReadOnlySpan<int> corners = [a, b, c, b, d, c];
            corners.CopyTo(indices.AsSpan(6 * cell));
        }
        return scene.AddMesh(vertices, indices);
    }
}
