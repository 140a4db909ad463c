using System;
using System.Diagnostics;
using System.Linq;
using System.Numerics;
using System.Threading;
using Demos.Scenes;

namespace Demos.Towers;

/// <summary>One structure in a world of its own, watched until it has fallen or the time is over.</summary>
sealed class TowerRun : IDisposable
{
    // Part of its height, beyond half of its own thickness, that a part loses when its structure has fallen: contacts give way by so much together.
    const float FallenPart = .25f;
    // After the first seconds it has sunk into its contacts.
    const float PushAfter = 2;
    // A structure that has fallen is watched no longer than this: time costs.
    const float WatchedAfterFall = .1f;

    readonly Structure structure;
    readonly TowerSettings settings;
    readonly TowerWorld world;
    readonly float[] halfThicknesses;
    readonly SceneRandom random;
    readonly int top;

    public TowerRun(Structure structure, TowerSettings settings)
    {
        this.structure = structure;
        this.settings = settings;
        random = new SceneRandom(settings.Seed + 1000);
        SceneDescription scene = structure.Build(settings.Offset, settings.Seed);
        world = new TowerWorld(scene, settings);
        halfThicknesses = [.. scene.Bodies.Where(body => body.Kind == SceneBodyKind.Dynamic)
            .Select(body => HalfThickness(scene.Shapes[body.Children[0].Shape]))];
        for (int i = 1; i < world.Starts.Count; ++i)
            top = world.Starts[i].Y > world.Starts[top].Y ? i : top;
    }

    static float HalfThickness(SceneShape shape)
    {
        if (shape.Kind == SceneShapeKind.Cylinder)
            return float.Min(shape.Size.X, shape.Size.Y);
        Vector3 size = 2 * shape.Size;
        if (shape.Points.Length > 0)
            size = shape.Points.Aggregate(Vector3.Max) - shape.Points.Aggregate(Vector3.Min);
        return float.Min(size.X, float.Min(size.Y, size.Z)) / 2;
    }

    /// <summary>Watches the structure.</summary>
    public TowerResult Run(CancellationToken stop = default)
    {
        float? fellAt = null;
        float time = 0;
        bool isPushed = settings.Push == 0;
        int steps = 0;
        var clock = new Stopwatch();
        while (time < settings.Seconds && !(time > fellAt + WatchedAfterFall) && !stop.IsCancellationRequested)
        {
            if (!isPushed && time >= PushAfter)
            {
                world[top].Velocity.Linear += structure.PushAxis * settings.Push;
                isPushed = true;
            }
            float dt = settings.Steps == StepPattern.Even ? settings.StepDuration : settings.StepDuration * random.Next(.5f, 2);
            clock.Start();
            world.Step(dt);
            clock.Stop();
            ++steps;
            time += dt;
            if (fellAt is null && HasFallen())
                fellAt = time;
        }
        double milliseconds = clock.Elapsed.TotalMilliseconds / steps;
        return new(structure.Name, world.Starts.Count, fellAt, world.Starts[top].Y - world.Position(top).Y, Lean(), milliseconds);
    }

    bool HasFallen()
    {
        for (int i = 0; i < world.Starts.Count; ++i)
        {
            if (!(world.Position(i).Y > world.Starts[i].Y * (1 - FallenPart) - halfThicknesses[i]))
                return true;
        }
        return false;
    }

    float Lean()
    {
        float farthest = 0;
        for (int i = 0; i < world.Starts.Count; ++i)
        {
            Vector3 way = world.Position(i) - world.Starts[i];
            farthest = float.Max(farthest, float.Sqrt(way.X * way.X + way.Z * way.Z));
        }
        return farthest;
    }

    public void Dispose() => world.Dispose();
}
