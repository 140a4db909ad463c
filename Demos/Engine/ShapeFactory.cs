using System;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using Demos.Running;
using Demos.Scenes;

namespace Demos.Engine;

/// <summary>Makes the library's shapes out of the scene's: those that it has.</summary>
sealed class ShapeFactory(Simulation simulation)
{
    public static bool SupportsCompounds => false;

    public static bool Supports(SceneShapeKind kind) => kind != SceneShapeKind.Mesh;

    /// <summary>Adds a shape.</summary>
    /// <param name="shape">The scene's shape.</param>
    /// <param name="solid">Whether a body of this shape has mass; without meaning to shapes that are their own centre.</param>
    public BuiltShape Build(SceneShape shape, bool solid)
    {
        (float x, float y, float z) = (shape.Size.X, shape.Size.Y, shape.Size.Z);
        return shape.Kind switch
        {
            SceneShapeKind.Box => Convex(new Box(2 * x, 2 * y, 2 * z), 8.0 * x * y * z),
            SceneShapeKind.Sphere => Convex(new Sphere(x), 4 / 3.0 * Math.PI * x * x * x),
            SceneShapeKind.Capsule => Convex(new Capsule(x, 2 * y), Math.PI * x * x * (4 / 3.0 * x + 2.0 * y)),
            SceneShapeKind.Cylinder => Convex(new Cylinder(x, 2 * y), 2 * Math.PI * x * x * y),
            SceneShapeKind.Hull => Hull(shape),
            _ => throw new SceneException(shape.Line, shape.Word, $"'{shape.Word}' is not supported yet"),
        };
    }

    /// <summary>Never called while <see cref="SupportsCompounds"/> is false.</summary>
    public BuiltShape BuildCompound(ReadOnlySpan<(BuiltShape Shape, SceneChild Child)> children, bool solid) =>
        throw new NotSupportedException("This library has no compounds yet.");

    BuiltShape Hull(SceneShape shape)
    {
        if (!ConvexHullHelper.TryCreateShape(shape.Points, simulation.BufferPool, out Vector3 center, out ConvexHull hull, out _))
            throw new SceneException(shape.Line, shape.Word, "the points of the hull enclose no volume");
        return Convex(hull, HullVolume.Of(hull), center);
    }

    BuiltShape Convex<TShape>(TShape shape, double volume, Vector3 center = default) where TShape : unmanaged, IConvexShape =>
        new(simulation.Shapes.Add(shape), center, volume, shape.ComputeInertia);
}
