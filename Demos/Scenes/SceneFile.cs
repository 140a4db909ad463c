using System;
using System.IO;
using System.Numerics;

namespace Demos.Scenes;

/// <summary>
/// Reads the scene format: a stream of tokens in a fixed order, each list headed by its count. Whatever is wrong with a file is said
/// with the line and the token; a file cannot make the reader reserve more memory than its own length justifies.
/// </summary>
public static class SceneFile
{
    const int Version = 1;
    static readonly string[] shapeWords = ["box", "sphere", "capsule", "cylinder", "hull", "mesh", "field"];

    /// <summary>Reads a scene from a file.</summary>
    /// <exception cref="SceneException">The content is not a scene.</exception>
    /// <exception cref="IOException">The file cannot be read.</exception>
    public static SceneDescription Read(string path) => Parse(File.ReadAllBytes(path));

    /// <summary>Reads a scene from UTF-8 text.</summary>
    /// <exception cref="SceneException">The content is not a scene.</exception>
    public static SceneDescription Parse(ReadOnlySpan<byte> text)
    {
        var tokens = new SceneTokens(text);
        tokens.Word("scene");
        int version = tokens.Integer("the version of the format", int.MinValue, int.MaxValue);
        if (version != Version)
            throw tokens.Wrong($"version {version} of the format is not known, only {Version}");
        tokens.Word("name");
        string name = tokens.Name("the scene's name");
        tokens.Word("steps");
        int steps = tokens.Integer("the number of steps", 1, int.MaxValue);
        tokens.Word("friction");
        float friction = tokens.NotNegative("friction");
        tokens.Word("damping");
        float damping = tokens.NotNegative("damping");
        tokens.Word("sleep");
        bool sleep = tokens.Integer("sleep", 0, 1) == 1;

        var scene = new SceneDescription { Name = name, Steps = steps, Friction = friction, Damping = damping, Sleep = sleep };
        ReadShapes(ref tokens, scene);
        ReadBodies(ref tokens, scene);
        ReadJoints(ref tokens, scene);
        tokens.End();
        return scene;
    }

    static void ReadShapes(ref SceneTokens tokens, SceneDescription scene)
    {
        tokens.Word("shapes");
        int count = tokens.Integer("the number of shapes", 0, int.MaxValue);
        scene.Shapes.Capacity = Math.Min(count, tokens.MostItemsLeft(2));
        for (int i = 0; i < count; ++i)
            scene.Shapes.Add(ReadShape(ref tokens, i, count));
    }

    static SceneShape ReadShape(ref SceneTokens tokens, int index, int count)
    {
        var kind = (SceneShapeKind)tokens.Word($"shape {index} of {count} (box, sphere, capsule, cylinder, hull, mesh or field)", shapeWords);
        int line = tokens.Line;
        switch (kind)
        {
            case SceneShapeKind.Box:
                var box = new Vector3(tokens.Positive("half width"), tokens.Positive("half height"), tokens.Positive("half length"));
                return new SceneShape { Kind = kind, Size = box, Line = line };
            case SceneShapeKind.Sphere:
                return new SceneShape { Kind = kind, Size = new Vector3(tokens.Positive("radius"), 0, 0), Line = line };
            case SceneShapeKind.Capsule:
                var capsule = new Vector3(tokens.Positive("radius"), tokens.NotNegative("half length"), 0);
                return new SceneShape { Kind = kind, Size = capsule, Line = line };
            case SceneShapeKind.Cylinder:
                var cylinder = new Vector3(tokens.Positive("radius"), tokens.Positive("half height"), 0);
                return new SceneShape { Kind = kind, Size = cylinder, Line = line };
            case SceneShapeKind.Hull:
                int pointCount = tokens.Integer("the number of points", 4, int.MaxValue);
                return new SceneShape { Kind = kind, Points = ReadPoints(ref tokens, pointCount), Line = line };
            case SceneShapeKind.Field:
                return ReadField(ref tokens, line);
            default:
                int vertexCount = tokens.Integer("the number of vertices", 3, int.MaxValue);
                int triangleCount = tokens.Integer("the number of triangles", 1, int.MaxValue / 3);
                Vector3[] vertices = ReadPoints(ref tokens, vertexCount);
                int[] indices = ReadIndices(ref tokens, 3 * triangleCount, vertexCount);
                return new SceneShape { Kind = kind, Points = vertices, Indices = indices, Line = line };
        }
    }

    static SceneShape ReadField(ref SceneTokens tokens, int line)
    {
        int countX = tokens.Integer("the number of samples along x", 2, 1 << 15), countZ = tokens.Integer("the number of samples along z", 2, 1 << 15);
        var distances = new Vector3(tokens.Positive("the distance of samples along x"), 0, tokens.Positive("the distance of samples along z"));
        int count = countX * countZ;
        var heights = new float[Math.Min(count, tokens.MostItemsLeft(1))];
        for (int i = 0; i < count; ++i)
        {
            float height = tokens.Number("a height");
            heights[i] = height;
        }
        return new SceneShape { Kind = SceneShapeKind.Field, Size = distances, RowLength = countX, Heights = heights, Line = line };
    }

