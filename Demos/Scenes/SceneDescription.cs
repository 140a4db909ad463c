using System.Collections.Generic;
using System.Numerics;

namespace Demos.Scenes;

/// <summary>
/// An initial state and nothing else, in metres, kilograms, seconds and radians; y is up and gravity is (0, -10, 0).
/// </summary>
public sealed class SceneDescription
{
    /// <summary>Acceleration of every dynamic body along y, in metres per second squared.</summary>
    public const float Gravity = -10;

    public required string Name { get; init; }

    /// <summary>How many steps of 1/60 s a comparison runs.</summary>
    public int Steps { get; init; } = 300;

    /// <summary>Coefficient of every pair.</summary>
    public float Friction { get; init; } = 0.5f;

    /// <summary>Rate in 1/s at which dynamic bodies lose velocity.</summary>
    public float Damping { get; init; } = 0.05f;

    /// <summary>Whether bodies may sleep.</summary>
    public bool Sleep { get; init; }

    public List<SceneShape> Shapes { get; } = [];

    public List<SceneBody> Bodies { get; } = [];

    public List<SceneJoint> Joints { get; } = [];

    /// <summary>Adds a box given by its half extents and returns its number.</summary>
    public int AddBox(float halfWidth, float halfHeight, float halfLength) =>
        Add(new SceneShape { Kind = SceneShapeKind.Box, Size = new Vector3(halfWidth, halfHeight, halfLength) });

    /// <summary>Adds a sphere and returns its number.</summary>
    public int AddSphere(float radius) => Add(new SceneShape { Kind = SceneShapeKind.Sphere, Size = new Vector3(radius, 0, 0) });

    /// <summary>Adds a capsule along local y and returns its number.</summary>
    public int AddCapsule(float radius, float halfLength) =>
        Add(new SceneShape { Kind = SceneShapeKind.Capsule, Size = new Vector3(radius, halfLength, 0) });

    /// <summary>Adds a cylinder along local y and returns its number.</summary>
    public int AddCylinder(float radius, float halfLength) =>
        Add(new SceneShape { Kind = SceneShapeKind.Cylinder, Size = new Vector3(radius, halfLength, 0) });

    /// <summary>Adds the convex hull of points and returns its number.</summary>
    public int AddHull(Vector3[] points) => Add(new SceneShape { Kind = SceneShapeKind.Hull, Points = points });

    /// <summary>Adds a mesh and returns its number; triangles are counter-clockwise seen from their front.</summary>
    public int AddMesh(Vector3[] vertices, int[] indices) => Add(new SceneShape { Kind = SceneShapeKind.Mesh, Points = vertices, Indices = indices });

    /// <summary>Adds a static body of one shape and returns its number.</summary>
    public int AddStatic(int shape, Vector3 position, Quaternion? orientation = null) => Add(new SceneBody
    {
        Kind = SceneBodyKind.Static,
        Children = [new SceneChild(shape, Vector3.Zero, Quaternion.Identity)],
        Position = position,
        Orientation = orientation ?? Quaternion.Identity,
    });

    /// <summary>Adds a dynamic body of one shape and returns its number.</summary>
    public int AddDynamic(int shape, float mass, Vector3 position, Quaternion? orientation = null,
        Vector3 linearVelocity = default, Vector3 angularVelocity = default, int group = 0) => Add(new SceneBody
        {
            Kind = SceneBodyKind.Dynamic,
            Children = [new SceneChild(shape, Vector3.Zero, Quaternion.Identity)],
            Mass = mass,
            Position = position,
            Orientation = orientation ?? Quaternion.Identity,
            LinearVelocity = linearVelocity,
            AngularVelocity = angularVelocity,
            Group = group,
        });

    int Add(SceneShape shape)
    {
        Shapes.Add(shape);
        return Shapes.Count - 1;
    }

    int Add(SceneBody body)
    {
        Bodies.Add(body);
        return Bodies.Count - 1;
    }
}
