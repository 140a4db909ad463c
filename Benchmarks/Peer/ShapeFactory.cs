using System;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuUtilities.Memory;
using Demos.Running;
using Demos.Scenes;

namespace Demos.Engine;

/// <summary>Makes the engine's shapes out of the scene's: all of them.</summary>
sealed class ShapeFactory(Simulation simulation)
{
    /// <summary>From this many children on a tree pays.</summary>
    const int BigCompoundChildCount = 16;

    readonly BufferPool pool = simulation.BufferPool;
    readonly Shapes shapes = simulation.Shapes;

    public static bool SupportsCompounds => true;

    public static bool Supports(SceneShapeKind kind) => Enum.IsDefined(kind);

    /// <summary>Whether a shape may be a part of a body that is made of several: there, convex ones alone.</summary>
    public static bool SupportsAsPart(SceneShapeKind kind) => kind is not (SceneShapeKind.Mesh or SceneShapeKind.Field);

    /// <summary>Adds a shape.</summary>
    /// <param name="shape">The scene's shape.</param>
    /// <param name="solid">Whether a body of this shape has mass; matters to a mesh, which then is taken as closed.</param>
    public BuiltShape Build(SceneShape shape, bool solid)
    {
        (float x, float y, float z) = (shape.Size.X, shape.Size.Y, shape.Size.Z);
        switch (shape.Kind)
        {
            case SceneShapeKind.Box:
                return Convex(new Box(2 * x, 2 * y, 2 * z), default, 8.0 * x * y * z);
            case SceneShapeKind.Sphere:
                return Convex(new Sphere(x), default, 4 / 3.0 * Math.PI * x * x * x);
            case SceneShapeKind.Capsule:
                return Convex(new Capsule(x, 2 * y), default, Math.PI * x * x * (4 / 3.0 * x + 2.0 * y));
            case SceneShapeKind.Cylinder:
                return Convex(new Cylinder(x, 2 * y), default, 2 * Math.PI * x * x * y);
            case SceneShapeKind.Hull:
                return Hull(shape);
            case SceneShapeKind.Field:
                return Mesh(TrianglesOf(shape), false);
            default:
                return Mesh(shape, solid);
        }
    }

    /// <summary>Adds a shape made of others.</summary>
    /// <param name="children">The parts and where they are in the body's frame.</param>
    /// <param name="solid">Whether the body has mass: then the centre of mass becomes the shape's origin.</param>
    public BuiltShape BuildCompound(ReadOnlySpan<(BuiltShape Shape, SceneChild Child)> children, bool solid)
    {
        double volume = 0;
        foreach ((BuiltShape shape, SceneChild _) in children)
            volume += shape.Volume;
        using var builder = new CompoundBuilder(pool, shapes, children.Length);
        foreach ((BuiltShape shape, SceneChild child) in children)
        {
            var pose = new RigidPose(child.Position + SceneMath.Rotate(shape.Center, child.Orientation), child.Orientation);
            builder.Add(shape.Index, pose, shape.Inertia((float)(shape.Volume / volume)));
        }
        Buffer<CompoundChild> parts;
        Vector3 center = default;
        BodyInertia unitInertia = default;
        if (solid)
            builder.BuildDynamicCompound(out parts, out unitInertia, out center);
        else
            builder.BuildKinematicCompound(out parts);
        TypedIndex index = parts.Length >= BigCompoundChildCount
            ? shapes.Add(new BigCompound(parts, shapes, pool))
            : shapes.Add(new Compound(parts));
        return new BuiltShape(index, center, volume, mass => new BodyInertia
        {
            InverseMass = unitInertia.InverseMass / mass,
            InverseInertiaTensor = unitInertia.InverseInertiaTensor * (1 / mass),
        });
    }

    BuiltShape Convex<TShape>(TShape shape, Vector3 center, double volume) where TShape : unmanaged, IConvexShape =>
        new(shapes.Add(shape), center, volume, shape.ComputeInertia);

    BuiltShape Hull(SceneShape shape)
    {
        if (!ConvexHullHelper.CreateShape(shape.Points, pool, out Vector3 center, out ConvexHull hull))
            throw new SceneException(shape.Line, shape.Word, "the points of the hull enclose no volume");
        return Convex(hull, center, HullVolume.Of(hull));
    }

    /// <summary>The engine has no height fields: the triangles of one.</summary>
    static SceneShape TrianglesOf(SceneShape field)
    {
        int row = field.RowLength, rowCount = field.Heights.Length / row;
        var points = new Vector3[field.Heights.Length];
        for (int i = 0; i < points.Length; ++i)
            points[i] = new(i % row * field.Size.X, field.Heights[i], i / row * field.Size.Z);
        var indices = new int[6 * (row - 1) * (rowCount - 1)];
        for (int cell = 0, next = 0; cell < (row - 1) * (rowCount - 1); ++cell)
        {
            int a = cell / (row - 1) * row + cell % (row - 1), b = a + 1, c = a + row, d = c + 1;
            ReadOnlySpan<int> corners = [a, c, b, b, c, d];
            corners.CopyTo(indices.AsSpan(next));
            next += corners.Length;
        }
        return new SceneShape { Kind = SceneShapeKind.Mesh, Points = points, Indices = indices, Line = field.Line };
    }

    BuiltShape Mesh(SceneShape shape, bool solid)
    {
        int count = shape.Indices.Length / 3;
        pool.Take(count, out Buffer<Triangle> triangles);
        for (int i = 0; i < count; ++i)
        {
            // The engine sees the side from which a triangle is clockwise.
            ReadOnlySpan<int> corners = shape.Indices.AsSpan(3 * i, 3);
            triangles[i] = new Triangle(shape.Points[corners[0]], shape.Points[corners[2]], shape.Points[corners[1]]);
        }
        var mesh = new Mesh(triangles, Vector3.One, pool);
        Vector3 center = default;
        if (solid)
        {
            center = mesh.ComputeClosedCenterOfMass();
            mesh.Recenter(center);
        }
        return new BuiltShape(shapes.Add(mesh), center, 0, mesh.ComputeClosedInertia);
    }
}
