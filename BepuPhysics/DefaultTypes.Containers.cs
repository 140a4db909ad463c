using BepuPhysics.Collidables;
using BepuPhysics.CollisionDetection;

namespace BepuPhysics;

// Pairs of which one shape at least is made of children.
public static partial class DefaultTypes
{
    static void RegisterContainers(CollisionTaskRegistry registry)
    {
        registry.RegisterWithConvex<Compound>();
        registry.RegisterWithConvex<BigCompound>();
        registry.RegisterWithConvex<Mesh>();
        registry.Register(new ContainerPairTask<Compound, Compound>());
        registry.Register(new ContainerPairTask<Compound, BigCompound>());
        registry.Register(new ContainerPairTask<BigCompound, BigCompound>());
        registry.Register(new ContainerPairTask<Compound, Mesh>());
        registry.Register(new ContainerPairTask<BigCompound, Mesh>());
        registry.Register(new ContainerPairTask<Mesh, Mesh>());
        registry.RegisterWithConvex<HeightField>();
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
}
