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
        registry.Register(new ConvexCollisionTask<Box, BoxWide, Box, BoxWide, Few4<ContactWide>, BoxBoxTester>());
        return registry;
    }
}
