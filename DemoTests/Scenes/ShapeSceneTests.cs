using System;
using System.Linq;
using Demos.Accuracy;
using Demos.References;
using Demos.Scenes;
using DemoTests.Accuracy;
using Xunit;
using Xunit.Abstractions;

namespace DemoTests.Scenes;

/// <summary>The built-in scenes of cylinders and hulls do what they are there for (R4).</summary>
public class ShapeSceneTests(ITestOutputHelper output)
{
    const string Settings = "s4 i1";

    /// <summary>Ten seconds, at four substeps reported: so high a stack falls then, of boxes still earlier.</summary>
    [Theory]
    [InlineData(4)]
    [InlineData(16)]
    public void The_tower_of_cylinders_stands(int substeps)
    {
        using var world = new ShapeProbe(SceneLibrary.Load("cylinder-tower", 1), substeps);
        int count = world.BodyCount;
        var start = Enumerable.Range(0, count).Select(world.Position).ToArray();
        double lean = 0, earlyTop = 0;
        for (int second = 0; second < 10; ++second)
        {
            world.Step(60);
            for (int i = 0; i < count; ++i)
            {
                var way = world.Position(i) - start[i];
                lean = Tally.Most(lean, Math.Sqrt(way.X * way.X + way.Z * way.Z));
            }
            if (second == 1)
                earlyTop = world.Position(count - 1).Y;
        }
        double tilt = Enumerable.Range(0, count).Max(i =>
        {
            var up = world.Orientation(i).Rotate(new(0, 1, 0));
            return Math.Atan2(Math.Sqrt(up.X * up.X + up.Z * up.Z), up.Y) * 180 / Math.PI;
        });
        new CaseResult("R4", "scene cylinder-tower", $"s{substeps} i1")
            // What a column of springs gives way at 16 substeps, 40^2 / 2 loads of 34 um, is 28 mm.
            .Limit("sinking", start[^1].Y - world.Position(count - 1).Y, .1, "m")
            .Limit("lean", lean, .1, "m")
            .Limit("tilt", tilt, .5, "degrees")
            .Note("sinking from the second second on", earlyTop - world.Position(count - 1).Y, "m")
            .Note("greatest speed", world.Speeds().Greatest, "m/s")
            .Finish(output);
    }

    /// <summary>Everything rolls straight down at the rate of its kind, without slip.</summary>
    [Fact]
    public void Rolling_follows_its_closed_forms()
    {
        const double angle = Math.PI / 9, time = 3;
        var scene = SceneLibrary.Load("rolling", 1);
        using var world = new ShapeProbe(scene);
        var dynamics = scene.Bodies.FindAll(body => body.Kind == SceneBodyKind.Dynamic);
        var start = Enumerable.Range(0, world.BodyCount).Select(world.Position).ToArray();
        var startAxis = Enumerable.Range(0, world.BodyCount).Select(i => world.Orientation(i).Rotate(new(0, 1, 0))).ToArray();
        world.Step(180);
        foreach (var kind in (ReadOnlySpan<SceneShapeKind>)[SceneShapeKind.Sphere, SceneShapeKind.Cylinder, SceneShapeKind.Capsule])
        {
            double distance = 0, aside = 0, turned = 0;
            for (int i = 0; i < world.BodyCount; ++i)
            {
                var shape = scene.Shapes[dynamics[i].Children[0].Shape];
                if (shape.Kind != kind)
                    continue;
                var way = world.Position(i) - start[i];
                double down = -(way.X * Math.Cos(angle) + way.Y * Math.Sin(angle));
                double expected = -SceneDescription.Gravity * Math.Sin(angle) / (1 + Gyration(shape)) * time * time / 2;
                distance = Tally.Worst(distance, down / expected - 1);
                aside = Tally.Worst(aside, way.Z / down);
                var axis = world.Orientation(i).Rotate(new(0, 1, 0));
                if (kind != SceneShapeKind.Sphere)
                    turned = Tally.Most(turned, Math.Atan2(Double3.Cross(axis, startAxis[i]).Length, Double3.Dot(axis, startAxis[i])) * 180 / Math.PI);
            }
            new CaseResult("R4", $"scene rolling, {kind}", Settings)
                .Limit("distance", distance, .02, "%")
                .Limit("aside per metre", aside, .001)
                .Limit("axis turned", turned, .5, "degrees")
                .Finish(output);
        }
    }

