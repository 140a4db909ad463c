using BepuPhysics.Collidables;
using BepuPhysics.CollisionDetection;
using BepuUtilities;

namespace BepuPhysics;

/// <summary>Registers the types that the library comes with.</summary>
public static partial class DefaultTypes
{
    /// <summary>Creates a registry with the tests of all pairs of shapes that the library comes with.</summary>
    public static CollisionTaskRegistry CreateDefaultCollisionTaskRegistry()
    {
        var registry = new CollisionTaskRegistry();
        registry.Register(new ConvexCollisionTask<Sphere, SphereWide, Sphere, SphereWide, Few1<ContactWide>, SphereSphereTester>());
        registry.Register(new ConvexCollisionTask<Sphere, SphereWide, Capsule, CapsuleWide, Few1<ContactWide>, SphereCapsuleTester>());
        registry.Register(new ConvexCollisionTask<Sphere, SphereWide, Box, BoxWide, Few1<ContactWide>, SphereBoxTester>());
        registry.Register(new ConvexCollisionTask<Sphere, SphereWide, Triangle, TriangleWide, Few1<ContactWide>, SphereTriangleTester>());
        registry.Register(new ConvexCollisionTask<Sphere, SphereWide, Cylinder, CylinderWide, Few1<ContactWide>, SphereCylinderTester>());
        registry.Register(new ConvexCollisionTask<Capsule, CapsuleWide, Capsule, CapsuleWide, Few2<ContactWide>, CapsuleCapsuleTester>());
        registry.Register(new ConvexCollisionTask<Capsule, CapsuleWide, Box, BoxWide, Few2<ContactWide>, CapsuleBoxTester>());
        registry.Register(new ConvexCollisionTask<Capsule, CapsuleWide, Triangle, TriangleWide, Few2<ContactWide>, CapsuleTriangleTester>());
        registry.Register(new ConvexCollisionTask<Capsule, CapsuleWide, Cylinder, CylinderWide, Few2<ContactWide>, CapsuleCylinderTester>());
        registry.Register(new ConvexCollisionTask<Box, BoxWide, Box, BoxWide, Few4<ContactWide>, BoxBoxTester>());
        registry.Register(new ConvexCollisionTask<Box, BoxWide, Triangle, TriangleWide, Few4<ContactWide>, BoxTriangleTester>());
        registry.Register(new ConvexCollisionTask<Triangle, TriangleWide, Triangle, TriangleWide, Few4<ContactWide>, TriangleTriangleTester>());
        RegisterSearches(registry);
        RegisterHalfSpaces(registry);
        RegisterContainers(registry);
        return registry;
    }

    static void RegisterHalfSpaces(CollisionTaskRegistry registry)
    {
        registry.Register(new ConvexCollisionTask<Sphere, SphereWide, HalfSpace, HalfSpaceWide, Few1<ContactWide>,
            HalfSpaceTester<SphereWide, SphereFeature, Few1<ContactWide>>>());
        registry.Register(new ConvexCollisionTask<Capsule, CapsuleWide, HalfSpace, HalfSpaceWide, Few2<ContactWide>,
            HalfSpaceTester<CapsuleWide, CapsuleFeature, Few2<ContactWide>>>());
        registry.Register(new ConvexCollisionTask<Box, BoxWide, HalfSpace, HalfSpaceWide, Few4<ContactWide>,
            HalfSpaceTester<BoxWide, BoxFeature, Few4<ContactWide>>>());
        registry.Register(new ConvexCollisionTask<Triangle, TriangleWide, HalfSpace, HalfSpaceWide, Few3<ContactWide>,
            HalfSpaceTester<TriangleWide, TriangleFeature, Few3<ContactWide>>>());
        registry.Register(new SearchCollisionTask<Cylinder, CylinderWide, HalfSpace, HalfSpaceWide, Few4<ContactWide>,
            HalfSpaceFaceTester<CylinderWide, CylinderSupport, CylinderFeature>>());
        registry.Register(new SearchCollisionTask<ConvexHull, ConvexHullWide, HalfSpace, HalfSpaceWide, Few4<ContactWide>,
            HalfSpaceFaceTester<ConvexHullWide, ConvexHullSupport, StandingHullFeature>>());
    }

    // The pairs for which no closed form is cheaper than the search.
    static void RegisterSearches(CollisionTaskRegistry registry)
    {
        Register<Sphere, SphereWide, SphereSupport, SphereFeature, ConvexHull, ConvexHullWide, ConvexHullSupport, ConvexHullFeature>(registry);
        Register<Capsule, CapsuleWide, CapsuleSupport, CapsuleFeature, ConvexHull, ConvexHullWide, ConvexHullSupport, ConvexHullFeature>(registry);
        Register<Box, BoxWide, BoxSupport, BoxFeature, Cylinder, CylinderWide, CylinderSupport, CylinderFeature>(registry);
        Register<Box, BoxWide, BoxSupport, BoxFeature, ConvexHull, ConvexHullWide, ConvexHullSupport, StandingHullFeature>(registry);
        Register<Triangle, TriangleWide, TriangleSupport, TriangleFeature, Cylinder, CylinderWide, CylinderSupport, CylinderFeature>(registry);
        Register<Triangle, TriangleWide, TriangleSupport, TriangleFeature, ConvexHull, ConvexHullWide, ConvexHullSupport, StandingHullFeature>(registry);
        Register<Cylinder, CylinderWide, CylinderSupport, CylinderFeature, Cylinder, CylinderWide, CylinderSupport, CylinderFeature>(registry);
        Register<Cylinder, CylinderWide, CylinderSupport, CylinderFeature, ConvexHull, ConvexHullWide, ConvexHullSupport, ConvexHullFeature>(registry);
        Register<ConvexHull, ConvexHullWide, ConvexHullSupport, ConvexHullFeature, ConvexHull, ConvexHullWide, ConvexHullSupport, ConvexHullFeature>(registry);
    }

    static void Register<TShapeA, TShapeWideA, TSupportA, TFeatureA, TShapeB, TShapeWideB, TSupportB, TFeatureB>(CollisionTaskRegistry registry)
        where TShapeA : unmanaged, IConvexShape where TShapeWideA : unmanaged, IShapeWide<TShapeA>
        where TSupportA : unmanaged, ISupport<TShapeWideA> where TFeatureA : unmanaged, IContactFeature<TShapeWideA>
        where TShapeB : unmanaged, IConvexShape where TShapeWideB : unmanaged, IShapeWide<TShapeB>
        where TSupportB : unmanaged, ISupport<TShapeWideB> where TFeatureB : unmanaged, IContactFeature<TShapeWideB> =>
        registry.Register(new SearchCollisionTask<TShapeA, TShapeWideA, TShapeB, TShapeWideB, Few4<ContactWide>,
            SearchPairTester<TShapeWideA, TSupportA, TFeatureA, TShapeWideB, TSupportB, TFeatureB>>());
}