    static Vector3[] ReadPoints(ref SceneTokens tokens, int count)
    {
        var points = new Vector3[Math.Min(count, tokens.MostItemsLeft(3))];
        for (int i = 0; i < count; ++i)
        {
            // The array ends where the file has to: past that end the token reader fails before the array is touched.
            Vector3 point = tokens.Vector("a coordinate");
            points[i] = point;
        }
        return points;
    }

    static int[] ReadIndices(ref SceneTokens tokens, int count, int vertexCount)
    {
        int[] indices = new int[Math.Min(count, tokens.MostItemsLeft(1))];
        for (int i = 0; i < count; ++i)
        {
            int index = tokens.Integer("the vertex of a triangle", 0, vertexCount - 1);
            indices[i] = index;
        }
        return indices;
    }

    static void ReadBodies(ref SceneTokens tokens, SceneDescription scene)
    {
        tokens.Word("bodies");
        int count = tokens.Integer("the number of bodies", 0, int.MaxValue);
        scene.Bodies.Capacity = Math.Min(count, tokens.MostItemsLeft(17));
        for (int i = 0; i < count; ++i)
            scene.Bodies.Add(ReadBody(ref tokens, i, count, scene.Shapes.Count));
    }

    static SceneBody ReadBody(ref SceneTokens tokens, int index, int count, int shapeCount)
    {
        var kind = (SceneBodyKind)tokens.Integer($"the kind of body {index} of {count}", 0, 2);
        int line = tokens.Line;
        // A kinematic body may be without shape: something to hang joints on.
        int childCount = tokens.Integer("the number of the body's shapes", kind == SceneBodyKind.Kinematic ? 0 : 1, int.MaxValue);
        var children = new SceneChild[Math.Min(childCount, tokens.MostItemsLeft(8))];
        for (int i = 0; i < childCount; ++i)
        {
            int shape = tokens.Integer("the number of a shape", 0, shapeCount - 1);
            Vector3 position = tokens.Vector("a child's position");
            Quaternion orientation = tokens.Rotation("a child's orientation");
            children[i] = new SceneChild(shape, position, orientation);
        }
        float mass = kind == SceneBodyKind.Dynamic ? tokens.Positive("the mass of a dynamic body") : tokens.NotNegative("the mass");
        return new SceneBody
        {
            Kind = kind,
            Children = children,
            Mass = mass,
            Position = tokens.Vector("the position"),
            Orientation = tokens.Rotation("the orientation"),
            LinearVelocity = tokens.Vector("the linear velocity"),
            AngularVelocity = tokens.Vector("the angular velocity"),
            Group = tokens.Integer("the group", -1, int.MaxValue),
            Line = line,
        };
    }

    static void ReadJoints(ref SceneTokens tokens, SceneDescription scene)
    {
        tokens.Word("joints");
        int count = tokens.Integer("the number of joints", 0, int.MaxValue);
        scene.Joints.Capacity = Math.Min(count, tokens.MostItemsLeft(9));
        for (int i = 0; i < count; ++i)
            scene.Joints.Add(ReadJoint(ref tokens, i, count, scene));
    }

    static SceneJoint ReadJoint(ref SceneTokens tokens, int index, int count, SceneDescription scene)
    {
        var kind = (SceneJointKind)tokens.Word($"joint {index} of {count} (ball or rag)", "ball", "rag");
        int line = tokens.Line;
        int bodyA = tokens.Integer("the joint's body A", 0, scene.Bodies.Count - 1);
        int bodyB = tokens.Integer("the joint's body B", 0, scene.Bodies.Count - 1);
        if (bodyA == bodyB)
            throw tokens.Wrong($"the joint holds body {bodyA} to itself");
        if (scene.Bodies[bodyA].Kind != SceneBodyKind.Dynamic && scene.Bodies[bodyB].Kind != SceneBodyKind.Dynamic)
            throw tokens.Wrong($"the joint holds bodies {bodyA} and {bodyB}, and neither is dynamic");
        Vector3 anchorA = tokens.Vector("the anchor on body A");
        Vector3 anchorB = tokens.Vector("the anchor on body B");
        float swing = 0, minimumTwist = 0, maximumTwist = 0;
        if (kind == SceneJointKind.Rag)
        {
            swing = tokens.NotNegative("the greatest swing");
            minimumTwist = tokens.Number("the least twist");
            maximumTwist = tokens.Number("the greatest twist");
            if (maximumTwist < minimumTwist)
                throw tokens.Wrong($"the greatest twist {maximumTwist} is below the least, {minimumTwist}");
        }
        return new SceneJoint
        {
            Kind = kind,
            BodyA = bodyA,
            BodyB = bodyB,
            AnchorA = anchorA,
            AnchorB = anchorB,
            MaximumSwing = swing,
            MinimumTwist = minimumTwist,
            MaximumTwist = maximumTwist,
            Line = line,
        };
    }
}