    /// <summary>Six layers: the depth of a contact grows with the weight above it, and with the ratio of the masses.</summary>
    [Theory]
    [InlineData("shape-pile", 6, 6)]
    [InlineData("hull-pile", 6, 6)]
    public void Small_piles_come_to_rest(string name, int columns, int layers)
    {
        var scene = SmallScenes.Pile(name, columns, layers);
        using var world = new ShapeProbe(scene);
        world.Step(600);
        var depths = world.TakeDepths();
        (double greatest, double meanSquare) = world.Speeds();
        int lost = Enumerable.Range(0, world.BodyCount).Count(i => !IsInside(world.Position(i), columns * .65 + .2));
        new CaseResult("R4", $"{scene.Name} of {world.BodyCount}", Settings)
            .Limit("lost", lost, 0)
            .Limit("depth p99", depths[depths.Count * 99 / 100], .006, "m")
            .Limit("mean speed", meanSquare, .02, "m/s")
            .Note("deepest", depths[^1], "m")
            .Note("contacts", depths.Count)
            .Note("greatest speed", greatest, "m/s")
            .Finish(output);
    }

    [Fact]
    public void The_coins_lie_flat_and_still()
    {
        const float halfHeight = .03f;
        var scene = SceneLibrary.Load("coins", 1);
        using var world = new SceneWorld(scene, 1);
        for (int i = 0; i < scene.Steps; ++i)
            world.Step();
        double spin = 0, speed = 0, height = 0, lean = 0;
        int unsettled = 0;
        ref var set = ref world.Simulation.Bodies.ActiveSet;
        for (int i = 0; i < set.Count; ++i)
        {
            ref var state = ref set.MotionStates[i];
            double bodySpin = ((Double3)state.Velocity.Angular).Length;
            var up = ((DoubleQuaternion)state.Pose.Orientation).Rotate(new(0, 1, 0));
            spin = Tally.Most(spin, bodySpin);
            speed = Tally.Most(speed, ((Double3)state.Velocity.Linear).Length);
            height = Tally.Worst(height, state.Pose.Position.Y - halfHeight);
            lean = Tally.Most(lean, Math.Atan2(Math.Sqrt(up.X * up.X + up.Z * up.Z), Math.Abs(up.Y)) * 180 / Math.PI);
            if (bodySpin >= .001)
                ++unsettled;
        }
        new CaseResult("R4", "scene coins", Settings)
            .Limit("unsettled", unsettled, 0)
            .Limit("spin", spin, .001, "rad/s")
            .Limit("speed", speed, .001, "m/s")
            .Limit("height", height, .001, "m")
            .Limit("lean", lean, .5, "degrees")
            .Finish(output);
    }

    static bool IsInside(Double3 position, double halfWidth) =>
        position.IsFinite && position.Y > 0 && Math.Abs(position.X) < halfWidth && Math.Abs(position.Z) < halfWidth;

    /// <summary>Moment of inertia about the axis that it rolls about, in units of its mass and the square of its radius.</summary>
    static double Gyration(SceneShape shape)
    {
        (double radius, double halfLength) = (shape.Size.X, shape.Size.Y);
        switch (shape.Kind)
        {
            case SceneShapeKind.Sphere:
                return 2 / 5d;
            case SceneShapeKind.Cylinder:
                return 1 / 2d;
            default:
                double barrel = 2 * halfLength, ends = 4 / 3d * radius;
                return (barrel / 2 + ends * 2 / 5) / (barrel + ends);
        }
    }
}
