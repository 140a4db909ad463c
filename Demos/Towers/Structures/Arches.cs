using System.Collections.Generic;
using System.Numerics;
using Demos.Scenes;

namespace Demos.Towers.Structures;

/// <summary>Half circles of wedges. They stand if they are thick enough for a line of thrust: from .1075 of the radius on (Milankovitch 1907).</summary>
static class Arches
{
    const int Wedges = 13;
    const float Depth = .8f;

    /// <summary>A thick arch, one of a little more than the least thickness, and one that is too thin.</summary>
    public static IEnumerable<Structure> All()
    {
        yield return Arch("arch-20", "arch of 13 wedges, as thick as .2 of its radius", .2f);
        yield return Arch("arch-12", "arch of 13 wedges, as thick as .12 of its radius", .12f);
        yield return Arch("arch-08", "arch of 13 wedges, as thick as .08 of its radius: it falls", .08f, stands: false);
    }

    static Structure Arch(string name, string summary, float thickness, bool stands = true) =>
        new(name, summary, () => Create(name, thickness)) { FreeAxes = Vector3.UnitZ, Stands = stands };

    static SceneDescription Create(string name, float thickness)
    {
        const float radius = 2;
        float inner = radius * (1 - thickness / 2), outer = radius * (1 + thickness / 2);
        SceneDescription scene = Ground.Create(name);
        for (int i = 0; i < Wedges; ++i)
        {
            float middle = (i + .5f) * float.Pi / Wedges, half = float.Pi / Wedges / 2;
            Vector3 center = Point(middle, radius, 0);
            var points = new List<Vector3>();
            foreach (float angle in new[] { middle - half, middle + half })
            {
                foreach (float distance in new[] { inner, outer })
                {
                    points.Add(Point(angle, distance, -Depth / 2) - center);
                    points.Add(Point(angle, distance, Depth / 2) - center);
                }
            }
            float area = (outer * outer - inner * inner) * float.Sin(half) * float.Cos(half);
            scene.AddDynamic(scene.AddHull([.. points]), area * Depth * Ground.Density, center);
        }
        return scene;
    }

    static Vector3 Point(float angle, float distance, float z) => new(distance * float.Cos(angle), distance * float.Sin(angle), z);
}
