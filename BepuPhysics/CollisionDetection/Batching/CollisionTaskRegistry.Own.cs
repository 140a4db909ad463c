using System;
using BepuPhysics.Collidables;
using BepuUtilities;

namespace BepuPhysics.CollisionDetection;

// Types of shapes that games make.
public sealed partial class CollisionTaskRegistry
{
    OwnShapeType[] ownTypes = [];

    /// <summary>
    /// Registers a type of shapes of a game's own that are made of children of one type, with tasks for it and every other type of shape: the library's, and
    /// those that were registered before it. A type that is registered already stays as it is.
    /// </summary>
    /// <typeparam name="TShape">Type of the shapes; of an id from 11 to 127.</typeparam>
    /// <typeparam name="TChildShape">Type of their children: one of the library's, or one that is registered too.</typeparam>
    /// <typeparam name="TChildShapeWide">Wide form of the children.</typeparam>
    /// <exception cref="InvalidOperationException">
    /// The type has the id of another one, or its children are none that a shape can have, or a stage or a query of the simulation is in
    /// progress; nothing was changed.
    /// </exception>
    public unsafe void RegisterHomogeneousCompound<TShape, TChildShape, TChildShapeWide>()
        where TShape : unmanaged, IHomogeneousCompoundShape<TChildShape, TChildShapeWide>
        where TChildShape : unmanaged, IConvexShape where TChildShapeWide : unmanaged, IShapeWide<TChildShape>
    {
        OwnShapeChecks.Child(typeof(TShape), typeof(TChildShape), TChildShape.TypeId, sizeof(TChildShape));
        var own = new OwnContainerType<HomogeneousContainer<TShape, TChildShape, TChildShapeWide>>(
            typeof(TShape), typeof(TChildShape), TChildShape.TypeId);
        Begin("CollisionTaskRegistry.RegisterHomogeneousCompound");
        try
        {
            if (TryAdd(own))
                RegisterOwnContainer<HomogeneousContainer<TShape, TChildShape, TChildShapeWide>>(own);
        }
        finally
        {
            World?.Release();
        }
    }

    /// <summary>
    /// Registers a type of convex shapes of a game's own, with tasks for it and every other type of shape: the library's, and those that were registered
    /// before it. A type that is registered already stays as it is.
    /// </summary>
    /// <typeparam name="TShape">Type of the shapes; of an id from 11 to 127.</typeparam>
    /// <typeparam name="TShapeWide">Wide form of the shapes.</typeparam>
    /// <typeparam name="TSupport">Farthest points of the shapes.</typeparam>
    /// <typeparam name="TFeature">
    /// What of a shape faces a direction; of shapes without faces and edges <see cref="PointFeature{TShapeWide, TSupport}"/>.
    /// </typeparam>
    /// <exception cref="InvalidOperationException">
    /// The type has the id of another one, or a stage or a query of the simulation is in progress; nothing was changed.
    /// </exception>
    public void RegisterConvex<TShape, TShapeWide, TSupport, TFeature>()
        where TShape : unmanaged, IConvexShape where TShapeWide : unmanaged, IShapeWide<TShape>
        where TSupport : unmanaged, ISupport<TShapeWide> where TFeature : unmanaged, IContactFeature<TShapeWide>
    {
        var own = new OwnConvexType<TShape, TShapeWide, TSupport, TFeature>();
        Begin("CollisionTaskRegistry.RegisterConvex");
        try
        {
            if (TryAdd(own))
                RegisterOwnConvex(own);
        }
        finally
        {
            World?.Release();
        }
    }

    // Before anything changes, and to be ended by releasing it.
    void Begin(string operation) => World?.Hold(operation);

    void RegisterOwnConvex<TShape, TShapeWide, TSupport, TFeature>(OwnConvexType<TShape, TShapeWide, TSupport, TFeature> own)
        where TShape : unmanaged, IConvexShape where TShapeWide : unmanaged, IShapeWide<TShape>
        where TSupport : unmanaged, ISupport<TShapeWide> where TFeature : unmanaged, IContactFeature<TShapeWide>
    {
        own.MeetConvex<Sphere, SphereWide, SphereSupport, SphereFeature>(this);
        own.MeetConvex<Capsule, CapsuleWide, CapsuleSupport, CapsuleFeature>(this);
        own.MeetConvex<Box, BoxWide, BoxSupport, BoxFeature>(this);
        own.MeetConvex<Triangle, TriangleWide, TriangleSupport, TriangleFeature>(this);
        own.MeetConvex<Cylinder, CylinderWide, CylinderSupport, CylinderFeature>(this);
        own.MeetConvex<ConvexHull, ConvexHullWide, ConvexHullSupport, ConvexHullFeature>(this);
        RegisterUnlocked(new SearchCollisionTask<TShape, TShapeWide, HalfSpace, HalfSpaceWide, Few4<ContactWide>,
            HalfSpaceFaceTester<TShapeWide, TSupport, TFeature>>());
        MeetContainers(own);
    }

