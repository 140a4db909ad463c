using System;
using System.Diagnostics.CodeAnalysis;
using System.Numerics;
using System.Runtime.CompilerServices;
using BepuPhysics.Trees;

namespace BepuPhysics.Collidables;

/// <summary>What is refused of shapes of a game's own. Not in what is generic, where it would be compiled for each type.</summary>
static class OwnShapeChecks
{
    /// <summary>Refuses the id of a type of a game's own.</summary>
    /// <param name="type">The type.</param>
    /// <param name="typeId">Its id.</param>
    public static void TypeId(Type type, int typeId)
    {
        if (typeId is <= ShapeLimits.LastTypeId or >= TypedIndex.MaximumTypeCount)
        {
            throw new InvalidOperationException($"{type.Name} has type id {typeId}. Those from 0 to {ShapeLimits.LastTypeId} are the library's: give it one " +
                $"from {ShapeLimits.LastTypeId + 1} to {TypedIndex.MaximumTypeCount - 1} that no other type of shape has.");
        }
    }

    /// <summary>Refuses children that are too large, or have no end.</summary>
    /// <param name="type">Type of the shape.</param>
    /// <param name="child">Type of its children.</param>
    /// <param name="childTypeId">Its id.</param>
    /// <param name="childByteCount">Size of a child.</param>
    public static void Child(Type type, Type child, int childTypeId, int childByteCount)
    {
        if (childByteCount > IContainer.ScratchByteCount)
        {
            throw new InvalidOperationException(
                $"A {child.Name} is of {childByteCount} bytes: children of a {type.Name} may be of {IContainer.ScratchByteCount} at most. " +
                "What they have in common, or is long, may lie in memory that they point to.");
        }
        if (childTypeId == HalfSpace.Id)
            throw new InvalidOperationException($"Children of a {type.Name} are of type {child.Name}, which has no end: a child must have one.");
        if (childTypeId <= ShapeLimits.LastTypeId && child != LibraryType(childTypeId))
            TypeId(child, childTypeId);
    }

    // Of those that children can be.
    static Type? LibraryType(int typeId) => typeId switch
    {
        Sphere.Id => typeof(Sphere),
        Capsule.Id => typeof(Capsule),
        Box.Id => typeof(Box),
        Triangle.Id => typeof(Triangle),
        Cylinder.Id => typeof(Cylinder),
        ConvexHull.Id => typeof(ConvexHull),
        _ => null,
    };

    /// <summary>Refuses two types of one id.</summary>
    public static void OneTypeOfAnId(Type type, int typeId, Type other, int otherTypeId)
    {
        if (typeId == otherTypeId && type != other)
        {
            throw new InvalidOperationException(
                $"{type.Name} has type id {typeId}, which {other.Name} already has. Each type needs one of its own.");
        }
    }

    /// <summary>Refuses a box that is none.</summary>
    /// <param name="type">Type of the shape.</param>
    /// <param name="min">Lower corner.</param>
    /// <param name="max">Upper corner.</param>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void Bounds(Type type, Vector3 min, Vector3 max)
    {
        if (!BoxMath.IsValid(min, max))
            ThrowBounds(type, min, max);
    }

    [DoesNotReturn]
    static void ThrowBounds(Type type, Vector3 min, Vector3 max) => throw new InvalidOperationException(
        $"The bounds of a {type.Name} are from {min} to {max}: they must be finite, and the lower corner nowhere above the upper one.");

    [DoesNotReturn]
    public static void ThrowNoChild(Type type, int index, int childCount) => throw new InvalidOperationException(
        $"{type.Name}.FindLocalOverlaps told of child {index} of {childCount}. Children have the numbers below ChildCount.");

    [DoesNotReturn]
    public static void ThrowTaken(Type type) => throw new InvalidOperationException(
        $"{type.Name}.FindLocalOverlaps took children out of the list: it only adds those that it finds.");
}
