using System;
using System.Numerics;
using System.Runtime.InteropServices;
using BepuUtilities;

namespace BepuPhysics.Collidables;

// Masses and inertias of children, without a builder.
public partial struct CompoundBuilder
{
    /// <summary>Inertia of a mass in a point around the origin.</summary>
    /// <param name="offset">Position of the point, m.</param>
    /// <param name="mass">The mass, kg.</param>
    /// <param name="contribution">Inertia, kg m2.</param>
    public static void GetOffsetInertiaContribution(Vector3 offset, float mass, out Symmetric3x3 contribution) =>
        contribution = ComputeInertiaForChild(offset, default, mass);

    /// <summary>Inertia of a child around the origin of its compound, kg m2, not inverted.</summary>
    /// <param name="pose">Pose of the child.</param>
    /// <param name="inverseLocalInertia">Inverse inertia of the child around its own centre; zero for a mass in a point.</param>
    /// <param name="mass">Mass of the child, kg.</param>
    public static Symmetric3x3 ComputeInertiaForChild(in RigidPose pose, Symmetric3x3 inverseLocalInertia, float mass)
    {
        var sum = default(CompoundMass);
        sum.AddInertia(pose, inverseLocalInertia, mass);
        return sum.Inertia;
    }

    /// <summary>Centre of mass of children; the origin where there is no mass.</summary>
    /// <param name="childPoses">Poses of the children.</param>
    /// <param name="childMasses">Masses of the children, kg.</param>
    /// <param name="inverseMass">One by the mass of all children, 1/kg; zero where there is no mass.</param>
    /// <exception cref="ArgumentException">There are not as many masses as children, or a mass is out of range.</exception>
    public static Vector3 ComputeCenterOfMass(Span<RigidPose> childPoses, Span<float> childMasses, out float inverseMass)
    {
        CheckMasses(childPoses.Length, childMasses);
        var sum = default(CompoundMass);
        for (int i = 0; i < childPoses.Length; ++i)
            sum.AddCenter(childPoses[i].Position, childMasses[i]);
        inverseMass = sum.Mass > 0 ? (float)(1 / sum.Mass) : 0;
        return sum.Center;
    }

    /// <inheritdoc cref="ComputeCenterOfMass(Span{RigidPose}, Span{float}, out float)"/>
    public static Vector3 ComputeCenterOfMass(Span<CompoundChild> children, Span<float> childMasses, out float inverseMass) =>
        ComputeCenterOfMass(Poses(children), childMasses, out inverseMass);

    /// <inheritdoc cref="ComputeCenterOfMass(Span{RigidPose}, Span{float}, out float)"/>
    public static Vector3 ComputeCenterOfMass(Span<RigidPose> childPoses, Span<float> childMasses) => ComputeCenterOfMass(childPoses, childMasses, out _);

    /// <inheritdoc cref="ComputeCenterOfMass(Span{RigidPose}, Span{float}, out float)"/>
    public static Vector3 ComputeCenterOfMass(Span<CompoundChild> children, Span<float> childMasses) => ComputeCenterOfMass(children, childMasses, out _);

    /// <summary>Inverse mass and inertia of children around the origin of their frame.</summary>
    /// <param name="childPoses">Poses of the children.</param>
    /// <param name="inverseLocalInertias">Inverse inertias of the children around their own centres; zero for a mass in a point.</param>
    /// <param name="childMasses">Masses of the children, kg.</param>
    /// <exception cref="ArgumentException">There are not as many of each, a mass is out of range, or floats cannot hold the inverse inertia.</exception>
    public static BodyInertia ComputeInverseInertia(Span<RigidPose> childPoses, Span<Symmetric3x3> inverseLocalInertias, Span<float> childMasses) =>
        SumUp(childPoses, inverseLocalInertias, childMasses, default);

    /// <inheritdoc cref="ComputeInverseInertia(Span{RigidPose}, Span{Symmetric3x3}, Span{float})"/>
    public static BodyInertia ComputeInverseInertia(Span<CompoundChild> children, Span<Symmetric3x3> inverseLocalInertias, Span<float> childMasses) =>
        ComputeInverseInertia(Poses(children), inverseLocalInertias, childMasses);

    /// <summary>Inverse mass and inertia of children around their centre of mass, which becomes the origin of their poses.</summary>
    /// <param name="childPoses">Poses of the children.</param>
    /// <param name="inverseLocalInertias">Inverse inertia of each child around its own centre, in its frame; zero for one that is a point.</param>
    /// <param name="childMasses">Masses of the children, kg; more than zero.</param>
    /// <param name="centerOfMass">Centre of mass in the frame that the poses were in.</param>
    public static BodyInertia ComputeInverseInertia(
        Span<RigidPose> childPoses, Span<Symmetric3x3> inverseLocalInertias, Span<float> childMasses, out Vector3 centerOfMass)
    {
        var center = ComputeCenterOfMass(childPoses, childMasses, out _);
        var inertia = SumUp(childPoses, inverseLocalInertias, childMasses, center);
        foreach (ref var pose in childPoses)
            pose.Position -= center;
        centerOfMass = center;
        return inertia;
    }

