using System;
using System.Numerics;
using Demos.Scenes;
using Demos.Towers.Structures;

namespace Demos.Towers.Trials;

/// <summary>A box that slides slowly out over the edge of a table, stops there, and stays or tips over.</summary>
static class OverTheEdge
{
    // Widths per second.
    const float RelativeSpeed = .05f;
    const float WaitedSeconds = 5;
    const float TippedHeight = .02f;
    const int Halvings = 10;

    /// <summary>Boxes of a metre and of ten centimetres.</summary>
    public static Trial[] All() => [For("edge-100", 1), For("edge-10", .1f)];

    static Trial For(string name, float width) => new(
        name, FormattableString.Invariant($"a box {width} m wide that slid over an edge: how far its centre is beyond when it tips over"), "% of the width", 0,
        settings => Find(settings, width));

    // Between resting and tipping by halving the way.
    static double Find(TowerSettings settings, float width)
    {
        double rests = -.1, tips = .4;
        for (int i = 0; i < Halvings; ++i)
        {
            double middle = (rests + tips) / 2;
            if (Tips(settings, width, (float)(middle * width)))
                tips = middle;
            else
                rests = middle;
        }
        return tips * 100;
    }

    static bool Tips(TowerSettings settings, float width, float overhang)
    {
        const float edge = 0;
        float height = width / 2, start = edge - width, speed = RelativeSpeed * width;
        // Friction would turn it while it slides.
        var scene = new SceneDescription { Name = "edge", Friction = 0, Damping = 0 };
        scene.AddStatic(scene.AddBox(2, .5f, 2), new Vector3(edge - 2, -.5f, 0));
        scene.AddBox(new Vector3(width, height, width), new Vector3(start, height / 2, 0));
        using var world = new TowerWorld(scene, settings);
        int steps = (int)((overhang - start) / (speed * settings.StepDuration));
        for (int i = 0; i < steps; ++i)
        {
            world[0].Velocity.Linear.X = speed;
            world.Step(settings.StepDuration);
        }
        for (float time = 0; time < WaitedSeconds; time += settings.StepDuration)
        {
            // What rests is pushed nowhere.
            world[0].Velocity.Linear.X = 0;
            world.Step(settings.StepDuration);
            if (world.Position(0).Y < height / 2 - TippedHeight * width)
                return true;
        }
        return false;
    }
}
