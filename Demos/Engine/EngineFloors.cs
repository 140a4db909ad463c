using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;

namespace Demos.Accuracy;

/// <summary>Floors of the suite that other engines with this surface do not have: triangles with two sides, half-spaces.</summary>
static class EngineFloors
{
    const string TwoSided = "two-sided triangle";
    const string Back = "back of a two-sided triangle";
    const string Plane = "half-space";

    public static readonly string[] Flat = [TwoSided, Back, Plane];

    /// <summary>Adds a floor.</summary>
    /// <param name="world">World to add to.</param>
    /// <param name="kind">One of <see cref="Flat"/>; false is returned for another.</param>
    /// <param name="surface">Pose of the surface.</param>
    /// <param name="triangle">A triangle in the surface that is as large as the floor must be, its front above.</param>
    public static bool TryAdd(AccuracyWorld world, string kind, RigidPose surface, in Triangle triangle)
    {
        switch (kind)
        {
            case TwoSided:
                world.AddStatic(triangle with { TwoSided = true }, surface);
                return true;
            case Back:
                world.AddStatic(new Triangle(triangle.A, triangle.C, triangle.B) { TwoSided = true }, surface);
                return true;
            case Plane:
                world.AddStatic(new HalfSpace(Vector3.UnitY), surface);
                return true;
            default:
                return false;
        }
    }
}
