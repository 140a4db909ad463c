using BepuPhysics.Collidables;

namespace BepuPhysics.CollisionDetection;

/// <summary>The tasks that look at pairs along directions, for all pairs of the shapes that the library comes with.</summary>
// Made when the first pair of children, or the first body on several statics, asks for them: other worlds have none.
static class DirectedTasks
{
    /// <summary>The tasks; each is an <see cref="IDirectedTask"/>.</summary>
    public static readonly CollisionTaskRegistry Registry = Create();

    static CollisionTaskRegistry Create()
    {
        var registry = new CollisionTaskRegistry();
        RegisterAll<Sphere, SphereWide, SphereSupport, SphereFeature>(registry);
        RegisterAll<Capsule, CapsuleWide, CapsuleSupport, CapsuleFeature>(registry);
        RegisterAll<Box, BoxWide, BoxSupport, BoxFeature>(registry);
        RegisterAll<Triangle, TriangleWide, TriangleSupport, TriangleFeature>(registry);
        RegisterAll<Cylinder, CylinderWide, CylinderSupport, CylinderFeature>(registry);
        RegisterAll<ConvexHull, ConvexHullWide, ConvexHullSupport, StandingHullFeature>(registry);
        return registry;
    }

    static void RegisterAll<TShape, TShapeWide, TSupport, TFeature>(CollisionTaskRegistry registry)
        where TShape : unmanaged, IConvexShape where TShapeWide : unmanaged, IShapeWide<TShape>
        where TSupport : unmanaged, ISupport<TShapeWide> where TFeature : unmanaged, IContactFeature<TShapeWide>
    {
        Register<TShape, TShapeWide, TSupport, TFeature, Sphere, SphereWide, SphereSupport, SphereFeature>(registry);
        Register<TShape, TShapeWide, TSupport, TFeature, Capsule, CapsuleWide, CapsuleSupport, CapsuleFeature>(registry);
        Register<TShape, TShapeWide, TSupport, TFeature, Box, BoxWide, BoxSupport, BoxFeature>(registry);
        Register<TShape, TShapeWide, TSupport, TFeature, Triangle, TriangleWide, TriangleSupport, TriangleFeature>(registry);
        Register<TShape, TShapeWide, TSupport, TFeature, Cylinder, CylinderWide, CylinderSupport, CylinderFeature>(registry);
        Register<TShape, TShapeWide, TSupport, TFeature, ConvexHull, ConvexHullWide, ConvexHullSupport, StandingHullFeature>(registry);
    }

    // The shape of the lower type id first, as everywhere.
    static void Register<TShapeA, TShapeWideA, TSupportA, TFeatureA, TShapeB, TShapeWideB, TSupportB, TFeatureB>(CollisionTaskRegistry registry)
        where TShapeA : unmanaged, IConvexShape where TShapeWideA : unmanaged, IShapeWide<TShapeA>
        where TSupportA : unmanaged, ISupport<TShapeWideA> where TFeatureA : unmanaged, IContactFeature<TShapeWideA>
        where TShapeB : unmanaged, IConvexShape where TShapeWideB : unmanaged, IShapeWide<TShapeB>
        where TSupportB : unmanaged, ISupport<TShapeWideB> where TFeatureB : unmanaged, IContactFeature<TShapeWideB>
    {
        if (TShapeA.TypeId <= TShapeB.TypeId)
            registry.Register(new DirectedTask<TShapeA, TShapeWideA, TSupportA, TFeatureA, TShapeB, TShapeWideB, TSupportB, TFeatureB>());
    }
}
