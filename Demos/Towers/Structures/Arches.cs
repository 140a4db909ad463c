using System;
using System.Collections.Generic;
using System.Numerics;
using Demos.Scenes;

namespace Demos.Towers.Structures;

/// <summary>Half circles of wedges. They stand if they are thick enough for a line of thrust: from .1075 of the radius on (Milankovitch 1907).</summary>
static class Arches
{
    const float Radius = 2;
    // Of the radius.
    const float Depth = .4f;

    /// <summary>A thick arch, one of a little more than the least thickness, and one that is too thin.</summary>
    public static IEnumerable<Structure> All()
    {
        yield return Arch("arch-20", 13, .2f);
        yield return Arch("arch-12", 13, .12f);
        yield return Arch("arch-08", 13, .08f, stands: false);
        yield return Arch("arch-7", 7, .14f);
        yield return Arch("arch-31", 31, .13f);
        yield return Arch("arch-10cm", 13, .12f, radius: .1f);
        yield return Arch("arch-40m", 21, .15f, radius: 40);
    }

    static Structure Arch(string name, int wedges, float thickness, float radius = Radius, bool stands = true) =>
        new(name, FormattableString.Invariant($"arch of {wedges} wedges over {2 * radius} m, as thick as {thickness} of its radius"),
            () => Create(name, wedges, thickness, radius))
        { FreeAxes = Vector3.UnitZ, Stands = stands, Scale = radius / Radius };

    static SceneDescription Create(string name, int wedges, float thickness, float radius)
    {
        float inner = radius * (1 - thickness / 2), outer = radius * (1 + thickness / 2), depth = Depth * radius;
        SceneDescription scene = Ground.Create(name);
        for (int i = 0; i < wedges; ++i)
        {
            float middle = (i + .5f) * float.Pi / wedges, half = float.Pi / wedges / 2;
            Vector3 center = Point(middle, radius, 0);
            var points = new List<Vector3>();
            foreach (float angle in new[] { middle - half, middle + half })
            {
                foreach (float distance in new[] { inner, outer })
                {
                    points.Add(Point(angle, distance, -depth / 2) - center);
                    points.Add(Point(angle, distance, depth / 2) - center);
                }
            }
            float area = (outer * outer - inner * inner) * float.Sin(half) * float.Cos(half);
            scene.AddDynamic(scene.AddHull([.. points]), area * depth * Ground.Density, center);
        }
        return scene;
    }

    static Vector3 Point(float angle, float distance, float z) => new(distance * float.Cos(angle), distance * float.Sin(angle), z);
}
