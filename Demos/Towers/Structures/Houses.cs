using System.Collections.Generic;
using System.Numerics;
using Demos.Scenes;

namespace Demos.Towers.Structures;

/// <summary>Uprights and what lies on them, cards that lean against each other, and blocks in threes.</summary>
static class Houses
{
    /// <summary>A house of five storeys, one of cards, and two towers of blocks.</summary>
    public static IEnumerable<Structure> All()
    {
        yield return new("house", "house of five storeys of uprights and lintels", () => House("house", .4f)) { FreeAxes = Vector3.UnitZ };
        yield return new("slim-house", "house of five storeys on uprights of 5 cm", () => House("slim-house", .05f)) { FreeAxes = Vector3.UnitZ };
        yield return new("card-house", "card house of three storeys", CardHouse) { FreeAxes = Vector3.UnitZ };
        yield return new("jenga-75", "18 layers of blocks of 75 x 15 x 25 cm", () => Jenga("jenga-75", .75f));
        yield return new("jenga-7.5", "18 layers of blocks of 7.5 x 1.5 x 2.5 cm", () => Jenga("jenga-7.5", .075f)) { Scale = .1f };
    }

    static SceneDescription House(string name, float thickness)
    {
        var upright = new Vector3(thickness, 1.5f, .8f);
        var lintel = new Vector3(3, .3f, .8f);
        SceneDescription scene = Ground.Create(name);
        for (int storey = 0; storey < 5; ++storey)
        {
            float floor = storey * (upright.Y + lintel.Y);
            for (int i = -1; i <= 1; ++i)
                scene.AddBox(upright, new Vector3(i * (lintel.X - upright.X) / 2, floor + upright.Y / 2, 0));
            scene.AddBox(lintel, new Vector3(0, floor + upright.Y + lintel.Y / 2, 0));
        }
        return scene;
    }

    static SceneDescription CardHouse()
    {
        const float lean = .35f, thickness = .02f;
        var card = new Vector3(thickness, 1, .7f);
        // A leaning card stands on its lower corner and touches its twin with the upper one.
        float height = card.Y * float.Cos(lean) + thickness * float.Sin(lean);
        float half = (card.Y * float.Sin(lean) + thickness * float.Cos(lean)) / 2;
        SceneDescription scene = Ground.Create("card-house");
        float floor = 0;
        for (int pairs = 3; pairs > 0; --pairs)
        {
            for (int i = 0; i < pairs; ++i)
            {
                float middle = (i - (pairs - 1) * .5f) * 4 * half;
                scene.AddBox(card, new Vector3(middle - half, floor + height / 2, 0), Ground.Tilt(-lean));
                scene.AddBox(card, new Vector3(middle + half, floor + height / 2, 0), Ground.Tilt(lean));
            }
            floor += height;
            if (pairs == 1)
                break;
            // Each lies from one tip to the next, and on both.
            for (int i = 0; i < pairs - 1; ++i)
                scene.AddBox(new Vector3(4 * half - .001f, thickness, card.Z), new Vector3((i - (pairs - 2) * .5f) * 4 * half, floor + thickness / 2, 0));
            floor += thickness;
        }
        return scene;
    }

    static SceneDescription Jenga(string name, float length)
    {
        var block = new Vector3(length, length / 5, length / 3);
        SceneDescription scene = Ground.Create(name);
        for (int layer = 0; layer < 18; ++layer)
        {
            float y = (layer + .5f) * block.Y;
            for (int i = -1; i <= 1; ++i)
            {
                // A hundredth of the width between neighbours.
                float place = i * block.Z;
                var size = block with { Z = block.Z * .99f };
                if (layer % 2 == 0)
                    scene.AddBox(size, new Vector3(0, y, place));
                else
                    scene.AddBox(new Vector3(size.Z, size.Y, size.X), new Vector3(place, y, 0));
            }
        }
        return scene;
    }
}
