using BepuPhysics.Collidables;
using BepuPhysics.CollisionDetection;

namespace BepuPhysics;

// Pairs of which one shape at least is made of children.
public static partial class DefaultTypes
{
    static void RegisterContainers(CollisionTaskRegistry registry)
    {
        RegisterContainer<Compound>(registry);
        RegisterContainer<BigCompound>(registry);
        RegisterContainer<Mesh>(registry);
        registry.Register(new ContainerPairTask<Compound, Compound>());
        registry.Register(new ContainerPairTask<Compound, BigCompound>());
        registry.Register(new ContainerPairTask<BigCompound, BigCompound>());
        registry.Register(new ContainerPairTask<Compound, Mesh>());
        registry.Register(new ContainerPairTask<BigCompound, Mesh>());
        registry.Register(new ContainerPairTask<Mesh, Mesh>());
        RegisterContainer<HeightField>(registry);
        RegisterOnGround<Compound>(registry);
        RegisterOnGround<BigCompound>(registry);
        RegisterOnGround<Mesh>(registry);
    }

    // Of shapes for statics there are no pairs.
    static void RegisterOnGround<TContainer>(CollisionTaskRegistry registry) where TContainer : unmanaged, IContainer
    {
        registry.Register(new ContainerPairTask<TContainer, HeightField>());
        registry.Register(new ContainerPlaneTask<TContainer>());
    }

    static void RegisterContainer<TContainer>(CollisionTaskRegistry registry) where TContainer : unmanaged, IContainer
    {
        registry.Register(new ConvexContainerTask<Sphere, SphereWide, TContainer>());
        registry.Register(new ConvexContainerTask<Capsule, CapsuleWide, TContainer>());
        registry.Register(new ConvexContainerTask<Box, BoxWide, TContainer>());
        registry.Register(new ConvexContainerTask<Triangle, TriangleWide, TContainer>());
        registry.Register(new ConvexContainerTask<Cylinder, CylinderWide, TContainer>());
        registry.Register(new ConvexContainerTask<ConvexHull, ConvexHullWide, TContainer>());
    }
}
