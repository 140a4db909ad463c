using System;
using System.Numerics;
using BepuUtilities;
using BepuUtilities.Collections;
using BepuUtilities.Memory;

namespace BepuPhysics.Collidables;

/// <summary>Collects the children of a compound, and finds the centre of mass and the inertia of all of them.</summary>
/// <remarks>It may be used again after <see cref="Reset"/>, and returns its memory with <see cref="Dispose"/>. What it builds is the caller's.</remarks>
/// <param name="pool">Source of the builder's memory and of that of children.</param>
/// <param name="shapes">Shapes that the children refer to.</param>
/// <param name="initialBuilderCapacity">Number of children to make room for.</param>
public partial struct CompoundBuilder(BufferPool pool, Shapes shapes, int initialBuilderCapacity) : IDisposable
{
    /// <summary>Source of the builder's memory and of that of children.</summary>
    public BufferPool Pool = pool ?? throw new ArgumentNullException(nameof(pool));
    /// <summary>Shapes that the children refer to.</summary>
    public Shapes Shapes = shapes ?? throw new ArgumentNullException(nameof(shapes));

    /// <summary>A child that was added.</summary>
    public struct Child
    {
        /// <summary>Pose of the child in the frame that it was described in.</summary>
        public RigidPose LocalPose;
        /// <summary>Name of the child's shape.</summary>
        public TypedIndex ShapeIndex;
        /// <summary>Mass of the child, kg; for a kinematic compound only what it counts for the centre.</summary>
        public float Weight;
        /// <summary>Inverse inertia of the child around its own centre, in its own frame, 1/(kg m2); zero for a mass in a point.</summary>
        public Symmetric3x3 LocalInverseInertia;
    }

    /// <summary>Children that were added.</summary>
    public QuickList<Child> Children = new(Math.Max(1, initialBuilderCapacity), pool);

    /// <summary>Adds a child.</summary>
    /// <param name="shape">Name of the child's shape; its centre of mass is its origin, see <see cref="Mesh.Recenter"/>.</param>
    /// <param name="localPose">Pose of the child.</param>
    /// <param name="localInverseInertia">Inverse inertia of the child, in its own frame.</param>
    /// <param name="weight">Mass of the child, kg; zero or more.</param>
    /// <exception cref="ArgumentException">The shape does not exist or cannot be a child, or a number is not finite or out of range.</exception>
    public void Add(TypedIndex shape, in RigidPose localPose, in Symmetric3x3 localInverseInertia, float weight)
    {
        var child = new CompoundChild(localPose, shape);
        CompoundChildren.Validate(child, Children.Count);
        CompoundChildren.CheckShape(child, Children.Count, Shapes, Children.Count + 1);
        CheckWeight(weight);
        CheckInertia(localInverseInertia);
        Children.Add(new() { LocalPose = localPose, ShapeIndex = shape, Weight = weight, LocalInverseInertia = localInverseInertia }, Pool);
    }

    /// <summary>Adds a child.</summary>
    /// <param name="shape">Name of the child's shape; its centre of mass is its origin, see <see cref="Mesh.Recenter"/>.</param>
    /// <param name="localPose">Pose of the child.</param>
    /// <param name="childInertia">Inverse mass, not zero, and inverse inertia of the child, in its own frame.</param>
    /// <exception cref="ArgumentException">The shape does not exist or cannot be a child, or a number is not finite or out of range.</exception>
    public void Add(TypedIndex shape, in RigidPose localPose, in BodyInertia childInertia)
    {
        if (!(childInertia.InverseMass > 0))
        {
            throw new ArgumentException(
                $"A child of an inverse mass of {childInertia.InverseMass} would be infinitely heavy, or nothing.", nameof(childInertia));
        }
        Add(shape, localPose, childInertia.InverseInertiaTensor, 1 / childInertia.InverseMass);
    }

    /// <summary>Adds a shape, and a child that is this shape.</summary>
    /// <param name="shape">Shape of the child.</param>
    /// <param name="localPose">Pose of the child.</param>
    /// <param name="weight">Mass of the child, kg.</param>
    /// <exception cref="ArgumentException">The shape is not valid, or a number is not finite or out of range.</exception>
    public void Add<TShape>(in TShape shape, in RigidPose localPose, float weight) where TShape : unmanaged, IConvexShape
    {
        var inertia = shape.ComputeInertia(weight);
        CompoundChildren.Validate(new(localPose, default), Children.Count);
        Add(Shapes.Add(shape), localPose, inertia.InverseInertiaTensor, weight);
    }

    /// <summary>Adds a child of a compound that nothing moves.</summary>
    /// <param name="shape">Name of the child's shape; its centre of mass is its origin, see <see cref="Mesh.Recenter"/>.</param>
    /// <param name="localPose">Pose of the child.</param>
    /// <param name="weight">What the child counts for the centre; zero or more.</param>
    /// <exception cref="ArgumentException">The shape does not exist or cannot be a child, or a number is not finite or out of range.</exception>
    public void AddForKinematic(TypedIndex shape, in RigidPose localPose, float weight) => Add(shape, localPose, default(Symmetric3x3), weight);

