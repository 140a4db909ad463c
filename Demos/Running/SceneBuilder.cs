using System;
using System.Collections.Generic;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuPhysics.Constraints;
using BepuUtilities;
using Demos.Engine;
using Demos.Scenes;

namespace Demos.Running;

/// <summary>Puts a scene into a simulation, in the order of the scene, so that the same scene always gets the same handles.</summary>
sealed class SceneBuilder
{
    /// <summary>Squared speed, in the engines' own measure, under which a body may fall asleep where the scene allows it.</summary>
    const float SleepThreshold = 0.01f;

    readonly SceneDescription scene;
    readonly Simulation simulation;
    readonly SpringSettings jointSpring;
    readonly BodyActivityDescription activity;
    readonly ShapeFactory shapeFactory;
    readonly Dictionary<(int Shape, bool Solid), BuiltShape> shapes = [];
    readonly Dictionary<int, BodyHandle> standIns = [];
    readonly BodyHandle[] bodies;
    readonly Vector3[] centers;
    readonly List<int> bodyGroups = [];
    readonly List<int> staticGroups = [];

    SceneBuilder(SceneDescription scene, Simulation simulation, SpringSettings jointSpring, bool maySleep)
    {
        this.scene = scene;
        this.simulation = simulation;
        this.jointSpring = jointSpring;
        activity = new BodyActivityDescription(maySleep ? SleepThreshold : -1);
        shapeFactory = new ShapeFactory(simulation);
        bodies = new BodyHandle[scene.Bodies.Count];
        centers = new Vector3[scene.Bodies.Count];
    }

    /// <summary>Adds all of a scene to a simulation that has nothing in it.</summary>
    /// <param name="scene">The scene.</param>
    /// <param name="simulation">The simulation.</param>
    /// <param name="jointSpring">Spring of all joints.</param>
    /// <param name="recorder">Is told which collidables are parts of one thing.</param>
    /// <param name="sleep">Whether bodies may fall asleep; as the scene says when null.</param>
    /// <exception cref="SceneException">The engine lacks something that the scene needs.</exception>
    public static BuiltScene Build(
        SceneDescription scene, Simulation simulation, SpringSettings jointSpring, ContactRecorder recorder, bool? sleep = null)
    {
        var builder = new SceneBuilder(scene, simulation, jointSpring, sleep ?? scene.Sleep);
        builder.RefuseUnsupported();
        var joints = new List<BuiltJoint>(scene.Joints.Count);
        int line = 0;
        try
        {
            for (int i = 0; i < scene.Bodies.Count; ++i)
            {
                line = scene.Bodies[i].Line;
                builder.AddBody(i);
            }
            foreach (SceneJoint joint in scene.Joints)
            {
                line = joint.Line;
                joints.Add(builder.AddJoint(joint));
            }
        }
        catch (ArgumentException refusal)
        {
            throw new SceneException(line, "", $"the engine refuses this: {refusal.Message}");
        }
        recorder.SetGroups([.. builder.bodyGroups], [.. builder.staticGroups]);
        return new BuiltScene(simulation, joints);
    }

    /// <summary>All that is missing is found before the first body exists.</summary>
    void RefuseUnsupported()
    {
        foreach (SceneShape shape in scene.Shapes)
        {
            if (!ShapeFactory.Supports(shape.Kind))
                throw new SceneException(shape.Line, shape.Word, $"'{shape.Word}' is not supported yet");
        }
        foreach (SceneBody body in scene.Bodies)
        {
            if (body.IsCompound && !ShapeFactory.SupportsCompounds)
                throw new SceneException(body.Line, "compound", "'compound' (a body of several or displaced shapes) is not supported yet");
        }
    }

    void AddBody(int index)
    {
        SceneBody body = scene.Bodies[index];
        BuiltShape? shape = ShapeOf(body);
        Vector3 center = shape?.Center ?? Vector3.Zero;
        TypedIndex shapeIndex = shape?.Index ?? default;
        Vector3 offset = SceneMath.Rotate(center, body.Orientation);
        var pose = new RigidPose(body.Position + offset, body.Orientation);
        centers[index] = center;
        if (body.Kind == SceneBodyKind.Static)
        {
            StaticHandle handle = simulation.Statics.Add(new StaticDescription(pose, shapeIndex));
            SetGroup(staticGroups, EngineHandles.Number(handle), body.Group);
            return;
        }
        var velocity = new BodyVelocity(body.LinearVelocity + SceneMath.Cross(body.AngularVelocity, offset), body.AngularVelocity);
        bodies[index] = simulation.Bodies.Add(body.Kind == SceneBodyKind.Kinematic
            ? BodyDescription.CreateKinematic(pose, velocity, shapeIndex, activity)
            : BodyDescription.CreateDynamic(pose, velocity, InertiaOf(body, shape!), shapeIndex, activity));
        SetGroup(bodyGroups, EngineHandles.Number(bodies[index]), body.Group);
    }

