using System.Collections.Generic;
using System.Numerics;
using Demos.Scenes;

namespace Demos.Towers.Structures;

/// <summary>Bricks in bond: each lies over the joint of the two below.</summary>
static class Walls
{
    static readonly Vector3 brick = new(.5f, .25f, .25f);
    // Between neighbours of a row, so that they do not push each other.
    const float Joint = .005f;

    /// <summary>A wall of 16 rows, one of 30, one with a doorway, and one of rough stones.</summary>
    public static IEnumerable<Structure> All()
    {
        yield return Wall("wall-16", "brick wall of 16 rows by 10", 16, 10, 0);
        yield return Wall("wall-30", "brick wall of 30 rows by 10", 30, 10, 0);
        yield return Wall("wall-door", "brick wall of 16 rows by 10 with a doorway", 16, 10, 8);
        yield return new("dry-stone", "dry stone wall of 8 rows by 6 hulls by lot", DryStone) { FreeAxes = Vector3.UnitZ };
    }

    static Structure Wall(string name, string summary, int rows, int length, int doorRows) =>
        new(name, summary, () => Bricks(name, rows, length, doorRows)) { FreeAxes = Vector3.UnitZ };

    static SceneDescription Bricks(string name, int rows, int length, int doorRows)
    {
        SceneDescription scene = Ground.Create(name);
        float pitch = brick.X;
        // The doorway is two bricks wide, and its lintel four long.
        float doorHalf = pitch, lintelHalf = 2 * pitch;
        for (int row = 0; row < rows; ++row)
        {
            float y = (row + .5f) * brick.Y;
            float half = length * pitch / 2;
            bool isDoor = row < doorRows, isLintel = doorRows > 0 && row == doorRows;
            if (!isDoor && !isLintel)
            {
                AddRow(scene, -half, half, row, y);
                continue;
            }
            float gap = isDoor ? doorHalf : lintelHalf;
            AddRow(scene, -half, -gap, row, y);
            AddRow(scene, gap, half, row, y);
            if (isLintel)
                scene.AddBox(brick with { X = 2 * lintelHalf - Joint }, new Vector3(0, y, 0));
        }
        return scene;
    }

    // Every other row begins and ends with half a brick.
    static void AddRow(SceneDescription scene, float from, float to, int row, float y)
    {
        float x = from;
        while (x < to - Joint)
        {
            float width = x == from && row % 2 == 1 ? brick.X / 2 : float.Min(brick.X, to - x);
            scene.AddBox(brick with { X = width - Joint }, new Vector3(x + width / 2, y, 0));
            x += width;
        }
    }

    static SceneDescription DryStone()
    {
        const float height = .3f, radius = .3f, pitch = .6f;
        SceneDescription scene = Ground.Create("dry-stone");
        var random = new SceneRandom(7);
        for (int row = 0; row < 8; ++row)
        {
            for (int i = 0; i < 6 - row % 2; ++i)
            {
                int stone = scene.AddHull(FlatHull.Create(random, radius, height));
                float x = (i + row % 2 * .5f) * pitch;
                scene.AddDynamic(stone, radius * radius * 3 * height * Ground.Density, new Vector3(x, (row + .5f) * height, 0));
            }
        }
        return scene;
    }
}