    /// <summary>Adds a shape, and a child of a compound that nothing moves that is this shape.</summary>
    /// <param name="shape">Shape of the child.</param>
    /// <param name="localPose">Pose of the child.</param>
    /// <param name="weight">What the child counts for the centre; zero or more.</param>
    /// <exception cref="ArgumentException">The shape is not valid, or a number is not finite or out of range.</exception>
    public void AddForKinematic<TShape>(in TShape shape, in RigidPose localPose, float weight) where TShape : unmanaged, IConvexShape
    {
        CompoundChildren.Validate(new(localPose, default), Children.Count);
        CheckWeight(weight);
        AddForKinematic(Shapes.Add(shape), localPose, weight);
    }

    /// <summary>Builds a compound that is moved, around its centre of mass.</summary>
    /// <param name="children">Receives the children, relative to the centre of mass.</param>
    /// <param name="inertia">Inverse mass and inertia of all children.</param>
    /// <param name="center">Centre of mass in the frame that the children were described in.</param>
    /// <exception cref="InvalidOperationException">There are no children.</exception>
    /// <exception cref="ArgumentException">The masses are out of range, or floats cannot hold the inverse inertia.</exception>
    public readonly void BuildDynamicCompound(out Buffer<CompoundChild> children, out BodyInertia inertia, out Vector3 center)
    {
        center = Center();
        inertia = Inertia(center);
        children = Build(center);
    }

    /// <summary>Builds a compound that is moved, around the origin of the frame that the children were described in.</summary>
    /// <param name="children">Receives the children.</param>
    /// <param name="inertia">Inverse mass and inertia of all children around the origin.</param>
    /// <exception cref="InvalidOperationException">There are no children.</exception>
    /// <exception cref="ArgumentException">The masses are out of range, or floats cannot hold the inverse inertia.</exception>
    public readonly void BuildDynamicCompound(out Buffer<CompoundChild> children, out BodyInertia inertia)
    {
        CheckNotEmpty();
        inertia = Inertia(default);
        children = Build(default);
    }

    /// <summary>Builds a compound that nothing moves, around the centre of the weights.</summary>
    /// <param name="children">Receives the children, relative to the centre.</param>
    /// <param name="center">Centre in the frame that the children were described in; its origin where all weights are zero.</param>
    /// <exception cref="InvalidOperationException">There are no children.</exception>
    public readonly void BuildKinematicCompound(out Buffer<CompoundChild> children, out Vector3 center)
    {
        center = Center();
        children = Build(center);
    }

    /// <summary>Builds a compound that nothing moves, around the origin of the frame that the children were described in.</summary>
    /// <param name="children">Receives the children.</param>
    /// <exception cref="InvalidOperationException">There are no children.</exception>
    public readonly void BuildKinematicCompound(out Buffer<CompoundChild> children)
    {
        CheckNotEmpty();
        children = Build(default);
    }

    /// <summary>Forgets all children, and keeps the memory for others.</summary>
    public void Reset() => Children.Count = 0;

    /// <summary>Returns the memory of the builder; not that of what it has built.</summary>
    public void Dispose() => Children.Dispose(Pool);

    readonly Vector3 Center()
    {
        CheckNotEmpty();
        var mass = default(CompoundMass);
        for (int i = 0; i < Children.Count; ++i)
            mass.AddCenter(Children[i].LocalPose.Position, Children[i].Weight);
        return mass.Center;
    }

    readonly BodyInertia Inertia(Vector3 center)
    {
        var sum = default(CompoundMass);
        for (int i = 0; i < Children.Count; ++i)
        {
            ref var child = ref Children[i];
            sum.Add(child.LocalPose, center, child.LocalInverseInertia, child.Weight);
        }
        return sum.ToInverse();
    }

    readonly Buffer<CompoundChild> Build(Vector3 center)
    {
        Pool.Take(Children.Count, out Buffer<CompoundChild> children);
        for (int i = 0; i < Children.Count; ++i)
        {
            ref var child = ref Children[i];
            children[i] = new(new RigidPose(child.LocalPose.Position - center, child.LocalPose.Orientation), child.ShapeIndex);
        }
        return children;
    }

    readonly void CheckNotEmpty()
    {
        if (Children.Count == 0)
            throw new InvalidOperationException("There are no children to build a compound of.");
    }

    static void CheckWeight(float weight)
    {
        if (!(weight >= 0 && weight <= ShapeLimits.MaximumMass))
            throw new ArgumentOutOfRangeException(nameof(weight), weight, $"A weight must be from 0 to {ShapeLimits.MaximumMass} kg.");
    }

    // That it has no negative moment shows when all are summed up.
    static void CheckInertia(in Symmetric3x3 inverse)
    {
        var sum = MathF.Abs(inverse.YX) + MathF.Abs(inverse.ZX) + MathF.Abs(inverse.ZY) + inverse.XX + inverse.YY + inverse.ZZ;
        if (!(float.IsFinite(sum) && inverse.XX >= 0 && inverse.YY >= 0 && inverse.ZZ >= 0))
        {
            throw new ArgumentException(
                "An inverse inertia must be finite, and not negative on its diagonal; not " +
                $"({inverse.XX}, {inverse.YY}, {inverse.ZZ}) there and ({inverse.YX}, {inverse.ZX}, {inverse.ZY}) below it.", nameof(inverse));
        }
    }
}