    /// <summary>Masses and sizes may be so small, or so large, that single precision cannot hold what follows from them.</summary>
    static BodyInertia InertiaOf(SceneBody body, BuiltShape shape)
    {
        BodyInertia inertia = shape.Inertia(body.Mass);
        Symmetric3x3 inverse = inertia.InverseInertiaTensor;
        bool isUsable = float.IsFinite(inertia.InverseMass) && inertia.InverseMass > 0
            && float.IsFinite(inverse.XX) && float.IsFinite(inverse.YX) && float.IsFinite(inverse.YY)
            && float.IsFinite(inverse.ZX) && float.IsFinite(inverse.ZY) && float.IsFinite(inverse.ZZ);
        return isUsable
            ? inertia
            : throw new SceneException(body.Line, "", FormattableString.Invariant($"a mass of {body.Mass} with this shape has no inertia"));
    }

    BuiltShape? ShapeOf(SceneBody body)
    {
        if (body.Children.Length == 0)
            return null;
        bool solid = body.Kind == SceneBodyKind.Dynamic;
        if (solid && Array.Exists(body.Children, child => scene.Shapes[child.Shape].Kind == SceneShapeKind.Field))
            throw new SceneException(body.Line, "field", "a field has no mass: its body must be static or kinematic");
        if (!body.IsCompound)
            return Shape(body.Children[0].Shape, solid);
        var children = new (BuiltShape Shape, SceneChild Child)[body.Children.Length];
        for (int i = 0; i < children.Length; ++i)
        {
            SceneChild child = body.Children[i];
            SceneShape part = scene.Shapes[child.Shape];
            if (!ShapeFactory.SupportsAsPart(part.Kind))
                throw new SceneException(body.Line, part.Word, $"a {part.Word} cannot be a part of a compound body");
            children[i] = (Shape(child.Shape, solid), child);
        }
        return shapeFactory.BuildCompound(children, solid);
    }

    /// <param name="index">Number of the shape in the scene.</param>
    /// <param name="solid">Whether the body has mass: its shape then has the centre of mass as its origin.</param>
    BuiltShape Shape(int index, bool solid)
    {
        solid |= scene.Shapes[index].Kind != SceneShapeKind.Mesh;
        if (!shapes.TryGetValue((index, solid), out BuiltShape? built))
        {
            built = shapeFactory.Build(scene.Shapes[index], solid);
            shapes.Add((index, solid), built);
        }
        return built;
    }

    BuiltJoint AddJoint(SceneJoint joint)
    {
        BodyHandle a = Holder(joint.BodyA), b = Holder(joint.BodyB);
        Vector3 anchorA = joint.AnchorA - centers[joint.BodyA], anchorB = joint.AnchorB - centers[joint.BodyB];
        simulation.Solver.Add(a, b, new BallSocket { LocalOffsetA = anchorA, LocalOffsetB = anchorB, SpringSettings = jointSpring });
        if (joint.Kind == SceneJointKind.Rag)
            AddLimits(joint, a, b);
        return new BuiltJoint(a, b, anchorA, anchorB);
    }

    void AddLimits(SceneJoint joint, BodyHandle a, BodyHandle b)
    {
        Quaternion orientationA = scene.Bodies[joint.BodyA].Orientation, orientationB = scene.Bodies[joint.BodyB].Orientation;
        Vector3 axisA = SceneMath.Rotate(Vector3.UnitY, orientationA);
        simulation.Solver.Add(a, b, new SwingLimit
        {
            AxisLocalA = Vector3.UnitY,
            AxisLocalB = SceneMath.Rotate(axisA, Quaternion.Conjugate(orientationB)),
            MinimumDot = (float)SceneMath.Cosine(Math.Min(joint.MaximumSwing, Math.PI)),
            SpringSettings = jointSpring,
        });
        // The twist axis is the z axis of each basis. B's x axis is where A's comes to lie when the shortest rotation takes one twist
        // axis to the other, which is how the limit measures: the angle is zero as the bodies are placed.
        Vector3 axisB = SceneMath.Rotate(Vector3.UnitY, orientationB);
        Vector3 referenceA = SceneMath.Rotate(Vector3.UnitZ, orientationA);
        Vector3 referenceB = SceneMath.Rotate(referenceA, SceneMath.Between(axisA, axisB));
        Vector3 referenceInB = SceneMath.Rotate(referenceB, Quaternion.Conjugate(orientationB));
        simulation.Solver.Add(a, b, new TwistLimit
        {
            LocalBasisA = SceneMath.Basis(Vector3.UnitZ, Vector3.UnitY),
            LocalBasisB = SceneMath.Basis(referenceInB, Vector3.UnitY),
            MinimumAngle = joint.MinimumTwist,
            MaximumAngle = joint.MaximumTwist,
            SpringSettings = jointSpring,
        });
    }

    /// <summary>A body that a joint can hold: a static is stood in for by a kinematic body without shape at the same place.</summary>
    BodyHandle Holder(int index)
    {
        SceneBody body = scene.Bodies[index];
        if (body.Kind != SceneBodyKind.Static)
            return bodies[index];
        if (!standIns.TryGetValue(index, out BodyHandle standIn))
        {
            Vector3 offset = SceneMath.Rotate(centers[index], body.Orientation);
            var pose = new RigidPose(body.Position + offset, body.Orientation);
            standIn = simulation.Bodies.Add(BodyDescription.CreateKinematic(pose, new CollidableDescription(default), activity));
            standIns.Add(index, standIn);
            SetGroup(bodyGroups, EngineHandles.Number(standIn), -1);
        }
        return standIn;
    }

    static void SetGroup(List<int> groups, int handle, int group)
    {
        while (groups.Count <= handle)
            groups.Add(0);
        groups[handle] = group;
    }
}
