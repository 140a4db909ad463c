using System;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuUtilities.Memory;
using Demos.Running;
using Demos.Scenes;

namespace Demos.Engine;

/// <summary>Makes the library's shapes out of the scene's: those that it has.</summary>
sealed class ShapeFactory(Simulation simulation)
{
    const int BigCompoundChildCount = 16;

    public static bool SupportsCompounds => true;

    public static bool Supports(SceneShapeKind kind) => Enum.IsDefined(kind);

    /// <summary>Whether a shape may be a part of a body that is made of several.</summary>
    public static bool SupportsAsPart(SceneShapeKind kind) => Supports(kind);

    /// <summary>Adds a shape.</summary>
    /// <param name="shape">The scene's shape.</param>
    /// <param name="solid">Whether a body of this shape has mass; matters to a mesh, which then is taken as closed.</param>
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
            SceneShapeKind.Field => Field(shape),
            _ => Mesh(shape, solid),
        };
    }

    /// <summary>Adds a shape made of others.</summary>
    /// <param name="children">The parts and where they are in the body's frame.</param>
    /// <param name="solid">Whether the body has mass: then the centre of mass becomes the shape's origin.</param>
    public BuiltShape BuildCompound(ReadOnlySpan<(BuiltShape Shape, SceneChild Child)> children, bool solid)
    {
        double volume = 0;
        foreach ((BuiltShape shape, SceneChild _) in children)
            volume += shape.Volume;
        using var builder = new CompoundBuilder(simulation.BufferPool, simulation.Shapes, children.Length);
        foreach ((BuiltShape shape, SceneChild child) in children)
        {
            var pose = new RigidPose(child.Position + SceneMath.Rotate(shape.Center, child.Orientation), child.Orientation);
            if (solid)
                builder.Add(shape.Index, pose, shape.Inertia((float)(shape.Volume / volume)));
            else
                builder.AddForKinematic(shape.Index, pose, 1);
        }
        Buffer<CompoundChild> parts;
        Vector3 center = default;
        BodyInertia unitInertia = default;
        if (solid)
            builder.BuildDynamicCompound(out parts, out unitInertia, out center);
        else
            builder.BuildKinematicCompound(out parts);
        TypedIndex index = parts.Length >= BigCompoundChildCount
            ? simulation.Shapes.Add(new BigCompound(parts, simulation.Shapes, simulation.BufferPool))
            : simulation.Shapes.Add(new Compound(parts));
        return new BuiltShape(index, center, volume, mass => new BodyInertia
        {
            InverseMass = unitInertia.InverseMass / mass,
            InverseInertiaTensor = unitInertia.InverseInertiaTensor * (1 / mass),
        });
    }

    BuiltShape Hull(SceneShape shape)
    {
        if (!ConvexHullHelper.TryCreateShape(shape.Points, simulation.BufferPool, out Vector3 center, out ConvexHull hull, out _))
            throw new SceneException(shape.Line, shape.Word, "the points of the hull enclose no volume");
        return Convex(hull, HullVolume.Of(hull), center);
    }

    BuiltShape Mesh(SceneShape shape, bool solid)
    {
        // The engine's front is the side from which a triangle is clockwise.
        var indices = new int[shape.Indices.Length];
        for (int i = 0; i < indices.Length; i += 3)
            (indices[i], indices[i + 1], indices[i + 2]) = (shape.Indices[i], shape.Indices[i + 2], shape.Indices[i + 1]);
        Mesh mesh = default;
        try
        {
            mesh = new Mesh(shape.Points, indices, Vector3.One, simulation.BufferPool);
            Vector3 center = default;
            float volume = 0;
            if (solid)
            {
                mesh.ComputeClosedCenterOfMass(out volume, out center);
                mesh.Recenter(center);
            }
            return new BuiltShape(simulation.Shapes.Add(mesh), center, volume, mesh.ComputeClosedInertia);
        }
        catch (ArgumentException exception)
        {
            mesh.Dispose(simulation.BufferPool);
            throw new SceneException(shape.Line, shape.Word, exception.Message);
        }
    }

    BuiltShape Field(SceneShape shape)
    {
        int rowCount = shape.Heights.Length / shape.RowLength;
        var field = new HeightField(shape.RowLength, rowCount, shape.Size.X, shape.Size.Z, shape.Heights, simulation.BufferPool);
        return new BuiltShape(simulation.Shapes.Add(field), default, 0, _ => default);
    }

    BuiltShape Convex<TShape>(TShape shape, double volume, Vector3 center = default) where TShape : unmanaged, IConvexShape =>
        new(simulation.Shapes.Add(shape), center, volume, shape.ComputeInertia);
}
