using System.Numerics;
using Demos.Scenes;

namespace Demos.Towers.Structures;

/// <summary>Hulls by lot with a flat end below and another above.</summary>
static class FlatHull
{
    // Corners of each end. Each has a sector of its own, so that no end is a sliver.
    const int Corners = 6;

    /// <summary>Points around the origin, which lies halfway between the ends.</summary>
    /// <param name="random">Draws the corners.</param>
    /// <param name="radius">Distance of a corner from the axis at most, m; at least three quarters of it.</param>
    /// <param name="height">Distance of the ends, m.</param>
    public static Vector3[] Create(SceneRandom random, float radius, float height)
    {
        var points = new Vector3[2 * Corners];
        for (int i = 0; i < points.Length; ++i)
        {
            float angle = (i % Corners + random.Next(0, .6f)) * float.Tau / Corners;
            float distance = radius * random.Next(.75f, 1);
            points[i] = new Vector3(distance * float.Cos(angle), (i < Corners ? -.5f : .5f) * height, distance * float.Sin(angle));
        }
        return points;
    }
}
