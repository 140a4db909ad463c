using System;
using BepuPhysics.Collidables;
using BepuUtilities;

namespace BepuPhysics.CollisionDetection;

/// <summary>A type of shapes that a game has made, and how it meets others: of two such types each knows only its own shape at compile time.</summary>
abstract class OwnShapeType(Type type, int typeId)
{
    /// <summary>The type of the shapes.</summary>
    public Type Type { get; } = type;

    /// <summary>Its id.</summary>
    public int TypeId { get; } = typeId;

    /// <summary>Type of the children; its own where there are none.</summary>
    public virtual Type ChildType => Type;

    /// <summary>Its id.</summary>
    public virtual int ChildTypeId => TypeId;

    /// <summary>Registers what tests pairs of this type and another one that a game has made.</summary>
    public abstract void Meet(OwnShapeType other, CollisionTaskRegistry registry);

    /// <summary>Registers what tests pairs of this type and a convex type.</summary>
    public abstract void MeetConvex<TShape, TShapeWide, TSupport, TFeature>(CollisionTaskRegistry registry)
        where TShape : unmanaged, IConvexShape where TShapeWide : unmanaged, IShapeWide<TShape>
        where TSupport : unmanaged, ISupport<TShapeWide> where TFeature : unmanaged, IContactFeature<TShapeWide>;

    /// <summary>Registers what tests pairs of this type and a type that is made of children.</summary>
    public abstract void MeetContainer<TContainer>(CollisionTaskRegistry registry) where TContainer : unmanaged, IContainer;
}

/// <summary>A type whose shapes are made of children.</summary>
sealed class OwnContainerType<TContainer>(Type type, Type childType, int childTypeId) : OwnShapeType(type, TContainer.TypeId)
    where TContainer : unmanaged, IContainer
{
    public override Type ChildType => childType;

    public override int ChildTypeId => childTypeId;

    public override void Meet(OwnShapeType other, CollisionTaskRegistry registry) => other.MeetContainer<TContainer>(registry);

    // It has no nodes, so it is the first.
    public override void MeetContainer<TOther>(CollisionTaskRegistry registry) => registry.RegisterUnlocked(new ContainerPairTask<TContainer, TOther>());

    public override void MeetConvex<TShape, TShapeWide, TSupport, TFeature>(CollisionTaskRegistry registry) =>
        registry.RegisterUnlocked(new ConvexContainerTask<TShape, TShapeWide, TContainer>());
}

/// <summary>A type whose shapes are convex.</summary>
sealed class OwnConvexType<TShape, TShapeWide, TSupport, TFeature>() : OwnShapeType(typeof(TShape), TShape.TypeId)
    where TShape : unmanaged, IConvexShape where TShapeWide : unmanaged, IShapeWide<TShape>
    where TSupport : unmanaged, ISupport<TShapeWide> where TFeature : unmanaged, IContactFeature<TShapeWide>
{
    public override void Meet(OwnShapeType other, CollisionTaskRegistry registry) =>
        other.MeetConvex<TShape, TShapeWide, TSupport, TFeature>(registry);

    public override void MeetConvex<TOther, TOtherWide, TOtherSupport, TOtherFeature>(CollisionTaskRegistry registry) =>
        registry.RegisterUnlocked(new SearchCollisionTask<TOther, TOtherWide, TShape, TShapeWide, Few4<ContactWide>,
            SearchPairTester<TOtherWide, TOtherSupport, TOtherFeature, TShapeWide, TSupport, TFeature>>());

    public override void MeetContainer<TContainer>(CollisionTaskRegistry registry) =>
        registry.RegisterUnlocked(new ConvexContainerTask<TShape, TShapeWide, TContainer>());
}