    void MeetContainers(OwnShapeType own)
    {
        own.MeetContainer<Compound>(this);
        own.MeetContainer<BigCompound>(this);
        own.MeetContainer<Mesh>(this);
        own.MeetContainer<HeightField>(this);
        MeetOwn(own);
    }

    void RegisterOwnContainer<TContainer>(OwnShapeType own) where TContainer : unmanaged, IContainer
    {
        RegisterWithConvex<TContainer>();
        RegisterUnlocked(new ContainerPlaneTask<TContainer>());
        MeetContainers(own);
    }

    /// <summary>Registers what tests pairs of a type that is made of children and each of the library's convex types, but half-spaces.</summary>
    internal void RegisterWithConvex<TContainer>() where TContainer : unmanaged, IContainer
    {
        RegisterUnlocked(new ConvexContainerTask<Sphere, SphereWide, TContainer>());
        RegisterUnlocked(new ConvexContainerTask<Capsule, CapsuleWide, TContainer>());
        RegisterUnlocked(new ConvexContainerTask<Box, BoxWide, TContainer>());
        RegisterUnlocked(new ConvexContainerTask<Triangle, TriangleWide, TContainer>());
        RegisterUnlocked(new ConvexContainerTask<Cylinder, CylinderWide, TContainer>());
        RegisterUnlocked(new ConvexContainerTask<ConvexHull, ConvexHullWide, TContainer>());
    }

    // Itself is among those that there are.
    void MeetOwn(OwnShapeType own)
    {
        foreach (var other in ownTypes)
            own.Meet(other, this);
    }

    bool TryAdd(OwnShapeType own)
    {
        OwnShapeChecks.TypeId(own.Type, own.TypeId);
        OwnShapeChecks.OneTypeOfAnId(own.Type, own.TypeId, own.ChildType, own.ChildTypeId);
        foreach (var other in ownTypes)
        {
            OwnShapeChecks.OneTypeOfAnId(own.Type, own.TypeId, other.Type, other.TypeId);
            OwnShapeChecks.OneTypeOfAnId(own.Type, own.TypeId, other.ChildType, other.ChildTypeId);
            OwnShapeChecks.OneTypeOfAnId(own.ChildType, own.ChildTypeId, other.Type, other.TypeId);
            OwnShapeChecks.OneTypeOfAnId(own.ChildType, own.ChildTypeId, other.ChildType, other.ChildTypeId);
            if (other.TypeId == own.TypeId)
                return false;
        }
        ownTypes = [.. ownTypes, own];
        return true;
    }

    /// <summary>Refuses shapes of another type than that which is registered by the same id: what tests the one would read the memory of the other.</summary>
    internal void CheckTypes(Shapes shapes)
    {
        foreach (var own in ownTypes)
        {
            if (shapes.FindBatch(own.TypeId) is { } batch)
                OwnShapeChecks.OneTypeOfAnId(batch.ShapeType, own.TypeId, own.Type, own.TypeId);
            if (shapes.FindBatch(own.ChildTypeId) is { } children)
                OwnShapeChecks.OneTypeOfAnId(children.ShapeType, own.ChildTypeId, own.ChildType, own.ChildTypeId);
        }
    }

    // What to do about a type that nothing is registered for.
    string Advise(int shapeType)
    {
        if (shapeType <= ShapeLimits.LastTypeId)
            return "";
        foreach (var own in ownTypes)
        {
            if (own.TypeId == shapeType)
                return "";
        }
        return $" Register the type of id {shapeType} before the first step, by {nameof(RegisterConvex)} or " +
            $"{nameof(RegisterHomogeneousCompound)} of {nameof(CollisionTaskRegistry)}.";
    }
}