    static BodyInertia SumUp(Span<RigidPose> poses, Span<Symmetric3x3> inverseInertias, Span<float> masses, Vector3 center)
    {
        CheckMasses(poses.Length, masses);
        if (inverseInertias.Length != poses.Length)
            throw new ArgumentException($"There are {poses.Length} children and {inverseInertias.Length} inertias.", nameof(inverseInertias));
        var sum = default(CompoundMass);
        for (int i = 0; i < poses.Length; ++i)
        {
            CheckInertia(inverseInertias[i]);
            sum.Add(poses[i], center, inverseInertias[i], masses[i]);
        }
        return sum.ToInverse();
    }

    /// <inheritdoc cref="ComputeInverseInertia(Span{RigidPose}, Span{Symmetric3x3}, Span{float}, out Vector3)"/>
    public static BodyInertia ComputeInverseInertia(
        Span<CompoundChild> children, Span<Symmetric3x3> inverseLocalInertias, Span<float> childMasses, out Vector3 centerOfMass) =>
        ComputeInverseInertia(Poses(children), inverseLocalInertias, childMasses, out centerOfMass);

    /// <summary>Inverse mass and inertia of children around the origin of their compound, each filled uniformly.</summary>
    /// <remarks>
    /// A mesh is what it encloses, whose centre of mass may be anywhere in its frame. How the mass of a compound is spread over its children is not
    /// known, and a height field encloses nothing: these are refused.
    /// </remarks>
    /// <param name="children">The children.</param>
    /// <param name="childMasses">Masses of the children, kg; more than zero.</param>
    /// <param name="shapes">Shapes that the children refer to.</param>
    /// <exception cref="ArgumentException">There are not as many masses as children, a mass is out of range, a shape does not exist or is neither convex
    /// nor a closed mesh, or floats cannot hold the inverse inertia.</exception>
    public static BodyInertia ComputeInertia(Span<CompoundChild> children, Span<float> childMasses, Shapes shapes) =>
        SumUp(FilledParts(children, childMasses, shapes, out var inertias), inertias, childMasses, default);

    /// <summary>Inverse mass and inertia of children around their centre of mass, which becomes the origin of their poses.</summary>
    /// <remarks><inheritdoc cref="ComputeInertia(Span{CompoundChild}, Span{float}, Shapes)" path="/remarks"/></remarks>
    /// <param name="children">The children.</param>
    /// <param name="childMasses">Masses of the children, kg; more than zero.</param>
    /// <param name="shapes">Shapes that the children refer to.</param>
    /// <param name="centerOfMass">Centre of mass in the frame that the children were in.</param>
    /// <exception cref="ArgumentException">There are not as many masses as children, a mass is out of range, a shape does not exist or is neither convex
    /// nor a closed mesh, or floats cannot hold the inverse inertia.</exception>
    public static BodyInertia ComputeInertia(Span<CompoundChild> children, Span<float> childMasses, Shapes shapes, out Vector3 centerOfMass)
    {
        var parts = FilledParts(children, childMasses, shapes, out var inertias);
        var inertia = ComputeInverseInertia(parts, inertias, childMasses, out centerOfMass);
        foreach (ref var child in children)
            child.LocalPosition -= centerOfMass;
        return inertia;
    }

    // Where the centres of mass of the children are, and their inertias around these.
    static RigidPose[] FilledParts(Span<CompoundChild> children, Span<float> childMasses, Shapes shapes, out Symmetric3x3[] inertias)
    {
        ArgumentNullException.ThrowIfNull(shapes);
        CheckMasses(children.Length, childMasses);
        var poses = Poses(children).ToArray();
        inertias = new Symmetric3x3[children.Length];
        for (int i = 0; i < children.Length; ++i)
        {
            var name = children[i].ShapeIndex;
            CompoundChildren.CheckShape(children[i], i, shapes, children.Length);
            inertias[i] = shapes.GetBatch(name.Type) switch
            {
                IConvexShapeBatch convex => convex.ComputeInertia(name.Index, childMasses[i]).InverseInertiaTensor,
                MeshShapeBatch meshes => FilledMesh(meshes.Get(name.Index), childMasses[i], i, ref poses[i]),
                _ => throw new ArgumentException($"Child {i} is {name}, whose inertia does not follow from a mass alone: give it with the child, by " +
                    $"{nameof(CompoundBuilder)}.{nameof(Add)}, or add its children instead.", nameof(children)),
            };
        }
        return poses;
    }

    static Symmetric3x3 FilledMesh(in Mesh mesh, float mass, int child, ref RigidPose pose)
    {
        try
        {
            var inertia = mesh.ComputeCenteredInertia(mass, out var center);
            pose.Position += Exact.Rotate(center, pose.Orientation);
            return inertia.InverseInertiaTensor;
        }
        catch (ArgumentException exception)
        {
            throw new ArgumentException($"Child {child} is a mesh that is not filled with mass: {exception.Message} Give its inertia with the child, by " +
                $"{nameof(CompoundBuilder)}.{nameof(Add)}: {nameof(Mesh.ComputeOpenInertia)} gives that of its triangles as sheets.", exception);
        }
    }

    // A child begins with its pose.
    static Span<RigidPose> Poses(Span<CompoundChild> children) => MemoryMarshal.Cast<CompoundChild, RigidPose>(children);

    static void CheckMasses(int childCount, Span<float> masses)
    {
        if (masses.Length != childCount)
            throw new ArgumentException($"There are {childCount} children and {masses.Length} masses.", nameof(masses));
        foreach (var mass in masses)
            CheckWeight(mass);
    }
}
