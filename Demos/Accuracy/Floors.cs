using System;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;

namespace Demos.Accuracy;

/// <summary>Static floors of every kind, their surfaces through the origin of a pose, its Y axis their normal.</summary>
static class Floors
{
    public const string Box = "box";
    public const string Hull = "hull";
    public const string Triangle = "triangle";
    public const string Pair = "two triangles";
    public const string Boxes = "two boxes";

    public static readonly string[] Flat = [Box, Hull, Triangle, .. EngineFloors.Flat, Pair];

    /// <summary>Adds a floor of at least this size.</summary>
    /// <param name="solids">Owner of the floor's hull, if it has one.</param>
    /// <param name="kind">One of <see cref="Flat"/>.</param>
    /// <param name="surface">Pose of the surface.</param>
    /// <param name="from">Least X that the floor reaches.</param>
    /// <param name="to">Greatest X that the floor reaches.</param>
    /// <param name="halfWidth">Greatest Z that the floor reaches.</param>
    public static void Add(Solids solids, string kind, RigidPose surface, float from, float to, float halfWidth)
    {
        var world = solids.World;
        // A triangle narrows towards its tip; where the floor ends it is still as wide as the others.
        float tip = 2 * to - from;
        var triangle = new Triangle(new(from, 0, -2 * halfWidth), new(tip, 0, 0), new(from, 0, 2 * halfWidth));
        switch (kind)
        {
            case Box:
                var center = new Vector3((from + to) / 2, -1, 0);
                world.AddStatic(new Box(to - from, 2, 2 * halfWidth), surface with { Position = Place(surface, center) });
                break;
            case Hull:
                Vector3[] corners =
                [
                    new(from, 0, -halfWidth), new(from, 0, halfWidth), new(to, 0, -halfWidth), new(to, 0, halfWidth),
                    new(from, -2, -halfWidth), new(from, -2, halfWidth), new(to, -2, -halfWidth), new(to, -2, halfWidth),
                ];
                var hull = solids.Keep(corners, out var middle);
                world.AddStatic(hull, surface with { Position = Place(surface, middle) });
                break;
            case Triangle:
                world.AddStatic(triangle, surface);
                break;
            case Pair:
                // The edge between them runs straight under what lies at the origin, and not along an axis.
                var first = new Vector3(from, 0, -halfWidth);
                var second = new Vector3(to, 0, halfWidth);
                world.AddStatic(new Triangle(first, second, new(from, 0, halfWidth)), surface);
                world.AddStatic(new Triangle(first, new(to, 0, -halfWidth), second), surface);
                break;
            case Boxes:
                // Side by side; they meet under the X axis.
                foreach (float side in (ReadOnlySpan<float>)[-.5f, .5f])
                {
                    var middleOfBox = new Vector3((from + to) / 2, -1, side * halfWidth);
                    world.AddStatic(new Box(to - from, 2, halfWidth), surface with { Position = Place(surface, middleOfBox) });
                }
                break;
            default:
                if (!EngineFloors.TryAdd(world, kind, surface, triangle))
                    throw new ArgumentOutOfRangeException(nameof(kind), kind, null);
                break;
        }
    }

    static Vector3 Place(RigidPose pose, Vector3 local) => pose.Position + Vector3.Transform(local, pose.Orientation);
}
